//! The loss of the chosen prediction over the directions of the light or the view.

use eframe::egui::{
    self, Align2, Color32, FontId, Pos2, Rect, RichText, Sense, Stroke, TextureId, TextureOptions, pos2, vec2,
};
use glam::DVec3;

use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::colour_map::difference_to_display;

use crate::viewer::jobs::why::{ComparedPair, DirectionMap};
use crate::viewer::model::command::{Command, SceneCommand, WhyCommand};
use crate::viewer::ui::pane::handles;
use crate::viewer::ui::why::WhyPanel;
use crate::viewer::ui::widgets::numbers::digits;
use crate::viewer::ui::widgets::texture::PanelTextures;

/// Largest side of the map, and width of what stands beside it, in points.
const MOST: f32 = 230.0;
const BESIDE: f32 = 96.0;
/// Colours in the bar.
const STEPS: usize = 64;

impl WhyPanel<'_> {
    pub fn directions(
        &self,
        ui: &mut egui::Ui,
        pair: &ComparedPair,
        textures: &mut PanelTextures,
        commands: &mut Vec<Command>,
    ) {
        let moved = self.why.moved;
        ui.horizontal_wrapped(|ui| {
            for (which, name, hover) in [
                (Endpoint::Light, "Over lights", "Distant lights from everywhere, for the view of the panes"),
                (Endpoint::View, "Over views", "Distant views from everywhere, for the light of the panes"),
            ] {
                if ui.selectable_label(moved == which, name).on_hover_text(hover).clicked() {
                    commands.push(WhyCommand::SetMoved(which).into());
                }
            }
        });
        let side = (ui.available_width() - BESIDE).clamp(80.0, MOST);
        let found = self.jobs.directions.get(pair, moved, &self.state.scene);
        let texture = found
            .map(|(map, current)| (textures.id(ui.ctx(), &map.picture, TextureOptions::NEAREST), current));
        let mut direction = None;
        ui.horizontal_top(|ui| {
            let (area, response) = ui.allocate_exact_size(vec2(side, side), Sense::click_and_drag());
            let name = if moved == Endpoint::Light { "light" } else { "view" };
            let label = format!("Loss over {name} directions");
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &label));
            let rim = pair.convention.u1_max.sqrt();
            self.paint(ui, area, rim, texture);
            if let Some(pos) =
                response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked())
            {
                let scene = put(self.state.scene, moved, direction_at(area, pos, rim));
                commands.push(SceneCommand::Set(scene).into());
            }
            let hovered = response.hover_pos().map(|pos| direction_at(area, pos, rim));
            direction = Some(hovered.unwrap_or_else(|| unit(&self.state.scene, moved)));
            response.on_hover_cursor(egui::CursorIcon::Crosshair);
            if let Some((map, _)) = found {
                legend(ui, side, map);
            }
        });
        if let Some(direction) = direction {
            ui.label(
                RichText::new(reading(moved, direction, found.map(|(map, _)| map))).monospace().size(11.5),
            );
        }
        let [x, y, z] = unit(&self.state.scene, other(moved));
        let fixed = if moved == Endpoint::Light { "view" } else { "light" };
        let text = format!("distant scenes, {fixed} fixed at ({x:.2}, {y:.2}, {z:.2})");
        ui.label(RichText::new(text).small().weak()).on_hover_text(
            "Seen from above: x to the right, y up, straight above in the middle. It covers the directions that the loss \
             samples. A click or drag shows the distant scene of that direction.",
        );
    }

    fn paint(&self, ui: &egui::Ui, area: Rect, rim: f64, texture: Option<(TextureId, bool)>) {
        let painter = ui.painter_at(area);
        let visuals = ui.visuals();
        let radius = area.width() / 2.0;
        if let Some((texture, current)) = texture {
            let tint = if current { Color32::WHITE } else { Color32::from_white_alpha(140) };
            let all = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(texture, area, all, tint);
        } else {
            painter.text(
                area.center(),
                Align2::CENTER_CENTER,
                "...",
                FontId::proportional(14.0),
                visuals.text_color(),
            );
        }
        let thin = Stroke::new(1.0, visuals.weak_text_color());
        painter.circle_stroke(area.center(), radius - 1.0, thin);
        if rim < 0.999 {
            painter.circle_stroke(
                area.center(),
                radius * rim as f32,
                Stroke::new(1.0, visuals.weak_text_color().gamma_multiply(0.5)),
            );
        }
        let at = |moved| pos_of(area, unit(&self.state.scene, moved));
        handles::paint_eye(&painter, at(Endpoint::View), false);
        handles::paint_sun(&painter, at(Endpoint::Light), false);
    }
}

fn other(moved: Endpoint) -> Endpoint {
    match moved {
        Endpoint::Light => Endpoint::View,
        Endpoint::View => Endpoint::Light,
    }
}

/// The direction of light or view from the middle of the material.
fn unit(scene: &Scene, which: Endpoint) -> [f64; 3] {
    let endpoint = match which {
        Endpoint::Light => scene.light,
        Endpoint::View => scene.view,
    };
    DVec3::from(endpoint).normalize().to_array()
}

