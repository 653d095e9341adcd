//! The differences between the printed algorithms and the authors' three released codes, as data.
//!
//! A loss is meaningful only together with its convention, so every result carries its name.

use serde::Serialize;

use super::grammar::RendererTerms;
use super::grammar::words::{Norm, Normals};

/// The numbers and switches in which the published variants of the rendering loss differ.
///
/// A limit of 0 means "no limit". The four named values are [`PRINTED`], [`SINGLE_IMAGE_2018`],
/// [`MULTI_IMAGE_2019`] and [`GUIDED_2020`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Convention {
    /// The name on the command line and in results.
    pub name: &'static str,
    /// Standard deviation of the logarithm of a near-field light's distance.
    pub light_distance_sigma: f64,
    /// Lower end of the uniform u1 of Algorithm 2.
    pub u1_min: f64,
    /// Upper end of the uniform u1 of Algorithm 2, whose square root is the sine of the polar angle.
    pub u1_max: f64,
    /// Height z of the random shift P_S of a near-field scene.
    pub shift_z: f64,
    /// Factor on the rendered radiance R.
    pub intensity: f64,
    /// Least roughness r that is rendered.
    pub roughness_floor: f64,
    /// Least l.z that R is divided by.
    pub light_z_floor: f64,
    /// Whether NoH is clamped at 0 from below before it is squared in D.
    pub clamp_n_dot_h: bool,
    /// Least denominator of D.
    pub d_floor: f64,
    /// Least denominator of each of the two factors of G.
    pub g_floor: f64,
    /// Epsilon inside the logarithms of the loss.
    pub epsilon: f64,
    /// The renderer and the norm, where they are not Algorithm 3 with these limits: the limits and the intensity are not used then.
    pub member: Option<&'static Member>,
}

/// A member of the grammar that is rendered by its own terms, in f64 on the processor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Member {
    pub terms: RendererTerms,
    pub norm: Norm,
    /// Whether its near-field scenes are sampled, too; otherwise all are distant.
    pub has_near: bool,
    /// That of [`PRINTED`] and [`GUIDED_2020`] whose terms differ in fewest from its own: what adapters and pages draw in its place.
    pub nearest: &'static Convention,
}

/// Lower end of the uniform u1 of Algorithm 2.
pub const U1_MIN: f64 = 0.001;

/// The algorithms as printed (the default).
pub const PRINTED: Convention = Convention {
    name: "printed",
    light_distance_sigma: 0.866_025_403_784_438_6, // the print says sigma^2 = 0.75
    u1_min: U1_MIN,
    u1_max: 0.95,
    shift_z: 0.0,
    intensity: 1.0,
    roughness_floor: 0.0001,
    light_z_floor: 0.0,
    clamp_n_dot_h: false,
    d_floor: 0.0,
    g_floor: 0.0,
    epsilon: 0.01,
    member: None,
};

/// The released code of "Single-Image SVBRDF Capture with a Rendering-Aware Deep Network" (2018).
///
/// Not reproduced: that code renders normals as stored, without normalizing them, on a transposed grid.
pub const SINGLE_IMAGE_2018: Convention = Convention {
    name: "single-image-2018",
    light_distance_sigma: 0.75,
    u1_min: U1_MIN,
    u1_max: 0.95,
    shift_z: 0.0001,
    intensity: std::f64::consts::PI,
    roughness_floor: 0.001,
    light_z_floor: 0.001,
    clamp_n_dot_h: true,
    d_floor: 0.001,
    g_floor: 0.001,
    epsilon: 0.01,
    member: None,
};

/// The released code of "Flexible SVBRDF Capture with a Multi-Image Deep Network" (2019).
pub const MULTI_IMAGE_2019: Convention = Convention {
    name: "multi-image-2019",
    u1_max: 0.9,
    intensity: 1.5 * std::f64::consts::PI,
    epsilon: 0.1,
    ..SINGLE_IMAGE_2018
};

/// The released code of "Guided Fine-Tuning for Large-Scale Material Transfer" (2020).
///
/// Not reproduced: its training loss also adds 1 - MS-SSIM of the log renderings.
pub const GUIDED_2020: Convention = Convention { name: "guided-2020", epsilon: 0.01, ..MULTI_IMAGE_2019 };

/// Every named convention of Algorithm 3, the default first.
pub const ALL: [Convention; 4] = [PRINTED, SINGLE_IMAGE_2018, MULTI_IMAGE_2019, GUIDED_2020];

impl Default for Convention {
    fn default() -> Self {
        PRINTED
    }
}

impl Convention {
    /// What adapters and pages draw: the convention itself, or the nearest one of a member.
    pub fn drawn(&self) -> Self {
        self.member.map_or(*self, |member| *member.nearest)
    }

    /// Whether the authors' code renders normals as stored. Those of a [`Material`](crate::material::Material) have length 1.
    pub fn has_stored_normals(&self) -> bool {
        let is_stored = |member: &Member| member.terms.material.normal == Normals::Stored;
        self.member.map_or(self.name == SINGLE_IMAGE_2018.name, is_stored)
    }

    /// How renderings are compared.
    pub fn norm(&self) -> Norm {
        match self.member {
            // Of renderers without a loss of this kind, ours.
            Some(Member { norm: Norm::None, .. }) | None => Norm::LogL1,
            Some(member) => member.norm,
        }
    }
}
