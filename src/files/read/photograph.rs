//! Photographs: radiance as a camera stores it.

use std::path::Path;

use glam::Vec3;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use svbrdf_core::choices;
use svbrdf_core::image::Image;

use super::decode;
use crate::disk::inputs;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::options::{Albedo, transfer};
use crate::read::raster::{Raster, Samples};
use crate::read::record::{Note, Subject};

choices! {
    /// How the samples of a photograph encode radiance.
    #[derive(JsonSchema)]
    Transfer, "transfer curve":
    /// Samples are proportional to radiance.
    Linear = "linear",
    /// The curve of IEC 61966-2-1.
    Srgb = "srgb",
    /// A power of 2.2.
    Gamma22 = "gamma2.2",
}

/// How a photograph is read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct PhotographOptions {
    /// `None`: linear for floats and for a PNG that declares itself linear, sRGB for other integers.
    pub transfer: Option<Transfer>,
    /// The stored value from which on a pixel is clipped, where 1 is the largest integer. `None`: 1 for integers; floats
    /// are never clipped.
    pub clip: Option<f64>,
    /// Red, green and blue of the light, each above 0, which are divided out. `None`: the light is white.
    pub light_colour: Option<[f64; 3]>,
}

/// A photograph, turned upright by its EXIF orientation.
#[derive(Clone, Debug, PartialEq)]
pub struct Photograph {
    /// Linear radiance in a unit of its own; 0 where a stored sample is not finite.
    pub image: Image<f32>,
    /// Of each pixel, whether a channel of it is clipped or not finite.
    pub clipped: Vec<bool>,
    pub transfer: Transfer,
    /// The source of the transfer curve.
    pub transfer_from: &'static str,
    /// Other things that were noticed.
    pub notes: Vec<Note>,
}

impl Transfer {
    /// The name in texts.
    pub fn label(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Srgb => "sRGB",
            Self::Gamma22 => "gamma 2.2",
        }
    }

    fn curve(self) -> Albedo {
        match self {
            Self::Linear => Albedo::Linear,
            Self::Srgb => Albedo::Srgb,
            Self::Gamma22 => Albedo::Gamma22,
        }
    }
}

impl Photograph {
    /// (width, height) in pixels.
    pub fn size(&self) -> [usize; 2] {
        [self.image.width, self.image.height]
    }
}

/// Reads the photograph at `path`: any picture format that opens as a map, gray or RGB. Of an EXR with several layers, the one
/// without a name is read; alpha is not used.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`].
pub fn read_photograph(path: &Path, options: &PhotographOptions) -> Result<Photograph, Error> {
    read_named_photograph(&NamedFile::by_user(path), options)
}

/// Reads the photograph `file`, as [`read_photograph`].
pub fn read_named_photograph(file: &NamedFile, options: &PhotographOptions) -> Result<Photograph, Error> {
    let (raster, mut notes) = decode::photograph(file)?;
    inputs::protect(file.path());
    let chunk = |note: &Note| if let Note::LinearChunk(_, chunk) = note { Some(*chunk) } else { None };
    let declared = notes.iter().find_map(chunk);
    let (transfer, transfer_from) = match options.transfer {
        Some(transfer) => (transfer, "as specified"),
        None if declared == Some("cICP") => (Transfer::Linear, "declared by its cICP chunk"),
        None if declared.is_some() => (Transfer::Linear, "declared by its gAMA chunk"),
        None if raster.is_float() => (Transfer::Linear, "since it stores floats"),
        None => (Transfer::Srgb, "since it stores integers"),
    };
    if transfer == Transfer::Linear {
        notes.retain(|note| chunk(note).is_none());
    }
    let clip = options.clip.unwrap_or(if raster.is_float() { f64::INFINITY } else { 1.0 });
    let channels = [0, 1, 2].map(|c| &raster.channels[c.min(raster.channels.len() - 1)]);
    let clipped: Vec<bool> =
        (0..raster.width * raster.height).into_par_iter().map(|i| is_clipped(channels, i, clip)).collect();
    let mut image = linear(&raster, channels, &clipped, transfer);
    if let Some(matrix) = raster.to_rec709 {
        let converted =
            |rgb: &mut [f32; 3]| *rgb = (matrix * Vec3::from(*rgb).as_dvec3()).as_vec3().to_array();
        image.pixels.par_iter_mut().for_each(converted);
        notes.push(Note::Converted(Subject::Photograph));
    }
    if let Some(colour) = options.light_colour {
        let gain = colour.map(|channel| channel.recip() as f32);
        image.pixels.iter_mut().for_each(|rgb| (0..3).for_each(|c| rgb[c] *= gain[c]));
    }
    Ok(Photograph { image, clipped, transfer, transfer_from, notes })
}

impl PhotographOptions {
    /// Whether a file specifies them so that a photograph can be read.
    ///
    /// # Errors
    /// The problem: numbers that are not above 0.
    pub fn check(&self) -> Result<(), String> {
        let is_usable = |number: &f64| number.is_finite() && *number > 0.0;
        if let Some(clip) = self.clip.filter(|clip| !is_usable(clip)) {
            return Err(format!("expected a clip above 0, found {clip}"));
        }
        match self.light_colour.filter(|colour| !colour.iter().all(is_usable)) {
            Some([r, g, b]) => Err(format!("expected a light of three numbers above 0, found {r}, {g}, {b}")),
            None => Ok(()),
        }
    }
}

fn is_clipped(channels: [&Samples; 3], index: usize, clip: f64) -> bool {
    channels.iter().map(|channel| channel.at(index)).any(|value| !value.is_finite() || value >= clip)
}

fn linear(raster: &Raster, channels: [&Samples; 3], clipped: &[bool], transfer: Transfer) -> Image<f32> {
    let curve = transfer.curve();
    // A power of a number below 0, which is noise, is NaN.
    let least = if curve == Albedo::Gamma22 { 0.0 } else { f64::NEG_INFINITY };
    let [r, g, b] =
        Samples::decoded_three::<f32>(channels, |value| transfer::linear(value.max(least), curve));
    let pixel = |index: usize| {
        let rgb = [r[index], g[index], b[index]];
        if clipped[index] { rgb.map(|value| if value.is_finite() { value } else { 0.0 }) } else { rgb }
    };
    let pixels = (0..clipped.len()).into_par_iter().map(pixel).collect();
    Image { width: raster.width, height: raster.height, pixels }
}
