//! Layout of a figure: texts and pictures at places in points, from which each format is written.

use std::borrow::Cow;

use image::RgbImage;
use image::imageops::{self, FilterType};
use svbrdf_core::image::Image;
use svbrdf_core::text::printable;

use super::font;

/// Points in a millimetre.
pub(in crate::export) const MILLIMETRE: f64 = 72.0 / 25.4;
/// From a baseline to the next, in ems.
const LEADING: f64 = 1.2;
/// From the top of a line to its baseline, in ems.
const ASCENT: f64 = 0.92;

/// Which part of a text is at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    Left,
    Middle,
    Right,
}

/// Most pixels of a point in a document: 600 in an inch. A printer has no more.
const PRINTED: f64 = 600.0 / 72.0;

/// How a text looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextStyle {
    /// In points.
    pub size: f64,
    pub ink: [u8; 3],
    pub anchor: Anchor,
}

#[derive(Clone, Debug)]
pub(super) struct Text {
    /// The anchor on the baseline.
    pub at: [f64; 2],
    pub text: String,
    pub style: TextStyle,
}

impl Text {
    pub(super) fn width(&self) -> f64 {
        font::width(&self.text, self.style.size)
    }

    pub(super) fn left(&self) -> f64 {
        let share = match self.style.anchor {
            Anchor::Left => 0.0,
            Anchor::Middle => 0.5,
            Anchor::Right => 1.0,
        };
        self.at[0] - share * self.width()
    }
}

/// A picture that covers a rectangle.
#[derive(Clone, Debug)]
pub(super) struct FigurePicture {
    pub at: [f64; 2],
    pub size: [f64; 2],
    pub image: Image<u8>,
}

impl FigurePicture {
    /// Its pixels for a document, averaged where a printer cannot resolve them.
    pub(super) fn printed(&self) -> Cow<'_, Image<u8>> {
        let Image { width, height, pixels } = &self.image;
        let [most_wide, most_high] = self.size.map(|side| (side * PRINTED).ceil().max(1.0) as u32);
        let [wide, high] = [*width as u32, *height as u32];
        let is_fine = wide <= most_wide && high <= most_high;
        let bytes = || pixels.as_flattened().to_vec();
        let picture = (!is_fine).then(|| RgbImage::from_raw(wide, high, bytes())).flatten();
        let Some(picture) = picture else { return Cow::Borrowed(&self.image) };
        let small =
            imageops::resize(&picture, wide.min(most_wide), high.min(most_high), FilterType::Triangle);
        let [width, height] = [small.width() as usize, small.height() as usize];
        Cow::Owned(Image { width, height, pixels: small.pixels().map(|pixel| pixel.0).collect() })
    }
}

/// A figure on white. Places are in points from the upper left corner, y down.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Width and height in points.
    pub size: [f64; 2],
    /// Pixels of a point in a PNG.
    pub scale: f64,
    pub(super) pictures: Vec<FigurePicture>,
    pub(super) texts: Vec<Text>,
}

impl Figure {
    /// A figure of this size in points, with nothing in it.
    pub fn new(size: [f64; 2], scale: f64) -> Self {
        Self { size, scale, pictures: Vec::new(), texts: Vec::new() }
    }

    /// Puts a picture into a rectangle, over what is there.
    pub fn picture(&mut self, at: [f64; 2], size: [f64; 2], image: Image<u8>) {
        self.pictures.push(FigurePicture { at, size, image });
    }

    /// Writes a text in lines of at most this width, the first below `top`; returns the bottom of the last.
    pub fn text(&mut self, [x, top]: [f64; 2], width: f64, text: &str, style: TextStyle) -> f64 {
        let lines = font::lines(&printable(text), style.size, width);
        for (number, text) in (0..).zip(lines) {
            let baseline = top + (f64::from(number) * LEADING + ASCENT) * style.size;
            self.texts.push(Text { at: [x, baseline], text, style });
        }
        top + Self::text_height(text, width, style.size)
    }

    /// The height of a text in lines of at most this width.
    pub fn text_height(text: &str, width: f64, size: f64) -> f64 {
        font::lines(&printable(text), size, width).len() as f64 * LEADING * size
    }

    /// The width of a text in one line.
    pub fn text_width(text: &str, size: f64) -> f64 {
        font::width(&printable(text), size)
    }

    /// Its pictures with their places and sizes, in the order in which they were put.
    pub fn pictures(&self) -> impl Iterator<Item = ([f64; 2], [f64; 2], &Image<u8>)> {
        self.pictures.iter().map(|picture| (picture.at, picture.size, &picture.image))
    }

    /// Width and height of its PNG in pixels.
    pub fn pixels(&self) -> [usize; 2] {
        self.size.map(|side| (side * self.scale).ceil().max(1.0) as usize)
    }
}
