//! The strip below the panes that show a difference: its colours, its range, its histogram and its statistics.

use eframe::egui::{
    self, Align2, Color32, FontId, Painter, Pos2, Rect, Response, RichText, Sense, Stroke, pos2, vec2,
};

use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::differences::Differences;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::{Distributions, Histogram};

use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;
use crate::pane::Displayed;
use crate::widgets::numbers::digits;
use crate::widgets::paint::colour_bar;
use crate::widgets::paint::inset;
use crate::widgets::{named, number, theme};

/// The error map in the drop-down of differences.
const ERROR_MAP: &str = "error map (all scenes)";
/// Height of the histograms and of the colour bar below them, in points.
pub const HISTOGRAM: f32 = 54.0;
pub const BAR: f32 = 12.0;
/// Widths of the controls, of their texts in pictures, and of the statistics, in points.
const CONTROLS: f32 = 184.0;
const LABELS: f32 = 148.0;
pub const STATISTICS: f32 = 366.0;
/// Least height of a count that is not 0, and side of the mark of what lies beyond the axis, in points.
const LEAST_MARK: f32 = 4.0;
const BEYOND: f32 = 6.0;
/// Least width of the histograms, in points.
const LEAST_SCALE: f32 = 48.0;
/// How far from 0 the axis goes in units of the range, before there are histograms.
const AXIS: f64 = 1.5;

/// The strip, and what all of its parts are drawn from.
#[derive(Debug)]
pub struct LegendStrip<'a> {
    pub shown: &'a Displayed<'a>,
    pub quantity: Quantity,
    pub kind: Difference,
    range: f64,
    /// The distributions, and whether they are up to date.
    pub distributions: Option<(&'a Distributions, bool)>,
    /// The materials with a difference: all beside a photograph, otherwise the predictions.
    pub materials: &'a [LoadedMaterial],
}

impl<'a> LegendStrip<'a> {
    pub fn new(shown: &'a Displayed<'a>) -> Self {
        let view = &shown.model.view;
        let materials = shown.materials();
        let predictions = materials.get(1..).unwrap_or_default();
        Self {
            shown,
            quantity: view.display.quantity,
            kind: view.difference_kind(),
            range: shown.range(),
            distributions: shown.distributions(),
            materials: if shown.photograph().is_some() { materials } else { predictions },
        }
    }

    /// Whether this is the chosen one of the materials with a difference.
    pub fn is_chosen(&self, index: usize) -> bool {
        let first = self.shown.materials().len() - self.materials.len();
        index + first == self.shown.chosen()
    }

    fn set_range(&self) -> Option<f64> {
        self.shown.model.view.display.differences.range(self.quantity)
    }

