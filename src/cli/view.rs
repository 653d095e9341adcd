//! `svbrdf view`: the window.

use std::path::PathBuf;

#[cfg(feature = "viewer")]
use svbrdf_core::loss::FileScenes;
#[cfg(feature = "viewer")]
use svbrdf_evaluate::dataset::{DatasetReading, decided};
#[cfg(feature = "viewer")]
use svbrdf_files::Error;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::scene_file;
use svbrdf_files::session::Session;

use super::args::protocol::MaskArgs;
use super::args::scenes::{Accuracy, SceneArgs};
use super::args::{MaterialArgs, Specified, refuse};
use super::job::{Job, NewJob};
use super::output::CommandError;
use super::output::exit::tell;
#[cfg(feature = "viewer")]
use super::rank::cases;

#[derive(Debug, clap::Args)]
#[command(mut_arg("predictions", |arg| arg.help("Predictions of it, of the same size. A scene file (JSON) among them has the \
    scenes of the loss")))]
#[cfg_attr(not(feature = "viewer"), allow(dead_code, reason = "there is no window to open"))]
pub struct ViewArgs {
    /// Rectified photograph in the place of the ground truth, or a folder of them, or the file that lists them
    #[arg(long, value_name = "FILE")]
    photo: Option<PathBuf>,

    #[command(flatten)]
    dataset: DatasetArgs,

    #[command(flatten)]
    mask: MaskArgs,

    /// Convention of renderings and losses: a name, which `svbrdf conventions` lists, or a .toml file [default: printed, or as in the
    /// session]
    #[arg(long, value_name = "NAME", value_parser = ChosenConvention::read)]
    convention: Option<ChosenConvention>,

    /// Graphics adapter whose name has this part, of those that `svbrdf adapters` lists
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,

    #[command(flatten)]
    materials: MaterialArgs,
}

/// A data set in the window.
#[derive(Debug, clap::Args)]
#[cfg_attr(not(feature = "viewer"), allow(dead_code, reason = "there is no window to open"))]
pub struct DatasetArgs {
    /// GT is a folder of ground truths, and every PRED that of a method
    ///
    /// Materials are matched by name, as `svbrdf rank --dataset` does.
    #[arg(long, requires = "ground_truth", conflicts_with_all = ["pairs", "photo"])]
    dataset: bool,

    /// GT is a CSV table of pairs
    #[arg(long, requires = "ground_truth", conflicts_with = "photo")]
    pairs: bool,

    /// Uses the losses of a data set, or of that of a session, that are in this folder, and adds the others to it as they come
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,

    /// Computes the floor of every ground truth, too, as `svbrdf rank --diagnose` does: losses below it are not resolvable
    #[arg(long)]
    diagnose: bool,

    #[command(flatten)]
    accuracy: SceneArgs<Accuracy>,
}

const ONLY_OF_DATASET: &str =
    "only the losses of a data set (--dataset, --pairs) are kept and asked for here";

impl ViewArgs {
    #[cfg_attr(not(feature = "viewer"), allow(unused_mut, reason = "there is no window to open"))]
    pub fn job(mut self, given: &Specified) -> NewJob {
        let materials = &self.materials;
        let is_dataset = self.dataset.dataset || self.dataset.pairs;
        let paths: Vec<_> = materials.paths().filter(|path| !scene_file::is_named(path)).collect();
        let is_session = !is_dataset && Session::is_among(&paths);
        if !is_dataset {
            refuse(self.dataset.diagnose, "diagnose", ONLY_OF_DATASET)?;
            let reason = "the window registers the predictions of data sets (--dataset, --pairs) alone";
            refuse(!materials.reading.register.is_empty(), "register", reason)?;
            given.refuse::<SceneArgs<Accuracy>>(ONLY_OF_DATASET)?;
            refuse(self.dataset.results.is_some() && !is_session, "results", ONLY_OF_DATASET)?;
        }
        let reason = "the window compares the texels of a mask of one material, and of data sets and photographs all texels";
        refuse(self.mask.mask.is_some() && (is_dataset || self.photo.is_some()), "mask", reason)?;
        refuse(materials.reading.both.verbose, "verbose", "the window lists what is noticed and assumed")?;
        if paths.is_empty() {
            materials.refuse_of_built_in(given)?;
        } else if is_session {
            materials.refuse_of_session(given)?;
        }
        Ok(Box::new(ViewJob {
            #[cfg(feature = "viewer")]
            adapter: self.adapter.take(),
            #[cfg(feature = "viewer")]
            options: self.options()?,
        }))
    }
}

