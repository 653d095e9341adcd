//! Text in pictures.

use std::sync::Once;

use epaint_default_fonts::UBUNTU_LIGHT;
use plotters::prelude::{BitMapBackend, IntoDrawingArea, IntoFont, RGBColor, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, TextStyle, register_font};

use svbrdf_core::image::Image;

use crate::error::Error;

/// The family name of the font.
const FONT: &str = "sans-serif";

/// Which part of the text is at the point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Left,
    Middle,
    Right,
}

fn install() {
    static ONCE: Once = Once::new();
    // It is a font: it is built in.
    ONCE.call_once(|| drop(register_font(FONT, FontStyle::Normal, UBUNTU_LIGHT)));
}

/// The width of a text, in pixels.
pub(super) fn width(text: &str, height: u32) -> usize {
    install();
    let size = (FONT, height).into_font().box_size(text);
    size.map_or(text.chars().count() * height as usize / 2, |(width, _)| width as usize)
}

/// Draws a text of this height, vertically centred at a point.
pub(super) fn draw(
    picture: &mut Image<u8>,
    text: &str,
    [x, y]: [usize; 2],
    height: u32,
    [r, g, b]: [u8; 3],
    anchor: Anchor,
) -> Result<(), Error> {
    install();
    let failed = |problem: String| Error::Internal(format!("text cannot be drawn: {problem}"));
    let size = (picture.width as u32, picture.height as u32);
    let area = BitMapBackend::with_buffer(picture.pixels.as_flattened_mut(), size).into_drawing_area();
    let side = match anchor {
        Anchor::Left => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::Right => HPos::Right,
    };
    let ink = RGBColor(r, g, b);
    let style = TextStyle::from((FONT, height).into_font()).color(&ink).pos(Pos::new(side, VPos::Center));
    area.draw(&Text::new(text.to_owned(), (x as i32, y as i32), style)).map_err(|e| failed(e.to_string()))?;
    area.present().map_err(|e| failed(e.to_string()))
}
