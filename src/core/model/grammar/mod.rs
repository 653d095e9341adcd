//! A grammar of renderers and losses: the terms in which published codes differ, as data.
//!
//! Keys and words are those of its TOML, one section for each struct. What a text leaves out has the value of [`RendererTerms::BASE`].

mod description;
mod radiance;
mod scenes;
pub mod words;

use serde::{Deserialize, Serialize};

pub use description::{Description, TermDifference};
pub use radiance::{Factors, Point};
pub use scenes::SceneTerms;
use words::{
    Alpha, Denominator, Distribution, F90, Falloff, Fresnel, FresnelCosine, K, Maps, Norm, NormalY, Normals,
    Rows, Shadowing, Sites, Transfer, Weight,
};

/// The material: its maps, and what happens to them before the formulas.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MapTerms {
    pub material: Maps,
    /// Specular reflectance of a dielectric.
    pub f0: f64,
    /// Clips colours and roughness to [0, 1].
    pub clip_maps: bool,
    pub r_min: f64,
    pub r_max: f64,
    pub alpha: Alpha,
    pub normal: Normals,
    pub normal_y: NormalY,
    /// Mirrors normals that point into the plane.
    pub flip_below: bool,
    /// Added to each length that a vector is divided by.
    pub vec_eps: f64,
}

/// The specular term D F G / denominator.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpecularTerms {
    #[serde(rename = "D")]
    pub d: Distribution,
    /// Whether D is 0 where the half vector is behind the texel.
    #[serde(rename = "D_xi")]
    pub d_xi: bool,
    /// Least `n.h^2 (a^2 - 1) + 1`.
    #[serde(rename = "D_den_min")]
    pub d_den_min: f64,
    /// Added to pi times its square.
    #[serde(rename = "D_add")]
    pub d_add: f64,
    /// Least value of that.
    #[serde(rename = "D_den2_min")]
    pub d_den2_min: f64,
    /// Largest D.
    #[serde(rename = "D_cap")]
    pub d_cap: f64,
    /// Least n.l, n.v, n.h and v.h.
    pub nl_min: f64,
    pub nv_min: f64,
    pub nh_min: f64,
    pub vh_min: f64,
    /// Whether n.h has limits.
    pub nh_clamped: bool,
    /// Largest of the four.
    pub dot_max: f64,
    #[serde(rename = "G")]
    pub g: Shadowing,
    pub k: K,
    pub k_add: f64,
    pub k_min: f64,
    /// Least denominator of each factor of Schlick's shadowing.
    #[serde(rename = "G_den_min")]
    pub g_den_min: f64,
    /// Added to the square of the cosine in Smith's.
    #[serde(rename = "G_add")]
    pub g_add: f64,
    /// Least denominator of the height-correlated visibility.
    #[serde(rename = "V_den_min")]
    pub v_den_min: f64,
    pub denominator: Denominator,
    pub den_add: f64,
    #[serde(rename = "F")]
    pub f: Fresnel,
    #[serde(rename = "F_of")]
    pub f_of: FresnelCosine,
    pub f90: F90,
    /// Whether the specular term is multiplied by the cosine.
    pub spec_cosine: bool,
    /// The specular term is 0 where n.l or n.v is at most this.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub front_min: Option<f64>,
}

/// The diffuse term.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DiffuseTerms {
    pub diffuse: Weight,
}

/// The light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightTerms {
    /// Least cosine that the terms are multiplied by.
    pub cos_min: f64,
    /// Largest one, where it is not `dot_max`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cos_max: Option<f64>,
    /// Divides by l.z, which is at least this; "none" does not.
    #[serde(with = "number_or_none")]
    pub lz: Option<f64>,
    pub falloff: Falloff,
    /// Added to the square of the distance.
    pub falloff_add: f64,
    /// Exponent of l.z, of a flash that shines along -z.
    pub spot: f64,
    pub intensity: [f64; 3],
    /// That of distant scenes, where it differs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intensity_distant: Option<[f64; 3]>,
    pub factor: f64,
    /// Light from everywhere, as a multiple of the diffuse colour.
    pub ambient: f64,
    /// Whether the camera is at the light.
    pub collocated: bool,
}

/// What is done to radiances.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OutputTerms {
    /// Clips the diffuse and the specular term each.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clip_terms: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clip: Option<[f64; 2]>,
    /// Added before the encoding.
    pub pre_add: f64,
    pub transfer: Transfer,
    /// Clips what is encoded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clip_after: Option<[f64; 2]>,
}

/// Where the texels of a material lie.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GridTerms {
    /// Half the width of the material in units of the world.
    pub half_extent: f64,
    pub sampling: Sites,
    pub orientation: Rows,
    /// Whether light and view of a distant scene are points at their directions.
    pub distant_is_point: bool,
    /// Whether the light alone is distant in a distant scene.
    pub light_only_distant: bool,
}

/// The loss of two renderings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LossTerms {
    pub norm: Norm,
    /// Added within the logarithm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub epsilon: Option<f64>,
}

