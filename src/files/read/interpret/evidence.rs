//! Evidence about colours: file types, names and pixels of diffuse and specular, and its log odds of linear.
//!
//! No single piece but a specular map of dielectrics, nearly all of it at 0.04, outweighs the prior.

use std::path::Path;

use svbrdf_core::statistics::median;

use crate::read::names::extension;
use crate::read::options::Albedo;
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
    let others = [metals(diffuse, specular), no_material(diffuse, specular)].into_iter().flatten();
    dielectrics(specular).into_iter().chain(dark).chain(others).collect()
}

pub(super) fn is_jpeg(file: &Path) -> bool {
    matches!(extension(file).as_str(), "jpg" | "jpeg" | "jfif" | "jpe")
}

/// The evidence of texels with the specular of dielectrics, 0.04, as it is or encoded.
pub(super) fn dielectrics(specular: &Raster) -> Option<Evidence> {
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

/// The evidence of texels that are those of no material if they are linear: too bright a specular for a dielectric, and too bright a
/// diffuse for a metal.
fn no_material(diffuse: &Raster, specular: &Raster) -> Option<Evidence> {
    if diffuse.size() != specular.size() {
        return None;
    }
    let is_one = |[d, s]: [f64; 2]| d > METAL_DIFFUSE && s > MOST_DIELECTRIC;
    let least = |rgb: [f64; 3]| rgb.into_iter().fold(1.0, f64::min);
    let (mut count, mut found) = (0_u32, 0_u32);
    for index in diffuse.sampled() {
        let stored = [diffuse, specular].map(|map| least(map.rgb(index)).max(0.0));
        count += 1;
        found += u32::from(is_one(stored) && !is_one(stored.map(|value| linear(value, Albedo::Srgb))));
    }
    let share = f64::from(found) / f64::from(count.max(1));
    (share > CHANCE).then_some(Evidence::NoMaterial(share))
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

/// Of colours of integers in files of their own, as artists name them: 1 in 20 is linear.
pub(super) const PRIOR: f64 = -3.0;
/// Of a set of diffuse, specular and roughness: of the sources in docs/formats.md, 1 in 4 stores them linear.
const RESEARCH: f64 = -1.1;
/// JPEG holds data less often than PNG.
const JPEG: f64 = -1.0;
/// Of a specular map that is 0.04 all over, as it is or encoded.
const DIELECTRICS: f64 = 8.0;
/// Shares of texels at 0.04 below this one tell nothing: a map that varies passes there.
pub(super) const CHANCE: f64 = 0.25;
/// Of diffuse and specular whose sum is above 1 everywhere.
const TOO_BRIGHT: f64 = -20.0;
/// Shares of texels with too bright a sum that tell nothing.
pub(super) const BRIGHT_CHANCE: f64 = 0.02;
/// Dielectrics reflect less than this at normal incidence, and metals have a diffuse below that.
const MOST_DIELECTRIC: f64 = 0.2;
const METAL_DIFFUSE: f64 = 0.05;
/// Log odds from which on pixels outweigh a custom of codes.
pub(super) const CUSTOM: f64 = 3.0;
/// Odds below 7 to 1 are unsure, and so is what evidence of such odds contradicts.
pub(super) const SURE: f64 = 2.0;
/// Logarithm of a usual albedo, 0.2, and the standard deviation of its logarithm over materials.
pub(super) const ALBEDO: [f64; 2] = [-1.61, 1.1];
/// The same of what metals reflect: 0.65.
pub(super) const METAL: [f64; 2] = [-0.43, 0.4];
/// Evidence of darkness from which on a colour by itself is unsure: a base colour is hardly ever linear.
pub(super) const DARK: f64 = 3.5;

impl Evidence {
    /// Its part of the log odds of linear.
    pub(super) fn log_odds(self) -> f64 {
        match self {
            Self::Prior => PRIOR,
            Self::Research => RESEARCH,
            Self::Jpeg => JPEG,
            Self::LinearDielectrics(share) => DIELECTRICS * (share - CHANCE),
            Self::EncodedDielectrics(share) => -DIELECTRICS * (share - CHANCE),
            Self::NoMaterial(share) => -DIELECTRICS * (share - CHANCE),
            Self::TooBright(share) => TOO_BRIGHT * (share - BRIGHT_CHANCE).min(0.5),
            Self::Dark(median) => likelihood(median, ALBEDO),
            Self::Metals { log_odds, .. } => log_odds,
        }
    }
}

/// The log odds that a stored `value` is linear where the logarithms of what materials reflect have this mean and standard deviation.
pub(super) fn likelihood(value: f64, [mean, deviation]: [f64; 2]) -> f64 {
    const GAMMA: f64 = 2.2;
    let density = |log: f64| -0.5 * ((log - mean) / deviation).powi(2);
    let log = value.max(1e-3).ln();
    density(log) - density(GAMMA * log)
}
