//! The diagnosis of a prediction: values fitted in a pilot, evaluated in other scenes, and marked.

use super::alignment::Alignments;
use super::evaluation::{correct, findings};
use super::explanation::explain;
use super::finding::{Diagnosis, Hypothesis};
use super::marking::Marking;
use super::proposals::Proposal;
use super::samples::Pair;
use super::trials::{Paired, Trials};
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

/// What explains the loss of a prediction: the sentence needs no more. The other lines are found after it.
#[derive(Debug)]
pub struct Explained<'a> {
    pilot: Trials<'a>,
    evaluation: Trials<'a>,
    alignments: Alignments,
    unchanged: Paired,
    /// With the findings of the explanation, whose p-values are not corrected yet.
    diagnosis: Diagnosis,
}

impl<'a> Explained<'a> {
    /// Tries what may explain the loss of a prediction, the second of the pair, against a ground truth, the first, which were read from
    /// `storages`. Nothing is marked where the loss is not above `floor`. `seed` names the scenes.
    ///
    /// # Errors
    /// [`Error::SizesDiffer`], [`Error::Cancelled`].
    pub fn of(
        [ground_truth, prediction]: [&'a Material<f32>; 2],
        storages: [&'a Storage; 2],
        convention: &'a Convention,
        floor: f64,
        seed: u64,
        progress: &'a Progress,
    ) -> Result<Self, Error> {
        check_same_size(ground_truth, prediction)?;
        progress.begin(STEPS);
        let pair = Pair { ground_truth, prediction, storages };
        let trials = |size, seed| Trials::new(pair, convention, size, seed, progress);
        let (pilot, evaluation) = (trials(PILOT, seed ^ PILOT_SEED)?, trials(EVALUATION, seed)?);
        let search = trials(SEARCH, seed ^ PILOT_SEED)?;
        let alignments = Alignments::of([ground_truth, prediction], pilot.sampling.seed)?;
        progress.step()?;
        let unchanged = evaluation.unchanged()?;
        let loss = Estimate::of_sampled(Sampler::Sobol, &evaluation.scenes, &unchanged.before);
        let resolvable = floor / loss.mean.max(f64::MIN_POSITIVE);
        let explained =
            if resolvable < 1.0 { explain([&search, &pilot], &alignments, resolvable)? } else { Vec::new() };
        progress.step()?;
        let findings = findings(&evaluation, &explained, &unchanged)?;
        let name = prediction.name().to_owned();
        let mut diagnosis = Diagnosis { prediction: name, loss, explained: None, findings };
        let hypotheses = Hypothesis::of(storages[1]).count();
        let marking = Marking { search: &search, pilot: &pilot, evaluation: &evaluation, hypotheses };
        marking.mark(&mut diagnosis, explained, resolvable)?;
        progress.step()?;
        Ok(Self { pilot, evaluation, alignments, unchanged, diagnosis })
    }

    /// The diagnosis without the lines that are not marked; p-values are corrected as if those of all others were 1.
    pub fn marked(&self) -> Diagnosis {
        let mut diagnosis = self.diagnosis.clone();
        correct(&mut diagnosis.findings, Hypothesis::of(self.pilot.pair.storages[1]).count());
        diagnosis.findings.retain(|finding| finding.marked);
        diagnosis
    }

    /// The diagnosis with all lines.
    ///
    /// # Errors
    /// As [`Self::of`].
    pub fn with_all_lines(mut self) -> Result<Diagnosis, Error> {
        let known = &self.diagnosis.findings;
        let mut lines = Proposal::all(&self.pilot, &self.alignments)?;
        let count = lines.len();
        lines.retain(|line| known.iter().all(|finding| finding.hypothesis != line.hypothesis));
        self.diagnosis.findings.extend(findings(&self.evaluation, &lines, &self.unchanged)?);
        self.diagnosis.findings.sort_by_key(|finding| finding.hypothesis as usize);
        correct(&mut self.diagnosis.findings, count);
        self.pilot.progress.step()?;
        Ok(self.diagnosis)
    }
}

/// The whole diagnosis of a prediction: [`Explained::of`], with all lines.
///
/// # Errors
/// As [`Explained::of`].
pub fn diagnose(
    pair: [&Material<f32>; 2],
    storages: [&Storage; 2],
    convention: &Convention,
    floor: f64,
    seed: u64,
    progress: &Progress,
) -> Result<Diagnosis, Error> {
    Explained::of(pair, storages, convention, floor, seed, progress)?.with_all_lines()
}
