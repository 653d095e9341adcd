//! Marking: which findings explain the loss, the largest share first, then what remains after the corrections of these.

use super::change::Change;
use super::evaluation::one_sided;
use super::finding::{Finding, Hypothesis};
use super::holm::holm;
use super::proposals::Proposal;
use super::trials::{Paired, Trials, mean};
use crate::error::Error;
use crate::loss::Estimate;
use crate::model::sampler::Sampler;

/// Least share of a marked finding.
const LEAST_SHARE: f64 = 0.1;
/// The probability of any mark where nothing explains the loss.
const LEVEL: f64 = 0.05;

/// The scenes and the proposals that findings are marked by.
pub(super) struct Marking<'a> {
    pub(super) pilot: &'a Trials<'a>,
    pub(super) evaluation: &'a Trials<'a>,
    pub(super) proposals: &'a [Proposal],
}

impl Marking<'_> {
    /// Marks the finding with the largest share, then those whose shares remain after the corrections of the marked ones. `findings`
    /// are those of the proposals, in their order.
    pub(super) fn mark(&self, findings: &mut [Finding]) -> Result<(), Error> {
        let mut open: Vec<usize> = (0..findings.len()).filter(|&index| passes(&findings[index])).collect();
        let mut next = first(findings, &open);
        let mut marked = Vec::new();
        while let Some(index) = next {
            marked.push(index);
            open.retain(|&other| other != index);
            next = self.next(&marked, &mut open)?;
        }
        marked.into_iter().for_each(|index| findings[index].marked = true);
        Ok(())
    }

    /// The proposal that explains most beside the `marked` ones; proposals that explain too little are removed from `open`.
    fn next(&self, marked: &[usize], open: &mut Vec<usize>) -> Result<Option<usize>, Error> {
        if open.is_empty() {
            return Ok(None);
        }
        let with = |other: Option<usize>| self.together(marked.iter().copied().chain(other));
        let trials = std::iter::once(None).chain(open.iter().copied().map(Some)).map(with);
        let losses = self.evaluation.losses(&trials.collect::<Result<Vec<_>, Error>>()?)?;
        let falls = self.falls(&losses);
        let p = holm(&falls.iter().map(one_sided).collect::<Vec<_>>());
        let explains: Vec<(usize, f64)> = open
            .iter()
            .zip(falls.iter().zip(p))
            .filter(|(_, (fall, p))| *p < LEVEL && fall.mean >= LEAST_SHARE)
            .map(|(&index, (fall, _))| (index, fall.mean))
            .collect();
        *open = explains.iter().map(|&(index, _)| index).collect();
        Ok(explains.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index))
    }

    /// How far each loss after the first is below it, as shares of the loss without changes.
    fn falls(&self, losses: &[Paired]) -> Vec<Estimate> {
        let relative = |paired: &Paired| {
            let before = mean(&paired.before).max(f64::MIN_POSITIVE);
            paired.after.iter().map(|loss| loss / before).collect::<Vec<_>>()
        };
        let Some((first, others)) = losses.split_first() else { return Vec::new() };
        let first = relative(first);
        let fall = |paired: &Paired| {
            Estimate::of_difference(Sampler::Sobol, &self.evaluation.scenes, &first, &relative(paired))
        };
        others.iter().map(fall).collect()
    }

    /// The changes of several proposals; exposures are fitted again, after the others.
    fn together(&self, indices: impl Iterator<Item = usize>) -> Result<Vec<Change>, Error> {
        let (exposures, others): (Vec<_>, Vec<_>) = indices
            .map(|index| &self.proposals[index])
            .partition(|proposal| matches!(proposal.change, Some(Change::Exposure(_))));
        let mut changes: Vec<Change> = others.iter().filter_map(|proposal| proposal.change).collect();
        if !exposures.is_empty() {
            let per_channel = exposures.iter().any(|p| p.hypothesis == Hypothesis::ExposureRgb);
            changes.push(Change::Exposure(self.pilot.best_exposure(&changes, per_channel)?));
        }
        Ok(changes)
    }
}

fn share(finding: &Finding) -> f64 {
    finding.share.unwrap_or(0.0)
}

fn passes(finding: &Finding) -> bool {
    finding.p.is_some_and(|p| p < LEVEL) && share(finding) >= LEAST_SHARE
}

/// The one of `open` with the largest share. Three factors explain at least as much as one: they have to explain clearly more.
fn first(findings: &[Finding], open: &[usize]) -> Option<usize> {
    let of = |index: usize| &findings[index];
    let best = open.iter().copied().max_by(|&a, &b| share(of(a)).total_cmp(&share(of(b))))?;
    let one = open.iter().copied().find(|&index| of(index).hypothesis == Hypothesis::Exposure);
    let is_enough = |one: &usize| {
        of(best).hypothesis == Hypothesis::ExposureRgb && share(of(best)) - share(of(*one)) < LEAST_SHARE
    };
    Some(one.filter(is_enough).unwrap_or(best))
}