    fn name(&self) -> &'static str {
        if self.shown.model.view.is_error_map() { ERROR_MAP } else { self.kind.name() }
    }

    pub fn ui(&self, ui: &mut egui::Ui, next: &mut Model) {
        let next = &mut next.view.display.differences;
        ui.horizontal_top(|ui| {
            let width = if self.shown.is_picture { LABELS } else { CONTROLS };
            ui.allocate_ui(vec2(width, HISTOGRAM + BAR), |ui| {
                ui.vertical(|ui| match self.shown.is_picture {
                    true => self.labels(ui),
                    false => self.controls(ui, next),
                });
            });
            let has_room = self.shown.is_picture || ui.available_width() > STATISTICS + 230.0;
            let statistics = if has_room { STATISTICS } else { 0.0 };
            let width = (ui.available_width() - statistics - 16.0).max(LEAST_SCALE);
            self.scale(ui, width, next);
            if statistics > 0.0 {
                ui.vertical(|ui| self.statistics(ui));
            }
        });
    }

    /// What the controls have chosen.
    fn labels(&self, ui: &mut egui::Ui) {
        ui.label(self.name());
        let how = if self.set_range().is_some() { "held" } else { "automatic" };
        ui.label(format!("Range {}, {how}", digits(self.range)));
        ui.label(RichText::new(self.unit()).small().weak());
    }

    fn controls(&self, ui: &mut egui::Ui, next: &mut Differences) {
        let combo = egui::ComboBox::from_id_salt("difference").width(CONTROLS - 16.0);
        let is_error_map = self.shown.model.view.is_error_map();
        let combo = combo.selected_text(self.name()).show_ui(ui, |ui| {
            for &kind in Difference::all(self.quantity) {
                let chosen = !is_error_map && kind == self.kind;
                if ui.selectable_label(chosen, kind.name()).clicked() {
                    next.choose(self.quantity, kind);
                }
            }
            if self.quantity == Quantity::Rendering {
                let label = ui.selectable_label(is_error_map, ERROR_MAP);
                let hover = "The log difference of each texel, averaged over scenes of the loss: its mean is the loss over these scenes";
                if label.on_hover_text(hover).clicked() {
                    next.choose_error_map();
                }
            }
        });
        named(&combo.response, "Difference");
        let of = if self.shown.photograph().is_some() {
            "a rendering p from the photograph g"
        } else {
            "a prediction p from the ground truth g"
        };
        combo.response.on_hover_text(format!("Which difference of {of}"));
        ui.horizontal(|ui| {
            ui.label("Range");
            let mut range = self.range;
            let auto = self.shown.auto_range();
            number(ui, "Range", &mut range, auto, |drag| {
                drag.speed(0.01 * self.range).range(1e-6..=1e6).max_decimals(4)
            })
            .on_hover_text("The difference that has the last colour; double-click for Auto");
            if range != self.range {
                next.set_range(self.quantity, (range != auto).then_some(range));
            }
            let is_held = self.set_range().is_some();
            let choices = [
                (
                    !is_held,
                    "Auto",
                    None,
                    "Of all panes: the 99th percentile, of the prediction where it is largest",
                ),
                (
                    is_held,
                    "Held",
                    Some(self.range),
                    "This range under every light, for every prediction, also after Reset",
                ),
            ];
            for (on, name, range, hover) in choices {
                let label = ui.selectable_label(on, name).on_hover_text(hover);
                let full = format!("{name} range");
                label.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, on, &full));
                if label.clicked() && !on {
                    next.set_range(self.quantity, range);
                }
            }
        });
        ui.label(RichText::new(self.unit()).small().weak());
    }

    fn unit(&self) -> String {
        match self.shown.error_map_scenes() {
            Some(scenes) => format!("mean {} of {scenes} scenes", self.kind.unit()),
            None => self.kind.unit().to_owned(),
        }
    }

    /// What the axis has: FLIP is a quantity without a unit.
    fn quantity_name(&self) -> String {
        if self.kind == Difference::Flip && !self.shown.model.view.is_error_map() {
            self.kind.name().to_owned()
        } else {
            self.unit()
        }
    }

    /// The low and high end of the axis.
    fn axis(&self) -> [f64; 2] {
        match self.distributions.and_then(|(distributions, _)| distributions.histograms.first()) {
            Some(histogram) => [histogram.low, histogram.high],
            None if self.kind.is_signed() => [-AXIS * self.range, AXIS * self.range],
            None => [0.0, AXIS * self.range],
        }
    }

    /// Histograms over the colour bar, with the handles of the range.
    fn scale(&self, ui: &mut egui::Ui, width: f32, next: &mut Differences) {
        let size = vec2(width, HISTOGRAM + BAR + 14.0);
        let (response, painter) = ui.allocate_painter(size, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::slider(true, self.range, "Difference range"));
        let area = inset(response.rect, vec2(8.0, 0.0)).with_max_y(response.rect.top() + HISTOGRAM + BAR);
        let [low, high] = self.axis();
        let x = |value: f64| {
            let share = ((value - low) / (high - low)).clamp(0.0, 1.0) as f32;
            area.left() + share * area.width()
        };
        let bar = area.with_min_y(area.bottom() - BAR);
        let ink = ui.visuals().text_color();
        let shares = [low, high].map(|value| (value / self.range) as f32);
        painter.add(colour_bar(bar, shares, self.kind.is_signed()));
        let (histograms, is_current) =
            self.distributions.map_or((&[][..], true), |(all, is_current)| (&all.histograms, is_current));
        let fade = if is_current { 1.0 } else { 0.5 };
        for (index, histogram) in histograms.iter().enumerate() {
            let colour = theme::series(self.series(index), ui.visuals().dark_mode).gamma_multiply(fade);
            let stroke = Stroke::new(if self.is_chosen(index) { 2.0 } else { 1.0 }, colour);
            let curve = area.with_max_y(bar.top());
            painter.extend(theme::series_line(&outline(histogram, curve), self.series(index), stroke));
            painter.extend(beyond(histogram, curve, colour));
        }
        let handles = if self.kind.is_signed() { vec![-self.range, self.range] } else { vec![self.range] };
        for value in handles {
            let at = x(value);
            painter.line_segment([pos2(at, area.top()), pos2(at, bar.bottom())], Stroke::new(1.5, ink));
            painter.circle_filled(pos2(at, bar.center().y), 4.5, ink);
        }
        self.paint_numbers(&painter, area, [low, high], ink);
        let weak = ui.visuals().weak_text_color();
        let at = area.right_top() + vec2(-3.0, 1.0);
        painter.text(at, Align2::RIGHT_TOP, axes(&self.quantity_name()), FontId::proportional(11.0), weak);
        let value = |pos: Pos2| low + f64::from((pos.x - area.left()) / area.width()) * (high - low);
        if let Some(range) = dragged(response, value) {
            next.set_range(self.quantity, Some(range));
        }
    }

    fn paint_numbers(&self, painter: &Painter, area: Rect, [low, high]: [f64; 2], ink: Color32) {
        let unit = if self.kind == Difference::Angle { " deg" } else { "" };
        let numbers = [
            (Align2::LEFT_TOP, area.left_bottom(), low),
            (Align2::CENTER_TOP, area.center_bottom(), 0.5 * (low + high)),
            (Align2::RIGHT_TOP, area.right_bottom(), high),
        ];
        for (align, at, value) in numbers {
            painter.text(at, align, format!("{}{unit}", digits(value)), FontId::monospace(11.0), ink);
        }
    }
}

