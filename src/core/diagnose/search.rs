//! The diagnosis of a prediction: values fitted in a pilot, evaluated in other scenes, and marked.

use super::evaluation::findings;
use super::finding::{Diagnosis, Finding, Hypothesis, Value};
use super::ladder::{Rung, ladder};
use super::marking::Marking;
use super::proposals::Proposal;
use super::seams::seams;
use super::storage::Storage;
use super::trials::Trials;
use crate::error::Error;
use crate::loss::check_same_size;
use crate::material::Material;
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::progress::Progress;

/// Near-field scenes, distant scenes, and texels of each up to which all are compared: of the pilot, and of the evaluation. Of larger maps
/// an eighth as many are.
const PILOT: [usize; 3] = [64, 32, 8192];
const EVALUATION: [usize; 3] = [128, 64, 1 << 16];
/// What the seed of the pilot differs by.
const PILOT_SEED: u64 = 0x7069_6c6f_7400_0000;
/// Near-field and distant scenes of the ladder.
const LADDER: [usize; 2] = [16, 8];
/// The steps of `progress`.
const STEPS: u64 = 4;

/// Tries on `prediction`, which was read from `storage`, what may explain its loss. `seed` names the scenes.
///
/// # Errors
/// [`Error::SizesDiffer`], [`Error::Cancelled`].
pub fn diagnose(
    ground_truth: &Material<f32>,
    prediction: &Material<f32>,
    storage: &Storage,
    convention: &Convention,
    seed: u64,
    progress: &Progress,
) -> Result<Diagnosis, Error> {
    check_same_size(ground_truth, prediction)?;
    progress.begin(STEPS);
    let materials = [ground_truth, prediction];
    let trials = |size, seed| Trials::new(materials, storage, convention, size, seed, progress);
    let (pilot, evaluation) = (trials(PILOT, seed ^ PILOT_SEED)?, trials(EVALUATION, seed)?);
    let (proposals, subtexel) = Proposal::all(&pilot)?;
    progress.step()?;
    let (loss, mut findings) = findings(&evaluation, &proposals)?;
    progress.step()?;
    Marking { pilot: &pilot, evaluation: &evaluation, proposals: &proposals }.mark(&mut findings)?;
    progress.step()?;
    let scenes = Sampler::Sobol.scenes(seed, LADDER[0], LADDER[1], convention);
    let ladder = ladder(ground_truth, prediction, &scenes, convention, &progress.part())?;
    progress.step()?;
    findings.insert(3, untested(Hypothesis::Subtexel, subtexel, None));
    findings.insert(5, resampling(&ladder));
    let name = prediction.name().to_owned();
    Ok(Diagnosis { prediction: name, loss, findings, ladder, seams: seams(prediction) })
}

/// A line without a test.
fn untested(hypothesis: Hypothesis, value: Value, losses: Option<[f64; 2]>) -> Finding {
    Finding {
        hypothesis,
        value,
        unit: hypothesis.unit(),
        loss: losses.map(|[_, after]| after),
        interval95: None,
        share: losses.map(|[before, after]| if before > 0.0 { 1.0 - after / before } else { 0.0 }),
        share_interval95: None,
        p: None,
        marked: false,
        remedy: None,
        change: None,
    }
}

/// The part of the loss that is due to detail smaller than 2 texels.
fn resampling(ladder: &[Rung]) -> Finding {
    let losses = ladder.get(1).map(|half| [ladder[0].loss, half.loss]);
    untested(Hypothesis::Resampling, Value::Number(2.0), losses)
}
