//! The analyses that the crate declares.

use std::str::FromStr as _;

use pyo3::prelude::*;
use serde_json::Value;
use svbrdf_core::image::Image;
use svbrdf_core::loss::Precision;
use svbrdf_evaluate::Error as EvaluateError;
use svbrdf_evaluate::analyses::{AnyAnalysis, Precise};
use svbrdf_evaluate::registration::Registered;
use svbrdf_evaluate::report::AnalysisInput;

use crate::arrays;
use crate::asked::{Asked, options, question};
use crate::errors::{Error, exception};
use crate::material::CoreMaterial;
use crate::report::ReportViews;
use crate::work;

/// A report.
#[derive(Debug, IntoPyObject)]
pub struct AnalysisItems<'py> {
    views: ReportViews,
    /// Its pictures, where it has any.
    maps: Option<Vec<Bound<'py, PyAny>>>,
}

/// The report of the analysis of this name.
#[pyfunction]
pub fn analysis<'py>(
    py: Python<'py>,
    asked: Asked<'_>,
    name: &str,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<AnalysisItems<'py>> {
    let analysis = AnyAnalysis::named(name).ok_or_else(|| Error::new_err(format!("no analysis {name}")))?;
    match Precision::from_str(&asked.precision).map_err(exception)? {
        Precision::F32 => report(py, analysis, &asked, &asked.materials(CoreMaterial::single)?, progress),
        Precision::F64 => report(py, analysis, &asked, &asked.materials(CoreMaterial::double)?, progress),
    }
}

/// The report about the first of the materials as the ground truth and the others as predictions.
fn report<'py, T: Precise>(
    py: Python<'py>,
    analysis: &AnyAnalysis,
    asked: &Asked<'_>,
    Registered { materials, mask, note }: &Registered<T>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<AnalysisItems<'py>> {
    let is_own = |name: &String| analysis.options.iter().any(|option| option.name == name);
    let (own, scenes) = question(&asked.question)?.into_iter().partition(|(name, _)| is_own(name));
    let (own, scenes) = (Value::Object(own), options(scenes)?);
    let input = AnalysisInput {
        ground_truth: &materials[0],
        predictions: materials[1..].iter().collect(),
        storages: asked.materials.iter().map(|material| &material.get().storage).collect(),
        paths: asked.paths.clone(),
        convention: asked.convention()?,
        request: analysis.request(&scenes, None).map_err(exception)?,
        few_scenes: scenes.is_open(),
        mask: mask.clone(),
    };
    // A report is no value of several threads.
    let (views, images) = work::run(py, progress, |progress| {
        let report = analysis.run(&input, own, progress)?;
        let views = ReportViews::new(&*report, !analysis.pictures);
        Ok::<_, EvaluateError>((views, report.pictures().map(|(images, _)| images.to_vec())))
    })?;
    let map = |Image { width, height, pixels }: Image<f32>| {
        arrays::array(py, pixels.into_flattened().into_iter(), [width, height], 3)
    };
    let maps = images.map(|images| images.into_iter().map(map).collect::<PyResult<_>>()).transpose()?;
    let mut views = views?;
    // What was asked for needs no word.
    views.warnings.extend(note.clone().filter(|_| asked.register.is_none()));
    Ok(AnalysisItems { views, maps })
}
