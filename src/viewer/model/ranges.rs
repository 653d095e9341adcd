//! Ranges of the numbers that come from files, settings and sessions: the one place that brings them within.

use std::fmt::Display;
use std::ops::RangeInclusive;

use svbrdf_core::loss::{LossSettings, Sampling, Texels};
use svbrdf_files::session::window::SessionDisplay as PaneDisplay;

use crate::model::Model;
use crate::model::settings::Settings;
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
const PREDICTIONS: RangeInclusive<usize> = 0..=100_000;

/// The numbers that were out of range.
#[derive(Debug, Default)]
struct RangeProblems(Vec<String>);

impl RangeProblems {
    /// Brings `value` into `range`; what is no number becomes `default`.
    fn number<T: PartialOrd + Copy + Display>(
        &mut self,
        name: &str,
        value: &mut T,
        range: RangeInclusive<T>,
        default: T,
    ) {
        if range.contains(value) {
            return;
        }
        let usable = match *value {
            low if low < *range.start() => *range.start(),
            high if high > *range.end() => *range.end(),
            _ => default,
        };
        self.0.push(format!("{name} {value} is now {usable}"));
        *value = usable;
    }

    fn settings(&mut self, settings: &mut Settings) {
        self.number("UI scale", &mut settings.ui_scale, UI_SCALE, 1.0);
        self.loss(&mut settings.loss);
    }

    fn loss(&mut self, loss: &mut LossSettings) {
        let most = Sampling::MAX_SCENES / 2;
        let default = LossSettings::default();
        self.number("near-field scenes", &mut loss.near, 0..=most, default.near);
        self.number("distant scenes", &mut loss.distant, 0..=most, default.distant);
        self.number("target error", &mut loss.target_percent, TARGET_PERCENT, default.target_percent);
        self.number("time budget", &mut loss.time_ms, TIME_MS, default.time_ms);
        if let Texels::Sampled(count) = &mut loss.texels {
            self.number("sampled texels", count, TEXELS, 1 << 14);
        }
        if loss.file.as_ref().is_some_and(|file| {
            file.scenes.is_empty() || file.scenes.iter().any(|scene| scene.check().is_err())
        }) {
            self.0.push("the scenes of the loss cannot be rendered, and are left out".to_owned());
            *loss = loss.with_file(None);
        }
    }

    fn view(&mut self, view: &mut ViewState) {
        self.number("exposure", &mut view.exposure_ev, -STOPS..=STOPS, 0.0);
        if let Err(problem) = view.scene.check() {
            self.0.push(format!("light and view are the default ones, since {problem}"));
            view.scene = ViewState::default().scene;
        }
        self.display(&mut view.display);
    }

    fn display(&mut self, display: &mut PaneDisplay) {
        self.number("wipe", &mut display.wipe, 0.0..=1.0, 0.5);
        if let Some(framing) = &mut display.framing {
            self.number("pixels per texel", &mut framing.pixels_per_texel, PIXELS_PER_TEXEL, 1.0);
            for value in &mut framing.centre {
                self.number("texel in the centre", value, CENTRE, 0.0);
            }
        }
        self.number("number of the prediction", &mut display.prediction, PREDICTIONS, 0);
        if !display.differences.leave_out_unusable() {
            self.0.push("a difference or its range is the default one".to_owned());
        }
    }
}

/// Brings every number of settings and view into its range; what they were and are, if there were others.
pub fn bring_into_range(model: &mut Model) -> Option<String> {
    let mut found = RangeProblems::default();
    found.settings(&mut model.settings);
    found.view(&mut model.view);
    (!found.0.is_empty()).then(|| format!("Settings out of range: {}.", found.0.join(", ")))
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

    fn is_usable(model: &Model) -> bool {
        let (settings, view) = (&model.settings, &model.view);
        let display = &view.display;
        UI_SCALE.contains(&settings.ui_scale)
            && TARGET_PERCENT.contains(&settings.loss.target_percent)
            && (0.0..=1.0).contains(&display.wipe)
            && display.framing.is_none_or(|framing| {
                PIXELS_PER_TEXEL.contains(&framing.pixels_per_texel)
                    && framing.centre.iter().all(|value| CENTRE.contains(value))
            })
            && (-STOPS..=STOPS).contains(&view.exposure_ev)
            && view.scene.check().is_ok()
            && settings.loss.near <= Sampling::MAX_SCENES
    }

    #[test]
    fn whatever_the_numbers_they_are_usable_afterwards_and_it_is_said() {
        for (index, number) in NUMBERS.into_iter().enumerate() {
            for field in 0..9 {
                let mut model = Model::default();
                assert_eq!(bring_into_range(&mut model), None, "the defaults are in range");
                let single = number as f32;
                match field {
                    0 => model.settings.ui_scale = single,
                    1 => model.settings.loss.target_percent = number,
                    2 => model.settings.loss.near = number as usize,
                    3 => model.view.display.wipe = single,
                    4 => {
                        let framing = Framing { pixels_per_texel: single, centre: [1.0; 2] };
                        model.view.display.framing = Some(framing);
                    }
                    5 => {
                        let framing = Framing { pixels_per_texel: 1.0, centre: [single, -single] };
                        model.view.display.framing = Some(framing);
                    }
                    6 => model.view.exposure_ev = single,
                    7 => model.view.scene.light[2] = number,
                    _ => model.settings.loss.time_ms = number as u64,
                }
                let was_usable = is_usable(&model);
                let message = bring_into_range(&mut model);
                assert!(is_usable(&model), "{field}, {index}: {message:?}");
                assert!(was_usable || message.is_some(), "{field}, {index}");
                assert_eq!(bring_into_range(&mut model), None, "{field}, {index}");
            }
        }
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