#[derive(Debug)]
struct ViewJob {
    /// A part of the name of the graphics adapter.
    #[cfg(feature = "viewer")]
    adapter: Option<String>,
    #[cfg(feature = "viewer")]
    options: svbrdf::ViewerOptions,
}

/// Opens the window and returns when it is closed.
impl Job for ViewJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        #[cfg(feature = "viewer")]
        self.adapter.into_iter().for_each(svbrdf_gpu::choice::name);
        #[cfg(feature = "viewer")]
        let closed = svbrdf::open_viewer(self.options).map_err(CommandError::from);
        #[cfg(not(feature = "viewer"))]
        let closed = Err(CommandError::NoWindow);
        closed.inspect_err(|error| {
            if error.is_without_graphics() {
                tell("note: `svbrdf loss` and `svbrdf render` work without a window");
            }
        })
    }
}

#[cfg(feature = "viewer")]
impl ViewArgs {
    fn options(&mut self) -> Result<svbrdf::ViewerOptions, CommandError> {
        use super::args::reading::ResizeTo;
        use super::job::session;

        let fit = match self.materials.reading.resize_to {
            None => false,
            Some(ResizeTo::GroundTruth) => true,
            Some(_) => {
                return Err(CommandError::usage(
                    "the window brings predictions to the size of the ground truth only (--resize-to gt); \
                     `svbrdf convert` writes a material of any size",
                ));
            }
        };
        if self.dataset.dataset || self.dataset.pairs {
            let strict = self.materials.reading.both.strict;
            let (dataset, convention) = (Some(Box::new(dataset_of(self)?)), self.convention.clone());
            return Ok(svbrdf::ViewerOptions { dataset, convention, strict, ..Default::default() });
        }
        let materials = &mut self.materials;
        let scenes = take_scenes(materials)?;
        let mut session = session::given(materials)?;
        if let (Some(session), Some(mask)) = (&mut session, &self.mask.mask) {
            session.mask = Some(mask.to_string().into());
        }
        let results = self.dataset.results.take();
        let is_of_dataset = session.as_ref().is_some_and(|session| session.dataset.is_some());
        refuse(results.is_some() && !is_of_dataset, "results", ONLY_OF_DATASET)?;
        let has_sources = session.is_none() && materials.ground_truth.is_some();
        let mut sources = if has_sources { materials.sources()? } else { Vec::new() }.into_iter();
        Ok(svbrdf::ViewerOptions {
            session,
            photograph: self.photo.take(),
            convention: self.convention.clone(),
            scenes,
            strict: materials.reading.both.strict,
            fit,
            mask: self.mask.mask.take(),
            ground_truth: sources.next(),
            predictions: sources.collect(),
            dataset: None,
            results,
        })
    }
}

/// The data set, matched by name.
#[cfg(feature = "viewer")]
fn dataset_of(args: &ViewArgs) -> Result<svbrdf::OpenDataset, CommandError> {
    let DatasetArgs { pairs, results, diagnose, accuracy, .. } = &args.dataset;
    let source = cases::source(&args.materials, *pairs)?;
    let request = accuracy.options()?.request()?;
    let mut dataset = svbrdf::OpenDataset::new(source, DatasetReading::default(), request, results.clone())?;
    dataset.settings.diagnose = *diagnose;
    let reading = cases::reading(&args.materials.reading, dataset.methods())?;
    dataset.reading = decided(&dataset.cases, reading, &svbrdf_core::progress::Progress::default())?;
    Ok(dataset)
}

/// Takes the scene file out of `materials`, and reads it.
#[cfg(feature = "viewer")]
fn take_scenes(materials: &mut MaterialArgs) -> Result<Option<FileScenes>, Error> {
    let all = materials.ground_truth.take().into_iter().chain(std::mem::take(&mut materials.predictions));
    let (files, others): (Vec<_>, Vec<_>) = all.partition(|given| scene_file::is_named(&given.path));
    let mut others = others.into_iter();
    materials.ground_truth = others.next();
    materials.predictions = others.collect();
    let files: Vec<_> = files.into_iter().map(|given| given.path).collect();
    scene_file::read_one(&files)
}
