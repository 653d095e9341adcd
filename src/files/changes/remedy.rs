//! The options of reading that correct how a material is read.

use std::fmt;

use super::reading::Reading;
use super::storage::{Storage, StoredEncoding};
use svbrdf_core::text::quoted;

/// An option of reading with the name of the value that corrects a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    NormalY(&'static str),
    /// Of diffuse or base colour, and of specular where it has a map: `albedo` alone would change specular, too, unless an option or
    /// a sidecar file specifies `specular-albedo`.
    Albedo(&'static str, Option<&'static str>),
    SpecularAlbedo(&'static str),
    Roughness(&'static str),
    Energy(&'static str),
}

impl Remedy {
    /// The option that reads a material, which was read from `storage`, in this reading; `None`: there is none.
    pub fn of(storage: &Storage, reading: Reading) -> Option<Self> {
        let present = storage.roughness.as_deref().unwrap_or("r");
        let specular = |to: StoredEncoding| (!storage.base_colour).then_some(to.name());
        match reading {
            Reading::NormalY => Some(Self::NormalY(if storage.normal_down { "up" } else { "down" })),
            Reading::Colours(to) => Some(Self::Albedo(to.name(), specular(to))),
            Reading::Diffuse(_) if storage.specular == StoredEncoding::Unknown => None,
            Reading::Diffuse(to) => Some(Self::Albedo(to.name(), specular(storage.specular))),
            Reading::Specular(to) => Some(Self::SpecularAlbedo(to.name())),
            Reading::Gloss if present == "gloss" => Some(Self::Roughness("r")),
            Reading::Gloss if present == "r" => Some(Self::Roughness("gloss")),
            Reading::RootOfRoughness if present == "r" => Some(Self::Roughness("alpha")),
            Reading::SquaredRoughness if present == "alpha" => Some(Self::Roughness("r")),
            Reading::Unscaled => Some(Self::Energy("unscaled")),
            Reading::Scaled => Some(Self::Energy("scaled")),
            Reading::NormalX
            | Reading::RedBlue
            | Reading::Gloss
            | Reading::RootOfRoughness
            | Reading::SquaredRoughness => None,
        }
    }

    /// What `--read` takes for the material `name`: `run 2:normal-y=down`.
    pub fn statement(self, name: &str) -> String {
        format!("{name}:{self}")
    }

    /// The option of the command line for the material `name`, quoted for a shell: `--read 'run 2:normal-y=down'`.
    pub fn command_option(self, name: &str) -> String {
        format!("--read {}", quoted(self.statement(name)))
    }
}

/// The options and their values, as `--read` has them: `normal-y=down`, `albedo=srgb,specular-albedo=linear`.
impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NormalY(value) => write!(f, "normal-y={value}"),
            Self::Albedo(value, None) => write!(f, "albedo={value}"),
            Self::Albedo(value, Some(specular)) => write!(f, "albedo={value},specular-albedo={specular}"),
            Self::SpecularAlbedo(value) => write!(f, "specular-albedo={value}"),
            Self::Roughness(value) => write!(f, "roughness={value}"),
            Self::Energy(value) => write!(f, "energy={value}"),
        }
    }
}
