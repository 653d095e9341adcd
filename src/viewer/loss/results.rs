//! The losses with their intervals, and their differences.

use eframe::egui::{self, Color32, RichText, Sense, Stroke, pos2, vec2};

use svbrdf_core::loss::{Estimate, Loss};
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::statistics::order;
use svbrdf_evaluate::analyses::SampledScenes;

use crate::loss::losses::ComputedLosses;
use crate::model::{Model, display};
use crate::widgets::names::{FEWEST, Names, fitted};
use crate::widgets::numbers::{half_width, means, signed, significant};
use crate::widgets::theme;

/// Heights of a line and of the bar below it, in points.
const LINE: f32 = 17.0;
const BAR: f32 = 3.0;
/// Widths of the columns, in points: the loss, half the width of its interval, the difference from the chosen prediction.
const MEAN: f32 = 48.0;
const HALF: f32 = 52.0;
const DIFFERENCE: f32 = 68.0;
/// Between two columns, in points.
const GAP: f32 = 4.0;
/// Size of the small numbers, in points.
const NUMBERS: f32 = 11.5;

/// What follows the number of a prediction whose loss is stale.
const STALE_MARK: &str = " (stale)";

/// What the rows show.
#[derive(Debug)]
pub struct Results<'a> {
    pub latest: &'a ComputedLosses,
    pub chosen: usize,
    /// The slot of each prediction.
    pub slots: Vec<usize>,
    /// Of each prediction, whether its files or those of the ground truth hold something else by now.
    pub stale: Vec<bool>,
}

impl Results<'_> {
    /// A row for each prediction; a click chooses it.
    pub fn ui(&self, ui: &mut egui::Ui, next: &mut Model) {
        let losses = &self.latest.report.outcome.losses;
        let names: Vec<&str> = losses.iter().map(|loss| loss.prediction.as_str()).collect();
        let short = Names::new(&names);
        // 15 predictions are seen at once in a window of 860 points.
        ui.spacing_mut().item_spacing.y = 2.0;
        ui.spacing_mut().button_padding.y = 1.0;
        ui.spacing_mut().interact_size.y = LINE;
        self.heads(ui);
        let order = order(&losses.iter().map(|loss| loss.estimate.mean).collect::<Vec<_>>());
        let means = means(&order.iter().map(|index| &losses[*index].estimate).collect::<Vec<_>>());
        for (index, mean) in order.into_iter().zip(means) {
            let is_stale = self.stale.get(index).is_some_and(|is_stale| *is_stale);
            let mark = if is_stale { STALE_MARK } else { "" };
            let name = |most| format!("{}{mark}  {}", self.slot(index), short.shortened(index, most));
            if self.row(ui, index, (&losses[index], &mean), &name).clicked() {
                display::choose(next, index);
            }
            if index == self.chosen {
                self.interval(ui, &losses[index]);
            }
        }
        ui.add_space(4.0);
        ui.label(RichText::new(summary(self.latest)).weak().small());
    }

    fn slot(&self, index: usize) -> usize {
        self.slots.get(index).copied().unwrap_or(index + 1)
    }

    fn heads(&self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            ui.add_space(name_width(ui));
            let small = |text: String| RichText::new(text).small().weak();
            cell(ui, MEAN, small("loss".to_owned()));
            cell(ui, HALF, small("±".to_owned())).on_hover_text("Half the width of the 95% interval");
            let versus = if self.latest.differences.len() > 1 {
                format!("vs {}", self.slot(self.chosen))
            } else {
                String::new()
            };
            cell(ui, DIFFERENCE, small(versus))
                .on_hover_text("The loss - the loss of the chosen prediction, on the same scenes");
        });
    }

    /// One line: name, loss, half the width of its interval, and the difference from the chosen prediction; its bar below.
    fn row(
        &self,
        ui: &mut egui::Ui,
        index: usize,
        (loss, mean): (&Loss, &str),
        name: &dyn Fn(usize) -> String,
    ) -> egui::Response {
        let line = ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            let size = vec2(name_width(ui), ui.spacing().interact_size.y);
            let layout = egui::Layout::left_to_right(egui::Align::Center).with_main_justify(true);
            let chosen = index == self.chosen;
            let font = egui::TextStyle::Button.resolve(ui.style());
            let room = size.x - 2.0 * ui.spacing().button_padding.x;
            let name = fitted(ui, &font, room, name).unwrap_or_else(|| name(FEWEST));
            let left = ui.allocate_ui_with_layout(size, layout.with_main_align(egui::Align::Min), |ui| {
                ui.add(egui::Button::selectable(chosen, name).truncate())
            });
            cell(ui, MEAN, RichText::new(mean).monospace().strong())
                .on_hover_text(self.in_full(&loss.estimate));
            let half = format!("±{}", half_width(&loss.estimate));
            cell(ui, HALF, RichText::new(half).monospace().size(NUMBERS).weak())
                .on_hover_text(self.in_full(&loss.estimate));
            self.difference(ui, index);
            left.inner.on_hover_text(format!("{}\nClick to choose this prediction", loss.prediction))
        });
        self.bar(ui, index, &loss.estimate);
        line.inner
    }

    /// The loss as a share of the largest one, with its interval as a line.
    fn bar(&self, ui: &mut egui::Ui, index: usize, estimate: &Estimate) {
        let end = |estimate: &Estimate| estimate.interval95.map_or(estimate.mean, |[_, high]| high);
        let losses = &self.latest.report.outcome.losses;
        let most = losses.iter().map(|loss| end(&loss.estimate)).fold(f64::MIN_POSITIVE, f64::max);
        // Close below its line.
        ui.add_space(1.0 - ui.spacing().item_spacing.y);
        let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), BAR), Sense::hover());
        let x = |value: f64| area.left() + area.width() * (value / most).clamp(0.0, 1.0) as f32;
        let colour = theme::series(self.slot(index), ui.visuals().dark_mode);
        ui.painter().rect_filled(area.with_max_x(x(estimate.mean)), 0.0, colour);
        if let Some([low, high]) = estimate.interval95 {
            let line = [pos2(x(low), area.center().y), pos2(x(high).max(x(low) + 1.0), area.center().y)];
            ui.painter().line_segment(line, Stroke::new(1.0, theme::ground_truth(ui.visuals())));
        }
    }

    /// The loss - the loss of the chosen prediction, and whether the difference is significant.
    fn difference(&self, ui: &mut egui::Ui, index: usize) {
        if index == self.chosen {
            let text = if self.latest.differences.len() > 1 { "chosen" } else { "" };
            cell(ui, DIFFERENCE, RichText::new(text).small().weak());
            return;
        }
        let of_chosen = self.latest.differences.get(self.chosen);
        let Some(estimate) = of_chosen.and_then(|all| all.get(index)) else { return };
        let Verdict { arrow, text: said, colour, place } = verdict(estimate);
        let [mean, interval] = significant(estimate);
        let text = format!("{} {arrow}", signed(&mean));
        let text = RichText::new(text).monospace().size(NUMBERS).color(colour(ui.visuals()));
        let response = cell(ui, DIFFERENCE, text);
        let meaning = match place {
            "" => "The 95% interval includes 0: use more scenes".to_owned(),
            _ => format!("{} is {place} the ground truth than {}", self.slot(index), self.slot(self.chosen)),
        };
        let full = format!("{} {interval} {said}", signed(&mean));
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &full));
        response.on_hover_text(format!("95% interval {interval}\n{meaning}\n{}", self.in_full(estimate)));
    }

    /// Below the chosen prediction: its interval.
    fn interval(&self, ui: &mut egui::Ui, loss: &Loss) {
        let [_, interval] = significant(&loss.estimate);
        ui.horizontal(|ui| {
            ui.add_space(10.0);
            ui.label(RichText::new(interval).monospace().size(NUMBERS))
                .on_hover_text(self.in_full(&loss.estimate));
        });
    }

    /// Every digit, the standard error and the scenes.
    fn in_full(&self, estimate: &Estimate) -> String {
        let [mean, error, interval] = estimate.texts();
        let SampledScenes { near, distant, .. } = self.latest.report.sampled;
        format!(
            "{mean} ± {error} (standard error)\n95% interval {interval}\n{near} near-field and {distant} distant scenes"
        )
    }
}

