//! Explanation: the few changes that together explain most of a loss, by a beam search.

use super::finding::Hypothesis;
use super::proposals::Proposal;
use super::shift::{Correlations, ShiftFit};
use super::trials::{Paired, Trials, mean};
use svbrdf_core::error::Error;
use svbrdf_core::statistics::sort_by_number;
use svbrdf_files::changes::Change;
use svbrdf_files::changes::Symmetry;

/// The part of the loss that each change has to explain.
pub(super) const LEAST_SHARE: f64 = 0.1;
/// The part that another reading of the ground truth has to explain: the loss against another reference may be smaller by chance.
const TRUTH_SHARE: f64 = 0.8;
/// Most changes of an explanation.
const MOST: usize = 4;
/// Explanations that are extended by another change.
const BEAM: usize = 4;
/// An explanation is extended where its last change lowers the loss below this part.
const PROMISING: f64 = 0.95;
/// How much better than without a change the maps have to correlate for an alignment to be extended whatever its loss: the sum over
/// planes.
const ALIGNED: f64 = 0.3;

/// Changes, and the loss that they leave.
#[derive(Clone, Debug)]
struct Explanation {
    proposals: Vec<Proposal>,
    /// The loss by that without changes.
    ratio: f64,
}

impl Explanation {
    fn none() -> Self {
        Self { proposals: Vec::new(), ratio: 1.0 }
    }

    /// Less is better: the loss that is left, not counting what is below `resolvable`, and the part that the changes have to explain.
    fn score(&self, resolvable: f64) -> f64 {
        let cost = |proposal: &Proposal| match proposal.hypothesis {
            Hypothesis::ExposureRgb => 2.0 * LEAST_SHARE,
            Hypothesis::GroundTruth => TRUTH_SHARE,
            _ => LEAST_SHARE,
        };
        self.ratio.max(resolvable) + self.proposals.iter().map(cost).sum::<f64>()
    }

    /// With its exposure fitted to its other changes.
    fn refitted(mut self, pilot: &Trials<'_>) -> Result<Self, Error> {
        let fitted =
            changes(pilot, &self.proposals)?.into_iter().find(|one| matches!(one, Change::Exposure(_)));
        for proposal in &mut self.proposals {
            if let (Some(Change::Exposure(_)), Some(Change::Exposure(stops))) = (proposal.change, fitted) {
                *proposal = Proposal::exposure(stops, proposal.hypothesis);
            }
        }
        Ok(self)
    }

    /// Whether it moves maps that `other` leaves where they are.
    fn is_aligned_beyond(&self, other: &Self) -> bool {
        let moves = |one: &Self| !one.admits(Hypothesis::Shift) || !one.admits(Hypothesis::Symmetry);
        moves(self) && !moves(other)
    }

    /// Whether it has the same changes.
    fn is_same(&self, other: &Self) -> bool {
        self.proposals.len() == other.proposals.len()
            && self.proposals.iter().all(|one| other.proposals.iter().any(|of| of.change == one.change))
    }

    /// Whether a change of this hypothesis may join.
    fn admits(&self, hypothesis: Hypothesis) -> bool {
        self.proposals.iter().all(|proposal| !exclude([proposal.hypothesis, hypothesis]))
    }

    /// Whether this change may join: not where both sides would be read otherwise in the same way, which explains no difference.
    fn admits_change(&self, added: &Proposal) -> bool {
        let reading = |change| match change {
            Some(Change::Reading(reading) | Change::GroundTruth(reading)) => Some(reading),
            _ => None,
        };
        let is_same =
            |one: &Proposal| reading(one.change).is_some_and(|of| reading(added.change) == Some(of));
        self.admits(added.hypothesis) && !self.proposals.iter().any(is_same)
    }
}

/// Whether two hypotheses change the same.
fn exclude(pair: [Hypothesis; 2]) -> bool {
    use Hypothesis::{AlbedoEncoding, DiffuseEncoding, SpecularEncoding};
    let both = |of: &[Hypothesis]| pair.iter().all(|one| of.contains(one));
    pair[0] == pair[1]
        || pair.iter().all(|one| is_exposure(*one))
        || pair.contains(&AlbedoEncoding) && both(&[AlbedoEncoding, DiffuseEncoding, SpecularEncoding])
}

