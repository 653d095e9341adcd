//! Proposals: each hypothesis with the value that fits best in the scenes of a pilot.

use super::change::Change;
use super::finding::{Hypothesis, Value};
use super::reading::Reading;
use super::remedy::Remedy;
use super::shift::{candidates, interior};
use super::storage::Storage;
use super::symmetry::Symmetry;
use super::trials::{Paired, Trials, mean};
use crate::error::Error;

/// Shifts that are confirmed by the loss.
const SHIFTS: usize = 3;

/// A hypothesis with the value that was fitted.
pub(super) struct Proposal {
    pub(super) hypothesis: Hypothesis,
    pub(super) value: Value,
    /// `None`: the best value changes nothing.
    pub(super) change: Option<Change>,
    pub(super) remedy: Option<Remedy>,
}

impl Proposal {
    fn new(hypothesis: Hypothesis, value: Value, change: Change) -> Self {
        Self { hypothesis, value, change: Some(change), remedy: None }
    }

    /// All hypotheses in the order of their lines, with the values that have the least loss in `pilot`; and the displacement by parts
    /// of a texel.
    pub(super) fn all(pilot: &Trials<'_>) -> Result<(Vec<Self>, Value), Error> {
        let (shift, subtexel) = shift(pilot)?;
        let first = [exposure(pilot, false)?, exposure(pilot, true)?, shift, symmetry(pilot)?];
        let readings = readings(pilot.storage).into_iter();
        let readings = readings.map(|(hypothesis, readings)| reading(pilot, hypothesis, &readings));
        let all = first.into_iter().map(Ok).chain(readings).collect::<Result<_, Error>>()?;
        Ok((all, subtexel))
    }
}

fn exposure(pilot: &Trials<'_>, per_channel: bool) -> Result<Proposal, Error> {
    let stops = pilot.best_exposure(&[], per_channel)?;
    let (hypothesis, value) = match per_channel {
        true => (Hypothesis::ExposureRgb, Value::Numbers(stops)),
        false => (Hypothesis::Exposure, Value::Number(stops[0])),
    };
    Ok(Proposal::new(hypothesis, value, Change::Exposure(stops)))
}

fn symmetry(pilot: &Trials<'_>) -> Result<Proposal, Error> {
    let mut symmetries: Vec<Symmetry> = Symmetry::of(pilot.ground_truth.size()).collect();
    let best = best(pilot, symmetries.iter().map(|&symmetry| Change::Symmetry(symmetry)))?;
    let symmetry = symmetries.swap_remove(best);
    Ok(Proposal::new(Hypothesis::Symmetry, Value::Name(symmetry.name()), Change::Symmetry(symmetry)))
}

fn reading(pilot: &Trials<'_>, hypothesis: Hypothesis, readings: &[Reading]) -> Result<Proposal, Error> {
    let reading = readings[best(pilot, readings.iter().map(|&reading| Change::Reading(reading)))?];
    let proposal = Proposal::new(hypothesis, Value::Name(reading.name()), Change::Reading(reading));
    Ok(Proposal { remedy: Remedy::of(pilot.storage, reading), ..proposal })
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
    let has = |hypothesis| Hypothesis::of(storage).any(|of_storage| of_storage == hypothesis);
    all.into_iter().filter(|(hypothesis, _)| has(*hypothesis)).collect()
}

/// The index of the change with the least loss.
fn best(pilot: &Trials<'_>, changes: impl Iterator<Item = Change>) -> Result<usize, Error> {
    let trials: Vec<Vec<Change>> = changes.map(|change| vec![change]).collect();
    if trials.len() < 2 {
        return Ok(0);
    }
    let losses = pilot.losses(&trials)?;
    let least = losses.iter().enumerate().min_by(|a, b| mean(&a.1.after).total_cmp(&mean(&b.1.after)));
    Ok(least.map_or(0, |(index, _)| index))
}

/// The displacement of the prediction by whole texels, and that by parts of a texel.
fn shift(pilot: &Trials<'_>) -> Result<(Proposal, Value), Error> {
    let candidates = candidates(pilot.ground_truth, pilot.prediction, SHIFTS);
    let fits = ratios(pilot, &candidates)?;
    let least = candidates.into_iter().zip(fits).min_by(|a, b| a.1.total_cmp(&b.1));
    let (shift, ratio) = least.filter(|(_, ratio)| *ratio < 1.0).unwrap_or(([0, 0], 1.0));
    let value = Value::Displacement(shift.map(f64::from));
    let change = (shift != [0, 0]).then_some(Change::Shift(shift));
    let subtexel = subtexel(pilot, shift, ratio)?.map_or_else(|| value.clone(), Value::Displacement);
    Ok((Proposal { hypothesis: Hypothesis::Shift, value, change, remedy: None }, subtexel))
}

/// The losses after shifts by the losses before, on the texels that both have.
fn ratios(pilot: &Trials<'_>, shifts: &[[i32; 2]]) -> Result<Vec<f64>, Error> {
    let trials: Vec<Vec<Change>> = shifts.iter().map(|&shift| vec![Change::Shift(shift)]).collect();
    let ratio = |paired: &Paired| {
        if mean(&paired.before) > 0.0 { mean(&paired.after) / mean(&paired.before) } else { 1.0 }
    };
    Ok(pilot.losses(&trials)?.iter().map(ratio).collect())
}

/// The vertex of the parabolas through the losses at a shift, where the `centre` is, and at its neighbours; `None` where the map has no
/// room for them.
fn subtexel(pilot: &Trials<'_>, [x, y]: [i32; 2], centre: f64) -> Result<Option<[f64; 2]>, Error> {
    let neighbours = [[x - 1, y], [x + 1, y], [x, y - 1], [x, y + 1]];
    let [left, right, above, below] = ratios(pilot, &neighbours)?[..] else { return Ok(None) };
    let vertex = |before: f64, after: f64| {
        let curvature = before - 2.0 * centre + after;
        if curvature > 0.0 { (0.5 * (before - after) / curvature).clamp(-0.5, 0.5) } else { 0.0 }
    };
    let has_room = !interior(pilot.ground_truth.size(), [x.abs() + 1, y.abs() + 1]).is_empty();
    Ok(has_room.then(|| [f64::from(x) + vertex(left, right), f64::from(y) + vertex(above, below)]))
}
