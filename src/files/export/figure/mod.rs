//! Figures of texts and pictures, laid out once in points: as PDF and SVG with real text, and as PNG.

mod document;
mod layout;
mod raster;

use std::io::Write as _;
use std::path::Path;

use svbrdf_core::image::Image;
use svbrdf_core::progress::Progress;

pub(super) use layout::MILLIMETRE;
pub use layout::{Anchor, Figure, TextStyle};

use super::encode::Entries;
use crate::disk::atomic::Destination;
use crate::disk::memory;
use crate::error::Error;

impl Figure {
    /// The figure in pixels.
    ///
    /// # Errors
    /// [`Error::Memory`].
    pub fn image(&self) -> Result<Image<u8>, Error> {
        let [width, height] = self.pixels();
        let what = || format!("a figure of {width} x {height} pixels");
        let _reserved = memory::reserve((3 * width * height) as u64, what)?;
        Ok(raster::image(self))
    }
}

impl Destination {
    /// The file of a figure: `.pdf`, `.svg` or `.png`.
    ///
    /// # Errors
    /// As [`Destination::new`].
    pub fn of_figure(path: &Path) -> Result<Self, Error> {
        Self::new(path, &["pdf", "svg", "png"], "extension of a figure", ".pdf, .svg, .png")
    }

    /// Writes a figure with these (keyword, text) entries of metadata. The file appears when it is complete, or not at all.
    ///
    /// # Errors
    /// [`Error::PageTooLarge`], [`Error::Memory`], [`Error::Unwritable`], [`Cancelled`](Error::is_cancelled).
    pub fn write_figure(&self, figure: &Figure, entries: &Entries, progress: &Progress) -> Result<(), Error> {
        if self.is("png") {
            return self.write_png(&figure.image()?, entries, progress);
        }
        if self.is("svg") {
            return self.replace(progress, |file| file.write_all(document::svg(figure, entries)?.as_bytes()));
        }
        if figure.size.iter().any(|side| *side > document::LARGEST) {
            let millimetres = figure.size.map(|side| side / MILLIMETRE);
            return Err(Error::PageTooLarge { millimetres, most: document::LARGEST / MILLIMETRE });
        }
        self.replace(progress, |file| file.write_all(&document::pdf(figure, entries)?))
    }
}

#[cfg(test)]
mod tests {
    use base64::Engine as _;
    use base64::prelude::BASE64_STANDARD;

    use super::*;
    use crate::export::encode;

    const TEXTS: [&str; 3] = ["deschaintre18 & <co>", "AV roughness (\u{2212}0.5)", "x"];

    fn picture() -> Image<u8> {
        let pixels = (0..60u8).map(|i| [i, 255 - i, 7]).collect();
        Image { width: 10, height: 6, pixels }
    }

    fn figure() -> Figure {
        let mut figure = Figure::new([100.0, 50.0], 4.0);
        figure.picture([80.0, 5.0], [2.5, 1.5], picture());
        for (line, text) in (0..).zip(TEXTS) {
            let style = TextStyle { size: 7.0, ink: [10, 20, 30], anchor: Anchor::Left };
            figure.text([2.0, 10.0 * f64::from(line)], 95.0, text, style);
        }
        figure
    }

    #[test]
    fn an_svg_has_its_texts_as_texts_and_its_pixels() {
        let svg = document::svg(&figure(), &[("svbrdf:shows", "a < b".to_owned())]).unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let of = |name: &'static str| document.descendants().filter(move |node| node.has_tag_name(name));
        assert_eq!(of("text").filter_map(|node| node.text()).collect::<Vec<_>>(), TEXTS);
        assert_eq!(of("desc").next().unwrap().text(), Some("svbrdf:shows: a < b\n"));
        let root = document.root_element();
        assert_eq!(
            [root.attribute("width"), root.attribute("viewBox")],
            [Some("35.278mm"), Some("0 0 100.000 50.000")]
        );
        let href = of("image").next().unwrap().attribute("href").unwrap();
        let file = BASE64_STANDARD.decode(href.strip_prefix("data:image/png;base64,").unwrap()).unwrap();
        let read = ::image::load_from_memory(&file).unwrap().to_rgb8();
        assert_eq!(read.as_raw(), picture().pixels.as_flattened());
    }

