//! Whether colours are linear: the evidence of file types, names, pixels and neighbouring materials, weighed together.
//!
//! Each piece of evidence adds to the log odds of linear. No single one but a specular map of dielectrics, nearly all of
//! it at 0.04, outweighs the prior.

use std::path::Path;

use super::transfer::linear;
use crate::files::read::assumption::Certainty;
use crate::files::read::evidence::Evidence;
use crate::files::read::locate::neighbours;
use crate::files::read::options::{Albedo, Roughness};
use crate::files::read::raster::Raster;
use crate::files::read::reason::Reason;
use crate::files::read::storage_convention::StorageConvention;
use crate::files::read::stored::StoredMap;

/// Of colours of integers in files of their own, as artists name them: 1 in 20 is linear.
const PRIOR: f64 = -3.0;
/// Of a set of diffuse, specular and roughness: of the sources in docs/formats.md, 1 in 4 stores them linear.
const RESEARCH: f64 = -1.1;
/// JPEG holds data less often than PNG.
const JPEG: f64 = -1.0;
/// Of a specular map that is 0.04 all over, as it is or encoded.
const DIELECTRICS: f64 = 8.0;
/// Shares of texels at 0.04 below this one say nothing: a map that varies passes there.
const CHANCE: f64 = 0.25;
/// Of diffuse and specular whose sum is above 1 everywhere.
const TOO_BRIGHT: f64 = -20.0;
/// Shares of texels with too bright a sum that say nothing.
const BRIGHT_CHANCE: f64 = 0.02;
/// Odds below 7 to 1 are unsure, and so is what evidence of such odds contradicts.
const SURE: f64 = 2.0;
/// Logarithm of a usual albedo, 0.2, and the spread of its logarithm over materials.
const ALBEDO: [f64; 2] = [-1.61, 1.1];
/// The same of what metals reflect: 0.65.
const METAL: [f64; 2] = [-0.43, 0.4];
/// Evidence of darkness from which on a colour by itself is unsure: a base colour is hardly ever linear.
const DARK: f64 = 3.5;
/// Darker than this, stored or decoded, is black.
const BLACK: f64 = 0.02;
/// A stored specular above this value means a metal; its diffuse is black or nearly so, which tells nothing.
const METAL_AT_LEAST: f64 = 0.3;
/// Share of the texels that have to be of metal.
const MOSTLY: f64 = 0.5;
/// What neighbours say counts half, and no more than this.
const MOST_OF_NEIGHBOURS: f64 = 3.0;

impl Evidence {
    /// What it adds to the log odds of linear.
    fn log_odds(self) -> f64 {
        match self {
            Self::Prior => PRIOR,
            Self::Research => RESEARCH,
            Self::Jpeg => JPEG,
            Self::LinearDielectrics(share) => DIELECTRICS * (share - CHANCE),
            Self::EncodedDielectrics(share) => -DIELECTRICS * (share - CHANCE),
            Self::TooBright(share) => TOO_BRIGHT * (share - BRIGHT_CHANCE).min(0.5),
            Self::Dark(median) => likelihood(median, ALBEDO),
            Self::Metals { log_odds, .. } | Self::Neighbours { log_odds, .. } => log_odds,
        }
    }
}

/// The log odds that a stored `value` is linear where the logarithms of what materials reflect have this mean and spread.
fn likelihood(value: f64, [mean, spread]: [f64; 2]) -> f64 {
    const GAMMA: f64 = 2.2;
    let density = |log: f64| -0.5 * ((log - mean) / spread).powi(2);
    let log = value.max(1e-3).ln();
    density(log) - density(GAMMA * log)
}

/// The encoding that the evidence of all colours supports, for diffuse (or a base colour) and for specular.
///
/// They differ only where evidence about diffuse alone says so. `roughness` is what the names say of it: glossiness is
/// how artists name it.
pub(crate) fn weigh(
    diffuse: &StoredMap,
    specular: &StoredMap,
    roughness: Option<Roughness>,
) -> [(Albedo, Reason, Certainty); 2] {
    let prior = if roughness == Some(Roughness::Gloss) { Evidence::Prior } else { Evidence::Research };
    let mut common = vec![prior];
    if is_jpeg(&diffuse.file) && is_jpeg(&specular.file) {
        common.push(Evidence::Jpeg);
    }
    common.extend(measured(&diffuse.raster, &specular.raster));
    let total: f64 = common.iter().map(|one| one.log_odds()).sum();
    if total.abs() < SURE {
        common.extend(of_neighbours(&diffuse.file, &specular.file));
    }
    let bright = too_bright(&diffuse.raster, &specular.raster);
    let of_diffuse = common.iter().copied().chain(bright).collect();
    [of_diffuse, common].map(verdict)
}

