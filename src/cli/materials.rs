//! The materials that a subcommand opens, and how their files are read.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use svbrdf::error::Error;
use svbrdf::material::Material;
use svbrdf::material::read::{
    self, Albedo, Binding, Energy, Grid, NonFinite, NormalCode, NormalY, Order, Preset, Read, ReadOptions,
    Reflectance, Roughness, Workflow,
};
use svbrdf::real::Real;
use svbrdf::samples;

use super::bar::watched;
use super::exit::tell;

#[derive(Debug, clap::Args)]
pub struct MaterialArgs {
    /// Ground truth: a packed or layered image, a folder, a name prefix; without one, the built-in materials
    #[arg(value_name = "GT")]
    pub ground_truth: Option<PathBuf>,

    /// Predictions of it, of the same size
    #[arg(value_name = "PRED")]
    pub predictions: Vec<PathBuf>,

    #[command(flatten)]
    pub reading: Reading,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Reading materials")]
pub struct Reading {
    #[command(flatten)]
    both: ReadingArgs,

    /// The same as --albedo for the ground truth only
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    gt_albedo: Option<Albedo>,

    /// The same as --albedo for the predictions only
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    pred_albedo: Option<Albedo>,

    /// Resizes materials of differing sizes: to that of the ground truth, of the first prediction, or N wide
    #[arg(long, value_name = "gt|pred|N", requires = "ground_truth")]
    resize_to: Option<ResizeTo>,
}

/// How one material is read. What is left out is found out from the files, and said.
#[derive(Clone, Copy, Debug, clap::Args)]
#[command(next_help_heading = "Reading materials")]
pub struct ReadingArgs {
    /// What a source of materials does, for all that the other options leave open
    #[arg(long, value_name = "NAME", requires = "ground_truth", long_help = preset_help())]
    preset: Option<Preset>,

    /// How diffuse, base colour and specular are stored [default: found out]
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    albedo: Option<Albedo>,

    /// How specular is stored where that differs
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    specular_albedo: Option<Albedo>,

    /// Where the green of normal maps points [default: found out]
    #[arg(long, value_name = "up|down", requires = "ground_truth")]
    normal_y: Option<NormalY>,

    /// What roughness values mean [default: found out]
    #[arg(long, value_name = "r|gloss|alpha|axay|gamma2.2", requires = "ground_truth")]
    roughness: Option<Roughness>,

    /// How the components of normals are stored [default: found out]
    #[arg(long, value_name = "unsigned|signed|xy|ag", requires = "ground_truth")]
    normal_code: Option<NormalCode>,

    /// Diffuse and specular, or base colour and metallic [default: by the maps that are there]
    #[arg(long, value_name = "specular|metallic", requires = "ground_truth")]
    workflow: Option<Workflow>,

    /// Reflectance of what is no metal, where no map says it [default: 0.04]
    #[arg(long, value_name = "F0", requires = "ground_truth")]
    dielectric_f0: Option<Reflectance>,

    /// What the renderer that diffuse was made for takes: d (1 - s), as ours, or plain d [default: deschaintre]
    #[arg(long, value_name = "deschaintre|plain", requires = "ground_truth")]
    energy: Option<Energy>,

    /// Order of the tiles of a packed image, a letter each: ndrs, dnrs, dsrn, ... [default: found out]
    #[arg(long, value_name = "LETTERS", requires = "ground_truth")]
    order: Option<Order>,

    /// How a packed image is divided [default: into square tiles]
    #[arg(long, value_name = "COLUMNSxROWS", requires = "ground_truth")]
    grid: Option<Grid>,

    /// Row 0 of every picture is the lowest one
    #[arg(long, value_name = "true|false", requires = "ground_truth")]
    #[arg(num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    flip_v: Option<bool>,

    /// Which row of a packed image, or which material of a file of several, from 0 [default: 0]
    #[arg(long, value_name = "K", requires = "ground_truth")]
    exemplar: Option<usize>,

    /// What becomes of NaN and infinity [default: refuse]
    #[arg(long, value_name = "refuse|replace", requires = "ground_truth")]
    non_finite: Option<NonFinite>,

    /// Fails where something could only be guessed
    #[arg(long, requires = "ground_truth")]
    strict: bool,
}

impl ReadingArgs {
    pub fn options(&self) -> ReadOptions {
        ReadOptions {
            preset: self.preset,
            albedo: self.albedo,
            specular: self.specular_albedo,
            normal_y: self.normal_y,
            normal_code: self.normal_code,
            roughness: self.roughness,
            workflow: self.workflow,
            dielectric: self.dielectric_f0,
            energy: self.energy,
            order: self.order,
            grid: self.grid,
            exemplar: self.exemplar,
            flip_v: self.flip_v,
            non_finite: self.non_finite,
        }
    }

