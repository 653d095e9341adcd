//! Shares of the maps in the loss of the chosen prediction.

use std::time::Duration;

use eframe::egui::{self, Align2, FontId, Rect, RichText, Sense, Stroke, pos2, vec2};

use svbrdf_core::loss::Request;
use svbrdf_core::material::Map;
use svbrdf_core::model::scene::Kind;
use svbrdf_evaluate::report::comparing;
use svbrdf_evaluate::why::{Attribution, MapShare, attribute_in};

use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::content::{ComparedPair, mask_of};
use crate::jobs::answers::{Answer, Answered, Question, Work};
use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;
use crate::widgets::numbers::{accuracy, seconds, significant};
use crate::widgets::{state_line, theme};

/// Half of the 95% interval of a loss that is attributed, as a share of the loss.
const ATTRIBUTION_TARGET: f64 = 0.01;
/// Height of a row, in points.
const ROW: f32 = 18.0;
/// Widths of the name of a map, of the number of a prediction and of its amounts, in points.
const NAME: f32 = 72.0;
const NUMBER: f32 = 16.0;
const AMOUNTS: f32 = 114.0;

/// The section; `pairs` are the ground truth and each prediction.
pub fn ui(ui: &mut egui::Ui, shown: Shown<'_>, pairs: &[ComparedPair], next: &mut Model) {
    let (display, seed) = (&shown.model.view.display, shown.model.settings.loss.seed);
    let predictions = shown.model.materials.predictions();
    let answers = &shown.jobs.answers;
    let ask = |(index, pair): (usize, &ComparedPair)| {
        let question = Attribute { pair: pair.clone(), seed };
        if index == display.prediction { answers.get(&question) } else { answers.get_later(&question) }
    };
    let asked: Vec<Answer<Attribution>> = pairs.iter().enumerate().map(ask).collect();
    let busy = asked.get(display.prediction).and_then(Answer::busy).unwrap_or_default();
    let found: Vec<_> = asked.into_iter().map(Answer::ready).collect();
    let all: Vec<Option<&Attribution>> =
        found.iter().map(|found| found.as_deref().map(|found| &found.answer)).collect();
    let axis = axis(all.iter().copied().flatten());
    for map in Map::ALL {
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            for (index, attributed) in all.iter().enumerate() {
                let row = MapRow {
                    map,
                    is_first: index == 0,
                    slot: predictions.get(index).map_or(0, |one| one.slot),
                    name: predictions.get(index).map_or("", LoadedMaterial::name),
                    count: all.len(),
                    attributed: *attributed,
                    axis,
                    is_chosen: index == display.prediction,
                };
                let is_isolated = row.is_chosen && display.isolated == Some(map);
                if row.ui(ui, is_isolated, display.only_right).clicked() {
                    next.view.choose(index);
                    next.view.isolate((!is_isolated).then_some(map));
                }
            }
        });
    }
    let attributed = found.get(display.prediction).and_then(Option::as_deref);
    let doing = || match busy.1 {
        Duration::ZERO => "After what is above".to_owned(),
        elapsed => format!("Mixing maps, {} s", elapsed.as_secs()),
    };
    state_line(ui, attributed.map(summary), ABOUT, (busy.0, doing));
    // Its row is kept where there is no note: what is below does not move when one comes.
    let note = attributed.and_then(|attributed| attributed.note()).unwrap_or_default();
    ui.add(egui::Label::new(RichText::new(note).small()).truncate());
    pane_choice(ui, &mut next.view.display.only_right);
}

/// What the state line tells of more than it has room for.
const ABOUT: &str = "All 16 mixtures of true and predicted maps, in the same scenes on the same texels. The Shapley value of a map is \
                     the mean of what it adds to the loss over all orders in which the maps can become wrong; the four add up to \
                     the loss. A negative share: the error of this map partly cancels the errors of others. At most 49,152 scenes \
                     are sampled.";

/// The sum and what it took.
fn summary(Answered { answer, elapsed }: &Answered<Attribution>) -> String {
    let count = |kind| answer.scenes.iter().filter(|scene| scene.kind == kind).count();
    let [mean, interval] = significant(&answer.loss);
    let missed = answer.loss.relative_error95() > ATTRIBUTION_TARGET;
    let missed =
        if missed { format!("Not within {}: ", accuracy(ATTRIBUTION_TARGET)) } else { String::new() };
    format!(
        "{missed}Sum {mean} {interval}, {} + {} scenes, {}",
        count(Kind::Near),
        count(Kind::Distant),
        seconds(*elapsed)
    )
}

/// What a click on a map shows.
fn pane_choice(ui: &mut egui::Ui, only_right: &mut bool) {
    ui.horizontal_wrapped(|ui| {
        ui.label("A click shows").on_hover_text(
            "A click on a bar chooses the prediction and shows it with this map alone wrong, or alone right, in its \
             pane. Another click, or Esc, shows the prediction itself.",
        );
        for (right, name, hover) in [
            (false, "only it wrong", "The ground truth with this map of the prediction"),
            (true, "only it right", "The prediction with this map of the ground truth"),
        ] {
            ui.selectable_value(only_right, right, name).on_hover_text(hover);
        }
    });
}

/// One map of one prediction.
struct MapRow<'a> {
    map: Map,
    /// Whether the prediction is the first; its slot, its name, and the number of predictions.
    is_first: bool,
    slot: usize,
    name: &'a str,
    count: usize,
    attributed: Option<&'a Attribution>,
    /// The values at both ends of the bars.
    axis: [f64; 2],
    is_chosen: bool,
}

