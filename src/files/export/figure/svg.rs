//! A figure as SVG: text is text, in the font of the reader where it has not that of the program, but as wide.

use std::fmt::Write as _;
use std::io;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

use super::layout::{Anchor, Figure, FigurePicture, MILLIMETRE, Text};
use crate::export::encode::{self, Entries};

/// The figure with its metadata as a description.
pub(super) fn text(figure: &Figure, entries: &Entries) -> io::Result<String> {
    let [width, height] = figure.size;
    let [wide, high] = figure.size.map(|side| side / MILLIMETRE);
    let about: String = entries.iter().map(|(key, text)| format!("{key}: {}\n", escaped(text))).collect();
    let mut svg = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{wide:.3}mm" height="{high:.3}mm" viewBox="0 0 {width:.3} {height:.3}" font-family="Ubuntu, Helvetica, Arial, sans-serif" font-weight="300">
<desc>{about}</desc>
<rect width="100%" height="100%" fill="#fff"/>
"##
    );
    for picture in &figure.pictures {
        let FigurePicture { at: [x, y], size: [width, height], .. } = picture;
        let mut file = Vec::new();
        encode::png(&mut file, &picture.printed(), &[])?;
        let data = BASE64_STANDARD.encode(file);
        let _ = writeln!(
            svg,
            r#"<image x="{x:.3}" y="{y:.3}" width="{width:.3}" height="{height:.3}" preserveAspectRatio="none" href="data:image/png;base64,{data}"/>"#
        );
    }
    for text in figure.texts.iter().filter(|text| !text.text.is_empty()) {
        let Text { at: [x, y], text: words, style } = text;
        let anchor = match style.anchor {
            Anchor::Left => "start",
            Anchor::Middle => "middle",
            Anchor::Right => "end",
        };
        let [r, g, b] = style.ink;
        let _ = writeln!(
            svg,
            r##"<text x="{x:.3}" y="{y:.3}" font-size="{:.3}" text-anchor="{anchor}" textLength="{:.3}" lengthAdjust="spacingAndGlyphs" fill="#{r:02x}{g:02x}{b:02x}">{}</text>"##,
            style.size,
            text.width(),
            escaped(words)
        );
    }
    Ok(svg + "</svg>\n")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
