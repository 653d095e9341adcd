//! Scenes, a light and a view each: Algorithm 2, and the scenes that Algorithm 1 samples.
//!
//! A scene is a function of a point of the unit cube: 6 numbers for a near-field scene, 4 for a distant one. The caller
//! chooses the points; [`sample`] takes them from a counter-based generator whose i-th point depends on the seed and on i
//! only.

use std::fmt;

use glam::DVec3;
use rand::distr::Open01;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};

use super::convention::Convention;
use crate::error::Error;
use crate::math::real::{Real, Vec3, Vector as _};

/// Mean of the logarithm of a near-field distance (Algorithm 1).
const DISTANCE_MU: f64 = 0.5;
/// Standard deviation of the logarithm of a near-field view's distance (Algorithm 1).
const VIEW_DISTANCE_SIGMA: f64 = 0.75;
/// Least height above the plane: closer to a texel, f32 squares of distances vanish.
const LOWEST: f64 = 1e-18;
/// Largest coordinate of a position; beyond it, f32 squares overflow.
const FARTHEST: f64 = 1e9;

/// Where the light and the view of a scene are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// At positions: directions differ from texel to texel.
    Near,
    /// Infinitely far: the same directions at every texel.
    Distant,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Near => "near",
            Self::Distant => "distant",
        })
    }
}

/// An endpoint of a scene: what moves while the other stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Endpoint {
    Light,
    View,
}

/// One view and one light.
///
/// Positions for [`Kind::Near`], directions of any length that [`Scene::check`] accepts for [`Kind::Distant`], in units of
/// half the width of the material, which lies in the plane z = 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a scene")]
pub struct Scene {
    pub kind: Kind,
    pub view: [f64; 3],
    pub light: [f64; 3],
}

/// A scene in the precision that it is rendered in.
#[derive(Clone, Copy, Debug)]
pub struct Rays<T: Real> {
    kind: Kind,
    view: Vec3<T>,
    light: Vec3<T>,
}

impl<T: Real> Rays<T> {
    /// The kind of the scene.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Light and view: positions, or unit directions.
    pub fn ends(&self) -> [Vec3<T>; 2] {
        [self.light, self.view]
    }

    /// The directions (w_L, w_V) from the texel at `c` to the light and to the viewer, not yet of unit length.
    #[inline]
    pub fn from_texel(&self, c: Vec3<T>) -> (Vec3<T>, Vec3<T>) {
        match self.kind {
            Kind::Near => (self.light - c, self.view - c),
            Kind::Distant => (self.light, self.view),
        }
    }
}

impl Scene {
    /// The scene in precision `T`. Directions are normalized in f64 first, so that no length is too long for f32.
    pub fn rays<T: Real>(&self) -> Rays<T> {
        let cast = |p: [f64; 3]| {
            let p = DVec3::from(p);
            match self.kind {
                Kind::Near => p.cast(),
                Kind::Distant => p.normalize().cast(),
            }
        };
        Rays { kind: self.kind, view: cast(self.view), light: cast(self.light) }
    }

    /// A near-field scene of Algorithm 1 from a point of the open unit cube: P_S.x, P_S.y, u1, u2, view distance,
    /// light distance.
    pub fn near_from_point(point: [f64; 6], convention: &Convention) -> Self {
        let [sx, sy, u1, u2, view, light] = point;
        if convention.member.is_some_and(|member| !member.has_near) {
            return Self::distant_from_point([u1, u2, view, light], convention);
        }
        let shift = DVec3::new(2.0 * sx - 1.0, 2.0 * sy - 1.0, convention.shift_z);
        let w = cosine(u1, u2, convention);
        let mirrored = DVec3::new(-w.x, -w.y, w.z);
        let view = w * log_normal(view, VIEW_DISTANCE_SIGMA) + shift;
        let light = mirrored * log_normal(light, convention.light_distance_sigma) + shift;
        Self { kind: Kind::Near, view: view.to_array(), light: light.to_array() }
    }

