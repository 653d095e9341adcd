//! Photographs: radiance as a camera stores it.

use glam::Vec3;
use rayon::prelude::*;

use svbrdf_core::image::Image;

use super::decode;
use crate::disk::inputs;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::options::{Albedo, transfer};
use crate::read::raster::{Raster, Samples};
use crate::read::record::{Note, Subject};

/// A photograph, turned upright by its EXIF orientation.
#[derive(Clone, Debug, PartialEq)]
pub struct Photograph {
    /// Linear radiance in a unit of its own; NaN where a channel of a pixel is clipped or not finite.
    pub image: Image<f32>,
    /// How the samples encode radiance.
    pub transfer: Albedo,
    /// The source of the transfer curve.
    pub transfer_from: &'static str,
    /// Other things that were noticed.
    pub notes: Vec<Note>,
}

/// Reads the photograph `file`: any picture format that opens as a map, gray or RGB. Of an EXR with several layers, the one without a
/// name is read; alpha is not used. `transfer`: by the file without one, linear for floats and for a PNG that declares itself linear,
/// sRGB for other integers.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`].
pub fn read_photograph(file: &NamedFile, transfer: Option<Albedo>) -> Result<Photograph, Error> {
    let (raster, mut notes) = decode::photograph(file)?;
    inputs::protect(file.path());
    let chunk = |note: &Note| if let Note::LinearChunk(_, chunk) = note { Some(*chunk) } else { None };
    let declared = notes.iter().find_map(chunk);
    let (transfer, transfer_from) = match (transfer, declared) {
        (Some(transfer), _) => (transfer, "as specified"),
        (None, Some("cICP chunk")) => (Albedo::Linear, "declared by its cICP chunk"),
        (None, Some("QOI header")) => (Albedo::Linear, "declared by its header"),
        (None, Some(_)) => (Albedo::Linear, "declared by its gAMA chunk"),
        (None, None) if raster.is_float() => (Albedo::Linear, "since it stores floats"),
        (None, None) => (Albedo::Srgb, "since it stores integers"),
    };
    if transfer == Albedo::Linear {
        notes.retain(|note| chunk(note).is_none());
    }
    let mut image = linear(&raster, transfer);
    if let Some(matrix) = raster.to_rec709 {
        let converted =
            |rgb: &mut [f32; 3]| *rgb = (matrix * Vec3::from(*rgb).as_dvec3()).as_vec3().to_array();
        image.pixels.par_iter_mut().for_each(converted);
        notes.push(Note::Converted(Subject::Photograph));
    }
    Ok(Photograph { image, transfer, transfer_from, notes })
}

fn linear(raster: &Raster, curve: Albedo) -> Image<f32> {
    // A power of a number below 0, which is noise, is NaN.
    let least = if curve == Albedo::Gamma22 { 0.0 } else { f64::NEG_INFINITY };
    let channels = [0, 1, 2].map(|c| &raster.channels[c.min(raster.channels.len() - 1)]);
    let [r, g, b] =
        Samples::decoded_three::<f32>(channels, |value| transfer::linear(value.max(least), curve));
    // Integers are clipped from the largest one on.
    let clip = if raster.is_float() { f64::INFINITY } else { 1.0 };
    let pixel = |index: usize| {
        let is_known = |value: f64| value.is_finite() && value < clip;
        match channels.iter().all(|channel| is_known(channel.at(index))) {
            true => [r[index], g[index], b[index]],
            false => [f32::NAN; 3],
        }
    };
    let pixels = (0..raster.width * raster.height).into_par_iter().map(pixel).collect();
    Image { width: raster.width, height: raster.height, pixels }
}
