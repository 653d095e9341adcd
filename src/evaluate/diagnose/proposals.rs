//! Proposals: each hypothesis with the value that fits best in the scenes of a pilot.

use super::alignment::Alignments;
use super::finding::{Hypothesis, Value};
use super::trials::{Paired, Trials, mean};
use svbrdf_core::error::Error;
use svbrdf_files::changes::{Change, Placement, Reading, Symmetry};
use svbrdf_files::read::{Albedo, ReadOptions, Storage};

/// A hypothesis with the value that was fitted.
#[derive(Clone, Debug)]
pub(super) struct Proposal {
    pub(super) hypothesis: Hypothesis,
    pub(super) value: Value,
    /// `None`: the best value changes nothing.
    pub(super) change: Option<Change>,
    pub(super) remedy: Option<ReadOptions>,
}

impl Proposal {
    fn new(hypothesis: Hypothesis, value: Value, change: Change) -> Self {
        Self { hypothesis, value, change: Some(change), remedy: None }
    }

    /// All hypotheses in the order of their lines, with the values that have the least loss in `pilot`.
    pub(super) fn all(pilot: &Trials<'_>, alignments: &Alignments) -> Result<Vec<Self>, Error> {
        let fitted = |hypothesis| -> Result<Self, Error> {
            Ok(Self::exposure(pilot.best_exposure(&[], hypothesis == Hypothesis::ExposureRgb)?, hypothesis))
        };
        let [diffuse, specular] = pilot.best_factors(&[])?;
        let mut all = vec![
            fitted(Hypothesis::Exposure)?,
            fitted(Hypothesis::ExposureRgb)?,
            shift(pilot, &alignments.shifts)?,
            Self::placement(alignments.placement),
            symmetry(pilot)?,
            Self::diffuse_factor(diffuse),
            Self::specular_factor(specular),
        ];
        for mut readings in Self::readings(pilot.pair.storages).into_iter().filter(|some| !some.is_empty()) {
            let best = best(pilot, readings.iter().filter_map(|reading| reading.change))?;
            all.push(readings.swap_remove(best));
        }
        Ok(all)
    }

    /// `None`: where it is.
    pub(super) fn placement(placement: Option<Placement>) -> Self {
        let Placement { scale, by: [right, down] } = placement.unwrap_or(Placement::NONE);
        let value = Value::Placement([scale, right, down]);
        let change = placement.map(Change::Placement);
        Self { hypothesis: Hypothesis::Placement, value, change, remedy: None }
    }

    pub(super) fn diffuse_factor(factor: f64) -> Self {
        Self::new(Hypothesis::DiffuseFactor, Value::Number(factor), Change::DiffuseFactor(factor))
    }

    pub(super) fn specular_factor(factor: f64) -> Self {
        Self::new(Hypothesis::SpecularFactor, Value::Number(factor), Change::SpecularFactor(factor))
    }

    pub(super) fn exposure(stops: [f64; 3], hypothesis: Hypothesis) -> Self {
        let value = match hypothesis {
            Hypothesis::ExposureRgb => Value::Numbers(stops),
            _ => Value::Number(stops[0]),
        };
        Self::new(hypothesis, value, Change::Exposure(stops))
    }

    pub(super) fn shift(shift: [i32; 2]) -> Self {
        let value = Value::Displacement(shift.map(f64::from));
        let change = (shift != [0, 0]).then_some(Change::Shift(shift));
        Self { hypothesis: Hypothesis::Shift, value, change, remedy: None }
    }

    pub(super) fn symmetry(symmetry: Symmetry) -> Self {
        Self::new(Hypothesis::Symmetry, Value::Name(symmetry.name()), Change::Symmetry(symmetry))
    }

    /// All readings by hypothesis, those of the ground truth last.
    pub(super) fn readings([of_truth, of_prediction]: [&Storage; 2]) -> Vec<Vec<Self>> {
        let one = |hypothesis: Hypothesis, reading: Reading| Self {
            remedy: reading.remedy(of_prediction),
            ..Self::new(hypothesis, Value::Name(reading.name()), Change::Reading(reading))
        };
        let truth = |reading: Reading| Self {
            remedy: reading.remedy(of_truth),
            ..Self::new(Hypothesis::GroundTruth, Value::Name(reading.words()), Change::GroundTruth(reading))
        };
        let prediction = readings(of_prediction)
            .into_iter()
            .map(|(hypothesis, readings)| readings.into_iter().map(|r| one(hypothesis, r)).collect());
        let truths = readings(of_truth).into_iter().flat_map(|(_, readings)| readings).map(truth).collect();
        prediction.chain([truths]).collect()
    }
}

fn symmetry(pilot: &Trials<'_>) -> Result<Proposal, Error> {
    let mut symmetries: Vec<Symmetry> = Symmetry::of(pilot.pair.ground_truth.size()).collect();
    let best = best(pilot, symmetries.iter().map(|&symmetry| Change::Symmetry(symmetry)))?;
    Ok(Proposal::symmetry(symmetries.swap_remove(best)))
}

/// The readings that are tried, by hypothesis.
fn readings(storage: &Storage) -> Vec<(Hypothesis, Vec<Reading>)> {
    let encodings = |of: Option<Albedo>, reading: fn(Albedo) -> Reading| {
        Storage::encodings(of).iter().map(|&to| reading(to)).collect::<Vec<_>>()
    };
    let energy = if storage.unscaled { Reading::Scaled } else { Reading::Unscaled };
    let all = vec![
        (Hypothesis::NormalY, vec![Reading::NormalY]),
        (Hypothesis::NormalX, vec![Reading::NormalX]),
        (Hypothesis::AlbedoEncoding, encodings(storage.colours, Reading::Colours)),
        (Hypothesis::DiffuseEncoding, encodings(storage.colours, Reading::Diffuse)),
        (Hypothesis::SpecularEncoding, encodings(storage.specular, Reading::Specular)),
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

/// The displacement of the prediction by whole texels with the least loss.
fn shift(pilot: &Trials<'_>, candidates: &[[i32; 2]]) -> Result<Proposal, Error> {
    let ratios = ratios(pilot, candidates)?;
    let least = candidates.iter().zip(ratios).min_by(|a, b| a.1.total_cmp(&b.1));
    Ok(Proposal::shift(least.filter(|(_, ratio)| *ratio < 1.0).map_or([0, 0], |(shift, _)| *shift)))
}

/// The losses after shifts by the losses before, on the texels that both have.
fn ratios(pilot: &Trials<'_>, shifts: &[[i32; 2]]) -> Result<Vec<f64>, Error> {
    let trials: Vec<Vec<Change>> = shifts.iter().map(|&shift| vec![Change::Shift(shift)]).collect();
    let ratio = |paired: &Paired| {
        if mean(&paired.before) > 0.0 { mean(&paired.after) / mean(&paired.before) } else { 1.0 }
    };
    Ok(pilot.losses(&trials)?.iter().map(ratio).collect())
}
