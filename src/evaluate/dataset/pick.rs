//! The choice among several predictions of a material by one method.

use super::record::{KnownLoss, MaterialResult, PredictionResult};

svbrdf_core::choices! {
    /// Which of several predictions of a material by one method counts.
    #[derive(Default)]
    #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
    Pick, "choice of samples":
    /// The first.
    #[default]
    Fixed = "fixed",
    /// The mean of the losses of all.
    Mean = "mean",
    /// The one with the smallest loss: what an oracle would choose.
    Best = "best",
}

/// The loss of a method for a material: the mean of the predictions that count; `None` where none has a loss.
pub fn counted_loss(result: &MaterialResult, method: &str, pick: Pick) -> Option<KnownLoss> {
    let counted = counted(result, method, pick);
    let known: Vec<&KnownLoss> = counted.iter().filter_map(|prediction| prediction.known.as_ref()).collect();
    let count = known.len() as f64;
    let mean = |of: &dyn Fn(&KnownLoss) -> f64| known.iter().map(|known| of(known)).sum::<f64>() / count;
    let scenes = known.iter().map(|known| known.scenes).max()?;
    // The scenes of one are the first of those of another: their errors add up.
    Some(KnownLoss {
        loss: mean(&|known| known.loss),
        standard_error: mean(&|known| known.standard_error),
        interval95: [0, 1].map(|end| mean(&|known| known.interval95[end])),
        scenes,
    })
}

/// The prediction of a method for a material that stands for it in pictures: the first that counts.
pub fn counted_sample(result: &MaterialResult, method: &str, pick: Pick) -> Option<usize> {
    counted(result, method, pick).first().map(|prediction| prediction.sample)
}

/// The predictions of a material by a method that count: those with a loss.
pub(super) fn counted<'a>(result: &'a MaterialResult, method: &str, pick: Pick) -> Vec<&'a PredictionResult> {
    let mut of_method = result.predictions.iter().filter(|prediction| prediction.method == method);
    let loss = |prediction: &PredictionResult| prediction.known.map_or(f64::INFINITY, |known| known.loss);
    let has_loss = |prediction: &&PredictionResult| prediction.known.is_some();
    match pick {
        // The first counts, and is not replaced by another.
        Pick::Fixed => of_method.next().filter(has_loss).into_iter().collect(),
        Pick::Best => {
            let known = of_method.filter(has_loss);
            known.min_by(|a, b| loss(a).total_cmp(&loss(b))).into_iter().collect()
        }
        Pick::Mean => of_method.filter(has_loss).collect(),
    }
}
