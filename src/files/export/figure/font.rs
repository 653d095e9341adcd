//! The font of figures: where its glyphs stand, and how texts break into lines.

use std::sync::LazyLock;

use ab_glyph::{Font as _, FontRef, GlyphId};
use epaint_default_fonts::UBUNTU_LIGHT;
use harfrust::{Feature, GlyphInfo, GlyphPosition, ShapeOptions, ShaperData, Tag, UnicodeBuffer};

/// The file of the font.
pub(super) const FILE: &[u8] = UBUNTU_LIGHT;
/// The font; `None` where the file is damaged, which a test excludes.
pub(super) static FONT: LazyLock<Option<FontRef<'static>>> =
    LazyLock::new(|| FontRef::try_from_slice(FILE).ok());

/// The same font for shaping, with its kerning and marks.
static SHAPING: LazyLock<Option<(harfrust::FontRef<'static>, ShaperData)>> = LazyLock::new(|| {
    let font = harfrust::FontRef::from_index(FILE, 0).ok()?;
    Some((font.clone(), ShaperData::new(&font)))
});

/// A glyph of a text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<'a> {
    pub id: GlyphId,
    /// The characters that it shows: none where another glyph shows them.
    pub characters: &'a str,
    /// From the beginning of the text, in ems.
    pub x: f32,
    /// Of the glyph alone, without kerning, in ems.
    pub advance: f32,
}

/// The glyphs of a text, kerned; each letter has its own.
pub(super) fn glyphs(text: &str) -> Vec<Placed<'_>> {
    let Some((font, (shaping, data))) = FONT.as_ref().zip(SHAPING.as_ref()) else { return Vec::new() };
    let mut buffer = UnicodeBuffer::new();
    buffer.push_str(text);
    buffer.guess_segment_properties();
    let no_ligatures = [*b"liga", *b"clig"].map(|tag| Feature::new(Tag::new(&tag), 0, ..));
    let shaped = data.shaper(shaping).build().shape(buffer, ShapeOptions::new().features(&no_ligatures));
    let em = font.units_per_em().unwrap_or(1000.0);
    let mut starts: Vec<usize> = shaped.glyph_infos().iter().map(|info| info.cluster as usize).collect();
    starts.sort_unstable();
    let (mut x, mut last) = (0.0, None);
    let place = |(info, position): (&GlyphInfo, &GlyphPosition)| {
        let id = GlyphId(info.glyph_id as u16);
        let start = info.cluster as usize;
        let end = starts.iter().copied().find(|other| *other > start).unwrap_or(text.len());
        let characters = if last.replace(start) == Some(start) { "" } else { &text[start..end] };
        let at = x + position.x_offset as f32 / em;
        x += position.x_advance as f32 / em;
        Placed { id, characters, x: at, advance: font.h_advance_unscaled(id) / em }
    };
    shaped.glyph_infos().iter().zip(shaped.glyph_positions()).map(place).collect()
}

/// The width of a text of this size, in its unit.
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
        let characters: Vec<&str> = placed.iter().map(|glyph| glyph.characters).collect();
        assert_eq!(characters, ["A", "V", "A", "V"]);
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
