//! A figure in pixels.

use ab_glyph::{Font as _, PxScale, point};
use svbrdf_core::image::Image;

use super::layout::{FONT, Figure, FigurePicture, Text, glyphs};

const WHITE: [u8; 3] = [255; 3];

/// The figure at its scale. A picture with as many pixels as its rectangle is copied, others take the nearest pixel.
pub(super) fn image(figure: &Figure) -> Image<u8> {
    let [width, height] = figure.pixels();
    let mut image = Image { width, height, pixels: vec![WHITE; width * height] };
    figure.pictures.iter().for_each(|picture| put(&mut image, picture, figure.scale));
    figure.texts.iter().for_each(|text| write(&mut image, text, figure.scale));
    image
}

fn put(image: &mut Image<u8>, picture: &FigurePicture, scale: f64) {
    let [left, top] = picture.at.map(|place| (place * scale).round() as usize);
    let [width, height] = picture.size.map(|side| (side * scale).round().max(1.0) as usize);
    let from = &picture.image;
    for y in 0..height.min(image.height.saturating_sub(top)) {
        let row = &from.pixels[y * from.height / height * from.width..][..from.width];
        for x in 0..width.min(image.width.saturating_sub(left)) {
            image.pixels[(top + y) * image.width + left + x] = row[x * from.width / width];
        }
    }
}

/// Covers a share of a pixel.
fn blend(pixel: &mut [u8; 3], ink: [u8; 3], cover: f32) {
    for (channel, ink) in pixel.iter_mut().zip(ink) {
        let [below, ink] = [*channel, ink].map(f32::from);
        *channel = (below + (ink - below) * cover.clamp(0.0, 1.0)).round() as u8;
    }
}

/// Writes a text, whose glyphs stand between pixels.
fn write(image: &mut Image<u8>, text: &Text, scale: f64) {
    let Some(font) = &*FONT else { return };
    let em = (text.style.size * scale) as f32;
    // The size of `ab_glyph` is that from the ascent to the descent.
    let size = PxScale::from(em * font.height_unscaled() / font.units_per_em().unwrap_or(1000.0));
    let [left, baseline] = [text.left(), text.at[1]].map(|place| (place * scale) as f32);
    for glyph in glyphs(&text.text) {
        let place = point(left + glyph.x * em, baseline);
        let Some(outline) = font.outline_glyph(glyph.id.with_scale_and_position(size, place)) else {
            continue;
        };
        let bounds = outline.px_bounds();
        outline.draw(|x, y, cover| {
            let [x, y] = [bounds.min.x + x as f32, bounds.min.y + y as f32];
            if x < 0.0 || y < 0.0 || x as usize >= image.width || y as usize >= image.height {
                return;
            }
            blend(&mut image.pixels[y as usize * image.width + x as usize], text.style.ink, cover);
        });
    }
}
