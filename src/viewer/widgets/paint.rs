//! Bar of false colours, textures of pictures, and texts in the panes.

use std::collections::HashMap;
use std::sync::{Arc, Weak};

use eframe::egui::{
    self, Align2, Color32, ColorImage, Context, FontId, Mesh, Rect, TextureHandle, TextureId, TextureOptions,
    pos2, vec2,
};

use svbrdf_core::picture::colour_map::difference_to_display;

use crate::jobs::work::picture::PanelPicture;

/// Colours from one end to the other.
const STEPS: u32 = 64;

/// The colours of the amounts from `low` to `high`, in units of the range: from left to right, or from below to above where
/// the bar is higher than wide.
pub fn colour_bar(bar: Rect, [low, high]: [f32; 2], is_signed: bool) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..=STEPS {
        let share = i as f32 / STEPS as f32;
        let [r, g, b] = difference_to_display(low + (high - low) * share, 1.0, is_signed);
        let ends = if bar.height() > bar.width() {
            let y = bar.bottom() - share * bar.height();
            [pos2(bar.left(), y), pos2(bar.right(), y)]
        } else {
            let x = bar.left() + share * bar.width();
            [pos2(x, bar.top()), pos2(x, bar.bottom())]
        };
        ends.into_iter().for_each(|end| mesh.colored_vertex(end, Color32::from_rgb(r, g, b)));
        if let Some(last) = (2 * i).checked_sub(2) {
            mesh.add_triangle(last, last + 1, last + 2);
            mesh.add_triangle(last + 1, last + 2, last + 3);
        }
    }
    mesh
}

/// The textures of the pictures that panels and panes draw; each is freed with its picture.
#[derive(Default)]
pub struct PanelTextures(HashMap<usize, (Weak<PanelPicture>, TextureHandle)>);

impl PanelTextures {
    /// The texture of a picture, which is loaded where it is new.
    pub fn id(&mut self, ctx: &Context, picture: &Arc<PanelPicture>, options: TextureOptions) -> TextureId {
        self.0.retain(|_, (of, _)| of.strong_count() > 0);
        let load = || {
            let image = ColorImage::from_rgba_premultiplied(picture.size, picture.pixels.as_flattened());
            (Arc::downgrade(picture), ctx.load_texture("picture", image, options))
        };
        // A picture that lives is at an address of its own.
        self.0.entry(Arc::as_ptr(picture).addr()).or_insert_with(load).1.id()
    }
}

impl std::fmt::Debug for PanelTextures {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("PanelTextures").field(&self.0.len()).finish()
    }
}

/// A text at the bottom of a pane.
pub fn paint_hint(painter: &egui::Painter, rect: Rect, text: &str) {
    let (font, ink) = (FontId::proportional(13.0), egui::Color32::from_gray(235));
    let galley = painter.layout(text.to_owned(), font, ink, (rect.width() - 24.0).max(40.0));
    let place = Align2::CENTER_BOTTOM.anchor_size(rect.center_bottom() - vec2(0.0, 10.0), galley.size());
    painter.rect_filled(place.expand2(vec2(8.0, 4.0)), 4.0, egui::Color32::from_black_alpha(170));
    painter.galley(place.min, galley, ink);
}

/// A text in the middle of an empty area.
pub fn note(ui: &egui::Ui, area: Rect, text: &str) {
    let galley = ui.painter().layout(
        text.to_owned(),
        FontId::proportional(15.0),
        egui::Color32::from_gray(235),
        area.width() * 0.8,
    );
    let rect = Align2::CENTER_CENTER.anchor_size(area.center(), galley.size());
    ui.painter().galley(rect.min, galley, egui::Color32::from_gray(235));
}
