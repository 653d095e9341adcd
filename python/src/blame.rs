//! How much of a loss comes from each map.

use pyo3::prelude::*;
use svbrdf::loss::Estimate;
use svbrdf::why::{self, Attribution, MapShare};

use crate::loss::Asked;
use crate::material::CoreMaterial;
use crate::work;

/// A mean over scenes with its error.
#[derive(Debug, IntoPyObject)]
pub struct EstimateItems {
    mean: f64,
    standard_error: Option<f64>,
    interval95: Option<(f64, f64)>,
}

impl From<&Estimate> for EstimateItems {
    fn from(e: &Estimate) -> Self {
        let interval95 = e.interval95.map(|[low, high]| (low, high));
        Self { mean: e.mean, standard_error: e.standard_error, interval95 }
    }
}

/// What a map adds to the loss.
#[derive(Debug, IntoPyObject)]
pub struct ShareItems {
    map: &'static str,
    shapley: EstimateItems,
    only_wrong: EstimateItems,
    only_right: EstimateItems,
}

/// The loss of a prediction and what each map adds to it.
#[derive(Debug, IntoPyObject)]
pub struct AttributionItems {
    /// The number of scenes.
    scenes: usize,
    seed: Option<u64>,
    loss: EstimateItems,
    maps: Vec<ShareItems>,
}

/// The attribution of the loss of `prediction`.
#[pyfunction]
pub fn blame(
    py: Python<'_>,
    ground_truth: &CoreMaterial,
    prediction: &CoreMaterial,
    asked: Asked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<AttributionItems> {
    let convention = asked.convention()?;
    let request = asked.request()?;
    let (truth, other) = (ground_truth.single(), prediction.single());
    let attribution =
        work::run(py, progress, |progress| why::attribute(&truth, &other, &convention, &request, progress))?;
    Ok(items(&attribution))
}

fn items(attribution: &Attribution) -> AttributionItems {
    let share = |share: &MapShare| ShareItems {
        map: share.map.name(),
        shapley: (&share.shapley).into(),
        only_wrong: (&share.only_wrong).into(),
        only_right: (&share.only_right).into(),
    };
    AttributionItems {
        scenes: attribution.scenes.len(),
        seed: attribution.sampling.map(|sampling| sampling.seed),
        loss: (&attribution.loss).into(),
        maps: attribution.maps.iter().map(share).collect(),
    }
}