/// The range under the pointer that drags a handle.
fn dragged(response: Response, value: impl Fn(Pos2) -> f64) -> Option<f64> {
    let hint = "Drag to set the range. Counts are logarithmic; the thick line is the chosen prediction.";
    let response = response.on_hover_text(hint);
    let pos = response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked())?;
    Some(value(pos).abs()).filter(|range| *range > 0.0)
}

/// What the axes of a histogram are: counts, upwards, of the texels by the quantity.
pub fn axes(quantity: &str) -> String {
    format!("texels (log) by {quantity}")
}

/// The logarithms of the counts as a line over `area`. A single texel leaves a mark that is seen.
pub fn outline(histogram: &Histogram, area: Rect) -> Vec<Pos2> {
    let log = |count: u64| (1.0 + count as f64).ln() as f32;
    let highest = histogram.counts.iter().map(|count| log(*count)).fold(f32::MIN_POSITIVE, f32::max);
    let step = area.width() / histogram.counts.len() as f32;
    let point = |(i, count): (usize, &u64)| {
        let mark = if *count > 0 { LEAST_MARK } else { 0.0 };
        let height = mark + log(*count) / highest * (area.height() - 4.0 - LEAST_MARK).max(0.0);
        pos2(area.left() + (i as f32 + 0.5) * step, area.bottom() - height)
    };
    histogram.counts.iter().enumerate().map(point).collect()
}

/// A triangle at each end of the axis beyond which there are texels.
pub fn beyond(histogram: &Histogram, area: Rect, colour: Color32) -> Vec<egui::Shape> {
    let triangle = |x: f32, outwards: f32| {
        let tip = pos2(x, area.bottom() - BEYOND);
        let base = [vec2(-outwards * BEYOND, -0.6 * BEYOND), vec2(-outwards * BEYOND, 0.6 * BEYOND)];
        egui::Shape::convex_polygon(vec![tip, tip + base[0], tip + base[1]], colour, Stroke::NONE)
    };
    let low = (histogram.below > 0).then(|| triangle(area.left(), -1.0));
    let high = (histogram.above > 0).then(|| triangle(area.right(), 1.0));
    low.into_iter().chain(high).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_texel_among_millions_and_texels_beyond_the_axis_leave_a_mark() {
        let counts = vec![0, 40_000_000, 0, 1, 0];
        let histogram = Histogram { low: 0.0, high: 5.0, counts, below: 0, above: 1 };
        let area = Rect::from_min_size(pos2(0.0, 0.0), vec2(50.0, 54.0));
        let points = outline(&histogram, area);
        assert!(points[4].y - points[3].y >= 4.0, "{points:?}");
        assert!(points[1].y >= area.top());
        assert_eq!(beyond(&histogram, area, Color32::WHITE).len(), 1);
        let inside = Histogram { above: 0, ..histogram };
        assert!(beyond(&inside, area, Color32::WHITE).is_empty());
    }
}