impl MapRow<'_> {
    fn ui(&self, ui: &mut egui::Ui, isolated: bool, only_right: bool) -> egui::Response {
        let (area, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
        let share = self.attributed.map(|attributed| attributed.of(self.map));
        let text = self.attributed.map_or_else(String::new, |attributed| percent(attributed, self.map));
        let of = if self.is_chosen { String::new() } else { format!(" of {}", self.name) };
        let label = format!("{}{of}: {text} of the loss", self.map.name());
        response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, isolated, &label));
        let visuals = ui.visuals();
        let painter = ui.painter();
        // The name of the map is that of all its rows.
        let row = area.with_min_x(area.left() + NAME);
        if isolated {
            painter.rect_filled(row, 3.0, visuals.selection.bg_fill);
        } else if response.hovered() {
            painter.rect_filled(row, 3.0, visuals.widgets.hovered.weak_bg_fill);
        }
        if response.has_focus() {
            painter.rect_stroke(row, 3.0, visuals.selection.stroke, egui::StrokeKind::Inside);
        }
        let ink = visuals.text_color();
        let (middle, font) = (area.center().y, FontId::monospace(12.0));
        if self.is_first {
            let name = pos2(area.left() + 4.0, area.top() + 0.5 * ROW);
            painter.text(name, Align2::LEFT_CENTER, self.map.name(), FontId::proportional(13.0), ink);
        }
        let bars = Rect::from_x_y_ranges(row.left() + NUMBER..=area.right() - AMOUNTS, area.y_range());
        if let Some(share) = share {
            self.bar(ui, bars, share);
        }
        if self.count > 1 {
            let at = pos2(row.left() + 4.0, middle);
            painter.text(at, Align2::LEFT_CENTER, self.slot.to_string(), font.clone(), ink);
        }
        let value = share.map_or_else(|| "...".to_owned(), |share| format!("{:.4}", share.shapley.mean));
        painter.text(pos2(area.right() - 4.0, middle), Align2::RIGHT_CENTER, value, font.clone(), ink);
        painter.text(pos2(area.right() - 64.0, middle), Align2::RIGHT_CENTER, text, font, ink);
        let side = if only_right { "right" } else { "wrong" };
        let map = self.map.name();
        response.on_hover_ui(|ui| {
            ui.strong(format!("{}  {}: {map}", self.slot, self.name));
            if let Some(share) = share {
                ui.label(numbers(share));
            }
            ui.label(match isolated {
                true => "Click to show the prediction itself (Esc)".to_owned(),
                false => format!("Click to show the prediction with only its {map} {side}"),
            });
        })
    }

    fn bar(&self, ui: &egui::Ui, area: Rect, share: &MapShare) {
        let [low, high] = self.axis;
        let x = |value: f64| area.left() + area.width() * ((value - low) / (high - low)) as f32;
        let (zero, end, middle) = (x(0.0), x(share.shapley.mean), area.center().y);
        let half = 4.0;
        let bar = Rect::from_x_y_ranges(zero.min(end)..=zero.max(end), middle - half..=middle + half);
        let painter = ui.painter();
        painter.rect_filled(bar, 1.0, theme::series(self.slot, ui.visuals().dark_mode));
        let thin = Stroke::new(1.0, ui.visuals().weak_text_color());
        painter.line_segment([pos2(zero, area.top()), pos2(zero, area.bottom())], thin);
        if let Some([low, high]) = share.shapley.interval95 {
            let stroke = Stroke::new(1.5, ui.visuals().text_color());
            painter.line_segment([pos2(x(low), middle), pos2(x(high), middle)], stroke);
            for at in [x(low), x(high)] {
                painter.line_segment([pos2(at, middle - half), pos2(at, middle + half)], stroke);
            }
        }
    }
}

fn percent(attribution: &Attribution, map: Map) -> String {
    let whole = attribution.loss.mean;
    if whole > 0.0 {
        format!("{:.1}%", 100.0 * attribution.of(map).shapley.mean / whole)
    } else {
        "-".to_owned()
    }
}

/// The numbers of a map, for its tooltip.
fn numbers(share: &MapShare) -> String {
    let [shapley, wrong, right] = [share.shapley, share.only_wrong, share.only_right].map(|estimate| {
        let [mean, interval] = significant(&estimate);
        format!("{mean} {interval}")
    });
    format!("Shapley value {shapley}\nLoss with only it wrong {wrong}\nLoss with only it right {right}")
}

/// From 0, or the least value where errors of maps cancel, to the largest: one axis for all predictions.
fn axis<'a>(all: impl Iterator<Item = &'a Attribution>) -> [f64; 2] {
    let ends = |share: &MapShare| share.shapley.interval95.unwrap_or([share.shapley.mean; 2]);
    all.flat_map(|one| &one.maps)
        .map(ends)
        .fold([0.0, f64::MIN_POSITIVE], |[low, high], ends| [low.min(ends[0]), high.max(ends[1])])
}

/// How much of the loss of a pair comes from each map.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    pub pair: ComparedPair,
    pub seed: u64,
}

impl Question for Attribute {
    type Answer = Attribution;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Attribution, Error> {
        let read = self.pair.read()?;
        let request = Request::Accuracy { target: ATTRIBUTION_TARGET, seed: self.seed };
        let (truth, prediction) = (read[0].material(), read[1].material());
        comparing(truth, &[prediction], self.pair.convention, mask_of(&read)?, |comparison| {
            Ok(attribute_in(&comparison, comparison.predictions()[0], &request, work.progress())?)
        })
    }
}