/// The room that the columns of numbers leave for a name, in points.
fn name_width(ui: &egui::Ui) -> f32 {
    (ui.available_width() - MEAN - HALF - DIFFERENCE - 3.0 * GAP).max(60.0)
}

/// A text at the right end of a column.
fn cell(ui: &mut egui::Ui, width: f32, text: RichText) -> egui::Response {
    let size = vec2(width, ui.spacing().interact_size.y);
    let layout = egui::Layout::right_to_left(egui::Align::Center);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_width(width);
        ui.label(text)
    })
    .inner
}

/// What a difference says of its first prediction.
struct Verdict {
    arrow: &'static str,
    text: &'static str,
    colour: fn(&egui::Visuals) -> Color32,
    /// How far from the ground truth the first is; nothing where that is not known.
    place: &'static str,
}

/// By whether the 95% interval excludes 0, and on which side.
fn verdict(difference: &Estimate) -> Verdict {
    match difference.interval95 {
        Some([_, high]) if high < 0.0 => {
            Verdict { arrow: "\u{2193}", text: "\u{2193} better", colour: theme::better, place: "closer to" }
        }
        Some([low, _]) if low > 0.0 => Verdict {
            arrow: "\u{2191}",
            text: "\u{2191} worse",
            colour: theme::problem,
            place: "farther from",
        },
        _ => Verdict {
            arrow: "~",
            text: "no significant difference",
            colour: egui::Visuals::weak_text_color,
            place: "",
        },
    }
}

fn summary(latest: &ComputedLosses) -> String {
    let report = &latest.report;
    let sampler = match report.sampled.sampler {
        Some(Sampler::Sobol) => "scrambled Sobol",
        Some(Sampler::Random) => "random",
        None => "listed",
    };
    format!(
        "convention {}, epsilon {}, {sampler} scenes{}, {}",
        report.convention,
        report.epsilon,
        // The one that was asked for: a first estimate has scenes of another one.
        latest.request.seed().map_or(String::new(), |seed| format!(" of seed {seed}")),
        report.precision,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_is_a_verdict_only_where_its_interval_excludes_0() {
        let of = |interval95| verdict(&Estimate { mean: 0.0, standard_error: None, interval95 }).place;
        assert_eq!(of(Some([-0.2, -0.1])), "closer to");
        assert_eq!(of(Some([0.1, 0.2])), "farther from");
        for interval in [Some([-0.1, 0.2]), Some([0.0, 0.0]), None] {
            assert_eq!(of(interval), "");
        }
    }
}