fn is_exposure(hypothesis: Hypothesis) -> bool {
    matches!(hypothesis, Hypothesis::Exposure | Hypothesis::ExposureRgb)
}

/// Alignments under which the maps correlate much better than as they are, the best first: a shift, a symmetry, or both.
fn alignments(
    correlations: &Correlations<'_>,
    of_shifts: &[ShiftFit],
    size: [usize; 2],
) -> Result<Vec<Vec<Proposal>>, Error> {
    let unmoved = of_shifts.iter().find(|fit| fit.shift == [0, 0]).map_or(0.0, |fit| fit.absolute);
    let best = |fits: &[ShiftFit]| fits.iter().copied().max_by(|a, b| a.absolute.total_cmp(&b.absolute));
    let shift = |fit: ShiftFit| (fit.shift != [0, 0]).then(|| Proposal::shift(fit.shift));
    let mut all: Vec<(f64, Vec<Proposal>)> = Vec::new();
    all.extend(best(of_shifts).map(|fit| (fit.absolute, shift(fit).into_iter().collect())));
    for symmetry in Symmetry::of(size) {
        let fits = correlations.fits(Some(symmetry))?;
        let changes = |fit: ShiftFit| [Proposal::symmetry(symmetry)].into_iter().chain(shift(fit)).collect();
        all.extend(best(&fits).map(|fit| (fit.absolute, changes(fit))));
    }
    all.retain(|(fit, changes)| *fit > unmoved + ALIGNED && !changes.is_empty());
    sort_by_number(&mut all, |(fit, _)| -fit);
    Ok(all.into_iter().take(2).map(|(_, changes)| changes).collect())
}

