//! Log odds: how far each piece of evidence speaks for linear colours.
//!
//! Each adds to the log odds of linear. No single one but a specular map of dielectrics, nearly all of it at 0.04, outweighs
//! the prior.

use crate::read::record::Evidence;

/// Of colours of integers in files of their own, as artists name them: 1 in 20 is linear.
pub(in crate::read) const PRIOR: f64 = -3.0;
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
/// Odds below 7 to 1 are unsure, and so is what evidence of such odds contradicts.
pub(in crate::read) const SURE: f64 = 2.0;
/// Logarithm of a usual albedo, 0.2, and the standard deviation of its logarithm over materials.
pub(super) const ALBEDO: [f64; 2] = [-1.61, 1.1];
/// The same of what metals reflect: 0.65.
pub(super) const METAL: [f64; 2] = [-0.43, 0.4];
/// Evidence of darkness from which on a colour by itself is unsure: a base colour is hardly ever linear.
pub(super) const DARK: f64 = 3.5;
/// The evidence of neighbours counts half, and no more than this.
pub(super) const MOST_OF_NEIGHBOURS: f64 = 3.0;

impl Evidence {
    /// Its part of the log odds of linear.
    pub(in crate::read) fn log_odds(self) -> f64 {
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

/// The log odds that a stored `value` is linear where the logarithms of what materials reflect have this mean and standard deviation.
pub(super) fn likelihood(value: f64, [mean, deviation]: [f64; 2]) -> f64 {
    const GAMMA: f64 = 2.2;
    let density = |log: f64| -0.5 * ((log - mean) / deviation).powi(2);
    let log = value.max(1e-3).ln();
    density(log) - density(GAMMA * log)
}
