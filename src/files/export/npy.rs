//! NumPy files: pictures as one array.

use std::io::{BufWriter, Write};
use std::path::Path;

use svbrdf_core::image::Image;
use svbrdf_core::progress::Progress;

use crate::disk::atomic::{check_place, replace_own};
use crate::error::Error;
use crate::npy::Header;

/// Writes pictures of one size into a file of NumPy, which is named by the program: number x height x width x 3, 32-bit floats. It
/// appears when it is complete, or not at all.
///
/// # Errors
/// [`Error::Unwritable`], [`Cancelled`](Error::is_cancelled).
pub fn write_npy(path: &Path, pictures: &[Image<f32>], progress: &Progress) -> Result<(), Error> {
    check_place(path)?;
    let [width, height] = pictures.first().map_or([0; 2], |picture| [picture.width, picture.height]);
    let shape = [pictures.len(), height, width, 3];
    replace_own(path, progress, |file| {
        let mut file = BufWriter::new(file);
        file.write_all(&Header::of_floats(&shape))?;
        for value in pictures.iter().flat_map(|picture| picture.pixels.as_flattened()) {
            file.write_all(&value.to_le_bytes())?;
        }
        file.flush()
    })
}
