//! The losses of the predictions over the directions of the light or the view, and the difference of two of them.

use eframe::egui::{
    self, Align2, Color32, FontId, Rect, RichText, Sense, Stroke, TextureId, TextureOptions, pos2, vec2,
};
use glam::DVec3;

use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::model::scene::{Kind, Scene};

use crate::jobs::why::DirectionMaps;
use crate::model::command::{Command, SceneCommand, WhyCommand};
use crate::ui::pane::handles;
use crate::ui::why::WhyPanel;
use crate::ui::why::legends::legends;
use crate::ui::widgets::hemisphere::{direction_at, pos_of, unit};
use crate::ui::widgets::names::shortened;
use crate::ui::widgets::numbers::{digits, signed};
use crate::ui::widgets::texture::PanelTextures;
use crate::ui::widgets::theme;

/// Largest side of a map, and gap between maps, in points.
const MOST: f32 = 230.0;
const GAP: f32 = 8.0;
/// Height of the line above a map, in points.
const CAPTION: f32 = 16.0;
/// Characters of a name above a map.
const NAME: usize = 12;

/// What a map shows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum DirectionMap {
    /// The losses of a prediction.
    Loss(usize),
    /// The losses of the chosen prediction minus those of another.
    Difference(usize),
}

impl WhyPanel<'_> {
    /// The maps of all predictions, which reach to the share `rim` of the radius, and the difference of the best two.
    pub fn directions(
        &self,
        ui: &mut egui::Ui,
        rim: f64,
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
        let found = self.jobs.directions.get(&self.pairs, moved, &self.state.scene);
        let chosen = self.state.display.prediction;
        let other = found.and_then(|(maps, _)| Some(maps.differences.get(chosen)?.0));
        let losses = (0..self.pairs.len()).map(|index| Some(DirectionMap::Loss(index)));
        // The difference has its place before it is known which other prediction is the best.
        let has_difference = self.pairs.len() > 1;
        let difference = has_difference.then_some(other.map(DirectionMap::Difference));
        let all: Vec<Option<DirectionMap>> = losses.chain(difference).collect();
        let columns = all.len().min(2) as f32;
        let side = ((ui.available_width() - GAP * (columns - 1.0)) / columns).clamp(80.0, MOST);
        let mut read = None;
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing = vec2(GAP, 4.0);
            for row in all.chunks(2) {
                ui.horizontal_top(|ui| {
                    for kind in row {
                        let Some(kind) = *kind else {
                            ui.allocate_exact_size(vec2(side, side + CAPTION), Sense::hover());
                            continue;
                        };
                        let hovered = self.map(ui, side, rim, kind, found, textures, commands);
                        read = hovered.map(|direction| (kind, direction)).or(read);
                    }
                });
            }
        });
        let (kind, direction) = read.unwrap_or((DirectionMap::Loss(chosen), unit(&self.state.scene, moved)));
        let text = self.reading(kind, direction, found.map(|(maps, _)| maps));
        ui.add(egui::Label::new(RichText::new(text).monospace().size(11.5)).truncate());
        legends(ui, chosen, has_difference, found.map(|(maps, _)| maps));
        let [x, y, z] = unit(&self.state.scene, other_endpoint(moved));
        let fixed = if moved == Endpoint::Light { "view" } else { "light" };
        let text = format!("distant scenes, {fixed} fixed at ({x:.2}, {y:.2}, {z:.2})");
        ui.label(RichText::new(text).small().weak()).on_hover_text(
            "Seen from above: x to the right, y up, straight above in the middle. It covers the directions that the loss \
             samples. A click or drag shows the distant scene of that direction.",
        );
    }

    /// One map below its caption; the direction under the pointer.
    #[expect(clippy::too_many_arguments, reason = "one for each thing that the map is drawn from")]
    fn map(
        &self,
        ui: &mut egui::Ui,
        side: f32,
        rim: f64,
        kind: DirectionMap,
        found: Option<(&DirectionMaps, bool)>,
        textures: &mut PanelTextures,
        commands: &mut Vec<Command>,
    ) -> Option<[f64; 3]> {
        let moved = self.why.moved;
        let (all, _) = ui.allocate_exact_size(vec2(side, side + CAPTION), Sense::hover());
        let area = all.with_min_y(all.top() + CAPTION);
        self.caption(ui, all.with_max_y(area.top()), kind, found.map(|(maps, _)| maps));
        let response =
            ui.interact(area, ui.scope_id().with(("directions", label(kind))), Sense::click_and_drag());
        let name = if moved == Endpoint::Light { "light" } else { "view" };
        let of = match kind {
            DirectionMap::Loss(index) if index == self.state.display.prediction => String::new(),
            _ => format!(" of {}", label(kind)),
        };
        let label = format!("Loss over {name} directions{of}");
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &label));
        let texture = found.and_then(|(maps, current)| {
            let scaled = match kind {
                DirectionMap::Loss(index) => maps.losses.get(index)?,
                DirectionMap::Difference(_) => &maps.differences.get(self.state.display.prediction)?.1,
            };
            Some((textures.id(ui.ctx(), &scaled.picture, TextureOptions::NEAREST), current))
        });
        self.paint(ui, area, rim, texture);
        let pressed = response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked());
        if let Some(pos) = pressed {
            let scene = put(self.state.scene, moved, direction_at(area, pos, rim));
            commands.push(SceneCommand::Set(scene).into());
        }
        let direction = response.hover_pos().map(|pos| direction_at(area, pos, rim));
        response.on_hover_cursor(egui::CursorIcon::Crosshair);
        direction
    }

    /// The number, name and mean of a prediction, or the numbers of two.
    fn caption(&self, ui: &mut egui::Ui, area: Rect, kind: DirectionMap, found: Option<&DirectionMaps>) {
        let chosen = self.state.display.prediction;
        let (text, mean, hover) = match kind {
            DirectionMap::Loss(index) => {
                let name = shortened(&self.names, NAME).swap_remove(index);
                let mean = found.map(|maps| digits(maps.map.mean(index)));
                (format!("{}  {name}", index + 1), mean, self.names[index].to_owned())
            }
            DirectionMap::Difference(other) => {
                let mean = found.map(|maps| {
                    let apart = maps.map.mean(chosen) - maps.map.mean(other);
                    signed(&digits(apart))
                });
                let text = format!("{} \u{2212} {}", chosen + 1, other + 1);
                let hover = format!(
                    "The loss of {} minus that of {}: where it is below 0, {} is better",
                    self.names[chosen], self.names[other], self.names[chosen]
                );
                (text, mean, hover)
            }
        };
        let ink = match kind {
            DirectionMap::Loss(index) => theme::series(index, ui.visuals().dark_mode),
            DirectionMap::Difference(_) => ui.visuals().text_color(),
        };
        let (font, painter) = (FontId::proportional(12.0), ui.painter_at(area));
        painter.text(area.left_center(), Align2::LEFT_CENTER, text, font, ink);
        if let Some(mean) = mean {
            let weak = ui.visuals().weak_text_color();
            painter.text(area.right_center(), Align2::RIGHT_CENTER, mean, FontId::monospace(11.0), weak);
        }
        let id = ui.scope_id().with(("caption", label(kind)));
        ui.interact(area, id, Sense::hover())
            .on_hover_text(format!("{hover}\nThe number is the mean over all directions of the map"));
    }

    /// The loss in a direction, with its standard error; or the difference of two losses.
    fn reading(&self, kind: DirectionMap, direction: [f64; 3], found: Option<&DirectionMaps>) -> String {
        let name = if self.why.moved == Endpoint::Light { "light" } else { "view" };
        let [x, y, z] = direction;
        let place = format!("{name} {x:5.2} {y:5.2} {z:4.2}");
        let read = |maps: &DirectionMaps| {
            let cell = maps.map.nearest_cell(direction)?;
            let of = |index: usize| maps.map.losses.get(index).map(|losses| losses[cell]);
            Some(match kind {
                DirectionMap::Loss(index) => {
                    format!("{:.4} ± {:.4}", of(index)?, maps.map.standard_errors[index][cell])
                }
                DirectionMap::Difference(other) => {
                    let apart = of(self.state.display.prediction)? - of(other)?;
                    signed(&format!("{apart:.4}"))
                }
            })
        };
        let number = found.and_then(read).unwrap_or_else(|| "-".to_owned());
        format!("{place}: {number}")
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

fn other_endpoint(moved: Endpoint) -> Endpoint {
    match moved {
        Endpoint::Light => Endpoint::View,
        Endpoint::View => Endpoint::Light,
    }
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

/// The number of a prediction, or the difference of two.
fn label(kind: DirectionMap) -> String {
    match kind {
        DirectionMap::Loss(index) => (index + 1).to_string(),
        DirectionMap::Difference(other) => format!("the difference to {}", other + 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::state::ViewState;

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
