//! The diagnosis of a prediction: values fitted in a pilot, evaluated in other scenes, and marked.

use super::alignment::Alignments;
use super::evaluation::findings;
use super::explanation::explain;
use super::finding::Diagnosis;
use super::marking::Marking;
use super::proposals::Proposal;
use super::samples::Pair;
use super::trials::Trials;
use svbrdf_core::error::Error;
use svbrdf_core::loss::{Estimate, check_same_size};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::Storage;

/// Near-field and distant scenes of what is found.
pub const SCENES: [usize; 2] = [2048, 1024];
/// Near-field scenes, distant scenes, and texels of each up to which all are compared: of the pilot, and of the evaluation. Of larger maps
/// an eighth as many are.
const PILOT: [usize; 3] = [64, 32, 8192];
const EVALUATION: [usize; 3] = [SCENES[0], SCENES[1], 2048];
/// The same of the search among sets of changes, which are many.
const SEARCH: [usize; 3] = [16, 8, 2048];
/// What the seed of the pilot differs by.
const PILOT_SEED: u64 = 0x7069_6c6f_7400_0000;
/// The steps of `progress`.
const STEPS: u64 = 4;

/// Tries what may explain the loss of a prediction, `pair[1]`, against a ground truth, `pair[0]`, which were read from `storages`.
/// Nothing is marked where the loss is not above `floor`. `seed` names the scenes.
///
/// # Errors
/// [`Error::SizesDiffer`], [`Error::Cancelled`].
pub fn diagnose(
    [ground_truth, prediction]: [&Material<f32>; 2],
    storages: [&Storage; 2],
    convention: &Convention,
    floor: f64,
    seed: u64,
    progress: &Progress,
) -> Result<Diagnosis, Error> {
    check_same_size(ground_truth, prediction)?;
    progress.begin(STEPS);
    let pair = Pair { ground_truth, prediction, storages };
    let trials = |size, seed| Trials::new(pair, convention, size, seed, progress);
    let (pilot, evaluation) = (trials(PILOT, seed ^ PILOT_SEED)?, trials(EVALUATION, seed)?);
    let search = trials(SEARCH, seed ^ PILOT_SEED)?;
    let alignments = Alignments::of([ground_truth, prediction], pilot.sampling.seed)?;
    let mut proposals = Proposal::all(&pilot, &alignments)?;
    progress.step()?;
    let unchanged = evaluation.unchanged()?;
    let loss = Estimate::of_sampled(Sampler::Sobol, &evaluation.scenes, &unchanged.before);
    let resolvable = floor / loss.mean.max(f64::MIN_POSITIVE);
    let explained =
        if resolvable < 1.0 { explain([&search, &pilot], &alignments, resolvable)? } else { Vec::new() };
    for proposal in &explained {
        let line = proposals.iter_mut().find(|line| line.hypothesis == proposal.hypothesis);
        line.into_iter().for_each(|line| *line = proposal.clone());
    }
    progress.step()?;
    let name = prediction.name().to_owned();
    let findings = findings(&evaluation, &proposals, &unchanged)?;
    progress.step()?;
    let mut diagnosis = Diagnosis { prediction: name, loss, explained: None, findings };
    let marking =
        Marking { search: &search, pilot: &pilot, evaluation: &evaluation, hypotheses: proposals.len() };
    marking.mark(&mut diagnosis, explained, resolvable)?;
    progress.step()?;
    Ok(diagnosis)
}
