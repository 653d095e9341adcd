//! The diagnosis of a prediction: values fitted in a pilot, evaluated in other scenes.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::change::Change;
use super::finding::{Diagnosis, Finding, Hypothesis, Value};
use super::holm::holm;
use super::ladder::{Rung, ladder};
use super::reading::Reading;
use super::remedy::remedy;
use super::seams::seams;
use super::shift::{candidates, interior};
use super::storage::Storage;
use super::symmetry::Symmetry;
use super::trials::{Paired, Trials};
use crate::error::Error;
use crate::loss::{Estimate, check_same_size};
use crate::material::Material;
use crate::model::convention::Convention;
use crate::model::sampler::{REPLICATES, Sampler};
use crate::model::scene::Scene;
use crate::progress::Progress;

/// Near-field scenes, distant scenes, and texels of each up to which all are compared: of the pilot, and of the evaluation. Of larger maps
/// an eighth as many are.
const PILOT: [usize; 3] = [64, 32, 8192];
const EVALUATION: [usize; 3] = [128, 64, 1 << 16];
/// What the seed of the pilot differs by.
const PILOT_SEED: u64 = 0x7069_6c6f_7400_0000;
/// Least share of a marked finding.
const LEAST_SHARE: f64 = 0.1;
/// The probability of any mark where nothing explains the loss.
const LEVEL: f64 = 0.05;
/// Shifts that are confirmed by the loss.
const SHIFTS: usize = 3;
/// Near-field and distant scenes of the ladder.
const LADDER: [usize; 2] = [16, 8];

/// A hypothesis with the value that was fitted.
struct Proposal {
    hypothesis: Hypothesis,
    value: Value,
    /// `None`: the best value changes nothing.
    change: Option<Change>,
    remedy: Option<String>,
}

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
    progress.begin(4);
    let materials = [ground_truth, prediction];
    let trials = |size, seed| Trials::new(materials, storage, convention, size, seed, progress);
    let (pilot, evaluation) = (trials(PILOT, seed ^ PILOT_SEED)?, trials(EVALUATION, seed)?);
    let (proposals, subtexel) = proposals(&pilot)?;
    progress.step()?;
    let search = Search { pilot, evaluation };
    let (loss, mut findings) = search.findings(&proposals)?;
    progress.step()?;
    search.mark(&proposals, &mut findings)?;
    progress.step()?;
    let scenes = Sampler::Sobol.scenes(seed, LADDER[0], LADDER[1], convention);
    let ladder = ladder(ground_truth, prediction, &scenes, convention, &progress.part())?;
    progress.step()?;
    findings.insert(3, untested(Hypothesis::Subtexel, subtexel, None));
    findings.insert(5, resampling(&ladder));
    let prediction_seams = seams(prediction);
    Ok(Diagnosis {
        prediction: prediction.name().to_owned(),
        loss,
        findings,
        ladder,
        seams: prediction_seams,
    })
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
    }
}

/// The part of the loss that is due to detail smaller than 2 texels.
fn resampling(ladder: &[Rung]) -> Finding {
    let losses = ladder.get(1).map(|half| [ladder[0].loss, half.loss]);
    untested(Hypothesis::Resampling, Value::Number(2.0), losses)
}

/// All hypotheses with the values that fit best in the scenes of `pilot`, in the order of their lines, and the displacement by parts of
/// a texel.
fn proposals(pilot: &Trials<'_>) -> Result<(Vec<Proposal>, Value), Error> {
    let exposure = |hypothesis, per_channel| -> Result<Proposal, Error> {
        let stops = pilot.best_exposure(&[], per_channel)?;
        let value = if per_channel { Value::Numbers(stops) } else { Value::Number(stops[0]) };
        Ok(Proposal { hypothesis, value, change: Some(Change::Exposure(stops)), remedy: None })
    };
    let (shift, subtexel) = shift(pilot)?;
    let change = (shift != [0, 0]).then_some(Change::Shift(shift));
    let value = Value::Displacement(shift.map(f64::from));
    let mut proposals = vec![
        exposure(Hypothesis::Exposure, false)?,
        exposure(Hypothesis::ExposureRgb, true)?,
        Proposal { hypothesis: Hypothesis::Shift, value, change, remedy: None },
    ];
    let mut symmetries: Vec<Symmetry> = Symmetry::of(pilot.ground_truth.size()).collect();
    let best =
        best(pilot, &symmetries.iter().map(|&symmetry| Change::Symmetry(symmetry)).collect::<Vec<_>>())?;
    let symmetry = symmetries.swap_remove(best);
    proposals.push(Proposal {
        hypothesis: Hypothesis::Symmetry,
        value: Value::Name(symmetry.name()),
        change: Some(Change::Symmetry(symmetry)),
        remedy: None,
    });
    for (hypothesis, readings) in readings(pilot.storage) {
        let changes: Vec<Change> = readings.iter().map(|&reading| Change::Reading(reading)).collect();
        let reading = readings[self::best(pilot, &changes)?];
        proposals.push(Proposal {
            hypothesis,
            value: Value::Name(reading.name()),
            change: Some(Change::Reading(reading)),
            remedy: remedy(pilot.storage, reading),
        });
    }
    Ok((proposals, subtexel))
}

