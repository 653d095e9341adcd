//! NumPy files: pictures as one array.

use std::io;
use std::path::Path;

use npyz::WriterBuilder;

use svbrdf_core::error::Error;
use svbrdf_core::image::Image;
use svbrdf_core::progress::Progress;

use crate::atomic::{check_place, replace};

/// Writes pictures of one size into a file of NumPy: number x height x width x 3, 32-bit floats. It appears when it is complete,
/// or not at all.
///
/// # Errors
/// [`Error::Unwritable`], [`Error::Cancelled`].
pub fn write_npy(path: &Path, pictures: &[Image<f32>], progress: &Progress) -> Result<(), Error> {
    check_place(path)?;
    let [width, height] = pictures.first().map_or([0; 2], |picture| [picture.width, picture.height]);
    let shape = [pictures.len(), height, width, 3].map(|count| count as u64);
    replace(path, progress, |file| {
        let options = npyz::WriteOptions::<f32>::new().default_dtype().shape(&shape);
        let mut array = options.writer(file).begin_nd().map_err(io::Error::other)?;
        for picture in pictures {
            array.extend(picture.pixels.iter().flatten().copied())?;
        }
        array.finish()
    })
}
