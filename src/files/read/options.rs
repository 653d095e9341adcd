//! How stored values are to be understood. Whatever a user leaves open is detected, and said.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::grid::Grid;
use super::order::Order;
use super::preset::Preset;
use crate::error::Error;

/// An enum whose values have names: for users, for files, and back.
macro_rules! choices {
    ($(#[$meta:meta])* $type:ident, $what:literal: $($(#[$of_variant:meta])* $variant:ident = $name:literal,)+) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub enum $type {
            $($(#[$of_variant])* #[serde(rename = $name)] $variant,)+
        }

        impl $type {
            /// Every choice.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$variant),+];

            /// How users call it.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }

        impl std::str::FromStr for $type {
            type Err = crate::error::Error;

            fn from_str(name: &str) -> Result<Self, Self::Err> {
                Self::ALL.into_iter().find(|value| value.name() == name).ok_or_else(|| {
                    crate::error::Error::UnknownName {
                        what: $what,
                        found: name.to_owned(),
                        known: Self::ALL.map(Self::name).join(", "),
                    }
                })
            }
        }
    };
}
pub(crate) use choices;

choices! {
    /// Colour space of diffuse, specular and base colour as stored.
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

choices! {
    /// Where the y axis of a normal map points, seen on the picture.
    NormalY, "direction of normal y":
    /// Green grows towards the top ("OpenGL").
    Up = "up",
    /// Green grows towards the bottom ("DirectX"); y is negated on reading.
    Down = "down",
}

choices! {
    /// How the components of normals are stored.
    NormalCode, "code of normals":
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
    /// What the stored value c of a roughness map means; r is the roughness, alpha = r^2 the width of GGX.
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
    /// Which maps say what is reflected.
    Workflow, "workflow":
    /// Diffuse and specular.
    Specular = "specular",
    /// A base colour b and metallic m: d = b (1 - m), s = f (1 - m) + b m with f of dielectrics.
    Metallic = "metallic",
}

choices! {
    /// What the renderer that the diffuse was made for does with it. Ours takes d (1 - s).
    Energy, "kind of diffuse":
    /// The same (Deschaintre, MaterialGAN): the stored value is used.
    Deschaintre = "deschaintre",
    /// It takes d alone: d / (1 - s) is used, so that it looks the same here.
    Plain = "plain",
}

choices! {
    /// What becomes of NaN and infinity.
    #[derive(Default)]
    NonFinite, "treatment of NaN and infinity":
    /// The first one is an error that says where it is and how many there are.
    #[default]
    Refuse = "refuse",
    /// Colours become 0, roughness 1, normals (0, 0, 1); how many is said.
    Replace = "replace",
}

/// Reflectance at normal incidence, in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Reflectance(f64);

impl Reflectance {
    /// That of most that is no metal.
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
        value.map(Self).ok_or_else(|| Error::UnknownName {
            what: "reflectance",
            found: text.to_owned(),
            known: "a number from 0 to 1, such as 0.04".to_owned(),
        })
    }
}

impl fmt::Display for Reflectance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// What the user says about the files of a material. `None` is found out from the files, and said; of what cannot be
/// found out it is the usual.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct ReadOptions {
    /// What a source of materials does, for all that is not said here.
    pub preset: Option<Preset>,
    /// Colour space of diffuse, base colour and, unless `specular` says otherwise, specular.
    pub albedo: Option<Albedo>,
    /// Colour space of specular where it is another one.
    #[serde(rename = "specular-albedo")]
    pub specular: Option<Albedo>,
    pub normal_y: Option<NormalY>,
    pub normal_code: Option<NormalCode>,
    pub roughness: Option<Roughness>,
    pub workflow: Option<Workflow>,
    /// Reflectance of what is no metal, where no map says it.
    #[serde(rename = "dielectric-f0")]
    pub dielectric: Option<Reflectance>,
    pub energy: Option<Energy>,
    /// Order of the tiles of a packed image.
    pub order: Option<Order>,
    /// How a packed image is divided; needed where its tiles are not square.
    pub grid: Option<Grid>,
    /// Which of several materials, or rows of a packed image, from 0.
    pub exemplar: Option<usize>,
    /// Whether row 0 is the lowest: then the material is mirrored, normals with it.
    pub flip_v: Option<bool>,
    pub non_finite: Option<NonFinite>,
}

impl ReadOptions {
    /// Which of the `count` materials of the file `path` is read. The only one of a file is, whatever is said: that may
    /// be meant for the other materials of a command line.
    ///
    /// # Errors
    /// [`Error::NotAMaterial`] where there is none of that number.
    pub(crate) fn exemplar_of(&self, count: usize, path: &Path) -> Result<usize, Error> {
        match self.exemplar.unwrap_or(0) {
            _ if count < 2 => Ok(0),
            exemplar if exemplar < count => Ok(exemplar),
            exemplar => Err(Error::NotAMaterial {
                path: path.to_owned(),
                expected: format!("an exemplar from 0 to {}: it holds {count} materials", count - 1),
                found: format!("--exemplar {exemplar}"),
                remedy: "count from 0".to_owned(),
            }),
        }
    }

    /// Everything is found out.
    pub const AUTO: Self = Self {
        preset: None,
        albedo: None,
        specular: None,
        normal_y: None,
        normal_code: None,
        roughness: None,
        workflow: None,
        dielectric: None,
        energy: None,
        order: None,
        grid: None,
        exemplar: None,
        flip_v: None,
        non_finite: None,
    };

    /// With what `kept` says wherever nothing else is said, also not by a preset.
    #[must_use]
    pub(crate) fn over(self, kept: Self) -> Self {
        let preset = self.preset.map(Preset::options).unwrap_or_default();
        macro_rules! either {
            ($($field:ident),+) => {
                Self { $($field: self.$field.or(if preset.$field.is_some() { None } else { kept.$field })),+ }
            };
        }
        either!(
            preset,
            albedo,
            specular,
            normal_y,
            normal_code,
            roughness,
            workflow,
            dielectric,
            energy,
            order,
            grid,
            exemplar,
            flip_v,
            non_finite
        )
    }

    /// With what the preset says wherever nothing else is said; not about y of normals, of which names know more.
    pub(crate) fn with_preset(self) -> Self {
        let Some(preset) = self.preset else { return self };
        let usual = preset.options();
        Self {
            albedo: self.albedo.or(usual.albedo),
            specular: self.specular.or(self.albedo).or(usual.specular),
            normal_code: self.normal_code.or(usual.normal_code),
            roughness: self.roughness.or(usual.roughness),
            workflow: self.workflow.or(usual.workflow),
            energy: self.energy.or(usual.energy),
            ..self
        }
    }
}
