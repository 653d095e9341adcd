//! Marks over the panes: crosshair, pins, rectangle, and numbers on large texels.

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, pos2, vec2};
use glam::Vec3;

use svbrdf_core::material::Grid;
use svbrdf_core::picture::camera::Camera;

use crate::viewer::model::inspection::{Inspection, Region};
use crate::viewer::ui::pane::handles::pos_from_ndc;

/// Side of a texel, in points, from which on its numbers are drawn on it.
pub const READABLE: f32 = 48.0;
/// Side of a texel, in points, from which on the crosshair is its outline.
const OUTLINED: f32 = 6.0;
const DARK: Color32 = Color32::from_black_alpha(190);
const BRIGHT: Color32 = Color32::from_rgb(0xf5, 0xf5, 0xf5);
const PIN: Color32 = Color32::from_rgb(0x7d, 0xd8, 0xff);

/// A pane's picture on the screen.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'a> {
    pub rect: Rect,
    pub camera: &'a Camera,
    pub grid: Grid,
}

impl Placed<'_> {
    /// Where the point `column`, `row` is, counted from the corner of the material in texels.
    fn pos(&self, column: f32, row: f32) -> Option<Pos2> {
        let [half_width, half_height] = self.grid.half_extent();
        let side = 2.0 * half_width / self.grid.width as f32;
        let at = Vec3::new(column * side - half_width, half_height - row * side, 0.0);
        self.camera.ndc_from_point(at).map(|ndc| pos_from_ndc(self.rect, ndc))
    }

    /// The outline of the texels of `region`.
    fn outline(&self, region: Region) -> Option<Vec<Pos2>> {
        let [left, top] = region.first.map(|v| v as f32);
        let [right, bottom] = region.last.map(|v| v as f32 + 1.0);
        [[left, top], [right, top], [right, bottom], [left, bottom]]
            .into_iter()
            .map(|[column, row]| self.pos(column, row))
            .collect()
    }

    /// The side of the texel (column, row), in points: the shorter one where perspective distorts it.
    pub fn texel_side(&self, [column, row]: [usize; 2]) -> f32 {
        let [column, row] = [column as f32, row as f32];
        let corners = [[column, row], [column + 1.0, row], [column, row + 1.0]];
        let [Some(a), Some(b), Some(c)] = corners.map(|[column, row]| self.pos(column, row)) else {
            return 0.0;
        };
        a.distance(b).min(a.distance(c))
    }

    /// Marks one texel: by its outline where it is large, otherwise by a cross that leaves it free.
    pub fn paint_crosshair(&self, painter: &Painter, texel: [usize; 2]) {
        if self.texel_side(texel) >= OUTLINED {
            self.paint_outline(painter, Region { first: texel, last: texel }, BRIGHT);
            return;
        }
        let Some(at) = self.pos(texel[0] as f32 + 0.5, texel[1] as f32 + 0.5) else { return };
        for (width, colour) in [(3.0, DARK), (1.0, BRIGHT)] {
            for direction in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
                let line = [at + direction * 5.0, at + direction * 12.0];
                painter.line_segment(line, Stroke::new(width, colour));
            }
        }
    }

    fn paint_outline(&self, painter: &Painter, region: Region, colour: Color32) {
        let Some(outline) = self.outline(region) else { return };
        painter.add(Shape::closed_line(outline.clone(), Stroke::new(3.0, DARK)));
        painter.add(Shape::closed_line(outline, Stroke::new(1.0, colour)));
    }

    /// The pins with their numbers, and the rectangle.
    pub fn paint_inspected(&self, painter: &Painter, inspection: &Inspection) {
        if let Some(region) = inspection.region {
            self.paint_outline(painter, region, BRIGHT);
        }
        for (index, pin) in inspection.pins.iter().enumerate() {
            let Some(at) = self.pos(pin[0] as f32 + 0.5, pin[1] as f32 + 0.5) else { continue };
            painter.circle_stroke(at, 4.5, Stroke::new(3.0, DARK));
            painter.circle_stroke(at, 4.5, Stroke::new(1.5, PIN));
            let place = at + vec2(7.0, -7.0);
            for (offset, colour) in [(vec2(1.0, 1.0), DARK), (vec2(0.0, 0.0), PIN)] {
                let text = (index + 1).to_string();
                painter.text(place + offset, Align2::LEFT_BOTTOM, text, FontId::proportional(12.0), colour);
            }
        }
    }

    /// The visible texels of a flat view.
    fn visible(&self) -> Option<Region> {
        let corner = |ndc: [f32; 2]| self.camera.plane_from_ndc(ndc[0], ndc[1]);
        Region::between(self.grid, corner([-1.0, 1.0])?, corner([1.0, -1.0])?)
    }

    /// The numbers of every visible texel of a flat view, on it; nothing where the texels are too small.
    pub fn paint_numbers(&self, painter: &Painter, numbers: impl Fn([usize; 2]) -> Vec<f64>) {
        let Some(region) = self.visible() else { return };
        if self.texel_side(region.first) < READABLE {
            return;
        }
        for texel in region.texels() {
            let Some(at) = self.pos(texel[0] as f32 + 0.5, texel[1] as f32 + 0.5) else { continue };
            let text: Vec<String> = numbers(texel).iter().map(|v| short(*v)).collect();
            let galley = painter.layout_no_wrap(text.join("\n"), FontId::monospace(10.5), BRIGHT);
            let place = Align2::CENTER_CENTER.anchor_size(at, galley.size());
            painter.rect_filled(place.expand(1.5), 2.0, Color32::from_black_alpha(150));
            painter.galley(pos2(place.left(), place.top()), galley, BRIGHT);
        }
    }
}

/// A number in at most 6 characters, for the side of a texel.
fn short(value: f64) -> String {
    match value.abs() {
        v if v < 10.0 => format!("{value:.3}"),
        v if v < 100.0 => format!("{value:.2}"),
        v if v < 1e5 => format!("{value:.0}"),
        _ => format!("{value:.0e}"),
    }
}
