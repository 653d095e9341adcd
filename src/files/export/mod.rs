//! Renderings as files: floats into EXR, display values into PNG, both with their provenance.

mod encode;
pub mod figure;
pub mod strip;

use std::path::Path;

pub use crate::disk::atomic::{Destination, check_place, write_text};
pub use encode::{Entries, Provenance};

use svbrdf_core::image::Image;
use svbrdf_core::picture::colour_map::heat;
use svbrdf_core::progress::Progress;

use crate::error::Error;

/// Texels between two panes of a picture.
pub const GAP: usize = 4;
/// Largest width of a row of panes, in texels: many programs open no wider picture.
const WIDEST: usize = 16_384;
/// The colour of the gap of a PNG.
const MID_GRAY: [u8; 3] = [128; 3];

impl Destination {
    /// The file of a picture: `.exr` for linear radiance as 32-bit floats, `.png` for 8 bits, exposed and sRGB-encoded.
    ///
    /// # Errors
    /// As [`Destination::new`].
    pub fn of_picture(path: &Path) -> Result<Self, Error> {
        let known = ".exr (linear floats), .png (8 bits for a screen)";
        Self::new(path, &["exr", "png"], "extension of an output file", known)
    }

    /// Writes `panes`, which are equally high, side by side, or in rows where one would be wider than 16,384 texels, with a text about
    /// the content that takes the place of the one of `provenance`. The file appears when it is complete, or not at all.
    ///
    /// # Errors
    /// [`Error::Unwritable`], [`Cancelled`](Error::is_cancelled), [`Error::Internal`].
    pub fn write_picture(
        &self,
        panes: &[Image<f32>],
        provenance: &Provenance,
        shows: Option<String>,
        progress: &Progress,
    ) -> Result<(), Error> {
        let colour = |rgb| provenance.content.colour(rgb, provenance.session.exposure);
        self.write_as(panes, colour, &provenance.entries(self.path(), shows)?, progress)
    }

    /// Writes maps of numbers, which are equally high, side by side: an EXR has the numbers, a PNG the colours of the means of
    /// the channels from 0 to `full`, and gray where there is no number.
    ///
    /// # Errors
    /// [`Error::Unwritable`], [`Cancelled`](Error::is_cancelled).
    pub fn write_maps(
        &self,
        panes: &[Image<f32>],
        full: f32,
        entries: &Entries,
        progress: &Progress,
    ) -> Result<(), Error> {
        let colour = |rgb: [f32; 3]| match rgb.iter().sum::<f32>() / 3.0 / full {
            share if share.is_nan() => MID_GRAY,
            share => heat(share).map(|c| (c * 255.0 + 0.5).floor() as u8),
        };
        self.write_as(panes, colour, entries, progress)
    }

    fn write_as(
        &self,
        panes: &[Image<f32>],
        colour: impl Fn([f32; 3]) -> [u8; 3],
        entries: &Entries,
        progress: &Progress,
    ) -> Result<(), Error> {
        if self.is("exr") {
            let picture = arranged(panes, [0.0; 3]);
            return self.replace(progress, |file| encode::exr(file, picture, entries));
        }
        let pictures: Vec<_> = panes.iter().map(|p| displayed(p, &colour)).collect();
        self.write_png(&arranged(&pictures, MID_GRAY), entries, progress)
    }

    /// Writes a PNG of a whole picture with these (keyword, text) entries of metadata. The file appears when it is complete, or not at
    /// all.
    ///
    /// # Errors
    /// [`Error::Unwritable`], [`Cancelled`](Error::is_cancelled).
    pub fn write_png(
        &self,
        picture: &Image<u8>,
        entries: &Entries,
        progress: &Progress,
    ) -> Result<(), Error> {
        self.replace(progress, |file| encode::png(file, picture, entries))
    }
}

/// Arranges `panes` from left to right, [`GAP`] texels of `gap` between them, cut to the least height. Where one row would be
/// wider than [`WIDEST`], there are several rows with the same number of panes, but for the last.
fn arranged<T: Copy>(panes: &[Image<T>], gap: [T; 3]) -> Image<T> {
    let height = panes.iter().map(|p| p.height).min().unwrap_or(0);
    let row_width = |row: &[Image<T>]| {
        row.iter().map(|pane| pane.width).sum::<usize>() + GAP * row.len().saturating_sub(1)
    };
    let widest = panes.iter().map(|pane| pane.width).max().unwrap_or(0);
    let most = ((WIDEST + GAP) / (widest + GAP)).max(1);
    let rows = panes.len().div_ceil(most).max(1);
    let columns = panes.len().div_ceil(rows).max(1);
    let width = panes.chunks(columns).map(row_width).max().unwrap_or(0);
    let mut pixels = Vec::with_capacity(width * (height + GAP) * rows);
    for (number, row) in panes.chunks(columns).enumerate() {
        pixels.extend(std::iter::repeat_n(gap, if number > 0 { GAP * width } else { 0 }));
        for line in 0..height {
            for (i, pane) in row.iter().enumerate() {
                pixels.extend(std::iter::repeat_n(gap, if i > 0 { GAP } else { 0 }));
                pixels.extend_from_slice(&pane.pixels[line * pane.width..][..pane.width]);
            }
            pixels.extend(std::iter::repeat_n(gap, width - row_width(row)));
        }
    }
    Image { width, height: pixels.len().checked_div(width).unwrap_or(0), pixels }
}

fn displayed(image: &Image<f32>, colour: impl Fn([f32; 3]) -> [u8; 3]) -> Image<u8> {
    let pixels = image.pixels.iter().map(|&rgb| colour(rgb)).collect();
    Image { width: image.width, height: image.height, pixels }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panes_stand_side_by_side_with_a_gap() {
        let pane = |width, value| Image { width, height: 2, pixels: vec![[value; 3]; 2 * width] };
        let picture = arranged(&[pane(1, 1), pane(2, 2)], [9u8; 3]);
        let row = [1, 9, 9, 9, 9, 2, 2].map(|v| [v; 3]);
        assert_eq!((picture.width, picture.height), (7, 2));
        assert_eq!(picture.pixels, [row, row].concat());
    }

    #[test]
    fn many_panes_stand_in_rows() {
        let pane = |value| Image { width: 4096, height: 2, pixels: vec![[value; 3]; 2 * 4096] };
        let three = arranged(&[pane(1), pane(2), pane(3)], [9u8; 3]);
        assert_eq!((three.width, three.height), (3 * 4096 + 2 * GAP, 2));
        let panes: Vec<_> = (1..=7).map(pane).collect();
        let picture = arranged(&panes, [9u8; 3]);
        // Four of them, with gaps, are wider than a picture may be.
        assert_eq!((picture.width, picture.height), (3 * 4096 + 2 * GAP, 3 * 2 + 2 * GAP));
        assert_eq!(picture.pixels.len(), picture.width * picture.height);
        for (index, value) in (0..7).zip(1u8..) {
            let (column, row) = (index % 3, index / 3);
            let at = (row * (2 + GAP) + 1) * picture.width + column * (4096 + GAP);
            assert_eq!([picture.pixels[at], picture.pixels[at + 4095]], [[value; 3]; 2], "{index}");
        }
        assert_eq!(picture.pixels[2 * picture.width], [9; 3], "between the rows");
        assert_eq!(picture.pixels.last(), Some(&[9; 3]), "beside the last row");
    }
}
