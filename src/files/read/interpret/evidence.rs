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

type Rgb = [f64; 3];

/// The texels of a map that are looked at. They are read once: in a large picture each is far from the others.
pub(super) fn texels(map: &Raster) -> Vec<Rgb> {
    map.sampled().map(|index| map.rgb(index)).collect()
}

/// The evidence of a colour without specular that is so dark if encoded that it may be linear.
pub(super) fn alone(colour: &[Rgb]) -> Option<Evidence> {
    dark(colour.len(), colour.iter()).filter(|dark| dark.log_odds() >= DARK)
}

/// The evidence of the [`texels`] of both together; without those of diffuse, of specular alone.
pub(super) fn measured(diffuse: &[Rgb], specular: &[Rgb]) -> Vec<Evidence> {
    let without_metal = diffuse.iter().zip(specular).filter(|(_, s)| most(s) <= METAL_AT_LEAST);
    let dark = dark(diffuse.len(), without_metal.map(|(d, _)| d));
    let others = [metals(diffuse, specular), no_material(diffuse, specular)].into_iter().flatten();
    dielectrics(specular).into_iter().chain(dark).chain(others).collect()
}

pub(super) fn is_jpeg(file: &Path) -> bool {
    matches!(extension(file).as_str(), "jpg" | "jpeg" | "jfif" | "jpe")
}

/// The share of the items that are so.
fn share<T>(all: impl ExactSizeIterator<Item = T>, is_so: impl Fn(T) -> bool) -> f64 {
    let count = all.len().max(1);
    all.map(is_so).filter(|is_so| *is_so).count() as f64 / count as f64
}

/// The evidence of texels with the specular of dielectrics, 0.04, as it is or encoded.
pub(super) fn dielectrics(specular: &[Rgb]) -> Option<Evidence> {
    let within = |low: f64, high: f64| share(specular.iter(), |rgb| (low..=high).contains(&least(rgb)));
    let (plain, encoded) = (within(0.03, 0.06), within(0.2, 0.26));
    let evidence = match plain > encoded {
        true => Evidence::LinearDielectrics(plain),
        false => Evidence::EncodedDielectrics(encoded),
    };
    (plain.max(encoded) > CHANCE).then_some(evidence)
}

/// The evidence where the colour of those of `count` texels that are without metal is so dark if encoded that it is rather linear.
fn dark<'a>(count: usize, colours: impl Iterator<Item = &'a Rgb>) -> Option<Evidence> {
    let mut values: Vec<f64> = colours.map(mean).filter(|value| *value > BLACK).collect();
    let share = values.len() as f64 / count.max(1) as f64;
    let median = median(&mut values).filter(|_| share > MOSTLY)?;
    (likelihood(median, ALBEDO) >= 1.0).then_some(Evidence::Dark(median))
}

/// The evidence of the reflectance of metals, where most texels are metal: their diffuse is black.
fn metals(diffuse: &[Rgb], specular: &[Rgb]) -> Option<Evidence> {
    let pairs = diffuse.iter().zip(specular);
    let of_metal = pairs.filter(|(d, s)| most(d) < BLACK && most(s) > METAL_AT_LEAST);
    let mut values: Vec<f64> = of_metal.map(|(_, s)| mean(s)).collect();
    let share = values.len() as f64 / specular.len().max(1) as f64;
    let median = median(&mut values).filter(|_| share > MOSTLY)?;
    Some(Evidence::Metals { median, log_odds: likelihood(median, METAL).clamp(-SURE, SURE) })
}

/// The evidence of texels that are those of no material if they are linear: too bright a specular for a dielectric, and too bright a
/// diffuse for a metal.
fn no_material(diffuse: &[Rgb], specular: &[Rgb]) -> Option<Evidence> {
    let is_one = |[d, s]: [f64; 2]| d > METAL_DIFFUSE && s > MOST_DIELECTRIC;
    let share = share(diffuse.iter().zip(specular), |(d, s)| {
        let stored = [d, s].map(|rgb| least(rgb).clamp(0.0, 1.0));
        is_one(stored) && !is_one(stored.map(|value| linear(value, Albedo::Srgb)))
    });
    (share > CHANCE).then_some(Evidence::NoMaterial(share))
}

fn most(rgb: &Rgb) -> f64 {
    rgb.iter().copied().fold(0.0, f64::max)
}

fn least(rgb: &Rgb) -> f64 {
    rgb.iter().copied().fold(f64::INFINITY, f64::min)
}

fn mean(rgb: &Rgb) -> f64 {
    rgb.iter().sum::<f64>() / 3.0
}

/// The evidence of texels that reflect more light than arrives if they are linear, and not if they are encoded.
pub(super) fn too_bright(diffuse: &[Rgb], specular: &[Rgb]) -> Option<Evidence> {
    let encoded = |(d, s): (f64, f64)| {
        linear(d.clamp(0.0, 1.0), Albedo::Srgb) + linear(s.clamp(0.0, 1.0), Albedo::Srgb)
    };
    let share = share(diffuse.iter().zip(specular), |(d, s)| {
        let pairs = || d.iter().copied().zip(s.iter().copied());
        pairs().any(|(d, s)| d + s > 1.0) && pairs().all(|pair| encoded(pair) <= 1.0)
    });
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