    /// A distant scene of Algorithm 1 from a point of the unit cube: view u1, u2, light u1, u2.
    pub fn distant_from_point(point: [f64; 4], convention: &Convention) -> Self {
        let [view_u1, view_u2, light_u1, light_u2] = point;
        Self {
            kind: Kind::Distant,
            view: cosine(view_u1, view_u2, convention).to_array(),
            light: cosine(light_u1, light_u2, convention).to_array(),
        }
    }

    /// Whether the scene can be rendered: finite, coordinates within 1e9 of the origin, light and view at least 1e-18 above
    /// the plane (directions: once they have length 1, of at least 1.5e-154 before).
    ///
    /// # Errors
    /// What is wrong, without saying which scene it is.
    pub fn check(&self) -> Result<(), String> {
        for (what, p) in [("view", self.view), ("light", self.light)] {
            if p.iter().any(|c| !c.is_finite()) {
                return Err(format!("its {what} {p:?} is not finite"));
            }
            if p.iter().any(|c| c.abs() > FARTHEST) {
                return Err(format!("its {what} {p:?} is farther away than {FARTHEST:e}"));
            }
            let direction = DVec3::from(p);
            if self.kind == Kind::Distant && p[2] > 0.0 && !direction.is_direction() {
                return Err(format!("its {what} {p:?} is too short for a direction: its square vanishes"));
            }
            let unit = match self.kind {
                Kind::Near => 1.0,
                Kind::Distant => direction.length(),
            };
            // NaN where a direction has no length.
            let height = p[2] / unit;
            if height.is_nan() || height < LOWEST {
                return Err(format!(
                    "its {what} {p:?} is not above the plane of the material (z must be at least {LOWEST:e})"
                ));
            }
        }
        Ok(())
    }

    /// [`Scene::check`] of a scene that is to be rendered.
    ///
    /// # Errors
    /// [`Error::UnusableScene`].
    pub fn check_usable(&self) -> Result<(), Error> {
        self.check().map_err(|problem| Error::UnusableScene { problem })
    }
}

/// Algorithm 2: a cosine-distributed direction from two numbers of [0, 1). Its z is at least `sqrt(1 - u1_max)`.
pub fn cosine(u1: f64, u2: f64, convention: &Convention) -> DVec3 {
    let u1 = convention.u1_min + (convention.u1_max - convention.u1_min) * u1;
    let rho = u1.sqrt();
    let phi = std::f64::consts::TAU * u2;
    DVec3::new(rho * phi.cos(), rho * phi.sin(), (1.0 - u1).sqrt())
}

/// The `u` quantile of exp(Normal(0.5, sigma)), for `u` in (0, 1).
fn log_normal(u: f64, sigma: f64) -> f64 {
    (DISTANCE_MU + sigma * Normal::standard().inverse_cdf(u)).exp()
}

/// Point `index` of stream `stream` of `seed`: coordinates in (0, 1), each an odd multiple of 2^-53.
///
/// ChaCha8 is counter-based and specified bit by bit: the point depends on its arguments alone.
fn point<const N: usize>(seed: u64, stream: u64, index: u64) -> [f64; N] {
    /// More than the 32-bit words that one point uses; a multiple of a ChaCha block.
    const WORDS_PER_POINT: u128 = 16;
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(stream);
    generator.set_word_pos(WORDS_PER_POINT * u128::from(index));
    std::array::from_fn(|_| generator.sample(Open01))
}

/// The scenes that Algorithm 1 draws for a seed: `near` near-field ones, then `distant` distant ones.
///
/// The i-th scene of either kind depends on (`seed`, i, `convention`) only.
pub fn sample(seed: u64, near: usize, distant: usize, convention: &Convention) -> Vec<Scene> {
    let near = (0..near as u64).map(|i| Scene::near_from_point(point(seed, 0, i), convention));
    let distant = (0..distant as u64).map(|i| Scene::distant_from_point(point(seed, 1, i), convention));
    near.chain(distant).collect()
}

/// The form of a scene file.
#[derive(Debug, Serialize, Deserialize)]
#[serde(expecting = "scenes")]
pub struct SceneFile {
    pub scenes: Vec<Scene>,
}
