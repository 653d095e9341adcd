//! The rendering loss: a comparison, a request, and its outcome as a dictionary.

use std::borrow::Cow;
use std::str::FromStr;
use std::time::Duration;

use pyo3::prelude::*;
use svbrdf::loss::{Comparison, Compute, Estimate, Loss, Precision, Request, Sampling};
use svbrdf::material::Material;
use svbrdf::model::convention::Convention;
use svbrdf::model::scene::Kind;
use svbrdf::rank::{self, Ranked};
use svbrdf::report::Report;

use crate::errors::exception;
use crate::material::CoreMaterial;
use crate::model::SceneTuple;
use crate::work;

/// What is asked for.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked {
    /// Of the ground truth, then of each prediction.
    names: Vec<String>,
    near: usize,
    distant: usize,
    seed: u64,
    sampler: String,
    texels: String,
    target_error: Option<f64>,
    /// In seconds.
    time_budget: Option<f64>,
    scenes: Option<Vec<SceneTuple>>,
    convention: String,
    precision: String,
}

impl Asked {
    /// The convention of its name.
    ///
    /// # Errors
    /// Where there is none.
    pub fn convention(&self) -> PyResult<Convention> {
        self.convention.parse().map_err(exception)
    }

    /// The request.
    ///
    /// # Errors
    /// Where a word is none of the known ones.
    pub fn request(&self) -> PyResult<Request> {
        let seed = self.seed;
        if let Some(scenes) = &self.scenes {
            return Ok(Request::Listed(scenes.iter().map(SceneTuple::scene).collect::<PyResult<_>>()?));
        }
        if let Some(target) = self.target_error {
            return Ok(Request::Accuracy { target, seed });
        }
        if let Some(seconds) = self.time_budget {
            return Ok(Request::Time { budget: Duration::from_secs_f64(seconds), seed });
        }
        Ok(Request::Scenes(Sampling {
            near: self.near,
            distant: self.distant,
            seed,
            sampler: self.sampler.parse().map_err(exception)?,
            texels: self.texels.parse().map_err(exception)?,
        }))
    }
}

/// The loss of a prediction.
#[derive(Debug, IntoPyObject)]
pub struct LossItems {
    prediction: String,
    loss: f64,
    standard_error: Option<f64>,
    interval95: Option<(f64, f64)>,
    losses: Vec<f64>,
}

/// How much larger the loss of a prediction is than that of the first.
#[derive(Debug, IntoPyObject)]
pub struct DifferenceItems {
    prediction: String,
    to: String,
    difference: f64,
    standard_error: Option<f64>,
    interval95: Option<(f64, f64)>,
}

/// The losses, with what they depend on; the keys are those of the command line's JSON.
#[derive(Debug, IntoPyObject)]
pub struct ReportItems {
    ground_truth: String,
    convention: &'static str,
    epsilon: f64,
    precision: &'static str,
    backend: &'static str,
    /// (width, height).
    size: (usize, usize),
    near: usize,
    distant: usize,
    seed: Option<u64>,
    sampler: Option<String>,
    texels: String,
    interval95_from: String,
    /// Half of the widest 95% interval, as a share of the loss.
    relative_error95: f64,
    results: Vec<LossItems>,
    differences: Vec<DifferenceItems>,
    scenes: Vec<SceneTuple>,
    /// Best first: the index of the result, the difference to the best, the group.
    places: Vec<(usize, Option<DifferenceItems>, usize)>,
    text: String,
}

/// The losses of `predictions` against `ground_truth`.
#[pyfunction]
pub fn loss(
    py: Python<'_>,
    ground_truth: &CoreMaterial,
    predictions: Vec<PyRef<'_, CoreMaterial>>,
    asked: Asked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<ReportItems> {
    let convention = asked.convention()?;
    let request = asked.request()?;
    let run = Run { request: &request, convention, names: &asked.names };
    let materials = std::iter::once(ground_truth).chain(predictions.iter().map(|p| &**p));
    match Precision::from_str(&asked.precision).map_err(exception)? {
        Precision::F32 => run.report(py, &materials.map(CoreMaterial::single).collect::<Vec<_>>(), progress),
        Precision::F64 => run.report(py, &materials.map(CoreMaterial::double).collect::<Vec<_>>(), progress),
    }
}

struct Run<'a> {
    request: &'a Request,
    convention: Convention,
    names: &'a [String],
}

impl Run<'_> {
    /// The report of the first of `materials` as the ground truth and the others as predictions.
    fn report<T: Compute>(
        &self,
        py: Python<'_>,
        materials: &[Cow<'_, Material<T>>],
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<ReportItems> {
        let all: Vec<_> = materials.iter().map(|material| &**material).collect();
        let comparison = Comparison::new(all[0], &all[1..], self.convention).map_err(exception)?;
        let outcome = work::run(py, progress, |progress| comparison.run(self.request, progress))?;
        Ok(items(&Report::new(&comparison, outcome).renamed(self.names)))
    }
}

fn items(report: &Report) -> ReportItems {
    let outcome = &report.outcome;
    let places = rank::places(outcome);
    let best = places.first().map_or(0, |place| place.index);
    let interval = |e: &Estimate| e.interval95.map(|[low, high]| (low, high));
    let of_loss = |loss: &Loss| LossItems {
        prediction: loss.prediction.clone(),
        loss: loss.estimate.mean,
        standard_error: loss.estimate.standard_error,
        interval95: interval(&loss.estimate),
        losses: loss.per_scene.clone(),
    };
    let of_difference = |loss: &Loss, to: &Loss, estimate: Estimate| DifferenceItems {
        prediction: loss.prediction.clone(),
        to: to.prediction.clone(),
        difference: estimate.mean,
        standard_error: estimate.standard_error,
        interval95: interval(&estimate),
    };
    let of_place = |place: Ranked| {
        let to_best = place
            .to_best
            .map(|estimate| of_difference(&outcome.losses[place.index], &outcome.losses[best], estimate));
        (place.index, to_best, place.group)
    };
    ReportItems {
        ground_truth: report.ground_truth.clone(),
        convention: report.convention.name,
        epsilon: report.convention.epsilon,
        precision: report.precision,
        backend: report.backend,
        size: report.size.into(),
        near: report.count(Kind::Near),
        distant: report.count(Kind::Distant),
        seed: report.seed(),
        sampler: report.sampler().map(|sampler| sampler.to_string()),
        texels: report.texels().to_string(),
        interval95_from: outcome.interval_source().to_string(),
        relative_error95: outcome.relative_error95(),
        results: outcome.losses.iter().map(of_loss).collect(),
        differences: report
            .differences()
            .into_iter()
            .map(|(loss, e)| of_difference(loss, &outcome.losses[0], e))
            .collect(),
        scenes: outcome.scenes.iter().map(SceneTuple::from).collect(),
        places: places.into_iter().map(of_place).collect(),
        text: report.text(),
    }
}
