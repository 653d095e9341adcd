//! Losses over listed scenes, for tests that compare backends.

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Backend, Comparison, Compute, Loss, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;

/// The losses of `predictions` over `scenes`, computed by `backend`.
pub fn losses<T: Compute>(
    backend: &dyn Backend<T>,
    ground_truth: &Material<T>,
    predictions: &[&Material<T>],
    scenes: &[Scene],
    convention: &Convention,
) -> Result<Vec<Loss>, Error> {
    let comparison = Comparison::new(ground_truth, predictions, *convention)?.on(backend);
    let outcome = comparison.run(&Request::Listed(scenes.to_vec()), &Progress::default())?;
    Ok(outcome.losses)
}
