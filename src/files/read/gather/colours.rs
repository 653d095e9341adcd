//! Evidence about colours: file types, names and pixels of diffuse and specular.

use std::path::Path;

use svbrdf_core::statistics::median;

use super::log_odds::{ALBEDO, BRIGHT_CHANCE, CHANCE, DARK, METAL, SURE, likelihood};
use crate::read::options::Albedo;
use crate::read::options::extensions;
use crate::read::options::transfer::linear;
use crate::read::raster::Raster;
use crate::read::record::Evidence;

/// Darker than this, stored or decoded, is black.
const BLACK: f64 = 0.02;
/// A stored specular above this value means a metal; its diffuse is black or nearly so, which tells nothing.
const METAL_AT_LEAST: f64 = 0.3;
/// Share of the texels that have to be of metal.
const MOSTLY: f64 = 0.5;

/// The evidence of a colour without specular that is so dark if encoded that it may be linear.
pub(super) fn alone(colour: &Raster) -> Option<Evidence> {
    dark(colour, |_| false).filter(|dark| dark.log_odds() >= DARK)
}

/// The evidence of the pixels of both together.
pub(super) fn measured(diffuse: &Raster, specular: &Raster) -> Vec<Evidence> {
    let dark = if diffuse.size() == specular.size() {
        let is_metal = |i: usize| most(specular.rgb(i)) > METAL_AT_LEAST;
        dark(diffuse, is_metal)
    } else {
        None
    };
    dielectrics(specular).into_iter().chain(dark).chain(metals(diffuse, specular)).collect()
}

pub(super) fn is_jpeg(file: &Path) -> bool {
    matches!(extensions::of_name(file).as_str(), "jpg" | "jpeg" | "jfif" | "jpe")
}

/// The evidence of texels with the specular of dielectrics, 0.04, as it is or encoded.
fn dielectrics(specular: &Raster) -> Option<Evidence> {
    let (mut count, mut plain, mut encoded) = (0_u32, 0_u32, 0_u32);
    for index in specular.sampled() {
        let least = specular.rgb(index).into_iter().fold(f64::INFINITY, f64::min);
        count += 1;
        plain += u32::from((0.03..=0.06).contains(&least));
        encoded += u32::from((0.2..=0.26).contains(&least));
    }
    let share = |texels: u32| f64::from(texels) / f64::from(count.max(1));
    let evidence = if plain > encoded {
        Evidence::LinearDielectrics(share(plain))
    } else {
        Evidence::EncodedDielectrics(share(encoded))
    };
    (share(plain.max(encoded)) > CHANCE).then_some(evidence)
}

/// The evidence where the colour of texels without metal is so dark if encoded that it is rather linear.
fn dark(colour: &Raster, is_metal: impl Fn(usize) -> bool) -> Option<Evidence> {
    let mean = |index| colour.rgb(index).iter().sum::<f64>() / 3.0;
    let mut values: Vec<f64> =
        colour.sampled().filter(|i| !is_metal(*i)).map(mean).filter(|value| *value > BLACK).collect();
    let share = values.len() as f64 / colour.sampled().count().max(1) as f64;
    let median = median(&mut values).filter(|_| share > MOSTLY)?;
    (likelihood(median, ALBEDO) >= 1.0).then_some(Evidence::Dark(median))
}

/// The evidence of the reflectance of metals, where most texels are metal: their diffuse is black.
fn metals(diffuse: &Raster, specular: &Raster) -> Option<Evidence> {
    if diffuse.size() != specular.size() {
        return None;
    }
    let is_metal = |i: &usize| most(diffuse.rgb(*i)) < BLACK && most(specular.rgb(*i)) > METAL_AT_LEAST;
    let mut values: Vec<f64> =
        specular.sampled().filter(is_metal).map(|i| specular.rgb(i).iter().sum::<f64>() / 3.0).collect();
    let share = values.len() as f64 / specular.sampled().count().max(1) as f64;
    let median = median(&mut values).filter(|_| share > MOSTLY)?;
    Some(Evidence::Metals { median, log_odds: likelihood(median, METAL).clamp(-SURE, SURE) })
}

fn most(rgb: [f64; 3]) -> f64 {
    rgb.into_iter().fold(0.0, f64::max)
}

/// The evidence of texels that reflect more light than arrives if they are linear, and not if they are encoded.
pub(super) fn too_bright(diffuse: &Raster, specular: &Raster) -> Option<Evidence> {
    if diffuse.size() != specular.size() {
        return None;
    }
    let (mut count, mut bright) = (0_u32, 0_u32);
    for index in diffuse.sampled() {
        let pairs = || diffuse.rgb(index).into_iter().zip(specular.rgb(index));
        let encoded = |(d, s): (f64, f64)| {
            linear(d.clamp(0.0, 1.0), Albedo::Srgb) + linear(s.clamp(0.0, 1.0), Albedo::Srgb)
        };
        count += 1;
        bright += u32::from(pairs().any(|(d, s)| d + s > 1.0) && pairs().all(|pair| encoded(pair) <= 1.0));
    }
    let share = f64::from(bright) / f64::from(count.max(1));
    (share > BRIGHT_CHANCE).then_some(Evidence::TooBright(share))
}
