//! Filmstrip of a capture: its photographs as thumbnails, all in one picture.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use svbrdf_core::image::Image;
use svbrdf_core::picture::tone::to_display;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::photograph::Rectified;
use svbrdf_files::photograph::{Capture, CapturedPhotograph};

use super::picture::exposure;
use crate::error::Error;
use crate::jobs::work::picture::Picture;

/// Side of a thumbnail, in pixels.
const SIDE: usize = 96;
/// Thumbnails in a row of the texture.
const COLUMNS: usize = 16;
/// Photographs that have a thumbnail.
const MOST: usize = 128;

/// The photographs of a capture.
#[derive(Debug)]
pub struct Filmstrip {
    pub capture: Capture,
    pub picture: Arc<Picture>,
    /// Why one of the first photographs, which have thumbnails, cannot be read.
    problems: Vec<Option<String>>,
    /// The absolute paths of the photographs.
    paths: Vec<PathBuf>,
    /// The number of photographs outside of the folder of the capture.
    pub outside: usize,
}

impl Filmstrip {
    /// The number of photographs.
    pub fn count(&self) -> usize {
        self.capture.photographs.len()
    }

    /// The index of the photograph at `path`.
    pub fn position(&self, path: &Path) -> Option<usize> {
        let path = absolute(path);
        self.paths.iter().position(|one| *one == path)
    }

    /// Why the photograph at this index has no thumbnail, where it cannot be read.
    pub fn problem(&self, index: usize) -> Option<&str> {
        self.problems.get(index)?.as_deref()
    }

    /// The part of the picture that is the thumbnail at this index: least and greatest x and y, as shares of its sides.
    pub fn part(&self, index: usize) -> Option<[[f32; 2]; 2]> {
        let rows = self.problems.len().div_ceil(COLUMNS).max(1);
        let size = [1.0 / COLUMNS as f32, 1.0 / rows as f32];
        let least = [(index % COLUMNS) as f32 * size[0], (index / COLUMNS) as f32 * size[1]];
        let is_drawn = self.problems.get(index).is_some_and(Option::is_none);
        is_drawn.then_some([least, [least[0] + size[0], least[1] + size[1]]])
    }
}

/// Reads the capture that the file or folder `path` describes and its photographs, one step of `progress` each. All thumbnails
/// have one exposure: a darker photograph is darker.
///
/// # Errors
/// As [`Capture::read`], and [`Cancelled`](Error::is_cancelled). A photograph that cannot be read has no thumbnail.
pub fn read(path: &Path, progress: &Progress) -> Result<Filmstrip, Error> {
    let capture = Capture::read(path)?;
    let count = capture.photographs.len().min(MOST);
    progress.begin(count as u64);
    let mut images = Vec::new();
    for one in &capture.photographs[..count] {
        images.push(thumbnail(one, progress).map_err(|error| error.to_string()));
        progress.step()?;
    }
    let pixels = images
        .iter()
        .flatten()
        .flat_map(|image: &Image<f32>| image.pixels.iter().copied())
        .collect::<Vec<_>>();
    let ev = exposure(&Image { width: pixels.len(), height: 1, pixels });
    Ok(Filmstrip {
        picture: Arc::new(atlas(&images, ev)),
        problems: images.into_iter().map(Result::err).collect(),
        paths: capture.photographs.iter().map(|one| absolute(one.file.path())).collect(),
        outside: capture.outside().len(),
        capture,
    })
}

fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// The material in a photograph; clipped pixels are white.
fn thumbnail(one: &CapturedPhotograph, progress: &Progress) -> Result<Image<f32>, Error> {
    let (mut photograph, corners) = one.read()?;
    photograph.clipped.fill(false);
    Ok(Rectified::new(&photograph, &corners, [SIDE; 2], &progress.part())?.image)
}

fn atlas(images: &[Result<Image<f32>, String>], ev: f32) -> Picture {
    let rows = images.len().div_ceil(COLUMNS).max(1);
    let size = [COLUMNS * SIDE, rows * SIDE];
    let mut picture = Picture { size, pixels: vec![Picture::TRANSPARENT; size[0] * size[1]] };
    for (index, image) in images.iter().enumerate() {
        let [left, top] = [index % COLUMNS * SIDE, index / COLUMNS * SIDE];
        for (at, pixel) in image.iter().flat_map(|image| &image.pixels).enumerate() {
            let place = (top + at / SIDE) * size[0] + left + at % SIDE;
            picture.pixels[place] = Picture::opaque(to_display(*pixel, ev));
        }
    }
    picture
}
