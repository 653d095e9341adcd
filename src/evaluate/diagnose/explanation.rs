//! Explanation: the few changes that together explain most of a loss, by a beam search.

use super::alignment::Alignments;
use super::finding::{Alternative, Hypothesis};
use super::proposals::Proposal;
use super::trials::{Paired, Trials, mean};
use svbrdf_core::error::Error;
use svbrdf_core::material::Map;
use svbrdf_core::parallel;
use svbrdf_core::statistics::sort_by_number;
use svbrdf_files::changes::{Change, Reading};

/// The part of the loss that each change has to explain.
pub(super) const LEAST_SHARE: f64 = 0.1;
/// The part that changes with another reading of the ground truth have to explain: the loss against another reference may be smaller by
/// chance.
pub(super) const TRUTH_SHARE: f64 = 0.8;
/// A part of the loss by which two explanations differ.
const DIFFERENT: f64 = 0.05;
/// Most changes of an explanation.
const MOST: usize = 4;
/// Explanations that are extended by another change.
const BEAM: usize = 4;
/// An explanation is extended where its last change lowers the loss below this part.
const PROMISING: f64 = 0.95;

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
            Hypothesis::ExposureRgb | Hypothesis::GroundTruth => 2.0 * LEAST_SHARE,
            // They follow from other errors more easily.
            Hypothesis::Placement | Hypothesis::DiffuseFactor | Hypothesis::SpecularFactor => {
                1.25 * LEAST_SHARE
            }
            _ => LEAST_SHARE,
        };
        self.ratio.max(resolvable) + self.proposals.iter().map(cost).sum::<f64>()
    }

    fn explains_enough(&self) -> bool {
        let is_truth = |one: &Proposal| one.hypothesis == Hypothesis::GroundTruth;
        self.ratio <= 1.0 - TRUTH_SHARE || !self.proposals.iter().any(is_truth)
    }

    fn is_aligned(&self) -> bool {
        use Hypothesis::{Placement, Shift, Symmetry};
        self.proposals.iter().any(|one| matches!(one.hypothesis, Shift | Placement | Symmetry))
    }

    /// The same changes with one factor in place of that on each channel, which may have stood for another change. `None` without such
    /// factors.
    fn with_one_factor(&self) -> Option<Vec<Proposal>> {
        let mut proposals = self.proposals.clone();
        let factors = proposals.iter_mut().find(|one| one.hypothesis == Hypothesis::ExposureRgb)?;
        *factors = Proposal::exposure([0.0; 3], Hypothesis::Exposure);
        Some(proposals)
    }

    /// Whether it has the same changes.
    fn is_same(&self, other: &Self) -> bool {
        self.proposals.len() == other.proposals.len()
            && self.proposals.iter().all(|one| other.proposals.iter().any(|of| of.change == one.change))
    }

    /// Whether this change may join.
    fn admits(&self, added: &Proposal) -> bool {
        self.proposals.iter().all(|one| !exclude([one, added]))
    }
}

/// Whether two changes do the same, or change one map of both sides: two readings imitate what is none.
fn exclude(pair: [&Proposal; 2]) -> bool {
    use Hypothesis::{AlbedoEncoding, DiffuseEncoding, GroundTruth, SpecularEncoding};
    let hypotheses = pair.map(|one| one.hypothesis);
    let both = |of: &[Hypothesis]| hypotheses.iter().all(|one| of.contains(one));
    hypotheses[0] == hypotheses[1]
        || hypotheses.iter().all(|one| is_exposure(*one))
        || hypotheses.contains(&AlbedoEncoding) && both(&[AlbedoEncoding, DiffuseEncoding, SpecularEncoding])
        || hypotheses.contains(&GroundTruth)
            && Map::ALL.iter().any(|map| pair.iter().all(|one| one.change.is_some_and(|of| is_of(of, *map))))
}

/// Whether a change is of the values of a map.
fn is_of(change: Change, map: Map) -> bool {
    let of: &[Map] = match change {
        Change::DiffuseFactor(_) => &[Map::Diffuse],
        Change::SpecularFactor(_) => &[Map::Specular],
        Change::Reading(reading) | Change::GroundTruth(reading) => match reading {
            Reading::NormalX | Reading::NormalY => &[Map::Normal],
            Reading::Colours(_) | Reading::RedBlue => &[Map::Diffuse, Map::Specular],
            Reading::Diffuse(_) | Reading::Scaled | Reading::Unscaled => &[Map::Diffuse],
            Reading::Specular(_) => &[Map::Specular],
            Reading::Gloss | Reading::RootOfRoughness | Reading::SquaredRoughness => &[Map::Roughness],
        },
        _ => &[],
    };
    of.contains(&map)
}

