//! Evaluation: the loss under each proposal in scenes other than those of the pilot.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::finding::Finding;
use super::proposals::Proposal;
use super::trials::{Paired, Trials, mean};
use svbrdf_core::error::Error;
use svbrdf_core::loss::Estimate;
use svbrdf_core::model::sampler::{REPLICATES, Sampler};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::statistics::order;

/// The finding of each proposal in the scenes of `evaluation`, not marked, with its own p-value. `unchanged`: the losses without changes.
pub(super) fn findings(
    evaluation: &Trials<'_>,
    proposals: &[Proposal],
    unchanged: &Paired,
) -> Result<Vec<Finding>, Error> {
    let changed = proposals.iter().filter_map(|proposal| Some(vec![proposal.change?]));
    let mut losses = evaluation.losses(&changed.collect::<Vec<_>>())?.into_iter();
    let scenes = &evaluation.scenes;
    let finding = |proposal: &Proposal| {
        let paired = proposal.change.and_then(|_| losses.next()).unwrap_or_else(|| unchanged.clone());
        finding(proposal, &paired, scenes)
    };
    Ok(proposals.iter().map(finding).collect())
}

/// Corrects the p-values for the number of hypotheses; those of hypotheses without a finding count as 1.
pub(super) fn correct(findings: &mut [Finding], hypotheses: usize) {
    let mut p: Vec<f64> = findings.iter().map(|finding| finding.p).collect();
    p.resize(hypotheses.max(p.len()), 1.0);
    findings.iter_mut().zip(holm(&p)).for_each(|(finding, p)| finding.p = p);
}

fn finding(proposal: &Proposal, paired: &Paired, scenes: &[Scene]) -> Finding {
    let loss = Estimate::of_sampled(Sampler::Sobol, scenes, &paired.after);
    let fall = Estimate::of_difference(Sampler::Sobol, scenes, &paired.before, &paired.after);
    let before = mean(&paired.before);
    let share = |fall: f64| if before > 0.0 { fall / before } else { 0.0 };
    Finding {
        hypothesis: proposal.hypothesis,
        value: proposal.value.clone(),
        unit: proposal.hypothesis.unit(),
        loss: loss.mean,
        interval95: loss.interval95,
        share: share(fall.mean),
        share_interval95: share_interval(paired, scenes),
        p: one_sided(&fall),
        marked: false,
        certain: false,
        alternative: None,
        remedy: proposal.remedy,
        change: proposal.change,
    }
}

/// The interval of `1 - after / before` for the means of both: that of the linear part of this ratio (Cochran 1977, Sampling techniques,
/// 6.3).
fn share_interval(paired: &Paired, scenes: &[Scene]) -> Option<[f64; 2]> {
    let (before, after) = (mean(&paired.before), mean(&paired.after));
    let ratio = if before > 0.0 { after / before } else { 1.0 };
    let expected: Vec<f64> = paired.before.iter().map(|loss| ratio * loss).collect();
    let residual = Estimate::of_difference(Sampler::Sobol, scenes, &expected, &paired.after);
    residual
        .interval95
        .map(|ends| ends.map(|end| 1.0 - ratio + if before > 0.0 { end / before } else { 0.0 }))
}

/// The probability of a mean as large as this, or larger, where the true one is 0: Student's t with the degrees of freedom of one
/// stratum, which are fewer than those of both.
pub(super) fn one_sided(fall: &Estimate) -> f64 {
    let error = fall.standard_error.unwrap_or(f64::INFINITY);
    if error == 0.0 || fall.mean <= 0.0 {
        return if fall.mean > 0.0 { 0.0 } else { 1.0 };
    }
    StudentsT::new(0.0, 1.0, (REPLICATES - 1) as f64).map_or(1.0, |t| t.sf(fall.mean / error))
}

/// The p-values adjusted for their number (Holm 1979): those below a level are rejected at this level for the whole family.
pub fn holm(p: &[f64]) -> Vec<f64> {
    let mut adjusted = vec![1.0; p.len()];
    let mut largest: f64 = 0.0;
    for (rank, index) in order(p).into_iter().enumerate() {
        largest = largest.max((p.len() - rank) as f64 * p[index]).min(1.0);
        adjusted[index] = largest;
    }
    adjusted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adjusted_values_are_those_of_r() {
        // p.adjust(c(0.01, 0.04, 0.03, 0.5), "holm")
        let found = holm(&[0.01, 0.04, 0.03, 0.5]);
        for (found, expected) in found.into_iter().zip([0.04, 0.09, 0.09, 0.5]) {
            assert!((found - expected).abs() < 1e-15, "{found}");
        }
        assert!(holm(&[]).is_empty());
    }
}
