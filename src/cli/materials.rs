//! The materials that a subcommand opens, and how their files are read.

use std::path::{Path, PathBuf};

use svbrdf::error::Error;
use svbrdf::material::Material;
use svbrdf::material::read::{self, Albedo, NormalY, Read, ReadOptions};
use svbrdf::real::Real;
use svbrdf::samples;

use super::bar::watched;
use super::exit::tell;

#[derive(Debug, clap::Args)]
pub struct MaterialArgs {
    /// Ground truth: a packed strip, a folder or a name prefix; without one, the built-in materials
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
    /// How diffuse and specular are stored
    #[arg(long, value_name = "linear|srgb|gamma2.2", requires = "ground_truth",
        default_value_t = ReadOptions::default().albedo)]
    albedo: Albedo,

    /// The same for the ground truth only
    #[arg(long, value_name = "linear|srgb|gamma2.2", requires = "ground_truth")]
    gt_albedo: Option<Albedo>,

    /// The same for the predictions only
    #[arg(long, value_name = "linear|srgb|gamma2.2", requires = "ground_truth")]
    pred_albedo: Option<Albedo>,

    /// Where the green of normal maps points
    #[arg(long, value_name = "up|down", requires = "ground_truth",
        default_value_t = ReadOptions::default().normal_y)]
    normal_y: NormalY,
}

impl Reading {
    pub fn of_ground_truth(&self) -> ReadOptions {
        self.with_albedo(self.gt_albedo)
    }

    pub fn of_predictions(&self) -> ReadOptions {
        self.with_albedo(self.pred_albedo)
    }

    fn with_albedo(&self, albedo: Option<Albedo>) -> ReadOptions {
        ReadOptions { albedo: albedo.unwrap_or(self.albedo), normal_y: self.normal_y }
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
    let ground_truth = open_one(ground_truth, &args.reading.of_ground_truth())?;
    let options = args.reading.of_predictions();
    let predictions = args.predictions.iter().map(|path| open_one(path, &options));
    Ok(Opened { ground_truth, predictions: predictions.collect::<Result<_, _>>()? })
}

fn open_one<T: Real>(path: &Path, options: &ReadOptions) -> Result<Material<T>, Error> {
    let what = format!("reading {}", path.display());
    watched(&what, |progress| read::read(path, options, progress)).map(noted)
}

/// The material, after what there is to say about its files.
fn noted<T: Real>(read: Read<T>) -> Material<T> {
    for note in &read.notes {
        tell(&format!("note: {}: {note}", read.material.name()));
    }
    read.material
}
