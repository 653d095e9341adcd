//! Marking: the findings of an explanation that hold in the scenes of the evaluation.

use super::evaluation::{holm, one_sided};
use super::explanation::{LEAST_SHARE, TRUTH_SHARE, alternatives, fitted};
use super::finding::{Alternative, Diagnosis, Hypothesis};
use super::proposals::Proposal;
use super::trials::{Paired, Trials, mean};
use svbrdf_core::error::Error;
use svbrdf_core::loss::Estimate;
use svbrdf_core::model::sampler::Sampler;

/// The probability of any mark where nothing explains the loss.
const LEVEL: f64 = 0.05;
/// The part of the loss that may be left where it counts as explained.
const EXPLAINED: f64 = 0.02;

/// The scenes that findings are marked by, and the number of hypotheses.
pub(super) struct Marking<'a> {
    pub(super) search: &'a Trials<'a>,
    pub(super) pilot: &'a Trials<'a>,
    pub(super) evaluation: &'a Trials<'a>,
    pub(super) hypotheses: usize,
}

/// The loss under several changes, as parts of that without changes.
struct Together {
    /// What is left under all of them.
    left: f64,
    /// How much more is left without each of them.
    falls: Vec<Estimate>,
}

impl Marking<'_> {
    /// Marks the findings of those `proposals` that each lower the loss beside all others. `resolvable`: the part of the loss below
    /// which nothing is resolvable.
    pub(super) fn mark(
        &self,
        diagnosis: &mut Diagnosis,
        mut proposals: Vec<Proposal>,
        resolvable: f64,
    ) -> Result<(), Error> {
        while !proposals.is_empty() {
            let together = self.together(&proposals)?;
            let Some(weakest) = self.weakest(&proposals, &together) else {
                let is_whole = together.left <= resolvable.max(EXPLAINED);
                diagnosis.explained = Some(1.0 - together.left);
                let others = alternatives(self.search, &proposals)?;
                for (proposal, alternative) in proposals.iter().zip(others) {
                    mark(diagnosis, proposal, alternative, is_whole);
                }
                return Ok(());
            };
            proposals.remove(weakest);
        }
        Ok(())
    }

    fn together(&self, proposals: &[Proposal]) -> Result<Together, Error> {
        let changes = |proposals: Vec<Proposal>| {
            let fitted = fitted(self.pilot, proposals)?;
            Ok(fitted.iter().filter_map(|proposal| proposal.change).collect::<Vec<_>>())
        };
        let without = |place: usize| {
            let rest = proposals.iter().enumerate().filter(|(other, _)| *other != place);
            changes(rest.map(|(_, proposal)| proposal.clone()).collect())
        };
        let trials = std::iter::once(changes(proposals.to_vec())).chain((0..proposals.len()).map(without));
        let losses = self.evaluation.losses(&trials.collect::<Result<Vec<_>, Error>>()?)?;
        let relative = |paired: &Paired| {
            let before = mean(&paired.before).max(f64::MIN_POSITIVE);
            paired.after.iter().map(|loss| loss / before).collect::<Vec<_>>()
        };
        let parts: Vec<Vec<f64>> = losses.iter().map(relative).collect();
        let Some((all, others)) = parts.split_first() else {
            return Ok(Together { left: 1.0, falls: Vec::new() });
        };
        let scenes = &self.evaluation.scenes;
        let fall = |other: &Vec<f64>| Estimate::of_difference(Sampler::Sobol, scenes, other, all);
        let left = Estimate::of_sampled(Sampler::Sobol, scenes, all).mean;
        Ok(Together { left, falls: others.iter().map(fall).collect() })
    }

    /// The proposal that explains least, if it explains too little, or not significantly.
    fn weakest(&self, proposals: &[Proposal], together: &Together) -> Option<usize> {
        let truth = proposals.iter().position(|one| one.hypothesis == Hypothesis::GroundTruth);
        if truth.is_some() && together.left > 1.0 - TRUTH_SHARE {
            return truth;
        }
        let mut p: Vec<f64> = together.falls.iter().map(one_sided).collect();
        p.resize(self.hypotheses.max(p.len()), 1.0);
        let p = holm(&p);
        let fails = |place: &usize| p[*place] >= LEVEL || together.falls[*place].mean < LEAST_SHARE;
        let fall = |place: &usize| together.falls[*place].mean;
        (0..together.falls.len()).filter(fails).min_by(|a, b| fall(a).total_cmp(&fall(b)))
    }
}

fn mark(diagnosis: &mut Diagnosis, proposal: &Proposal, alternative: Option<Alternative>, is_whole: bool) {
    let of_hypothesis = diagnosis.findings.iter_mut().find(|one| one.hypothesis == proposal.hypothesis);
    if let Some(finding) = of_hypothesis {
        finding.marked = true;
        finding.certain = is_whole && alternative.is_none();
        finding.alternative = alternative;
    }
}
