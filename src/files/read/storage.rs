//! Storage of the maps of a material, as far as a diagnosis uses it.

use super::options::transfer::{encoded, linear};
use super::options::{Albedo, Roughness};

/// How the maps of a material are stored, and how their values were read.
#[derive(Clone, Debug, PartialEq)]
pub struct Storage {
    /// The encoding of diffuse or base colour; `None` where it is not known, as for arrays.
    pub colours: Option<Albedo>,
    /// The encoding of specular.
    pub specular: Option<Albedo>,
    /// Whether diffuse and specular follow from a base colour and metallic, so that there is no map of specular.
    pub base_colour: bool,
    /// Whether y of normals was read as pointing down.
    pub normal_down: bool,
    /// How far the lengths of the stored normals are from 1 on average, where more than rounding explains; else 0.
    pub off_unit: f64,
    /// The reading of roughness values; r where it is not known.
    pub roughness: Roughness,
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

    /// The stored value of a linear one, both in [0, 1]; of an encoding that is unknown or logarithmic it counts as linear.
    pub fn encode(encoding: Option<Albedo>, value: f32) -> f32 {
        power(encoding).map_or(value, |encoding| encoded(value, encoding))
    }

    /// The inverse of [`Storage::encode`].
    pub fn decode(encoding: Option<Albedo>, value: f32) -> f32 {
        power(encoding).map_or(value, |encoding| linear(value, encoding))
    }

    /// The other encodings in which colours may be stored; none where values of the present one cannot be encoded again.
    pub fn encodings(present: Option<Albedo>) -> &'static [Albedo] {
        match present {
            None | Some(Albedo::Gamma22) => &[Albedo::Linear, Albedo::Srgb],
            Some(Albedo::Linear) => &[Albedo::Srgb, Albedo::Gamma22],
            Some(Albedo::Srgb) => &[Albedo::Linear, Albedo::Gamma22],
            Some(Albedo::Log) => &[],
        }
    }
}

fn power(encoding: Option<Albedo>) -> Option<Albedo> {
    encoding.filter(|encoding| *encoding != Albedo::Log)
}

impl Default for Storage {
    /// Unknown readings of 8 bits.
    fn default() -> Self {
        Self {
            colours: None,
            specular: None,
            base_colour: false,
            normal_down: false,
            off_unit: 0.0,
            roughness: Roughness::R,
            unscaled: false,
            steps: [1.0 / 255.0; 4],
        }
    }
}
