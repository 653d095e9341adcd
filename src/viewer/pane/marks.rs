//! Marks over the panes: crosshair, pins, rectangle and numbers on large texels.

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Shape, Stroke, pos2, vec2};

use crate::model::inspection::{Inspection, Region};
use crate::pane::placed::Placed;
use crate::widgets::numbers::in_width;

/// Side of a texel, in points, from which on its numbers are drawn on it.
pub const READABLE: f32 = 48.0;
/// Side of a texel, in points, from which on the crosshair is its outline.
const OUTLINED: f32 = 6.0;
const DARK: Color32 = Color32::from_black_alpha(190);
const BRIGHT: Color32 = Color32::from_rgb(0xf5, 0xf5, 0xf5);
const PIN: Color32 = Color32::from_rgb(0x7d, 0xd8, 0xff);

impl Placed {
    /// Marks one texel: by its outline where it is large, otherwise by a cross that leaves it free.
    pub fn paint_crosshair(&self, painter: &Painter, texel: [usize; 2]) {
        if self.side(centre(texel)) >= OUTLINED {
            self.paint_outline(painter, Region { first: texel, last: texel });
        } else if let Some(at) = self.pos(centre(texel)) {
            paint_cross(painter, at);
        }
    }

    fn paint_outline(&self, painter: &Painter, region: Region) {
        let Some(outline) = self.outline(region) else { return };
        painter.add(Shape::closed_line(outline.clone(), Stroke::new(3.0, DARK)));
        painter.add(Shape::closed_line(outline, Stroke::new(1.0, BRIGHT)));
    }

    /// The pins with their numbers, and the rectangle.
    pub fn paint_inspected(&self, painter: &Painter, inspection: &Inspection) {
        inspection.region.into_iter().for_each(|region| self.paint_outline(painter, region));
        for (index, pin) in inspection.pins.iter().enumerate() {
            if let Some(at) = self.pos(centre(*pin)) {
                paint_pin(painter, at, index + 1);
            }
        }
    }

    /// The numbers of every visible texel of a flat view, on it; nothing where the texels are too small.
    pub fn paint_numbers(&self, painter: &Painter, numbers: impl Fn([usize; 2]) -> Vec<f64>) {
        let Some(Region { first, last }) = self.visible() else { return };
        if self.side(centre(first)) < READABLE {
            return;
        }
        let texels =
            (first[1]..=last[1]).flat_map(|row| (first[0]..=last[0]).map(move |column| [column, row]));
        for texel in texels {
            let Some(at) = self.pos(centre(texel)) else { continue };
            let text: Vec<String> = numbers(texel).iter().map(|v| in_width(*v, 6, 3)).collect();
            let galley = painter.layout_no_wrap(text.join("\n"), FontId::monospace(11.0), BRIGHT);
            let place = Align2::CENTER_CENTER.anchor_size(at, galley.size());
            painter.rect_filled(place.expand(1.5), 2.0, Color32::from_black_alpha(150));
            painter.galley(pos2(place.left(), place.top()), galley, BRIGHT);
        }
    }
}

/// The place of the middle of a texel.
fn centre(texel: [usize; 2]) -> [f32; 2] {
    texel.map(|number| number as f32 + 0.5)
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
