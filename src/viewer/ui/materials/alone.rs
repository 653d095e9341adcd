//! A material that is looked at alone: its maps at a glance, and how to look at it.

use std::sync::Arc;

use eframe::egui::{self, RichText, Role, TextureOptions, WidgetInfo, vec2};

use svbrdf_core::picture::content::PictureContent;
use svbrdf_core::picture::quantity::Quantity;

use crate::jobs::work::picture::Picture;
use crate::model::command::{Command, DisplayCommand, SceneCommand, WindowCommand};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::MaterialId;
use crate::model::view::animation::Animation;
use crate::model::view::state::ViewState;
use crate::ui::widgets::texture::PanelTextures;

/// Side of a thumbnail, in points, and in pixels.
const SIDE: f32 = 66.0;
const PIXELS: usize = 136;
/// The maps, in the order of their thumbnails.
const MAPS: [Quantity; 4] = [Quantity::Normal, Quantity::Diffuse, Quantity::Specular, Quantity::Roughness];

/// The thumbnails of the maps of a material, which are made once.
#[derive(Debug, Default)]
pub struct MapThumbnails(Option<(MaterialId, [Arc<Picture>; MAPS.len()])>);

impl MapThumbnails {
    fn of(&mut self, material: &LoadedMaterial, view: &ViewState) -> [Arc<Picture>; MAPS.len()] {
        match &self.0 {
            Some((id, pictures)) if *id == material.id() => pictures.clone(),
            _ => {
                let pictures = MAPS.map(|map| Arc::new(thumbnail(material, map, view)));
                self.0 = Some((material.id(), pictures.clone()));
                pictures
            }
        }
    }
}

/// Every n-th texel of a map.
fn thumbnail(material: &LoadedMaterial, map: Quantity, view: &ViewState) -> Picture {
    let size = material.material().size();
    let step = size[0].max(size[1]).div_ceil(PIXELS).max(1);
    let [columns, rows] = size.map(|side| side.div_ceil(step));
    let (content, convention) = (PictureContent { quantity: map, difference: None }, view.convention());
    let pixel = |index: usize| {
        let place = [index % columns, index / columns];
        let texel = [0, 1].map(|axis| (place[axis] * step + step / 2).min(size[axis] - 1));
        Picture::opaque(content.colour(map.at(material.material(), &view.scene, &convention, texel), 0.0))
    };
    Picture { size: [columns, rows], pixels: (0..columns * rows).map(pixel).collect() }
}

/// What stands above the files of a material that is looked at alone.
#[derive(Debug)]
pub struct AloneCard<'a> {
    pub material: &'a LoadedMaterial,
    pub view: &'a ViewState,
    pub animation: &'a Animation,
}

impl AloneCard<'_> {
    pub fn ui(
        &self,
        ui: &mut egui::Ui,
        thumbnails: &mut MapThumbnails,
        textures: &mut PanelTextures,
    ) -> Vec<Command> {
        let mut commands = Vec::new();
        ui.label(RichText::new("Material").size(14.5));
        ui.separator();
        ui.horizontal(|ui| {
            // Four fit into the panel.
            ui.spacing_mut().button_padding = vec2(2.0, 2.0);
            ui.spacing_mut().item_spacing.x = 6.0;
            for (map, picture) in MAPS.iter().zip(thumbnails.of(self.material, self.view)) {
                self.map(ui, *map, &picture, textures, &mut commands);
            }
        });
        ui.horizontal_wrapped(|ui| self.ways(ui, &mut commands));
        ui.horizontal(|ui| {
            let open = ui.link("Open a prediction to compare");
            if open
                .on_hover_text("Its loss and its differences are shown then (Ctrl+O, or drop it here)")
                .clicked()
            {
                commands.push(WindowCommand::ShowOpen(true).into());
            }
        });
        ui.separator();
        commands
    }

    /// The thumbnail of a map; a click shows the map, and another one the rendering again.
    fn map(
        &self,
        ui: &mut egui::Ui,
        map: Quantity,
        picture: &Arc<Picture>,
        textures: &mut PanelTextures,
        commands: &mut Vec<Command>,
    ) {
        let is_shown = self.view.display.quantity == map;
        ui.vertical(|ui| {
            let texture = textures.id(ui.ctx(), picture, TextureOptions::LINEAR);
            let [width, height] = picture.size.map(|side| side as f32);
            let size = vec2(width, height) * (SIDE / width.max(height));
            let button =
                ui.add(egui::Button::image((texture, size)).selected(is_shown).min_size(vec2(SIDE, SIDE)));
            button.widget_info(|| {
                WidgetInfo::selected(Role::Button, true, is_shown, format!("Map {}", map.name()))
            });
            ui.label(RichText::new(map.name()).small().weak());
            if button.on_hover_text("Show this map; again: the rendering (M)").clicked() {
                let shown = if is_shown { Quantity::Rendering } else { map };
                commands.push(DisplayCommand::SetQuantity(shown).into());
            }
        });
    }

    /// Tiling, and what moves by itself.
    fn ways(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let tile = ui.selectable_label(self.view.display.tiled, "Repeat");
        if tile.on_hover_text("Repeat the material 2 × 2 times: shows its seams (T)").clicked() {
            commands.push(DisplayCommand::ToggleTiled.into());
        }
        let mut animation = *self.animation;
        let turns = ui.selectable_label(animation.turntable, "Turntable");
        if turns.on_hover_text("The view turns about the upright axis of the material").clicked() {
            animation.turntable ^= true;
        }
        let moves = ui.selectable_label(animation.light, "Moving light");
        if moves.on_hover_text("The light follows a path by itself").clicked() {
            animation.light ^= true;
        }
        if animation != *self.animation {
            animation.paused = false;
            commands.push(SceneCommand::Animate(animation).into());
        }
    }
}
