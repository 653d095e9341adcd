//! Editor of the corners: the whole photograph in its pane, with handles that drag the corners of the material.

use eframe::egui::{
    self, Color32, CursorIcon, Pos2, Rect, Sense, Shape, Stroke, TextureId, TextureOptions, Vec2, pos2, vec2,
};

use svbrdf_files::photograph::Corners;

use crate::jobs::photograph::EditedCorners;
use crate::model::command::{Command, PhotographCommand};
use crate::ui::widgets::bounds::inset;
use crate::ui::widgets::hint::paint_hint;
use crate::ui::widgets::texture::PanelTextures;
use crate::ui::widgets::theme;

/// Names of the corners, in their order.
pub const CORNER_NAMES: [&str; 4] = ["Top left", "Top right", "Bottom right", "Bottom left"];
/// Radius of the ring of a handle, in points.
const RADIUS: f32 = 7.0;
/// Distance within which a press grabs a handle, in points.
const GRABBING: f32 = 16.0;
/// Room around the photograph, so that handles on its border are whole, in points.
const MARGIN: f32 = GRABBING;
/// Room below the photograph, for the hint, in points.
const BELOW: f32 = 40.0;
/// Side of the magnifier, in points.
const MAGNIFIER: f32 = 132.0;
/// Magnification against the pane, and least size of a pixel, in points.
const MAGNIFIED: (f32, f32) = (4.0, 4.0);
const DARK: Color32 = Color32::from_black_alpha(170);
const BRIGHT: Color32 = Color32::from_rgb(0xf5, 0xf5, 0xf5);

/// The photograph as it was taken, and the corners of the material in it.
#[derive(Clone, Copy, Debug)]
pub struct CornerEditor<'a>(pub EditedCorners<'a>);

/// A grabbed handle.
#[derive(Clone, Copy, Debug)]
struct Grabbed {
    /// The number of the corner.
    index: usize,
    /// From the press to the middle of the handle: a press beside the middle does not move the corner.
    offset: Vec2,
}

/// A photograph on the screen.
#[derive(Clone, Copy, Debug)]
struct PlacedPhotograph {
    /// Where its first pixel begins.
    origin: Pos2,
    /// Points per pixel.
    scale: f32,
    size: [usize; 2],
}

impl PlacedPhotograph {
    /// As large as fits into a pane.
    fn fitted(pane: Rect, size: [usize; 2]) -> Self {
        let room = Rect::from_min_max(pane.min + Vec2::splat(MARGIN), pane.max - vec2(MARGIN, BELOW));
        let sides = vec2(size[0] as f32, size[1] as f32);
        let scale = (room.width() / sides.x).min(room.height() / sides.y).max(1e-3);
        Self { origin: room.center() - sides * scale * 0.5, scale, size }
    }

    /// So that the point `at` of it, in pixels, is at `pos`.
    fn around(pos: Pos2, at: [f64; 2], scale: f32, size: [usize; 2]) -> Self {
        Self { origin: pos - vec2(at[0] as f32, at[1] as f32) * scale, scale, size }
    }

    fn rect(&self) -> Rect {
        Rect::from_min_size(self.origin, vec2(self.size[0] as f32, self.size[1] as f32) * self.scale)
    }

    /// Where the point (x, y), in pixels, is on the screen.
    fn pos(&self, [x, y]: [f64; 2]) -> Pos2 {
        self.origin + vec2(x as f32, y as f32) * self.scale
    }

    /// The point of the photograph that is nearest to `pos`, in pixels.
    fn point(&self, pos: Pos2) -> [f64; 2] {
        let at = (pos - self.origin) / self.scale;
        let [width, height] = self.size.map(|side| side as f64);
        [f64::from(at.x).clamp(0.0, width), f64::from(at.y).clamp(0.0, height)]
    }
}

