//! The font of figures: where its glyphs stand, and how texts break into lines.

use std::sync::LazyLock;

use ab_glyph::{Font as _, FontRef, GlyphId};
use epaint_default_fonts::UBUNTU_LIGHT;
use ttf_parser::Face;
use ttf_parser::gpos::{PairAdjustment, PositioningSubtable};
use ttf_parser::opentype_layout::{LayoutTable, Lookup};

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

pub(super) fn width(text: &str, size: f64) -> f64 {
    glyphs(text).last().map_or(0.0, |last| f64::from(last.x + last.advance) * size)
}

/// The text in lines of at most this width: broken after a space, `/`, `_` or `-`, and within a word that is wider.
pub(super) fn lines(text: &str, size: f64, most: f64) -> Vec<String> {
    let fits = |line: &str, more: &str| width((line.to_owned() + more).trim_end(), size) <= most;
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
        assert!(width("AVAV", 1.0) < f64::from(apart) - 0.05, "{placed:?}");
        assert!((width("deschaintre18", 10.0) - 10.0 * width("deschaintre18", 1.0)).abs() < 1e-9);
    }

    #[test]
    fn lines_break_between_words_and_lose_nothing() {
        for text in ["ours_without_augmentation", "worn tiles / a", "Wwwwwwwwwwwwwwwwwwww", "", "x"] {
            let lines = lines(text, 7.0, 40.0);
            assert!(lines.iter().all(|line| width(line, 7.0) <= 40.0), "{lines:?}");
            let bare = |text: &str| text.replace(' ', "");
            assert_eq!(bare(&lines.concat()), bare(text));
        }
        assert_eq!(lines("ours_without_augmentation", 7.0, 60.0), ["ours_without_", "augmentation"]);
    }
}
