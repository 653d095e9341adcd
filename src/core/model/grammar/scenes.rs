//! The scenes that a code samples.

use serde::{Deserialize, Serialize};

/// Scenes of one kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", deny_unknown_fields)]
pub enum SceneTerms {
    /// Camera and light in mirrored directions w about a point P_S, at distances of their own: P_S = (U(shift), U(shift), shift_z),
    /// P_V = w exp(N(mu, sigma_view)) + P_S.
    #[serde(rename = "mirror")]
    Mirror {
        count: usize,
        /// The range of the square of the sine of the polar angle.
        u1: [f64; 2],
        mu: f64,
        sigma_view: f64,
        sigma_light: f64,
        shift: [f64; 2],
        shift_z: f64,
    },
    /// Independent directions, the same at every texel.
    #[serde(rename = "distant")]
    Distant { count: usize, u1: [f64; 2] },
    /// Independent points of the unit hemisphere.
    #[serde(rename = "unit-distance")]
    UnitDistance { count: usize, u1: [f64; 2] },
    /// Camera and light at (0, 0, z).
    #[serde(rename = "flash")]
    Flash { z: f64 },
    /// One scene.
    #[serde(rename = "fixed")]
    Fixed {
        view: [f64; 3],
        /// In words: it is estimated.
        light_direction: String,
    },
}
