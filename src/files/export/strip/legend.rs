//! Texts and scale bars beside the cells: what a column shows, and the colours of a difference with their numbers and unit.

use svbrdf_core::image::Image;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::content::{ColouredDifference, PictureContent};
use svbrdf_core::picture::quantity::Quantity;

use super::sheet::{INK, SMALL, style};
use crate::export::figure::{Anchor, Figure};

/// A column: what it shows, and under which light and view.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub content: PictureContent,
    pub scene: Scene,
}

impl Column {
    /// What it shows, for metadata.
    pub(super) fn text(&self, epsilon: f64) -> String {
        match self.scene() {
            Some(scene) => format!("{}, {}", self.content.text(epsilon), scene_text(scene)),
            None => self.content.text(epsilon),
        }
    }

    pub(super) fn name(&self) -> String {
        content_name(&self.content)
    }

    /// The scene of a rendering.
    pub(super) fn scene(&self) -> Option<&Scene> {
        (self.content.quantity == Quantity::Rendering).then_some(&self.scene)
    }
}

pub(super) fn content_name(content: &PictureContent) -> String {
    let quantity = content.quantity.name();
    match content.difference {
        Some(difference) if content.quantity == Quantity::Rendering => difference.kind.name().to_owned(),
        Some(difference) => format!("{quantity}, {}", difference.kind.name()),
        None => quantity.to_owned(),
    }
}

pub(super) fn scene_text(scene: &Scene) -> String {
    let kind = match scene.kind {
        Kind::Near => "light",
        Kind::Distant => "distant light",
    };
    let number = |x: f64| (1000.0 * x).round() / 1000.0 + 0.0;
    let point = |p: [f64; 3]| p.map(|x| number(x).to_string()).join(", ");
    format!("{kind} {}; view {}", point(scene.light), point(scene.view))
}

pub(super) fn stops(ev: f32) -> String {
    format!("exposure {}{ev} EV", if ev > 0.0 { "+" } else { "" })
}

const COLOURS: usize = 256;
/// Height of the bar and of its ticks, and width of a tick, in ems.
const BAR: f64 = 0.9;
const TICK: [f64; 2] = [0.06, 0.25];
/// Height of a line of its texts, in ems.
const LINE: f64 = 1.2 * SMALL;
/// From the middle of a number to that of the next one, in ems, at least.
const APART: f64 = 3.0;

/// The height of a scale bar with its texts, in ems.
pub(super) const HEIGHT: f64 = 2.0 * LINE + BAR + TICK[1] + 0.3;

/// Draws a scale bar of a width in points, below `top`, for texts of `em` points.
pub(super) fn draw(
    figure: &mut Figure,
    [left, top]: [f64; 2],
    width: f64,
    em: f64,
    difference: ColouredDifference,
) {
    let range = difference.range.unwrap_or_else(|| difference.kind.default_range());
    let lowest = if difference.kind.is_signed() { -range } else { 0.0 };
    let content = PictureContent { quantity: Quantity::Rendering, difference: Some(difference) };
    let colour = |place: usize| {
        let amount = lowest + (range - lowest) * (place as f64 + 0.5) / COLOURS as f64;
        content.colour([amount as f32; 3], 0.0)
    };
    let unit = difference.kind.unit().replace(" - ", " \u{2212} ");
    figure.text([left, top], f64::INFINITY, &unit, style(SMALL * em, Anchor::Left));
    let top = top + (LINE + 0.15) * em;
    let bar = Image { width: COLOURS, height: 1, pixels: (0..COLOURS).map(colour).collect() };
    figure.picture([left, top], [width, BAR * em], bar);
    let [wide, high] = TICK.map(|side| side * em);
    let below = top + BAR * em;
    for value in ticks(lowest, range, (width / (APART * em)) as usize) {
        let share = (value - lowest) / (range - lowest);
        let x = left + share * width;
        let tick = Image { width: 1, height: 1, pixels: vec![INK] };
        figure.picture([left + share * (width - wide), below], [wide, high], tick);
        let anchor = match share {
            0.0 => Anchor::Left,
            1.0 => Anchor::Right,
            _ => Anchor::Middle,
        };
        let number = number(value);
        figure.text([x, below + high], f64::INFINITY, &number, style(SMALL * em, anchor));
    }
}

/// The numbers below a bar from `lowest` to `highest`, with at most `most` intervals between them: round ones and both ends.
fn ticks(lowest: f64, highest: f64, most: usize) -> Vec<f64> {
    let length = highest - lowest;
    let is_round = |step: f64| {
        let digit = step / 10f64.powi(step.log10().floor() as i32 - 1);
        (digit - digit.round()).abs() < 1e-9
    };
    let parts = if lowest < 0.0 { [4, 2].as_slice() } else { &[4, 5, 3, 2] };
    let equal = parts.iter().copied().find(|parts| *parts <= most && is_round(length / *parts as f64));
    if let Some(parts) = equal {
        return (0..=parts).map(|part| lowest + length * part as f64 / parts as f64).collect();
    }
    let middle = Some(0.0).filter(|_| lowest < 0.0 && most >= 2);
    [Some(lowest), middle, Some(highest)].into_iter().flatten().collect()
}

/// A number of a scale in three significant digits, without zeros at the end.
fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let decimals = (2.0 - value.abs().log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    let short = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    short.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_at_both_ends() {
        let texts =
            |lowest, highest, most| ticks(lowest, highest, most).into_iter().map(number).collect::<Vec<_>>();
        assert_eq!(texts(0.0, 45.0, 4), ["0", "15", "30", "45"]);
        assert_eq!(texts(0.0, 2.0, 4), ["0", "0.5", "1", "1.5", "2"]);
        assert_eq!(texts(0.0, 1.0, 4), ["0", "0.25", "0.5", "0.75", "1"]);
        assert_eq!(texts(0.0, 1.0, 2), ["0", "0.5", "1"]);
        assert_eq!(texts(0.0, 2.0, 1), ["0", "2"]);
        assert_eq!(texts(-2.0, 2.0, 4), ["\u{2212}2", "\u{2212}1", "0", "1", "2"]);
        assert_eq!(texts(0.0, 0.995_37, 4), ["0", "0.995"]);
        assert_eq!(texts(-0.995_37, 0.995_37, 4), ["\u{2212}0.995", "0", "0.995"]);
        assert_eq!(texts(0.0, 0.012_345, 4), ["0", "0.0123"]);
        assert_eq!(texts(0.0, 1234.5, 4), ["0", "1234"]);
    }
}
