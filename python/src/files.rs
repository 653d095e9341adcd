//! Files of materials: reading and writing them, and those that are built in.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use pyo3::prelude::*;
use svbrdf_core::loss::Precision;
use svbrdf_core::material::Material;
use svbrdf_core::math::real::Real;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;
use svbrdf_files::disk::inputs::check_output_of;
use svbrdf_files::read::{self as reading, Certainty, Read, ReadOptions};
use svbrdf_files::samples;
use svbrdf_files::write as writing;

use crate::errors::exception;
use crate::material::{CoreMaterial, Values, read_options};
use crate::work;

/// What reading a material gave.
#[derive(Debug, IntoPyObject)]
pub struct Found {
    material: CoreMaterial,
    notes: Vec<String>,
    /// About what, the choice, why, how certain.
    assumptions: Vec<[String; 4]>,
    files: Vec<PathBuf>,
}

/// Reads a material; `options` are read options as JSON.
#[pyfunction]
pub fn read(
    py: Python<'_>,
    path: PathBuf,
    options: &str,
    precision: &str,
    strict: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Found> {
    fn checked<T: Real>(
        path: &Path,
        options: &ReadOptions,
        strict: bool,
        progress: &Progress,
    ) -> Result<Read<T>, Error> {
        let read = reading::read(path, options, progress)?;
        if strict {
            read.refuse_guesses(path)?;
        }
        Ok(read)
    }
    let options = &read_options(options)?;
    match Precision::from_str(precision).map_err(exception)? {
        Precision::F32 => {
            found(work::run(py, progress, |progress| checked::<f32>(&path, options, strict, progress))?)
        }
        Precision::F64 => {
            found(work::run(py, progress, |progress| checked::<f64>(&path, options, strict, progress))?)
        }
    }
}

fn found<T: Real>(read: Read<T>) -> PyResult<Found>
where
    Values: From<Material<T>>,
{
    let certainty = |certainty| match certainty {
        Certainty::Unsure => "unsure",
        Certainty::Likely => "likely",
        Certainty::Sure => "sure",
        Certainty::Given => "given",
    };
    let assumptions = read.assumptions.iter();
    let assumptions = assumptions
        .map(|a| [a.what.name(), &a.chosen, &a.why.to_string(), certainty(a.certainty)].map(str::to_owned));
    let storage = read.storage();
    Ok(Found {
        assumptions: assumptions.collect(),
        notes: read.notes.iter().map(ToString::to_string).collect(),
        files: read.files,
        material: CoreMaterial { values: read.material.into(), storage },
    })
}

/// The built-in ground truth, then the predictions of it.
#[pyfunction]
pub fn built_in(py: Python<'_>, precision: &str) -> PyResult<Vec<CoreMaterial>> {
    fn all<T: Real>() -> Result<Vec<CoreMaterial>, Error>
    where
        Values: From<Material<T>>,
    {
        let samples = samples::load::<T>()?;
        let all = std::iter::once(samples.ground_truth).chain(samples.predictions);
        let material = |read: Read<T>| CoreMaterial { storage: read.storage(), values: read.material.into() };
        Ok(all.map(material).collect())
    }
    match Precision::from_str(precision).map_err(exception)? {
        Precision::F32 => work::at_once(py, all::<f32>),
        Precision::F64 => work::at_once(py, all::<f64>),
    }
}

/// Writes a material that was read from `files`, if any. Returns a note where some programs show less than the file has.
#[pyfunction]
pub fn write(
    py: Python<'_>,
    material: &CoreMaterial,
    path: PathBuf,
    files: Vec<PathBuf>,
    depth: Option<&str>,
) -> PyResult<Option<&'static str>> {
    let depth = depth.map(str::parse).transpose().map_err(exception)?;
    let kind = writing::FileKind::new(&path, depth).map_err(exception)?;
    check_output_of(&path, &files).map_err(exception)?;
    let material = material.single();
    work::run(py, None, |progress| writing::write_watched(&material, &path, kind, progress))
}
