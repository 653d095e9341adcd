//! `svbrdf view`: the window.

use std::path::PathBuf;

#[cfg(feature = "viewer")]
use svbrdf_core::loss::FileScenes;
#[cfg(feature = "viewer")]
use svbrdf_core::model::scene::Scene;
#[cfg(feature = "viewer")]
use svbrdf_files::Error;
use svbrdf_files::photograph::Capture;
#[cfg(feature = "viewer")]
use svbrdf_files::photograph::SessionPhotograph;
use svbrdf_files::scene_file;
use svbrdf_files::session::Session;

use super::args::photograph::{PhotoReadingArgs, PhotoSceneArgs};
use super::args::{Given, MaterialArgs, refuse};
use super::job::{Job, NewJob};
use super::output::CommandError;
use super::output::exit::tell;

#[derive(Debug, clap::Args)]
#[command(mut_arg("predictions", |arg| arg.help("Predictions of it, of the same size. A scene file (JSON) among them has the \
    scenes of the loss")))]
#[cfg_attr(not(feature = "viewer"), allow(dead_code, reason = "there is no window to open"))]
pub struct ViewArgs {
    /// Compares renderings with this photograph, in the place of the ground truth; or with those of a capture: its folder, or the
    /// file that lists them
    #[arg(long, value_name = "FILE")]
    photo: Option<PathBuf>,

    #[command(flatten)]
    photo_scene: PhotoSceneArgs,

    #[command(flatten)]
    photo_reading: PhotoReadingArgs,

    #[command(flatten)]
    materials: MaterialArgs,
}

impl ViewArgs {
    #[cfg_attr(not(feature = "viewer"), allow(unused_mut, reason = "there is no window to open"))]
    pub fn job(mut self, given: &Given) -> NewJob {
        let materials = &self.materials;
        refuse(materials.reading.both.verbose, "verbose", "the window lists what is noticed and assumed")?;
        match materials.paths().find(|path| !scene_file::is_named(path)) {
            None => materials.refuse_of_built_in(given)?,
            Some(path) if Session::is_named(path) => materials.refuse_of_session(given)?,
            Some(_) => (),
        }
        if self.photo.as_deref().is_some_and(Capture::is_named) {
            let reason = "a capture lists the lights and views of its photographs, and how they are read";
            given.refuse::<PhotoSceneArgs>(reason)?;
            given.refuse::<PhotoReadingArgs>(reason)?;
        }
        Ok(Box::new(ViewJob {
            #[cfg(feature = "viewer")]
            options: self.options()?,
        }))
    }
}

#[derive(Debug)]
struct ViewJob {
    #[cfg(feature = "viewer")]
    options: svbrdf::ViewerOptions,
}

/// Opens the window and returns when it is closed.
impl Job for ViewJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
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
        let photograph = photograph_of(self)?;
        let materials = &mut self.materials;
        let scenes = take_scenes(materials)?;
        let session = session::given(materials)?;
        let has_sources = session.is_none() && materials.ground_truth.is_some();
        let mut sources = if has_sources { materials.sources()? } else { Vec::new() }.into_iter();
        Ok(svbrdf::ViewerOptions {
            session,
            photograph,
            scenes,
            strict: materials.reading.both.strict,
            fit,
            ground_truth: sources.next(),
            predictions: sources.collect(),
        })
    }
}

/// The photograph, and its light and view where they are specified.
#[cfg(feature = "viewer")]
fn photograph_of(args: &ViewArgs) -> Result<Option<(SessionPhotograph, Option<Scene>)>, Error> {
    let photograph = args.photo.clone().map(|path| args.photo_reading.photograph(path));
    let opened =
        photograph.map(|one| scene_file::open_photograph(one, args.photo_scene.specified().as_ref()));
    opened.transpose()
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