/// The encoding of a colour without specular, by convention; unsure where it is so dark if encoded that it may be linear.
pub(crate) fn alone(colour: &Raster) -> (Albedo, Reason, Certainty) {
    match dark(colour, |_| false).filter(|dark| dark.log_odds() >= DARK) {
        Some(dark) => {
            let evidence = vec![Evidence::Prior, dark];
            (Albedo::Srgb, Reason::Weighed { log_odds: PRIOR, evidence }, Certainty::Unsure)
        }
        None => (Albedo::Srgb, StorageConvention::SeparateColours.into(), Certainty::Likely),
    }
}

/// What the pixels of both say together.
fn measured(diffuse: &Raster, specular: &Raster) -> Vec<Evidence> {
    let dark = if diffuse.size() == specular.size() {
        let is_metal = |i: usize| most(specular.rgb(i)) > METAL_AT_LEAST;
        dark(diffuse, is_metal)
    } else {
        None
    };
    dielectrics(specular).into_iter().chain(dark).chain(metals(diffuse, specular)).collect()
}

fn verdict(evidence: Vec<Evidence>) -> (Albedo, Reason, Certainty) {
    let log_odds = evidence.iter().map(|one| one.log_odds()).sum::<f64>();
    let albedo = if log_odds > 0.0 { Albedo::Linear } else { Albedo::Srgb };
    let disagrees = |one: &Evidence| {
        let alone = one.log_odds();
        !one.is_custom() && alone.abs() >= SURE && (alone > 0.0) != (log_odds > 0.0)
    };
    let is_sure = log_odds.abs() >= SURE && !evidence.iter().any(disagrees);
    let certainty = if is_sure { Certainty::Likely } else { Certainty::Unsure };
    (albedo, Reason::Weighed { log_odds, evidence }, certainty)
}

/// What the pictures of neighbouring materials say.
fn of_neighbours(diffuse: &Path, specular: &Path) -> Option<Evidence> {
    let pairs = neighbours::of(diffuse, specular);
    let said = pairs.iter().map(|[d, s]| measured(d, s).iter().map(|one| one.log_odds()).sum::<f64>());
    let log_odds = 0.5 * said.sum::<f64>();
    let log_odds = log_odds.clamp(-MOST_OF_NEIGHBOURS, MOST_OF_NEIGHBOURS);
    (log_odds != 0.0).then_some(Evidence::Neighbours { count: pairs.len(), log_odds })
}

fn is_jpeg(file: &Path) -> bool {
    file.extension().is_some_and(|e| e.eq_ignore_ascii_case("jpg") || e.eq_ignore_ascii_case("jpeg"))
}

/// What the shares of texels say that have the specular of dielectrics, 0.04, as it is or encoded.
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

/// Whether the colour of what `is_metal` does not say of is so dark if it is encoded that it is rather linear.
fn dark(colour: &Raster, is_metal: impl Fn(usize) -> bool) -> Option<Evidence> {
    let mean = |index| colour.rgb(index).iter().sum::<f64>() / 3.0;
    let values: Vec<f64> =
        colour.sampled().filter(|i| !is_metal(*i)).map(mean).filter(|value| *value > BLACK).collect();
    let share = values.len() as f64 / colour.sampled().count().max(1) as f64;
    let median = median(values).filter(|_| share > MOSTLY)?;
    (likelihood(median, ALBEDO) >= 1.0).then_some(Evidence::Dark(median))
}

/// What the reflectance of metals says, where most texels are of metal: their diffuse is black.
fn metals(diffuse: &Raster, specular: &Raster) -> Option<Evidence> {
    if diffuse.size() != specular.size() {
        return None;
    }
    let is_metal = |i: &usize| most(diffuse.rgb(*i)) < BLACK && most(specular.rgb(*i)) > METAL_AT_LEAST;
    let values: Vec<f64> =
        specular.sampled().filter(is_metal).map(|i| specular.rgb(i).iter().sum::<f64>() / 3.0).collect();
    let share = values.len() as f64 / specular.sampled().count().max(1) as f64;
    let median = median(values).filter(|_| share > MOSTLY)?;
    Some(Evidence::Metals { median, log_odds: likelihood(median, METAL).clamp(-SURE, SURE) })
}

fn most(rgb: [f64; 3]) -> f64 {
    rgb.into_iter().fold(0.0, f64::max)
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// How many texels reflect more light than arrives if they are linear, and not if they are encoded.
fn too_bright(diffuse: &Raster, specular: &Raster) -> Option<Evidence> {
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