/// A renderer: everything but its name, its loss and its scenes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RendererTerms {
    pub material: MapTerms,
    pub specular: SpecularTerms,
    pub diffuse: DiffuseTerms,
    pub light: LightTerms,
    pub output: OutputTerms,
    pub grid: GridTerms,
}

impl RendererTerms {
    /// What a text that leaves everything out means: no floors, no limits, a light of intensity 1.
    pub const BASE: Self = Self {
        material: MapTerms {
            material: Maps::Diffuse,
            f0: 0.04,
            clip_maps: false,
            r_min: 0.0,
            r_max: f64::INFINITY,
            alpha: Alpha::Square,
            normal: Normals::Unit,
            normal_y: NormalY::Up,
            flip_below: false,
            vec_eps: 0.0,
        },
        specular: SpecularTerms {
            d: Distribution::Ggx,
            d_xi: false,
            d_den_min: 0.0,
            d_add: 0.0,
            d_den2_min: 0.0,
            d_cap: f64::INFINITY,
            nl_min: 0.0,
            nv_min: 0.0,
            nh_min: 0.0,
            vh_min: 0.0,
            nh_clamped: true,
            dot_max: f64::INFINITY,
            g: Shadowing::Schlick,
            k: K::HalfAlpha,
            k_add: 0.0,
            k_min: 0.0,
            g_den_min: 0.0,
            g_add: 0.0,
            v_den_min: 0.0,
            denominator: Denominator::Cancelled,
            den_add: 0.0,
            f: Fresnel::Base2,
            f_of: FresnelCosine::Half,
            f90: F90::One,
            spec_cosine: true,
            front_min: None,
        },
        diffuse: DiffuseTerms { diffuse: Weight::Specular },
        light: LightTerms {
            cos_min: 0.0,
            cos_max: None,
            lz: None,
            falloff: Falloff::None,
            falloff_add: 0.0,
            spot: 0.0,
            intensity: [1.0; 3],
            intensity_distant: None,
            factor: 1.0,
            ambient: 0.0,
            collocated: false,
        },
        output: OutputTerms {
            clip_terms: None,
            clip: None,
            pre_add: 0.0,
            transfer: Transfer::Linear,
            clip_after: None,
        },
        grid: GridTerms {
            half_extent: 1.0,
            sampling: Sites::Corner,
            orientation: Rows::Up,
            distant_is_point: false,
            light_only_distant: false,
        },
    };
}

/// The value of a section that is left out, and of a key that is.
macro_rules! base {
    ($($type:ident = $section:ident,)+) => {
        $(impl Default for $type {
            fn default() -> Self {
                RendererTerms::BASE.$section
            }
        })+
    };
}

base! {
    MapTerms = material,
    SpecularTerms = specular,
    DiffuseTerms = diffuse,
    LightTerms = light,
    OutputTerms = output,
    GridTerms = grid,
}

impl Norm {
    /// What a value of two renderings adds to the loss, where the loss is the mean of that over texels and channels.
    pub fn term(self, epsilon: f64) -> Option<impl Fn(f64, f64) -> f64> {
        let is_mean = matches!(self, Self::LogL1 | Self::L1 | Self::Mse);
        is_mean.then_some(move |a: f64, b: f64| match self {
            Self::LogL1 => ((a + epsilon).ln() - (b + epsilon).ln()).abs(),
            Self::Mse => (a - b).powi(2),
            _ => (a - b).abs(),
        })
    }

    /// That term in words.
    pub fn of_term(self) -> &'static str {
        match self {
            Self::LogL1 => "log difference",
            Self::Mse => "squared difference",
            _ => "absolute difference",
        }
    }

    /// The loss of renderings `a` and `b`; `None` of [`Norm::None`].
    pub fn of(self, a: &[f64], b: &[f64], epsilon: f64) -> Option<f64> {
        if self == Self::Rmse {
            return Self::Mse.of(a, b, epsilon).map(f64::sqrt);
        }
        let term = self.term(epsilon)?;
        Some(a.iter().zip(b).map(|(a, b)| term(*a, *b)).sum::<f64>() / a.len().max(1) as f64)
    }
}

impl Default for LossTerms {
    fn default() -> Self {
        Self { norm: Norm::None, epsilon: None }
    }
}

/// A number, or the word "none".
mod number_or_none {
    use serde::de::{Deserialize, Deserializer, Error};
    use serde::ser::Serializer;

    #[derive(serde::Deserialize)]
    #[serde(untagged, expecting = "a number or \"none\"")]
    enum Value {
        Number(f64),
        Word(String),
    }

    pub(super) fn serialize<S: Serializer>(value: &Option<f64>, to: S) -> Result<S::Ok, S::Error> {
        match value {
            Some(number) => to.serialize_f64(*number),
            None => to.serialize_str("none"),
        }
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
        match Value::deserialize(from)? {
            Value::Number(number) => Ok(Some(number)),
            Value::Word(word) if word == "none" => Ok(None),
            Value::Word(word) => {
                Err(D::Error::custom(format!("lz: expected a number or \"none\", found \"{word}\"")))
            }
        }
    }
}