impl CornerEditor<'_> {
    /// Draws the photograph and its handles into pane `number`; what a drag does.
    pub fn ui(
        &self,
        ui: &egui::Ui,
        pane: Rect,
        number: usize,
        textures: &mut PanelTextures,
    ) -> Option<Command> {
        let id = ui.scope_id().with(("corners", number));
        let response = ui.interact(pane, id, Sense::drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Corner pane"));
        let placed = PlacedPhotograph::fitted(pane, self.0.size);
        let texture = self.0.picture.map(|picture| textures.id(ui.ctx(), picture, TextureOptions::LINEAR));
        if response.drag_started() {
            // On slow adapters the pointer has moved on by the frame of the press.
            let press = ui.input(|i| i.pointer.press_origin());
            ui.data_mut(|data| data.insert_temp(id, press.and_then(|press| self.grabbed(&placed, press))));
        }
        let grabbed: Option<Grabbed> =
            ui.data(|data| data.get_temp(id)).filter(|_| response.dragged()).flatten();
        let pointed = response.hover_pos().and_then(|pos| self.grabbed(&placed, pos));
        let lit = grabbed.or(pointed).map(|grabbed| grabbed.index);

        let painter = ui.painter_at(pane);
        painter.rect_filled(pane, 0.0, theme::surround(ui.visuals().dark_mode));
        self.paint(&painter, texture, &placed, 1.5);
        paint_hint(&painter, pane, "Drag the corners of the material. Esc: done");
        for (index, name) in CORNER_NAMES.into_iter().enumerate() {
            let at = placed.pos(self.0.corners.0[index]);
            let area = Rect::from_center_size(at, Vec2::splat(2.0 * GRABBING));
            let label = ui.interact(area, id.with(index), Sense::hover());
            label
                .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, format!("{name} corner")));
            let colour = if lit == Some(index) { theme::SUN } else { BRIGHT };
            painter.circle_stroke(at, RADIUS, Stroke::new(4.0, DARK));
            painter.circle_stroke(at, RADIUS, Stroke::new(2.0, colour));
        }
        if let Some(index) = lit {
            self.magnify(&painter, texture, pane, &placed, index);
            ui.ctx().set_cursor_icon(if grabbed.is_some() { CursorIcon::Grabbing } else { CursorIcon::Grab });
        }
        let corners = self.dragged(grabbed?, response.interact_pointer_pos()?, &placed)?;
        Some(PhotographCommand::SetCorners(Some(corners)).into())
    }

    /// The handle that a press at `pos` grabs: the nearest one within reach.
    fn grabbed(&self, placed: &PlacedPhotograph, pos: Pos2) -> Option<Grabbed> {
        let all = self.0.corners.0.iter().enumerate();
        let all = all.map(|(index, corner)| Grabbed { index, offset: placed.pos(*corner) - pos });
        let nearest = all.min_by(|a, b| a.offset.length().total_cmp(&b.offset.length()));
        nearest.filter(|grabbed| grabbed.offset.length() <= GRABBING)
    }

    /// The corners with the grabbed one dragged to where the pointer is; `None` where it stays, or where the material cannot be.
    fn dragged(&self, grabbed: Grabbed, pos: Pos2, placed: &PlacedPhotograph) -> Option<Corners> {
        let mut corners = self.0.corners;
        corners.0[grabbed.index] = placed.point(pos + grabbed.offset);
        let moves = placed.pos(self.0.corners.0[grabbed.index]).distance(pos + grabbed.offset) > 0.05;
        (moves && corners != self.0.corners && corners.check(self.0.size).is_ok()).then_some(corners)
    }

    /// The photograph and the outline of the material.
    fn paint(
        &self,
        painter: &egui::Painter,
        texture: Option<TextureId>,
        placed: &PlacedPhotograph,
        width: f32,
    ) {
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        match texture {
            Some(texture) => painter.image(texture, placed.rect(), whole, Color32::WHITE),
            None => painter.rect_filled(placed.rect(), 0.0, Color32::BLACK),
        };
        let outline = self.0.corners.0.map(|corner| placed.pos(corner)).to_vec();
        painter.add(Shape::closed_line(outline.clone(), Stroke::new(width + 2.0, DARK)));
        painter.add(Shape::closed_line(outline, Stroke::new(width, BRIGHT)));
    }

    /// The neighbourhood of corner `index`, magnified, on the far side of the pane.
    fn magnify(
        &self,
        painter: &egui::Painter,
        texture: Option<TextureId>,
        pane: Rect,
        placed: &PlacedPhotograph,
        index: usize,
    ) {
        let corner = self.0.corners.0[index];
        let at = placed.pos(corner);
        let side = MAGNIFIER.min(0.4 * pane.width().min(pane.height()));
        let room = inset(pane, Vec2::splat(0.5 * side + 8.0));
        let far = |at: f32, near: f32, far: f32| if at < 0.5 * (near + far) { far } else { near };
        let middle = pos2(far(at.x, room.left(), room.right()), far(at.y, room.top(), room.bottom()));
        let window = Rect::from_center_size(middle, Vec2::splat(side));
        let inner = painter.with_clip_rect(window);
        inner.rect_filled(window, 0.0, Color32::BLACK);
        let scale = (MAGNIFIED.0 * placed.scale).max(MAGNIFIED.1);
        self.paint(&inner, texture, &PlacedPhotograph::around(middle, corner, scale, self.0.size), 1.0);
        painter.rect_stroke(window, 0.0, Stroke::new(1.0, BRIGHT), egui::StrokeKind::Outside);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_photograph_fits_into_its_pane_and_points_are_found_again() {
        for (size, pane) in [([400, 300], vec2(500.0, 700.0)), ([30, 4000], vec2(640.0, 300.0))] {
            let pane = Rect::from_min_size(pos2(7.0, 30.0), pane);
            let placed = PlacedPhotograph::fitted(pane, size);
            assert!(pane.shrink(MARGIN - 0.01).contains_rect(placed.rect()), "{placed:?}");
            assert!(placed.rect().bottom() <= pane.bottom() - BELOW + 0.01, "{placed:?}");
            for at in [[0.0, 0.0], [12.25, 250.5], [size[0] as f64, size[1] as f64]] {
                let found = placed.point(placed.pos(at));
                let at = [at[0].min(size[0] as f64), at[1]];
                assert!((found[0] - at[0]).abs() < 1e-2 && (found[1] - at[1]).abs() < 1e-2, "{found:?}");
            }
            let beyond = placed.rect().max + vec2(50.0, 90.0);
            assert_eq!(placed.point(beyond), size.map(|side| side as f64), "clamped");
            assert_eq!(placed.point(placed.rect().min - vec2(50.0, 90.0)), [0.0, 0.0]);
        }
    }

    #[test]
    fn the_magnifier_has_the_corner_in_its_middle() {
        let placed = PlacedPhotograph::around(pos2(100.0, 50.0), [12.0, 8.0], 4.0, [400, 300]);
        assert_eq!(placed.pos([12.0, 8.0]), pos2(100.0, 50.0));
        assert_eq!(placed.pos([13.0, 8.0]), pos2(104.0, 50.0));
    }
}