/// The distant scene with light or view in this direction. Both keep their distances, for when the scene is made near-field
/// again.
fn put(scene: Scene, moved: Endpoint, direction: [f64; 3]) -> Scene {
    let moved_to = |from: [f64; 3]| (DVec3::from(direction) * DVec3::from(from).length()).to_array();
    match moved {
        Endpoint::Light => Scene { kind: Kind::Distant, light: moved_to(scene.light), ..scene },
        Endpoint::View => Scene { kind: Kind::Distant, view: moved_to(scene.view), ..scene },
    }
}

/// Where a unit direction is on the map.
fn pos_of(area: Rect, [x, y, _]: [f64; 3]) -> Pos2 {
    area.center() + vec2(x as f32, -y as f32) * (area.width() / 2.0)
}

/// The unit direction at a point of the map; beyond the rim, the nearest on it.
fn direction_at(area: Rect, pos: Pos2, rim: f64) -> [f64; 3] {
    let at = (pos - area.center()) / (area.width() / 2.0);
    let [x, y] = [f64::from(at.x), f64::from(-at.y)];
    let shrink = (rim / x.hypot(y)).min(1.0);
    let [x, y] = [x * shrink, y * shrink];
    [x, y, (1.0 - x * x - y * y).max(0.0).sqrt()]
}

/// The loss in a direction, with its standard error.
fn reading(moved: Endpoint, direction: [f64; 3], found: Option<&DirectionMap>) -> String {
    let name = if moved == Endpoint::Light { "light" } else { "view" };
    let [x, y, z] = direction;
    let place = format!("{name} {x:5.2} {y:5.2} {z:4.2}");
    let read = |map: &DirectionMap| {
        let index = map.map.nearest_cell(direction)?;
        let [loss, error] = [map.map.losses[0][index], map.map.standard_errors[0][index]];
        Some(format!("{place}: {loss:.4} ± {error:.4}"))
    };
    found.and_then(read).unwrap_or_else(|| format!("{place}: -"))
}

/// The colour bar, and the numbers of the whole map.
fn legend(ui: &mut egui::Ui, height: f32, found: &DirectionMap) {
    ui.vertical(|ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        let ink = ui.visuals().text_color();
        let (area, _) = ui.allocate_exact_size(vec2(BESIDE - 20.0, height * 0.5), Sense::hover());
        let bar = area.with_max_x(area.left() + 12.0).shrink2(vec2(0.0, 5.0));
        let step = bar.height() / STEPS as f32;
        for i in 0..STEPS {
            let [r, g, b] = difference_to_display((i as f32 + 0.5) / STEPS as f32, 1.0, false);
            let bottom = bar.bottom() - i as f32 * step;
            let part = Rect::from_x_y_ranges(bar.x_range(), bottom - step..=bottom + 0.5);
            ui.painter().rect_filled(part.intersect(bar), 0.0, Color32::from_rgb(r, g, b));
        }
        let font = FontId::monospace(11.0);
        for (value, y) in [(found.largest, bar.top()), (0.0, bar.bottom())] {
            let text = if value > 0.0 { digits(value) } else { "0".to_owned() };
            ui.painter().text(pos2(bar.right() + 4.0, y), Align2::LEFT_CENTER, text, font.clone(), ink);
        }
        let small = |text: String| RichText::new(text).monospace().size(11.0);
        ui.label(small(format!("mean\n{}", digits(found.map.mean(0)))))
            .on_hover_text("Over all directions of the map");
        ui.label(small(format!("std. err.\n{}", digits(found.map.standard_error(0)))))
            .on_hover_text("Of a direction, from the choice of the compared texels; neighbours share it");
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::model::view::state::ViewState;

    #[test]
    fn a_point_of_the_map_is_where_its_direction_is_drawn() {
        let area = Rect::from_min_size(pos2(10.0, 20.0), vec2(200.0, 200.0));
        for pos in [pos2(110.0, 120.0), pos2(60.0, 90.0), pos2(150.0, 180.0)] {
            let direction = direction_at(area, pos, 0.97);
            assert!(pos_of(area, direction).distance(pos) < 1e-3, "{direction:?}");
            assert!((DVec3::from(direction).length() - 1.0).abs() < 1e-12);
        }
        // The upper left corner: x to the left, y up, on the rim.
        let [x, y, _] = direction_at(area, area.min, 0.97);
        assert!(x < 0.0 && y > 0.0 && (x.hypot(y) - 0.97).abs() < 1e-12);
    }

    #[test]
    fn what_is_put_somewhere_keeps_its_distance_and_leaves_the_other() {
        let scene = ViewState::default().scene;
        let direction = [0.6, 0.0, 0.8];
        let moved = put(scene, Endpoint::Light, direction);
        assert_eq!((moved.kind, moved.view), (Kind::Distant, scene.view));
        assert!((DVec3::from(moved.light).length() - DVec3::from(scene.light).length()).abs() < 1e-12);
        assert!(DVec3::from(unit(&moved, Endpoint::Light)).distance(DVec3::from(direction)) < 1e-12);
    }
}
