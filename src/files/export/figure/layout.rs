//! Layout of a figure: texts and pictures at places in points, from which each format is written, and the font of its texts.

use std::borrow::Cow;
use std::sync::LazyLock;

use ab_glyph::{Font as _, FontRef, GlyphId};
use epaint_default_fonts::UBUNTU_LIGHT;
use image::RgbImage;
use image::imageops::{self, FilterType};
use svbrdf_core::image::Image;
use svbrdf_core::text::printable;
use ttf_parser::Face;
use ttf_parser::gpos::{PairAdjustment, PositioningSubtable};
use ttf_parser::opentype_layout::{LayoutTable, Lookup};

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
        text_width(&self.text, self.style.size)
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
        let lines = lines_of(&printable(text), style.size, width);
        for (number, text) in (0..).zip(lines) {
            let baseline = top + (f64::from(number) * LEADING + ASCENT) * style.size;
            self.texts.push(Text { at: [x, baseline], text, style });
        }
        top + Self::text_height(text, width, style.size)
    }

    /// The height of a text in lines of at most this width.
    pub fn text_height(text: &str, width: f64, size: f64) -> f64 {
        lines_of(&printable(text), size, width).len() as f64 * LEADING * size
    }

    /// The width of a text in one line.
    pub fn text_width(text: &str, size: f64) -> f64 {
        text_width(&printable(text), size)
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

pub(super) const FILE: &[u8] = UBUNTU_LIGHT;
/// The font; `None` where the file is damaged, which a test excludes.
pub(super) static FONT: LazyLock<Option<FontRef<'static>>> =
    LazyLock::new(|| FontRef::try_from_slice(FILE).ok());

static KERNING: LazyLock<Vec<Lookup<'static>>> = LazyLock::new(|| {
    let of = |table: LayoutTable<'static>| {
        let feature = table.features.find(ttf_parser::Tag::from_bytes(b"kern"))?;
        Some(feature.lookup_indices.into_iter().filter_map(|index| table.lookups.get(index)).collect())
    };
    Face::parse(FILE, 0).ok().and_then(|face| of(face.tables().gpos?)).unwrap_or_default()
});

#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedText {
    pub id: GlyphId,
    pub character: char,
    /// From the beginning of the text, in ems.
    pub x: f32,
    /// Of the glyph alone, without kerning, in ems.
    pub advance: f32,
}

/// The glyphs of a text, kerned, one for each character.
pub(super) fn glyphs(text: &str) -> Vec<PlacedText> {
    let Some(font) = FONT.as_ref() else { return Vec::new() };
    let em = font.units_per_em().unwrap_or(1000.0);
    let (mut end, mut last) = (0.0, None);
    let place = |character| {
        let id = font.glyph_id(character);
        let x = end + last.replace(id).map_or(0.0, |last| kern(last, id) / em);
        let advance = font.h_advance_unscaled(id) / em;
        end = x + advance;
        PlacedText { id, character, x, advance }
    };
    text.chars().map(place).collect()
}

/// How much farther the second of two glyphs stands from the first, in units of the font (OpenType, GPOS, lookup type 2).
fn kern(first: GlyphId, second: GlyphId) -> f32 {
    let [first, second] = [first, second].map(|glyph| ttf_parser::GlyphId(glyph.0));
    let of_subtable = |subtable| {
        let PositioningSubtable::Pair(pairs) = subtable else { return None };
        let index = pairs.coverage().get(first)?;
        let (adjusted, _) = match pairs {
            PairAdjustment::Format1 { sets, .. } => sets.get(index)?.get(second)?,
            PairAdjustment::Format2 { classes, matrix, .. } => {
                matrix.get((classes.0.get(first), classes.1.get(second)))?
            }
        };
        Some(f32::from(adjusted.x_advance))
    };
    KERNING.iter().filter_map(|lookup| lookup.subtables.into_iter().find_map(of_subtable)).sum()
}

fn text_width(text: &str, size: f64) -> f64 {
    glyphs(text).last().map_or(0.0, |last| f64::from(last.x + last.advance) * size)
}

/// The text in lines of at most this width: broken after a space, `/`, `_` or `-`, and within a word that is wider.
fn lines_of(text: &str, size: f64, most: f64) -> Vec<String> {
    let fits = |line: &str, more: &str| text_width((line.to_owned() + more).trim_end(), size) <= most;
    let mut lines = Vec::new();
    let mut line = String::new();
    for part in text.split_inclusive([' ', '/', '_', '-']) {
        if !line.is_empty() && !fits(&line, part) {
            lines.push(std::mem::take(&mut line));
        }
        for character in part.chars() {
            if !line.is_empty() && !fits(&line, character.encode_utf8(&mut [0; 4])) {
                lines.push(std::mem::take(&mut line));
            }
            line.push(character);
        }
    }
    lines.push(line);
    lines.iter().map(|line| line.trim_end().to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glyphs_follow_one_another_and_pairs_are_kerned() {
        let placed = glyphs("AVAV");
        assert!(placed.iter().map(|glyph| glyph.character).eq("AVAV".chars()), "{placed:?}");
        assert_eq!(glyphs("office").len(), 6, "no ligatures");
        assert!(placed.windows(2).all(|pair| pair[0].x < pair[1].x), "{placed:?}");
        let apart: f32 = placed.iter().map(|glyph| glyph.advance).sum();
        assert!(text_width("AVAV", 1.0) < f64::from(apart) - 0.05, "{placed:?}");
        assert!((text_width("deschaintre18", 10.0) - 10.0 * text_width("deschaintre18", 1.0)).abs() < 1e-9);
    }

    #[test]
    fn lines_break_between_words_and_lose_nothing() {
        for text in ["ours_without_augmentation", "worn tiles / a", "Wwwwwwwwwwwwwwwwwwww", "", "x"] {
            let lines = lines_of(text, 7.0, 40.0);
            assert!(lines.iter().all(|line| text_width(line, 7.0) <= 40.0), "{lines:?}");
            let bare = |text: &str| text.replace(' ', "");
            assert_eq!(bare(&lines.concat()), bare(text));
        }
        assert_eq!(lines_of("ours_without_augmentation", 7.0, 60.0), ["ours_without_", "augmentation"]);
    }
}