/// The readings that are tried, by hypothesis.
fn readings(storage: &Storage) -> Vec<(Hypothesis, Vec<Reading>)> {
    let colours = Storage::encodings(storage.colours).iter().map(|&to| Reading::Colours(to));
    let specular = Storage::encodings(storage.specular).iter().map(|&to| Reading::Specular(to));
    let energy = if storage.unscaled { Reading::Scaled } else { Reading::Unscaled };
    let all = vec![
        (Hypothesis::NormalY, vec![Reading::NormalY]),
        (Hypothesis::NormalX, vec![Reading::NormalX]),
        (Hypothesis::AlbedoEncoding, colours.collect()),
        (Hypothesis::SpecularEncoding, specular.collect()),
        (Hypothesis::Roughness, vec![Reading::Gloss, Reading::RootOfRoughness, Reading::SquaredRoughness]),
        (Hypothesis::Channels, vec![Reading::RedBlue]),
        (Hypothesis::Energy, vec![energy]),
    ];
    let has = |hypothesis| !(storage.base_colour && hypothesis == Hypothesis::SpecularEncoding);
    all.into_iter().filter(|(hypothesis, _)| has(*hypothesis)).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// The index of the change with the least loss.
fn best(pilot: &Trials<'_>, changes: &[Change]) -> Result<usize, Error> {
    if changes.len() < 2 {
        return Ok(0);
    }
    let trials: Vec<Vec<Change>> = changes.iter().map(|&change| vec![change]).collect();
    let losses = pilot.losses(&trials)?;
    let least = losses.iter().enumerate().min_by(|a, b| mean(&a.1.after).total_cmp(&mean(&b.1.after)));
    Ok(least.map_or(0, |(index, _)| index))
}

/// The displacement of the prediction by whole texels, and that by parts of a texel.
fn shift(pilot: &Trials<'_>) -> Result<([i32; 2], Value), Error> {
    let ratios = |shifts: &[[i32; 2]]| -> Result<Vec<f64>, Error> {
        let trials: Vec<Vec<Change>> = shifts.iter().map(|&shift| vec![Change::Shift(shift)]).collect();
        let ratio = |paired: &Paired| {
            if mean(&paired.before) > 0.0 { mean(&paired.after) / mean(&paired.before) } else { 1.0 }
        };
        Ok(pilot.losses(&trials)?.iter().map(ratio).collect())
    };
    let candidates = candidates(pilot.ground_truth, pilot.prediction, SHIFTS);
    let fits = ratios(&candidates)?;
    let least = candidates.into_iter().zip(fits).min_by(|a, b| a.1.total_cmp(&b.1));
    let (shift, centre) = least.filter(|(_, ratio)| *ratio < 1.0).unwrap_or(([0, 0], 1.0));
    let [x, y] = shift;
    let [left, right, above, below] = ratios(&[[x - 1, y], [x + 1, y], [x, y - 1], [x, y + 1]])?[..] else {
        return Ok((shift, Value::Displacement(shift.map(f64::from))));
    };
    // The vertex of the parabola through three losses.
    let vertex = |before: f64, after: f64| {
        let curvature = before - 2.0 * centre + after;
        if curvature > 0.0 { (0.5 * (before - after) / curvature).clamp(-0.5, 0.5) } else { 0.0 }
    };
    let subtexel = [f64::from(x) + vertex(left, right), f64::from(y) + vertex(above, below)];
    let has_room = !interior(pilot.ground_truth.size(), [x.abs() + 1, y.abs() + 1]).is_empty();
    Ok((shift, Value::Displacement(if has_room { subtexel } else { shift.map(f64::from) })))
}

struct Search<'a> {
    pilot: Trials<'a>,
    evaluation: Trials<'a>,
}

