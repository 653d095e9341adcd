//! Ranges of the numbers that come from settings and sessions: the one place that refuses what is out of them.

use std::ops::RangeInclusive;

use svbrdf_core::loss::{LossSettings, Sampling, Texels};

use crate::model::Model;
use crate::model::view::{STOPS, ViewState};

/// Physical pixels per texel.
const PIXELS_PER_TEXEL: RangeInclusive<f32> = 1e-4..=1e6;
/// The texel in the centre of a pane.
const CENTRE: RangeInclusive<f32> = 0.0..=1e6;
/// Scale of text and controls. The smallest text has 11 points, and 8 at the smallest scale.
pub const UI_SCALE: RangeInclusive<f32> = 0.75..=4.0;
/// Target error of a loss in percent.
const TARGET_PERCENT: RangeInclusive<f64> = 0.001..=100.0;
/// Time for a loss in milliseconds.
const TIME_MS: RangeInclusive<u64> = 1..=3_600_000;
/// Sampled texels of a scene.
const TEXELS: RangeInclusive<usize> = 1..=1 << 28;
/// Largest number of a prediction.
const PREDICTIONS: usize = 100_000;

/// What is checked: its name, whether it is usable, and what puts a usable value in its place.
type Check = (&'static str, fn(&Model) -> bool, fn(&mut Model));

const CHECKS: [Check; 11] = [
    ("UI scale", |m| UI_SCALE.contains(&m.settings.ui_scale), |m| m.settings.ui_scale = 1.0),
    (
        "number of scenes",
        |m| m.settings.loss.near.max(m.settings.loss.distant) <= Sampling::MAX_SCENES / 2,
        |m| {
            let LossSettings { near, distant, .. } = LossSettings::default();
            (m.settings.loss.near, m.settings.loss.distant) = (near, distant);
        },
    ),
    (
        "target error",
        |m| TARGET_PERCENT.contains(&m.settings.loss.target_percent),
        |m| m.settings.loss.target_percent = LossSettings::default().target_percent,
    ),
    (
        "time budget",
        |m| TIME_MS.contains(&m.settings.loss.time_ms),
        |m| m.settings.loss.time_ms = LossSettings::default().time_ms,
    ),
    (
        "sampled texels",
        |m| !matches!(m.settings.loss.texels, Texels::Sampled(count) if !TEXELS.contains(&count)),
        |m| m.settings.loss.texels = Texels::All,
    ),
    (
        "scenes of the loss",
        |m| {
            let file = m.settings.loss.file.as_ref();
            file.is_none_or(|file| {
                !file.scenes.is_empty() && file.scenes.iter().all(|scene| scene.check().is_ok())
            })
        },
        |m| m.settings.loss = m.settings.loss.with_file(None),
    ),
    ("exposure", |m| (-STOPS..=STOPS).contains(&m.view.exposure_ev), |m| m.view.exposure_ev = 0.0),
    ("light and view", |m| m.view.scene.check().is_ok(), |m| m.view.scene = ViewState::default().scene),
    ("wipe", |m| (0.0..=1.0).contains(&m.view.display.wipe), |m| m.view.display.wipe = 0.5),
    (
        "magnified part",
        |m| {
            m.view.display.framing.is_none_or(|framing| {
                PIXELS_PER_TEXEL.contains(&framing.pixels_per_texel)
                    && framing.centre.iter().all(|value| CENTRE.contains(value))
            })
        },
        |m| m.view.display.framing = None,
    ),
    (
        "number of the prediction",
        |m| m.view.display.prediction <= PREDICTIONS,
        |m| m.view.display.prediction = 0,
    ),
];

/// Puts the default in the place of every number of settings and view that is out of its range; which, if there were any.
pub fn bring_into_range(model: &mut Model) -> Option<String> {
    let mut found: Vec<&str> = Vec::new();
    for (name, is_usable, mend) in CHECKS {
        if !is_usable(model) {
            found.push(name);
            mend(model);
        }
    }
    if !model.view.display.differences.leave_out_unusable() {
        found.push("difference or its range");
    }
    (!found.is_empty()).then(|| format!("Out of range, and now the default: {}.", found.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_core::picture::difference::Difference;
    use svbrdf_core::picture::quantity::Quantity;
    use svbrdf_files::session::window::Framing;

    /// Numbers that files may hold, usable and not.
    const NUMBERS: [f64; 12] =
        [0.0, -0.0, 1.0, -1.0, 0.5, 1e-30, 1e9, -1e9, f64::MAX, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

    #[test]
    fn whatever_the_numbers_they_are_usable_afterwards_and_it_is_said() {
        let edits: [fn(&mut Model, f64); 9] = [
            |m, number| m.settings.ui_scale = number as f32,
            |m, number| m.settings.loss.target_percent = number,
            |m, number| m.settings.loss.near = number as usize,
            |m, number| m.view.display.wipe = number as f32,
            |m, number| m.view.display.framing = framing(number as f32, 0.0),
            |m, number| m.view.display.framing = framing(1.0, number as f32),
            |m, number| m.view.exposure_ev = number as f32,
            |m, number| m.view.scene.light[2] = number,
            |m, number| m.settings.loss.time_ms = number as u64,
        ];
        for (field, edit) in edits.into_iter().enumerate() {
            let mut mended = 0;
            for number in NUMBERS {
                let mut model = Model::default();
                edit(&mut model, number);
                let unusable = CHECKS.iter().filter(|(_, is_usable, _)| !is_usable(&model)).count();
                mended += unusable;
                assert_eq!(bring_into_range(&mut model).is_some(), unusable > 0, "{field}, {number}");
                assert_eq!(bring_into_range(&mut model), None, "{field}, {number}");
            }
            assert!(mended > 0, "{field}");
        }
    }

    fn framing(pixels_per_texel: f32, centre: f32) -> Option<Framing> {
        Some(Framing { pixels_per_texel, centre: [centre, -centre] })
    }

    #[test]
    fn a_difference_that_a_quantity_does_not_have_is_left_out() {
        let text = r#"{"chosen": [["Normal", "Log"]], "ranges": [[["Rendering", "Log"], -1.0]]}"#;
        let mut model = Model::default();
        model.view.display.differences = serde_json::from_str(text).unwrap();
        assert!(bring_into_range(&mut model).is_some());
        let differences = &model.view.display.differences;
        assert!(Difference::all(Quantity::Normal).contains(&differences.kind(Quantity::Normal)));
        assert_eq!(differences.range(Quantity::Rendering), None);
    }
}
