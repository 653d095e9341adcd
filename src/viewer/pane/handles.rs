//! Handles of light (a sun) and view (an eye) over the material, and of the wipe line.

use eframe::egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, Vec2, pos2};
use glam::Vec3;

use svbrdf_core::picture::camera::Camera;

use crate::model::endpoint::{self, Endpoint};
use crate::model::view::{Projection, ViewState};
use crate::widgets::paint::{inset, nearest};
use crate::widgets::theme;

/// Distance, in points, within which a press grabs a handle or the wipe line.
pub const REACH: f32 = 12.0;
/// Radius of the sun's disc, in points.
const RADIUS: f32 = 6.0;

/// From a pane's coordinates (x right, y up in [-1, 1]) to the screen.
pub fn pos_from_ndc(rect: Rect, [x, y]: [f32; 2]) -> Pos2 {
    rect.center() + Vec2::new(x * rect.width(), -y * rect.height()) * 0.5
}

/// From the screen to a pane's coordinates (x right, y up in [-1, 1]).
pub fn ndc_from_pos(rect: Rect, pos: Pos2) -> [f32; 2] {
    let offset = (pos - rect.center()) / (rect.size() * 0.5);
    [offset.x, -offset.y]
}

/// Draws the handles of a scene: the sun, and in flat panes the eye.
pub fn paint_endpoints(painter: &Painter, rect: Rect, camera: &Camera, state: &ViewState) {
    let place = |which| pos_from_plane(camera, rect, endpoint::over_plane(&state.scene, which));
    if state.display.projection == Projection::Flat
        && let Some((at, out_of_range)) = place(Endpoint::View)
    {
        paint_eye(painter, at, out_of_range);
    }
    if let Some((at, out_of_range)) = place(Endpoint::Light) {
        paint_sun(painter, at, out_of_range);
    }
}

/// The point (x, y) of the plane on the screen, clamped to the pane; and whether it lies out_of_range of it.
pub fn pos_from_plane(camera: &Camera, rect: Rect, [x, y]: [f64; 2]) -> Option<(Pos2, bool)> {
    let ndc = camera.ndc_from_point(Vec3::new(x as f32, y as f32, 0.0))?;
    let pos = pos_from_ndc(rect, ndc);
    let clamped = nearest(inset(rect, Vec2::splat(RADIUS)), pos);
    Some((clamped, clamped != pos))
}

/// The light's handle; hollow where the light is out_of_range of the pane.
pub fn paint_sun(painter: &Painter, at: Pos2, out_of_range: bool) {
    let fill = if out_of_range { Color32::TRANSPARENT } else { theme::SUN };
    for (width, colour) in [(4.0, Color32::from_black_alpha(150)), (2.0, theme::SUN)] {
        for i in 0..8 {
            let direction = Vec2::angled(i as f32 * std::f32::consts::TAU / 8.0);
            let ray = [at + direction * (RADIUS + 2.5), at + direction * (RADIUS + 6.0)];
            painter.line_segment(ray, Stroke::new(width, colour));
        }
        painter.circle_stroke(at, RADIUS, Stroke::new(width, colour));
    }
    painter.circle_filled(at, RADIUS - 1.0, fill);
}

/// The view's handle; hollow where the view is out_of_range of the pane.
pub fn paint_eye(painter: &Painter, at: Pos2, out_of_range: bool) {
    let (half_width, half_height) = (RADIUS * 1.9, RADIUS * 1.1);
    let outline: Vec<Pos2> = (0..32)
        .map(|i| {
            let angle = i as f32 * std::f32::consts::TAU / 32.0;
            let pointed = angle.sin() * angle.sin().abs().sqrt();
            at + Vec2::new(angle.cos() * half_width, pointed * half_height)
        })
        .collect();
    let fill = if out_of_range { Color32::TRANSPARENT } else { theme::EYE };
    painter.add(Shape::closed_line(outline.clone(), Stroke::new(4.0, Color32::from_black_alpha(150))));
    painter.add(Shape::convex_polygon(outline, fill, Stroke::new(1.5, theme::EYE)));
    let pupil = if out_of_range { theme::EYE } else { Color32::from_gray(30) };
    painter.circle_filled(at, RADIUS * 0.55, pupil);
}

/// The line between the two sides of a wipe, with a grip.
pub fn paint_wipe(painter: &Painter, rect: Rect, wipe: f32) {
    let x = rect.left() + wipe * rect.width();
    let line = [pos2(x, rect.top()), pos2(x, rect.bottom())];
    painter.line_segment(line, Stroke::new(3.0, Color32::from_black_alpha(140)));
    painter.line_segment(line, Stroke::new(1.0, theme::EYE));
    let grip = Rect::from_center_size(pos2(x, rect.top() + 0.85 * rect.height()), Vec2::new(8.0, 28.0));
    painter.rect_filled(grip, 4.0, theme::EYE);
    painter.rect_stroke(
        grip,
        4.0,
        Stroke::new(1.0, Color32::from_gray(40)),
        eframe::egui::StrokeKind::Outside,
    );
}