/// The explanation with the least loss where each change has to explain a part of it; `resolvable`: the part of the loss below which
/// nothing is explained. An exposure is fitted in the pilot.
pub(super) fn explain(
    [search, pilot]: [&Trials<'_>; 2],
    (correlations, fits): (&Correlations<'_>, &[ShiftFit]),
    resolvable: f64,
) -> Result<Vec<Proposal>, Error> {
    let alignments = alignments(correlations, fits, search.pair.ground_truth.size())?;
    let (mut best, mut open) = (Explanation::none(), vec![Explanation::none()]);
    for _ in 0..MOST {
        open = extended(search, &open, &alignments, resolvable)?;
        let candidates = std::iter::once(&best).chain(&open);
        let least = candidates.min_by(|a, b| a.score(resolvable).total_cmp(&b.score(resolvable))).cloned();
        best = least.unwrap_or(best);
        if open.is_empty() || best.ratio <= resolvable {
            break;
        }
    }
    Ok(best.refitted(pilot)?.proposals)
}

/// The most promising explanations with one change more than those of `open`, or with an alignment.
fn extended(
    pilot: &Trials<'_>,
    open: &[Explanation],
    alignments: &[Vec<Proposal>],
    resolvable: f64,
) -> Result<Vec<Explanation>, Error> {
    let mut all = Vec::new();
    for one in open.iter().filter(|one| one.ratio > resolvable) {
        let aligned = alignments.iter().filter(|_| one.admits(Hypothesis::Shift));
        let aligned = aligned.filter(|_| one.admits(Hypothesis::Symmetry)).cloned();
        let added = singles(pilot).into_iter().filter(|added| one.admits_change(added));
        let added: Vec<_> = added.map(|added| vec![added]).chain(aligned).collect();
        let with = |added: Vec<Proposal>| [one.proposals.clone(), added].concat();
        let tried = tried(pilot, added.into_iter().map(with).collect())?;
        let limit = PROMISING * one.ratio;
        all.extend(tried.into_iter().filter(|new| new.ratio < limit || new.is_aligned_beyond(one)));
    }
    sort_by_number(&mut all, |one| one.score(resolvable));
    all.dedup_by(|a, b| a.is_same(b));
    all.truncate(BEAM);
    Ok(all)
}

/// Each reading and exposure alone; exposures are fitted when they are tried. The encoding of both colours comes last: where only one of
/// them is in another encoding, it changes the same.
fn singles(pilot: &Trials<'_>) -> Vec<Proposal> {
    let exposures = [Hypothesis::Exposure, Hypothesis::ExposureRgb];
    let exposures = exposures.map(|hypothesis| Proposal::exposure([0.0; 3], hypothesis));
    let readings = Proposal::readings(pilot.pair.storages).into_iter().flatten();
    let mut all: Vec<Proposal> = readings.chain(exposures).collect();
    all.sort_by_key(|proposal| proposal.hypothesis == Hypothesis::AlbedoEncoding);
    all
}

/// The losses under each of these sets of changes.
fn tried(pilot: &Trials<'_>, sets: Vec<Vec<Proposal>>) -> Result<Vec<Explanation>, Error> {
    let trials = sets.iter().map(|set| changes(pilot, set)).collect::<Result<Vec<_>, Error>>()?;
    let losses = pilot.losses(&trials)?;
    let ratio = |paired: &Paired| mean(&paired.after) / mean(&paired.before).max(f64::MIN_POSITIVE);
    Ok(sets
        .into_iter()
        .zip(&losses)
        .map(|(proposals, paired)| Explanation { proposals, ratio: ratio(paired) })
        .collect())
}

/// The changes of several proposals; an exposure is fitted again, after the others.
pub(super) fn changes(pilot: &Trials<'_>, proposals: &[Proposal]) -> Result<Vec<Change>, Error> {
    let (exposures, others): (Vec<_>, Vec<_>) =
        proposals.iter().partition(|proposal| matches!(proposal.change, Some(Change::Exposure(_))));
    let mut changes: Vec<Change> = others.iter().filter_map(|proposal| proposal.change).collect();
    if !exposures.is_empty() {
        let per_channel = exposures.iter().any(|one| one.hypothesis == Hypothesis::ExposureRgb);
        changes.push(Change::Exposure(pilot.best_exposure(&changes, per_channel)?));
    }
    Ok(changes)
}

/// The change in place of each proposal of `explanation` that lowers the loss as far, where there is one. In place of a factor on each
/// channel it may come with one factor on all: both together are as free, or less.
pub(super) fn alternatives(pilot: &Trials<'_>, proposals: &[Proposal]) -> Result<Vec<Option<Change>>, Error> {
    let with = tried(pilot, vec![proposals.to_vec()])?.first().map_or(1.0, |all| all.ratio);
    let of = |place: usize| {
        let mut rest = Explanation { proposals: proposals.to_vec(), ratio: 1.0 };
        let replaced = rest.proposals.remove(place).hypothesis;
        let is_other = |other: &Proposal| {
            rest.admits_change(other)
                && other.hypothesis != replaced
                && !(is_exposure(other.hypothesis) && is_exposure(replaced))
        };
        let others: Vec<Proposal> = singles(pilot).into_iter().filter(is_other).collect();
        let exposure = singles(pilot).into_iter().find(|one| one.hypothesis == Hypothesis::Exposure);
        let beside = exposure.filter(|_| replaced == Hypothesis::ExposureRgb).map(|exposure| vec![exposure]);
        let set = |beside: Vec<Proposal>, other: &Proposal| {
            [rest.proposals.clone(), beside, vec![other.clone()]].concat()
        };
        let sets = std::iter::once(Vec::new()).chain(beside);
        let sets = sets.flat_map(|beside| {
            others.iter().map(move |other| set(beside.clone(), other)).collect::<Vec<_>>()
        });
        let sets = sets.collect();
        let tried = tried(pilot, sets)?;
        let best = tried.iter().min_by(|a, b| a.ratio.total_cmp(&b.ratio));
        let best = best.filter(|other| other.ratio < with + 0.5 * LEAST_SHARE);
        Ok(best.and_then(|other| other.proposals.last()?.change))
    };
    (0..proposals.len()).map(of).collect()
}
