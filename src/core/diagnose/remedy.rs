//! The options of reading that correct how a prediction is read.

use std::fmt;

use super::reading::Reading;
use super::storage::{Storage, Transfer};
use crate::text::quoted;

/// An option of reading with the name of the value that corrects a prediction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    NormalY(&'static str),
    Albedo(&'static str),
    SpecularAlbedo(&'static str),
    Roughness(&'static str),
    Energy(&'static str),
}

impl Remedy {
    /// The option that reads a prediction, which was read from `storage`, in this reading; `None`: there is none.
    pub(super) fn of(storage: &Storage, reading: Reading) -> Option<Self> {
        let present = storage.roughness.as_deref().unwrap_or("r");
        let encoding = |transfer| if transfer == Transfer::Linear { "linear" } else { "srgb" };
        match reading {
            Reading::NormalY => Some(Self::NormalY(if storage.normal_down { "up" } else { "down" })),
            Reading::Colours(to) => Some(Self::Albedo(encoding(to))),
            Reading::Specular(to) => Some(Self::SpecularAlbedo(encoding(to))),
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
        format!("--read {}", quoted(&self.statement(name)))
    }

    /// The name of the value.
    pub fn value(self) -> &'static str {
        match self {
            Self::NormalY(value)
            | Self::Albedo(value)
            | Self::SpecularAlbedo(value)
            | Self::Roughness(value)
            | Self::Energy(value) => value,
        }
    }

    /// The name of the option.
    pub fn option(self) -> &'static str {
        match self {
            Self::NormalY(_) => "normal-y",
            Self::Albedo(_) => "albedo",
            Self::SpecularAlbedo(_) => "specular-albedo",
            Self::Roughness(_) => "roughness",
            Self::Energy(_) => "energy",
        }
    }
}

/// The option and its value, as `--read` and a sidecar file have them: `normal-y=down`.
impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.option(), self.value())
    }
}
