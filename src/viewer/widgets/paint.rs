//! Bar of false colours, textures of pictures, and texts in the panes.

use std::collections::HashMap;
use std::sync::{Arc, Weak};

use eframe::egui::{
    self, Align2, Color32, ColorImage, Context, FontId, Mesh, Pos2, Rect, TextureHandle, TextureId,
    TextureOptions, Vec2, pos2, vec2,
};

use svbrdf_core::picture::colour_map::difference_to_display;

/// Colours from one end to the other.
const STEPS: u32 = 64;

/// The colours of the amounts from `low` to `high`, in units of the range, from left to right.
pub fn colour_bar(bar: Rect, [low, high]: [f32; 2], is_signed: bool) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..=STEPS {
        let share = i as f32 / STEPS as f32;
        let [r, g, b] = difference_to_display(low + (high - low) * share, 1.0, is_signed);
        let x = bar.left() + share * bar.width();
        let ends = [pos2(x, bar.top()), pos2(x, bar.bottom())];
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
pub struct PanelTextures(HashMap<usize, (Weak<ColorImage>, TextureHandle)>);

impl PanelTextures {
    /// The texture of a picture, which is loaded where it is new.
    pub fn id(&mut self, ctx: &Context, picture: &Arc<ColorImage>, options: TextureOptions) -> TextureId {
        self.0.retain(|_, (of, _)| of.strong_count() > 0);
        let load = || (Arc::downgrade(picture), ctx.load_texture("picture", picture.clone(), options));
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

/// `value` between `low` and `high`; halfway between them where they are the wrong way round.
pub fn between(value: f32, low: f32, high: f32) -> f32 {
    if low <= high { value.max(low).min(high) } else { 0.5 * (low + high) }
}

/// The point of `rect` nearest to `pos`.
pub fn nearest(rect: Rect, pos: Pos2) -> Pos2 {
    pos2(between(pos.x, rect.left(), rect.right()), between(pos.y, rect.top(), rect.bottom()))
}

/// `rect` without a margin at each side; its middle along an axis that is shorter than both margins.
pub fn inset(rect: Rect, margin: Vec2) -> Rect {
    let rest = (rect.size() - 2.0 * margin).max(Vec2::ZERO);
    Rect::from_center_size(rect.center(), rest)
}

/// Pictures in one, in cells of the size of the largest.
#[derive(Debug)]
pub struct Atlas {
    pub picture: Arc<ColorImage>,
    /// The upper left corner and the size of each.
    parts: Vec<[[usize; 2]; 2]>,
}

impl Atlas {
    pub fn new(pictures: &[ColorImage]) -> Self {
        let side = |axis: usize| pictures.iter().map(|one| one.size[axis]).max().unwrap_or(1);
        let columns = (pictures.len() as f64).sqrt().ceil().max(1.0) as usize;
        let sides = [side(0), side(1)];
        let size = [columns * sides[0], pictures.len().div_ceil(columns).max(1) * sides[1]];
        let mut picture = ColorImage::filled(size, Color32::TRANSPARENT);
        let mut parts = Vec::new();
        for (index, one) in pictures.iter().enumerate() {
            let least = [index % columns * sides[0], index / columns * sides[1]];
            for (row, line) in one.pixels.chunks(one.size[0].max(1)).enumerate() {
                let start = (least[1] + row) * size[0] + least[0];
                picture.pixels[start..start + line.len()].copy_from_slice(line);
            }
            parts.push([least, one.size]);
        }
        Self { picture: Arc::new(picture), parts }
    }

    /// The part that is the picture of this number: least and greatest x and y, as shares of its sides; and its size in pixels.
    pub fn part(&self, number: usize) -> Option<([[f32; 2]; 2], [usize; 2])> {
        let [least, size] = self.parts.get(number)?;
        let share = |at: [usize; 2]| [0, 1].map(|axis| at[axis] as f32 / self.picture.size[axis] as f32);
        Some(([share(*least), share([least[0] + size[0], least[1] + size[1]])], *size))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_remains_of_an_area_lies_in_it_and_has_no_negative_side() {
        let margin = vec2(6.0, 60.0);
        for width in [0.0, 2.5, 8.0, 12.0, 640.0] {
            for height in [0.0, 2.5, 119.0, 121.0, 640.0] {
                let rect = Rect::from_min_size(pos2(30.0, 40.0), vec2(width, height));
                let rest = inset(rect, margin);
                assert!(rest.width() >= 0.0 && rest.height() >= 0.0, "{rest:?}");
                assert!(rect.expand(1e-3).contains_rect(rest), "{rest:?} in {rect:?}");
                assert!(rest.contains(nearest(rest, pos2(1e6, -1e6))), "{rest:?}");
            }
        }
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(100.0, 200.0));
        assert_eq!(inset(rect, margin), rect.shrink2(margin));
    }

    #[test]
    fn each_part_of_the_picture_is_one_of_the_pictures() {
        let sizes = [[3, 2], [2, 3], [3, 3], [1, 1]];
        let one = |(shade, size): (u8, [usize; 2])| ColorImage::filled(size, Color32::from_rgb(shade, 0, 0));
        let atlas = Atlas::new(&(0..).zip(sizes).map(one).collect::<Vec<_>>());
        assert_eq!(atlas.picture.size, [6, 6]);
        assert!(atlas.part(4).is_none());
        for (shade, expected) in sizes.into_iter().enumerate() {
            let ([least, most], size) = atlas.part(shade).unwrap();
            let [first, last] = [least, most].map(|at| [0, 1].map(|axis| (at[axis] * 6.0).round() as usize));
            assert_eq!(([last[0] - first[0], last[1] - first[1]], size), (expected, expected));
            let places = (first[1]..last[1]).flat_map(|y| (first[0]..last[0]).map(move |x| [x, y]));
            let shade = Color32::from_rgb(shade as u8, 0, 0);
            assert!(places.into_iter().all(|[x, y]| atlas.picture.pixels[y * 6 + x] == shade));
        }
    }
}
