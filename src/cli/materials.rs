//! The materials that a subcommand opens.

use std::path::{Path, PathBuf};

use svbrdf::error::Error;
use svbrdf::files::read::{self, Binding, Read, ReadOptions};
use svbrdf::files::session::{Session, SessionMaterial};
use svbrdf::files::steps::runs_in;
use svbrdf::material::Material;
use svbrdf::math::real::Real;
use svbrdf::report::distinct_names;
use svbrdf::samples;

use super::bar::watched;
use super::exit::tell;
use super::reading::{PairReadingArgs, ResizeTo};

/// Longest side of a material that is resized, as of one that is read.
const MAX_SIDE: usize = 16_384;
/// Most bytes of one, as of one that is read.
const MAX_BYTES: usize = 4 << 30;

#[derive(Debug, clap::Args)]
pub struct MaterialArgs {
    /// Ground truth: a packed or layered image, a folder, a name prefix, or a session file of the window with its
    /// predictions; without one, the built-in materials
    #[arg(value_name = "GT")]
    pub ground_truth: Option<PathBuf>,

    /// Predictions of it, of the same size
    #[arg(value_name = "PRED")]
    pub predictions: Vec<PathBuf>,

    #[command(flatten)]
    pub reading: PairReadingArgs,
}

impl MaterialArgs {
    /// Puts the steps of training runs in the place of each prediction that is a folder of them. Returns the number of the step of
    /// each prediction.
    ///
    /// # Errors
    /// Where a folder cannot be listed.
    pub fn expand_steps(&mut self) -> Result<Vec<Option<u64>>, Error> {
        let mut expanded = Vec::new();
        for path in std::mem::take(&mut self.predictions) {
            let runs = if path.is_dir() { runs_in(&path)? } else { Vec::new() };
            if runs.is_empty() {
                expanded.push((path, None));
            }
            let steps = runs.into_iter().flat_map(|run| run.steps);
            expanded.extend(steps.map(|step| (step.path, Some(step.number))));
        }
        let (paths, steps) = expanded.into_iter().unzip();
        self.predictions = paths;
        Ok(steps)
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

/// Opens the materials of the command line under distinct names, or the built-in ones where it names none.
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
    if Session::is_named(ground_truth) {
        return open_session(args, ground_truth);
    }
    let paths: Vec<&Path> = std::iter::once(ground_truth).chain(&args.predictions).map(|p| &**p).collect();
    let options = [args.reading.of_ground_truth(), args.reading.of_predictions()];
    let one = |(index, path): (usize, &&Path)| -> Result<Read<T>, Error> {
        let read = read_one(path, &[], &options[index.min(1)])?;
        args.reading.both.check(path, &read)?;
        Ok(read)
    };
    let read = paths.iter().enumerate().map(one).collect::<Result<Vec<_>, _>>()?;
    let named: Vec<_> = read.iter().map(|read| read.material.name()).zip(paths).collect();
    let named = distinct_names(&named).into_iter().zip(read);
    let mut materials = named.map(|(name, read)| {
        let material = read.material.renamed(name);
        args.reading.both.noted(Read { material, ..read })
    });
    // There is one for each path.
    let Some(ground_truth) = materials.next() else {
        return Err(Error::Internal("there is no ground truth".to_owned()));
    };
    let opened = Opened { ground_truth, predictions: materials.collect() };
    match args.reading.resize_to {
        Some(to) => resized(opened, to),
        None => Ok(opened),
    }
}

/// The materials of a session file, as it reads them.
fn open_session<T: Real>(args: &MaterialArgs, path: &Path) -> Result<Opened<T>, Error> {
    if !args.predictions.is_empty() {
        return Err(Error::Usage("a session names its predictions itself; give it alone".to_owned()));
    }
    let entries = Session::read(path)?.materials;
    let one = |entry: &SessionMaterial| -> Result<Read<T>, Error> {
        let read = match (&entry.path, entry.built_in) {
            (Some(path), _) => {
                let text = format!("reading {}", path.display());
                watched(&text, |progress| read::read_as::<T>(path, &entry.read, progress))?
            }
            (None, number) => built_in(number.unwrap_or(0))?,
        };
        args.reading.both.check(path, &read)?;
        Ok(read)
    };
    let all = entries.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    let paths = entries.iter().map(|entry| entry.path.as_deref().unwrap_or(Path::new("")));
    let named: Vec<_> = all.iter().map(|read| read.material.name()).zip(paths).collect();
    let names = distinct_names(&named);
    let mut materials: Vec<Material<T>> = Vec::new();
    for ((read, name), entry) in all.into_iter().zip(names).zip(&entries) {
        let material = read.material.renamed(name);
        let material = args.reading.both.noted(Read { material, ..read });
        let size = materials.first().map_or_else(|| material.size(), Material::size);
        materials.push(if entry.fit { material.resized(size)? } else { material });
    }
    let mut materials = materials.into_iter();
    // A session has at least one.
    let ground_truth =
        materials.next().ok_or_else(|| Error::Internal("there is no ground truth".to_owned()))?;
    Ok(Opened { ground_truth, predictions: materials.collect() })
}

/// The built-in material of this number, 0 for the ground truth.
fn built_in<T: Real>(number: usize) -> Result<Read<T>, Error> {
    let built_in = samples::load()?;
    let mut all = std::iter::once(built_in.ground_truth).chain(built_in.predictions);
    all.nth(number).ok_or_else(|| Error::Usage(format!("there is no built-in material {number}")))
}

/// Every material in one size.
fn resized<T: Real>(opened: Opened<T>, to: ResizeTo) -> Result<Opened<T>, Error> {
    let [w, h] = match (to, opened.predictions.first()) {
        (ResizeTo::Prediction, Some(prediction)) => prediction.size(),
        _ => opened.ground_truth.size(),
    };
    let size = match to {
        ResizeTo::Width(width) => {
            let size = [width, (h * width + w / 2).checked_div(w).unwrap_or(1).max(1)];
            check_size::<T>(size)?;
            size
        }
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

/// Whether a material of this size can be expected to fit into memory.
fn check_size<T>([width, height]: [usize; 2]) -> Result<(), Error> {
    // Three planes each of normals, diffuse and specular, one of roughness.
    let bytes = width.saturating_mul(height).saturating_mul(10 * size_of::<T>());
    if width.max(height) <= MAX_SIDE && bytes <= MAX_BYTES {
        return Ok(());
    }
    Err(Error::TooLarge { width, height, bytes, max_side: MAX_SIDE, max_bytes: MAX_BYTES })
}

/// Reads one material under a progress bar, with the maps of `bindings` in place of its own.
///
/// # Errors
/// Those of the reader.
pub fn read_one<T: Real>(path: &Path, bindings: &[Binding], options: &ReadOptions) -> Result<Read<T>, Error> {
    watched(&format!("reading {}", path.display()), |progress| {
        read::read_bound(path, bindings, options, progress)
    })
}
