//! Marks over the panes: crosshair, pins, rectangle, and numbers on large texels.

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Shape, Stroke, pos2, vec2};

use crate::model::inspection::{Inspection, Region};
use crate::model::view::texel_plane::{CellRect, Seen};
use crate::ui::pane::placed::Placed;
use crate::ui::widgets::readout::in_width;

/// Side of a texel, in points, from which on its numbers are drawn on it.
pub const READABLE: f32 = 48.0;
/// Side of a texel, in points, from which on the crosshair is its outline.
const OUTLINED: f32 = 6.0;
const DARK: Color32 = Color32::from_black_alpha(190);
const BRIGHT: Color32 = Color32::from_rgb(0xf5, 0xf5, 0xf5);
const PIN: Color32 = Color32::from_rgb(0x7d, 0xd8, 0xff);

impl Placed {
    /// Marks one texel wherever it is seen: by its outline where it is large, otherwise by a cross that leaves it free.
    pub fn paint_crosshair(&self, painter: &Painter, texel: [usize; 2]) {
        for copy in self.texels.copies(Region { first: texel, last: texel }) {
            if self.side(copy.centre()) >= OUTLINED {
                self.paint_outline(painter, copy, BRIGHT);
            } else if let Some(at) = self.pos(copy.centre()) {
                paint_cross(painter, at);
            }
        }
    }

    fn paint_outline(&self, painter: &Painter, part: CellRect, colour: Color32) {
        let Some(outline) = self.outline(part) else { return };
        painter.add(Shape::closed_line(outline.clone(), Stroke::new(3.0, DARK)));
        painter.add(Shape::closed_line(outline, Stroke::new(1.0, colour)));
    }

    /// The pins with their numbers, and the rectangle, wherever they are seen.
    pub fn paint_inspected(&self, painter: &Painter, inspection: &Inspection) {
        for copy in inspection.region.into_iter().flat_map(|region| self.texels.copies(region)) {
            self.paint_outline(painter, copy, BRIGHT);
        }
        for (index, pin) in inspection.pins.iter().enumerate() {
            let copies = self.texels.copies(Region { first: *pin, last: *pin });
            for at in copies.iter().filter_map(|copy| self.pos(copy.centre())) {
                paint_pin(painter, at, index + 1);
            }
        }
    }

    /// The numbers of every visible texel of a flat view, on it; nothing where the texels are too small.
    pub fn paint_numbers(&self, painter: &Painter, numbers: impl Fn(Seen) -> Vec<f64>) {
        let Some([first, last]) = self.visible() else { return };
        if self.side(CellRect::of_cell(first).centre()) < READABLE {
            return;
        }
        let cells =
            (first[1]..=last[1]).flat_map(|row| (first[0]..=last[0]).map(move |column| [column, row]));
        for cell in cells {
            let Some(at) = self.pos(CellRect::of_cell(cell).centre()) else { continue };
            let text: Vec<String> =
                numbers(self.texels.seen_in(cell)).iter().map(|v| in_width(*v, 6, 3)).collect();
            let galley = painter.layout_no_wrap(text.join("\n"), FontId::monospace(11.0), BRIGHT);
            let place = Align2::CENTER_CENTER.anchor_size(at, galley.size());
            painter.rect_filled(place.expand(1.5), 2.0, Color32::from_black_alpha(150));
            painter.galley(pos2(place.left(), place.top()), galley, BRIGHT);
        }
    }
}

fn paint_cross(painter: &Painter, at: Pos2) {
    for (width, colour) in [(3.0, DARK), (1.0, BRIGHT)] {
        for direction in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
            let line = [at + direction * 5.0, at + direction * 12.0];
            painter.line_segment(line, Stroke::new(width, colour));
        }
    }
}

fn paint_pin(painter: &Painter, at: Pos2, number: usize) {
    painter.circle_stroke(at, 4.5, Stroke::new(3.0, DARK));
    painter.circle_stroke(at, 4.5, Stroke::new(1.5, PIN));
    let place = at + vec2(7.0, -7.0);
    for (offset, colour) in [(vec2(1.0, 1.0), DARK), (vec2(0.0, 0.0), PIN)] {
        let text = number.to_string();
        painter.text(place + offset, Align2::LEFT_BOTTOM, text, FontId::proportional(12.0), colour);
    }
}