fn is_exposure(hypothesis: Hypothesis) -> bool {
    matches!(hypothesis, Hypothesis::Exposure | Hypothesis::ExposureRgb)
}

/// The explanation with the least loss where each change has to explain a part of it; `resolvable`: the part of the loss below which
/// nothing is explained. What is fitted is fitted in the pilot.
pub(super) fn explain(
    [search, pilot]: [&Trials<'_>; 2],
    alignments: &Alignments,
    resolvable: f64,
) -> Result<Vec<Proposal>, Error> {
    // Also where an alignment alone raises the loss, as beside normals of another sign.
    let shifts = alignments.shifts.iter().map(|&shift| Proposal::shift(shift));
    let placement = alignments.placement.map(|placement| Proposal::placement(Some(placement)));
    let mut aligned: Vec<Vec<Proposal>> = shifts.chain(placement).map(|one| vec![one]).collect();
    aligned.extend(alignments.symmetries.iter().map(|&(symmetry, shift)| {
        let shift = (shift != [0, 0]).then(|| Proposal::shift(shift));
        [Proposal::symmetry(symmetry)].into_iter().chain(shift).collect()
    }));
    let (mut best, mut open) = (Explanation::none(), vec![Explanation::none()]);
    for _ in 0..MOST {
        open = extended(search, &open, &aligned, resolvable)?;
        let candidates = std::iter::once(&best).chain(open.iter().filter(|one| one.explains_enough()));
        let least = candidates.min_by(|a, b| a.score(resolvable).total_cmp(&b.score(resolvable))).cloned();
        best = least.unwrap_or(best);
        if open.is_empty() || best.ratio <= resolvable {
            break;
        }
    }
    fitted(pilot, best.proposals)
}

/// The most promising explanations with one change more than those of `open`, or with an alignment.
fn extended(
    pilot: &Trials<'_>,
    open: &[Explanation],
    aligned: &[Vec<Proposal>],
    resolvable: f64,
) -> Result<Vec<Explanation>, Error> {
    let mut all = Vec::new();
    for one in open.iter().filter(|one| one.ratio > resolvable) {
        let added = singles(pilot).into_iter().filter(|added| one.admits(added)).map(|added| vec![added]);
        let aligned = aligned.iter().filter(|_| !one.is_aligned()).cloned();
        let added: Vec<Vec<Proposal>> = added.chain(aligned).collect();
        let bases = std::iter::once(one.proposals.clone()).chain(one.with_one_factor());
        let sets = bases.flat_map(|base| added.iter().map(move |added| [&base[..], added].concat()));
        let tried = tried(pilot, sets.collect())?;
        let limit = PROMISING * one.ratio;
        let is_kept = |new: &Explanation| new.ratio < limit || new.is_aligned() && !one.is_aligned();
        all.extend(tried.into_iter().filter(is_kept));
    }
    sort_by_number(&mut all, |one| one.score(resolvable));
    all.dedup_by(|a, b| a.is_same(b));
    all.truncate(BEAM);
    Ok(all)
}

/// Each reading, factor and exposure alone; what is free is fitted when it is tried. The encoding of both colours comes last: where only
/// one of them is in another encoding, it changes the same.
fn singles(pilot: &Trials<'_>) -> Vec<Proposal> {
    let free = [
        Proposal::exposure([0.0; 3], Hypothesis::Exposure),
        Proposal::exposure([0.0; 3], Hypothesis::ExposureRgb),
        Proposal::diffuse_factor(1.0),
        Proposal::specular_factor(1.0),
    ];
    let readings = Proposal::readings(pilot.pair.storages).into_iter().flatten();
    let mut all: Vec<Proposal> = readings.chain(free).collect();
    all.sort_by_key(|proposal| proposal.hypothesis == Hypothesis::AlbedoEncoding);
    all
}

/// The losses under each of these sets of changes, which are fitted.
fn tried(pilot: &Trials<'_>, sets: Vec<Vec<Proposal>>) -> Result<Vec<Explanation>, Error> {
    let sets = parallel::try_map(sets.len(), |set| fitted(pilot, sets[set].clone()))?;
    let trials: Vec<Vec<Change>> =
        sets.iter().map(|set| set.iter().filter_map(|one| one.change).collect()).collect();
    let losses = pilot.losses(&trials)?;
    let ratio = |paired: &Paired| mean(&paired.after) / mean(&paired.before).max(f64::MIN_POSITIVE);
    let explanation = |(proposals, paired)| Explanation { proposals, ratio: ratio(paired) };
    Ok(sets.into_iter().zip(&losses).map(explanation).collect())
}

/// The same changes with their factors fitted after all others, and then their exposure.
pub(super) fn fitted(pilot: &Trials<'_>, mut proposals: Vec<Proposal>) -> Result<Vec<Proposal>, Error> {
    let is_factor =
        |one: &Proposal| matches!(one.hypothesis, Hypothesis::DiffuseFactor | Hypothesis::SpecularFactor);
    let others = |all: &[Proposal], is_fitted: &dyn Fn(&Proposal) -> bool| -> Vec<Change> {
        all.iter().filter(|one| !is_fitted(one)).filter_map(|one| one.change).collect()
    };
    if proposals.iter().any(is_factor) {
        let [diffuse, specular] =
            pilot.best_factors(&others(&proposals, &|one| is_factor(one) || is_exposure(one.hypothesis)))?;
        for one in &mut proposals {
            match one.hypothesis {
                Hypothesis::DiffuseFactor => *one = Proposal::diffuse_factor(diffuse),
                Hypothesis::SpecularFactor => *one = Proposal::specular_factor(specular),
                _ => {}
            }
        }
    }
    if let Some(place) = proposals.iter().position(|one| is_exposure(one.hypothesis)) {
        let hypothesis = proposals[place].hypothesis;
        let others = others(&proposals, &|one| is_exposure(one.hypothesis));
        let stops = pilot.best_exposure(&others, hypothesis == Hypothesis::ExposureRgb)?;
        proposals[place] = Proposal::exposure(stops, hypothesis);
    }
    Ok(proposals)
}

/// The change in place of each proposal of `explanation` that lowers the loss as far, where there is one. In place of a factor on each
/// channel it may come with one factor on all: both together are as free, or less.
pub(super) fn alternatives(
    pilot: &Trials<'_>,
    proposals: &[Proposal],
) -> Result<Vec<Option<Alternative>>, Error> {
    let with = tried(pilot, vec![proposals.to_vec()])?.first().map_or(1.0, |all| all.ratio);
    let of = |place: usize| {
        let mut rest = Explanation { proposals: proposals.to_vec(), ratio: 1.0 };
        let replaced = rest.proposals.remove(place).hypothesis;
        let is_other = |other: &Proposal| {
            let hypothesis = other.hypothesis;
            let is_same = hypothesis == replaced || is_exposure(hypothesis) && is_exposure(replaced);
            !is_same && rest.admits(other)
        };
        let others: Vec<Proposal> = singles(pilot).into_iter().filter(is_other).collect();
        let exposure = Proposal::exposure([0.0; 3], Hypothesis::Exposure);
        let beside = (replaced == Hypothesis::ExposureRgb).then(|| vec![exposure]);
        let set = |beside: &[Proposal], other: &Proposal| {
            [&rest.proposals[..], beside, std::slice::from_ref(other)].concat()
        };
        let is_free = |other: &&Proposal| !is_exposure(other.hypothesis);
        let alone = others.iter().map(|other| set(&[], other));
        let beside = beside.iter().flat_map(|one| others.iter().filter(is_free).map(|other| set(one, other)));
        let tried = tried(pilot, alone.chain(beside).collect())?;
        let best = tried.iter().min_by(|a, b| a.ratio.total_cmp(&b.ratio));
        let best = best.filter(|other| other.ratio < with + DIFFERENT);
        Ok(best.and_then(|other| {
            let change = other.proposals.last()?.change?;
            Some(Alternative { change, explains_more: other.ratio < with - DIFFERENT })
        }))
    };
    (0..proposals.len()).map(of).collect()
}
