//! Whether colours are linear: the evidence of file types and pixels, weighed together.
//!
//! Each piece of evidence adds to the log odds of linear. No single one but a specular map of dielectrics, nearly all of
//! it at 0.04, outweighs the prior.

use std::path::Path;

use super::transfer::linear;
use crate::files::read::assumption::Certainty;
use crate::files::read::evidence::Evidence;
use crate::files::read::options::Albedo;
use crate::files::read::raster::Raster;
use crate::files::read::reason::Reason;
use crate::files::read::stored::StoredMap;

/// Of colours of integers in files of their own: 1 in 20 is linear.
const PRIOR: f64 = -3.0;
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
/// Odds below 7 to 1 are unsure.
const SURE: f64 = 2.0;

impl Evidence {
    /// What it adds to the log odds of linear.
    fn log_odds(self) -> f64 {
        match self {
            Self::Prior => PRIOR,
            Self::Jpeg => JPEG,
            Self::LinearDielectrics(share) => DIELECTRICS * (share - CHANCE),
            Self::EncodedDielectrics(share) => -DIELECTRICS * (share - CHANCE),
            Self::TooBright(share) => TOO_BRIGHT * (share - BRIGHT_CHANCE).min(0.5),
        }
    }
}

/// The encoding that the evidence of all colours supports, for diffuse (or a base colour) and for specular.
///
/// They differ only where evidence about diffuse alone says so.
pub fn weigh(diffuse: &StoredMap, specular: &StoredMap) -> [(Albedo, Reason, Certainty); 2] {
    let mut common = vec![Evidence::Prior];
    if is_jpeg(&diffuse.file) && is_jpeg(&specular.file) {
        common.push(Evidence::Jpeg);
    }
    let of_specular: Vec<_> = common.iter().copied().chain(dielectrics(&specular.raster)).collect();
    let bright = too_bright(&diffuse.raster, &specular.raster);
    let of_diffuse = of_specular.iter().copied().chain(bright).collect();
    [of_diffuse, of_specular].map(verdict)
}

fn verdict(evidence: Vec<Evidence>) -> (Albedo, Reason, Certainty) {
    let log_odds = evidence.iter().map(|one| one.log_odds()).sum::<f64>();
    let albedo = if log_odds > 0.0 { Albedo::Linear } else { Albedo::Srgb };
    // One piece of measured evidence that points the other way is enough to doubt.
    let disagrees = |one: &Evidence| !one.is_custom() && (one.log_odds() > 0.0) != (log_odds > 0.0);
    let is_sure = log_odds.abs() >= SURE && !evidence.iter().any(disagrees);
    let certainty = if is_sure { Certainty::Likely } else { Certainty::Unsure };
    (albedo, Reason::Weighed { log_odds, evidence }, certainty)
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
