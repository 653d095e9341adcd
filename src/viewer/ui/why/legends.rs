//! The legends of the maps over directions.

use eframe::egui::{self, Align2, FontId, Rect, RichText, Sense, pos2, vec2};

use crate::jobs::why::{DirectionMaps, ScaledPicture};
use crate::ui::widgets::bounds::inset;
use crate::ui::widgets::colour_bar::colour_bar;
use crate::ui::widgets::numbers::{digits, signed};

/// Height of a colour bar with its numbers, in points.
const BAR: f32 = 10.0;

/// The colours of the losses, and those of their difference, in rows that are there before the maps.
///
/// `chosen` is the prediction from which another one differs, where it `has_difference`.
pub fn legends(ui: &mut egui::Ui, chosen: usize, has_difference: bool, maps: Option<&DirectionMaps>) {
    let losses = maps.and_then(|maps| maps.losses.first());
    let ends = losses.map(|losses| ["0".to_owned(), digits(losses.range)]);
    bar(ui, ends.map(|ends| ("loss".to_owned(), ends)), false);
    if has_difference {
        let difference = maps.and_then(|maps| maps.differences.get(chosen));
        let legend = difference.map(|(other, ScaledPicture { range, .. })| {
            let ends = [signed(&digits(-range)), signed(&digits(*range))];
            (format!("{} \u{2212} {}", chosen + 1, other + 1), ends)
        });
        bar(ui, legend, true);
    }
    let error = maps.map_or_else(|| "...".to_owned(), |maps| digits(maps.map.standard_error(chosen)));
    ui.label(RichText::new(format!("standard error {error}")).small().weak())
        .on_hover_text("Of a direction, from the choice of the compared texels; neighbours share it");
}

/// A name, and a colour bar between the numbers of its ends; an empty row without them.
fn bar(ui: &mut egui::Ui, legend: Option<(String, [String; 2])>, is_signed: bool) {
    let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), BAR + 4.0), Sense::hover());
    let Some((name, [low, high])) = legend else { return };
    let painter = ui.painter_at(area);
    let (ink, font) = (ui.visuals().text_color(), FontId::monospace(11.0));
    let middle = area.center().y;
    painter.text(pos2(area.left(), middle), Align2::LEFT_CENTER, name, font.clone(), ink);
    let colours = Rect::from_x_y_ranges(area.left() + 100.0..=area.right() - 56.0, area.y_range());
    let colours = inset(colours, vec2(0.0, 2.0));
    painter.text(pos2(colours.left() - 4.0, middle), Align2::RIGHT_CENTER, low, font.clone(), ink);
    painter.text(pos2(colours.right() + 4.0, middle), Align2::LEFT_CENTER, high, font, ink);
    painter.add(colour_bar(colours, [if is_signed { -1.0 } else { 0.0 }, 1.0], is_signed));
}
