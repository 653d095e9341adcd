//! Storage of the maps of a material, as far as a diagnosis uses it.

use serde::{Deserialize, Serialize};

use svbrdf_core::math::srgb;

/// The encoding of a stored colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StoredEncoding {
    /// Not known, as for arrays.
    #[default]
    Unknown,
    Linear,
    Srgb,
    /// The power 1 / 2.2.
    Gamma22,
    /// Another one.
    Other,
}

impl StoredEncoding {
    /// Its name as a value of an option of reading.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Gamma22 => "gamma2.2",
            Self::Srgb | Self::Unknown => "srgb",
            Self::Other => "log",
        }
    }

    /// The stored value of a linear one, both in [0, 1]; unknown encodings count as linear.
    pub fn encode(self, value: f32) -> f32 {
        match self {
            Self::Srgb => srgb::encode(value),
            Self::Gamma22 => value.powf(1.0 / 2.2),
            Self::Unknown | Self::Linear | Self::Other => value,
        }
    }

    /// The inverse of [`StoredEncoding::encode`].
    pub fn decode(self, value: f32) -> f32 {
        match self {
            Self::Srgb => srgb::decode(value),
            Self::Gamma22 => value.powf(2.2),
            Self::Unknown | Self::Linear | Self::Other => value,
        }
    }
}

/// How the maps of a material are stored, and how their values were read.
#[derive(Clone, Debug, PartialEq)]
pub struct Storage {
    /// The encoding of diffuse or base colour.
    pub colours: StoredEncoding,
    /// The encoding of specular.
    pub specular: StoredEncoding,
    /// Whether diffuse and specular follow from a base colour and metallic, so that there is no map of specular.
    pub base_colour: bool,
    /// Whether y of normals was read as pointing down.
    pub normal_down: bool,
    /// The reading of roughness values by the name of its option, such as "gloss"; `None`: r, or unknown.
    pub roughness: Option<String>,
    /// Whether diffuse was read as not scaled by (1 - specular).
    pub unscaled: bool,
    /// The distance between two stored values of normal, diffuse, specular and roughness, for stored values in [0, 1]; 0: floats.
    pub steps: [f64; 4],
}

impl Storage {
    /// Of arrays: unknown readings, and values without steps.
    pub fn exact() -> Self {
        Self { steps: [0.0; 4], ..Self::default() }
    }

    /// Whether a map has steps, so that a loss may be too small to be resolved; floats resolve every loss.
    pub fn has_steps(&self) -> bool {
        self.steps.iter().any(|step| *step > 0.0)
    }

    /// The other encodings in which colours may be stored; none where values of the present one cannot be encoded again.
    pub fn encodings(transfer: StoredEncoding) -> &'static [StoredEncoding] {
        match transfer {
            StoredEncoding::Unknown => &[StoredEncoding::Linear, StoredEncoding::Srgb],
            StoredEncoding::Linear => &[StoredEncoding::Srgb, StoredEncoding::Gamma22],
            StoredEncoding::Srgb => &[StoredEncoding::Linear, StoredEncoding::Gamma22],
            StoredEncoding::Gamma22 => &[StoredEncoding::Linear, StoredEncoding::Srgb],
            StoredEncoding::Other => &[],
        }
    }
}

impl Default for Storage {
    /// Unknown readings of 8 bits.
    fn default() -> Self {
        Self {
            colours: StoredEncoding::Unknown,
            specular: StoredEncoding::Unknown,
            base_colour: false,
            normal_down: false,
            roughness: None,
            unscaled: false,
            steps: [1.0 / 255.0; 4],
        }
    }
}
