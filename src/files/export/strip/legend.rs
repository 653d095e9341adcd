//! The scale bar of a difference: its colours with their numbers and unit.

use svbrdf_core::image::Image;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent};
use svbrdf_core::picture::quantity::Quantity;

use super::column::{INK, SMALL};
use super::sheet::put;
use crate::error::Error;
use crate::export::text::{self, Anchor};

/// Pixels of a tick below the bar, and from the bar to its numbers and its unit.
const TICK: usize = 4;
const TO_NUMBERS: usize = 12;
const TO_UNIT: usize = 10;
/// Widths of a bar that has room for a number between its ends, and for three.
const WITH_MIDDLE: usize = 120;
const WITH_QUARTERS: usize = 240;

/// Draws the scale bar in the middle of a cell.
pub(super) fn draw(
    picture: &mut Image<u8>,
    [left, top]: [usize; 2],
    [width, height]: [usize; 2],
    difference: ColouredDifference,
) -> Result<(), Error> {
    let range = difference.range.unwrap_or_else(|| difference.kind.default_range());
    let lowest = if difference.kind.is_signed() { -range } else { 0.0 };
    let content = PictureContent { quantity: Quantity::Rendering, difference: Some(difference) };
    let bar = [(width * 4 / 5).max(1), (height / 12).clamp(1, 16)];
    let colour = |x: usize| {
        let amount = lowest + (range - lowest) * (x as f64 + 0.5) / bar[0] as f64;
        content.colour([amount as f32; 3], 0.0)
    };
    let [x, y] = [left + width / 10, top + height / 2];
    let pixels = (0..bar[1]).flat_map(|_| (0..bar[0]).map(colour)).collect();
    put(picture, [x, y], &Image { width: bar[0], height: bar[1], pixels });
    let parts = match bar[0] {
        WITH_QUARTERS.. => 4,
        WITH_MIDDLE.. => 2,
        _ => 1,
    };
    for part in 0..=parts {
        let at = x + (bar[0] - 1) * part / parts;
        let tick = Image { width: 1, height: TICK, pixels: vec![INK; TICK] };
        put(picture, [at, y + bar[1]], &tick);
        let value = lowest + (range - lowest) * part as f64 / parts as f64;
        let anchor = match part {
            0 => Anchor::Left,
            _ if part == parts => Anchor::Right,
            _ => Anchor::Middle,
        };
        text::draw(picture, &number(value, range), [at, y + bar[1] + TO_NUMBERS], SMALL, INK, anchor)?;
    }
    text::draw(picture, difference.kind.unit(), [x, y.saturating_sub(TO_UNIT)], SMALL, INK, Anchor::Left)
}

/// A value of a scale up to `range`, in three digits of that, without zeros at the end.
fn number(value: f64, range: f64) -> String {
    let decimals = (2.0 - range.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    let short = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if short == "-0" { "0".to_owned() } else { short.replace('-', "\u{2212}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_of_the_range() {
        let cases = [
            (2.0, 2.0, "2"),
            (0.5, 2.0, "0.5"),
            (0.0, 2.0, "0"),
            (-1.0, 1.0, "\u{2212}1"),
            (0.995_37, 0.995_37, "0.995"),
            (0.012_345, 0.012_345, "0.0123"),
            (33.75, 45.0, "33.8"),
            (1234.5, 1234.5, "1234"),
            (-0.0, 1.0, "0"),
        ];
        for (value, range, expected) in cases {
            assert_eq!(number(value, range), expected, "{value} of {range}");
        }
    }
}
