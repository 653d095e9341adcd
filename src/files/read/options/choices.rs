//! The choices that specify how stored values are read, and presets: bundles of them for sources of materials.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use svbrdf_core::choices;
use svbrdf_core::error::Error;

use super::tiles::Order;

choices! {
    /// Colour space of diffuse, specular and base colour as stored; also the transfer curve of a photograph, of radiance.
    #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
    Albedo, "albedo":
    /// The stored value is the reflectance.
    Linear = "linear",
    /// Encoded by the transfer function of IEC 61966-2-1.
    Srgb = "srgb",
    /// Encoded by the power 1 / 2.2.
    Gamma22 = "gamma2.2",
    /// (ln(x + 0.01) - ln 0.01) / (ln 1.01 - ln 0.01): the `logOutputAlbedos` of Deschaintre et al. 2018.
    Log = "log0.01",
}

impl Albedo {
    /// The name in texts.
    pub fn label(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Srgb => "sRGB",
            Self::Gamma22 => "gamma 2.2",
            Self::Log => "logarithmic",
        }
    }
}

choices! {
    /// The direction of the y axis of a normal map on the picture.
    NormalY, "direction of normal y":
    /// Green grows towards the top ("OpenGL").
    Up = "up",
    /// Green grows towards the bottom ("DirectX"); y is negated on reading.
    Down = "down",
}

choices! {
    /// How the components of normals are stored.
    NormalEncoding, "normal encoding":
    /// (n + 1) / 2.
    Unsigned = "unsigned",
    /// n itself.
    Signed = "signed",
    /// (n + 1) / 2 of x and y; z follows.
    Xy = "xy",
    /// The same with x in alpha and y in green ("DXT5nm").
    Ag = "ag",
}

choices! {
    /// The meaning of the stored value c of a roughness map; r is the roughness, alpha = r^2 the width of GGX.
    Roughness, "meaning of roughness":
    /// r = c.
    R = "r",
    /// Glossiness or smoothness: r = 1 - c.
    Gloss = "gloss",
    /// The width of GGX itself: r = sqrt(c).
    Alpha = "alpha",
    /// The widths of an anisotropic GGX in red and green: r = sqrt(sqrt(c_red c_green)).
    Anisotropic = "axay",
    /// Stored like a colour: r = c^2.2.
    Gamma22 = "gamma2.2",
}

choices! {
    /// Which maps specify the reflectance.
    Workflow, "workflow":
    /// Diffuse and specular.
    Specular = "specular",
    /// A base colour b and metallic m: d = b (1 - m), s = f (1 - m) + b m with f of dielectrics.
    Metallic = "metallic",
}

choices! {
    /// Whether the renderer that diffuse was made for scales it by (1 - specular), as this one does.
    Energy, "diffuse scaling":
    /// Diffuse is scaled by (1 - specular) (Deschaintre, MaterialGAN): the stored value is used.
    Scaled = "scaled",
    /// Diffuse is not scaled by (1 - specular): d / (1 - s) is used, so that the material looks the same here.
    Unscaled = "unscaled",
}

choices! {
    /// The treatment of NaN and infinity.
    #[derive(Default)]
    NonFinite, "treatment of NaN and infinity":
    /// An error that names the first one and counts them.
    #[default]
    Refuse = "refuse",
    /// Colours become 0, roughness 1, normals (0, 0, 1); the count is reported.
    Replace = "replace",
}

/// Reflectance at normal incidence, in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Reflectance(f64);

impl Reflectance {
    /// That of most dielectrics.
    pub const DIELECTRIC: Self = Self(0.04);

    pub fn value(self) -> f64 {
        self.0
    }
}

impl From<Reflectance> for f64 {
    fn from(reflectance: Reflectance) -> Self {
        reflectance.0
    }
}

impl TryFrom<f64> for Reflectance {
    type Error = Error;

    fn try_from(value: f64) -> Result<Self, Error> {
        value.to_string().parse()
    }
}

impl FromStr for Reflectance {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let value = text.parse().ok().filter(|value| (0.0..=1.0).contains(value));
        value
            .map(Self)
            .ok_or_else(|| Error::unknown_name("reflectance", text, "a number from 0 to 1, such as 0.04"))
    }
}

impl fmt::Display for Reflectance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

choices! {
    /// A source of materials: a research code, a data set, a library or a tool.
    Preset, "preset":
    /// Deschaintre et al. 2019-2020, mworchel: N D R S, all linear.
    Deschaintre = "deschaintre",
    /// Deschaintre et al. 2018: the same; only their photos, which are ignored here, are linear, too.
    Deschaintre18 = "deschaintre18",
    /// Gao et al. 2019: N D R S, only D with gamma 2.2.
    Gao = "gao",
    /// MaterialGAN and svbrdf-diff-renderer: D, S and R with gamma 2.2.
    MaterialGan = "materialgan",
    /// Zhou & Kalantari 2022: D N R S, D and S with gamma 2.2, R as it is.
    LookAhead = "lookahead",
    /// MatFusion: D S R N, D and S with gamma 2.2; of base colour and metallic s = 0.04 + b m.
    MatFusion = "matfusion",
    /// SurfaceNet and MatFuse: files of raw values.
    SurfaceNet = "surfacenet",
    /// DiffMat: metallic, base colour with gamma 2.2, y down.
    DiffMat = "diffmat",
    /// OpenSVBRDF: linear, GGX widths ax and ay.
    OpenSvbrdf = "opensvbrdf",
    /// glTF 2.0 and networks that write its maps (CHORD, StableMaterials, MatE): metallic, base colour sRGB, y up.
    Gltf = "gltf",
    /// Poly Haven: as glTF.
    PolyHaven = "polyhaven",
    /// ambientCG: as glTF.
    AmbientCg = "ambientcg",
    /// MaterialPalette: diffuse with gamma 2.2, roughness as it is, y up.
    MaterialPalette = "materialpalette",
    /// Substance, specular and glossiness: colours sRGB.
    SubstanceSg = "substance-sg",
}

impl Preset {
    /// The order in which it packs maps, where it does.
    pub(crate) fn order(self) -> Option<Order> {
        match self {
            Self::Deschaintre | Self::Deschaintre18 | Self::Gao => Some(Order::NDRS),
            Self::MaterialGan | Self::LookAhead => Some(Order::DNRS),
            Self::MatFusion => Some(Order::DSRN),
            _ => None,
        }
    }
}