impl Search<'_> {
    /// The loss, and the finding of each proposal, not yet marked.
    fn findings(&self, proposals: &[Proposal]) -> Result<(Estimate, Vec<Finding>), Error> {
        // The first trial changes nothing.
        let changed = proposals.iter().filter_map(|proposal| Some(vec![proposal.change?]));
        let trials: Vec<Vec<Change>> = std::iter::once(Vec::new()).chain(changed).collect();
        let mut losses = self.evaluation.losses(&trials)?.into_iter();
        let unchanged = losses.next().ok_or_else(|| Error::Internal("a trial has no loss".to_owned()))?;
        let scenes = &self.evaluation.scenes;
        let finding = |proposal: &Proposal| {
            let paired = proposal.change.and_then(|_| losses.next()).unwrap_or_else(|| unchanged.clone());
            finding(proposal, &paired, scenes)
        };
        let mut findings: Vec<Finding> = proposals.iter().map(finding).collect();
        let p = holm(&findings.iter().map(|finding| finding.p.unwrap_or(1.0)).collect::<Vec<_>>());
        findings.iter_mut().zip(p).for_each(|(finding, p)| finding.p = Some(p));
        Ok((Estimate::of_sampled(Sampler::Sobol, scenes, &unchanged.before), findings))
    }

    /// Marks the finding with the largest share, then those whose shares remain after the corrections of the marked ones.
    fn mark(&self, proposals: &[Proposal], findings: &mut [Finding]) -> Result<(), Error> {
        let share = |finding: &Finding| finding.share.unwrap_or(0.0);
        let passes =
            |finding: &Finding| finding.p.is_some_and(|p| p < LEVEL) && share(finding) >= LEAST_SHARE;
        let mut open: Vec<usize> = (0..findings.len()).filter(|&i| passes(&findings[i])).collect();
        // Three factors explain at least as much as one.
        let largest = |open: &[usize]| {
            open.iter().copied().max_by(|&a, &b| share(&findings[a]).total_cmp(&share(&findings[b])))
        };
        let first = largest(&open).map(|best| {
            let one = open.iter().copied().find(|&i| findings[i].hypothesis == Hypothesis::Exposure);
            let is_rgb = findings[best].hypothesis == Hypothesis::ExposureRgb;
            one.filter(|&one| is_rgb && share(&findings[best]) - share(&findings[one]) < LEAST_SHARE)
                .unwrap_or(best)
        });
        let mut next = first;
        let mut marked = Vec::new();
        while let Some(index) = next {
            marked.push(index);
            open.retain(|&other| other != index);
            next = self.next(proposals, &marked, &mut open)?;
        }
        marked.into_iter().for_each(|index| findings[index].marked = true);
        Ok(())
    }

    /// The proposal that explains most beside the `marked` ones; those that explain too little are removed from `open`.
    fn next(
        &self,
        proposals: &[Proposal],
        marked: &[usize],
        open: &mut Vec<usize>,
    ) -> Result<Option<usize>, Error> {
        if open.is_empty() {
            return Ok(None);
        }
        let with =
            |other: Option<usize>| self.together(marked.iter().copied().chain(other).map(|i| &proposals[i]));
        let trials = std::iter::once(None).chain(open.iter().copied().map(Some)).map(with);
        let losses = self.evaluation.losses(&trials.collect::<Result<Vec<_>, Error>>()?)?;
        let relative = |paired: &Paired| {
            let before = mean(&paired.before).max(f64::MIN_POSITIVE);
            paired.after.iter().map(|loss| loss / before).collect::<Vec<_>>()
        };
        let first = relative(&losses[0]);
        let fall = |paired: &Paired| {
            Estimate::of_difference(Sampler::Sobol, &self.evaluation.scenes, &first, &relative(paired))
        };
        let falls: Vec<Estimate> = losses[1..].iter().map(fall).collect();
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

    /// The changes of several proposals; exposures are fitted again, after the others.
    fn together<'p>(&self, proposals: impl Iterator<Item = &'p Proposal>) -> Result<Vec<Change>, Error> {
        let (exposures, others): (Vec<_>, Vec<_>) =
            proposals.partition(|p| matches!(p.change, Some(Change::Exposure(_))));
        let mut changes: Vec<Change> = others.iter().filter_map(|proposal| proposal.change).collect();
        if !exposures.is_empty() {
            let per_channel = exposures.iter().any(|p| p.hypothesis == Hypothesis::ExposureRgb);
            changes.push(Change::Exposure(self.pilot.best_exposure(&changes, per_channel)?));
        }
        Ok(changes)
    }
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
        loss: Some(loss.mean),
        interval95: loss.interval95,
        share: Some(share(fall.mean)),
        share_interval95: share_interval(paired, scenes),
        p: Some(one_sided(&fall)),
        marked: false,
        remedy: proposal.remedy.clone(),
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
fn one_sided(fall: &Estimate) -> f64 {
    let error = fall.standard_error.unwrap_or(f64::INFINITY);
    if error == 0.0 || fall.mean <= 0.0 {
        return if fall.mean > 0.0 { 0.0 } else { 1.0 };
    }
    StudentsT::new(0.0, 1.0, (REPLICATES - 1) as f64).map_or(1.0, |t| t.sf(fall.mean / error))
}