    /// Refuses guesses where the user wants none.
    ///
    /// # Errors
    /// [`Error::Guessed`].
    pub fn check<T>(&self, path: &Path, read: &Read<T>) -> Result<(), Error> {
        if self.strict { read.refuse_guesses(path) } else { Ok(()) }
    }
}

impl Reading {
    /// Whether guesses are errors.
    pub fn is_strict(&self) -> bool {
        self.both.strict
    }

    /// The size that all are brought to; `None`: each keeps its own.
    pub fn resize_to(&self) -> Option<ResizeTo> {
        self.resize_to
    }

    pub fn of_ground_truth(&self) -> ReadOptions {
        self.with_albedo(self.gt_albedo)
    }

    pub fn of_predictions(&self) -> ReadOptions {
        self.with_albedo(self.pred_albedo)
    }

    fn with_albedo(&self, albedo: Option<Albedo>) -> ReadOptions {
        let options = self.both.options();
        ReadOptions { albedo: albedo.or(options.albedo), ..options }
    }
}

fn preset_help() -> String {
    let known = Preset::ALL.map(Preset::name).join(", ");
    format!("What a source of materials does, for all that the other options leave open: {known}")
}

/// The size that materials are brought to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResizeTo {
    GroundTruth,
    Prediction,
    /// This many texels wide, as high as its shape wants.
    Width(usize),
}

impl FromStr for ResizeTo {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match (text, text.parse()) {
            ("gt", _) => Ok(Self::GroundTruth),
            ("pred", _) => Ok(Self::Prediction),
            (_, Ok(width @ 1..=16_384)) => Ok(Self::Width(width)),
            _ => Err("expected gt, pred or a width from 1 to 16384".to_owned()),
        }
    }
}

/// The ground truth and its predictions.
#[derive(Debug)]
pub struct Opened<T> {
    pub ground_truth: Material<T>,
    pub predictions: Vec<Material<T>>,
}

impl<T> Opened<T> {
    /// The ground truth, then the predictions.
    pub fn into_all(self) -> Vec<Material<T>> {
        std::iter::once(self.ground_truth).chain(self.predictions).collect()
    }
}

/// Opens the materials of the command line, or the built-in ones where it names none.
///
/// # Errors
/// Those of the reader.
pub fn open<T: Real>(args: &MaterialArgs) -> Result<Opened<T>, Error> {
    let Some(ground_truth) = &args.ground_truth else {
        let built_in = samples::load()?;
        return Ok(Opened {
            ground_truth: built_in.ground_truth.material,
            predictions: built_in.predictions.into_iter().map(|read| read.material).collect(),
        });
    };
    let one = |path: &Path, options: &ReadOptions| open_one(path, options, &args.reading.both);
    let ground_truth = one(ground_truth, &args.reading.of_ground_truth())?;
    let options = args.reading.of_predictions();
    let predictions = args.predictions.iter().map(|path| one(path, &options));
    let opened = Opened { ground_truth, predictions: predictions.collect::<Result<_, _>>()? };
    match args.reading.resize_to {
        Some(to) => resized(opened, to),
        None => Ok(opened),
    }
}

/// Every material in one size.
fn resized<T: Real>(opened: Opened<T>, to: ResizeTo) -> Result<Opened<T>, Error> {
    let [w, h] = match (to, opened.predictions.first()) {
        (ResizeTo::Prediction, Some(prediction)) => prediction.size(),
        _ => opened.ground_truth.size(),
    };
    let size = match to {
        ResizeTo::Width(width) => [width, (h * width + w / 2).checked_div(w).unwrap_or(1).max(1)],
        _ => [w, h],
    };
    let bring = |material: Material<T>| {
        if material.size() != size {
            let [w, h] = material.size();
            tell(&format!(
                "note: {} is resized from {w} x {h} to {} x {}",
                material.name(),
                size[0],
                size[1]
            ));
        }
        material.resized(size)
    };
    let predictions = opened.predictions.into_iter().map(bring).collect::<Result<_, _>>()?;
    Ok(Opened { ground_truth: bring(opened.ground_truth)?, predictions })
}

fn open_one<T: Real>(path: &Path, options: &ReadOptions, args: &ReadingArgs) -> Result<Material<T>, Error> {
    let read = read_one(path, &[], options)?;
    args.check(path, &read)?;
    Ok(noted(read))
}

/// Reads one material under a progress bar, with the maps of `bindings` in the place of its own.
///
/// # Errors
/// Those of the reader.
pub fn read_one<T: Real>(path: &Path, bindings: &[Binding], options: &ReadOptions) -> Result<Read<T>, Error> {
    watched(&format!("reading {}", path.display()), |progress| {
        read::read_bound(path, bindings, options, progress)
    })
}

/// The material, after what there is to say about its files.
pub fn noted<T>(read: Read<T>) -> Material<T> {
    for note in read.said() {
        tell(&format!("note: {note}"));
    }
    read.material
}