    /// The bytes of the literal strings between `[` and `] TJ`.
    fn shown(line: &str) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut rest = line.bytes();
        let mut is_within = false;
        while let Some(byte) = rest.next() {
            match byte {
                b'(' if !is_within => is_within = true,
                b')' if is_within => is_within = false,
                b'\\' => bytes.push(match rest.next().unwrap() {
                    b'n' => 10,
                    b'r' => 13,
                    b't' => 9,
                    b'b' => 8,
                    b'f' => 12,
                    digit @ b'0'..=b'7' => {
                        let digits = [digit, rest.next().unwrap(), rest.next().unwrap()];
                        digits.iter().fold(0, |sum, digit| 8 * sum + (digit - b'0'))
                    }
                    other => other,
                }),
                byte if is_within => bytes.push(byte),
                _ => {}
            }
        }
        bytes
    }

    /// The texts of a PDF by its map from codes to characters.
    fn texts_of(pdf: &str) -> Vec<String> {
        let pairs =
            pdf.lines().filter_map(|line| line.strip_prefix('<')?.strip_suffix('>')?.split_once("> <"));
        let number = |digits: &str| u16::from_str_radix(digits, 16).unwrap();
        let map: std::collections::HashMap<u16, char> = pairs
            .filter(|(code, character)| code.len() == 4 && character.len() == 4)
            .map(|(code, character)| (number(code), char::from_u32(number(character).into()).unwrap()))
            .collect();
        let lines = pdf.lines().filter(|line| line.ends_with(" TJ"));
        let text = |line: &str| {
            shown(line).chunks(2).map(|code| map[&u16::from_be_bytes([code[0], code[1]])]).collect()
        };
        lines.map(text).collect()
    }

    #[test]
    fn a_pdf_has_its_texts_as_texts_and_its_pixels() {
        let bytes = document::pdf(&figure(), &[]).unwrap();
        let pdf: String = bytes.iter().copied().map(char::from).collect();
        assert_eq!(texts_of(&pdf), TEXTS);
        assert!(pdf.contains("/MediaBox [0 0 100 50]") && pdf.contains("/FontFile2"), "{}", pdf.len());
        // A subset of the font, and the compressed data of a PNG.
        assert!(bytes.len() < 40_000, "{} bytes", bytes.len());
        let mut file = Vec::new();
        encode::png(&mut file, &picture(), &[]).unwrap();
        let data: String = encode::compressed(&file).into_iter().map(char::from).collect();
        assert!(data.len() > 20 && pdf.contains(&data) && pdf.contains("/Predictor 15"));
        let wrong = pdf.replacen("> <0064>", "> <0065>", 1);
        assert_ne!(texts_of(&wrong), TEXTS, "a planted fault: d is called e");
    }

    #[test]
    fn a_page_that_no_program_opens_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, height: f64| {
            let path = folder.path().join(name);
            let figure = Figure::new([10.0, height], 0.1);
            Destination::of_figure(&path).unwrap().write_figure(&figure, &[], &Progress::default())
        };
        assert!(write("a.pdf", 14_400.0).is_ok() && write("a.svg", 14_500.0).is_ok());
        let problem = write("b.pdf", 14_500.0).unwrap_err().to_string();
        assert!(problem.contains("4 x 5115 mm") && problem.contains("5080 mm"), "{problem}");
    }

    #[test]
    fn pixels_are_those_of_pictures_and_texts() {
        let figure = figure();
        let image = figure.image().unwrap();
        assert_eq!([image.width, image.height], [400, 200]);
        let at = |x: usize, y: usize| image.pixels[y * image.width + x];
        for (i, pixel) in picture().pixels.iter().enumerate() {
            assert_eq!(at(320 + i % 10, 20 + i / 10), *pixel, "{i}");
        }
        let ink = |left: usize, right: usize| {
            (0..image.height).any(|y| (left..right).any(|x| at(x, y) != [255; 3]))
        };
        let end = (4.0 * (2.0 + Figure::text_width(TEXTS[0], 7.0))).ceil() as usize;
        assert!(ink(8, 20) && ink(end - 20, end) && !ink(0, 7) && !ink(end + 1, 320), "{end}");
        // Glyphs stand between pixels: a shift by half a pixel is another picture, and by a whole one the same.
        let shifted = |x: f64| {
            let mut figure = Figure::new([40.0, 12.0], 4.0);
            let style = TextStyle { size: 7.0, ink: [0; 3], anchor: Anchor::Left };
            figure.text([x, 1.0], 40.0, "iii", style);
            figure.image().unwrap()
        };
        let columns = |image: &Image<u8>, by: usize| {
            image.pixels.chunks(image.width).flat_map(|row| row[by..by + 100].to_vec()).collect::<Vec<_>>()
        };
        assert_eq!(columns(&shifted(2.0), 0), columns(&shifted(2.25), 1));
        assert_ne!(columns(&shifted(2.0), 0), columns(&shifted(2.125), 0));
    }
}
