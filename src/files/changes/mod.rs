//! Changes of a material that may explain a loss: its values in another reading, its texels elsewhere, its radiance brighter.

mod placement;
mod reading;

use std::fmt;

use serde::{Deserialize, Serialize};

use svbrdf_core::error::Error;
use svbrdf_core::material::{Material, Planes};

pub use placement::{Placement, Symmetry, Taps, interpolated};
pub use reading::Reading;

use crate::read::Storage;

/// A change that is tried on a prediction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Change {
    /// Its radiance times 2^stops, for red, green and blue.
    Exposure([f64; 3]),
    /// It is moved back from this displacement (right, down), in texels.
    Shift([i32; 2]),
    /// It is moved back by parts of a texel, from another scale.
    Placement(Placement),
    Symmetry(Symmetry),
    /// Its diffuse times this.
    DiffuseFactor(f64),
    /// Its specular times this.
    SpecularFactor(f64),
    Reading(Reading),
    /// The ground truth in another reading; the prediction stays as it is.
    GroundTruth(Reading),
}

impl Change {
    /// Whether maps of a prediction of this size (width, height) show it: an exposure changes no map, and only square maps are
    /// transposed.
    pub fn fits(self, size: [usize; 2]) -> bool {
        match self {
            Self::Exposure(_) | Self::GroundTruth(_) => false,
            Self::Symmetry(symmetry) => Symmetry::of(size).any(|of_size| of_size == symmetry),
            Self::Shift(_) | Self::Placement(_) | Self::Reading(_) => true,
            Self::DiffuseFactor(_) | Self::SpecularFactor(_) => true,
        }
    }

    /// `prediction`, whose values were read from `storage`, after the change. What a shift moves out on one side enters on the other.
    /// Where the change does not [fit](Change::fits), the prediction itself.
    ///
    /// # Errors
    /// Those of [`Material::new`], which values of a material do not give.
    pub fn applied(self, prediction: &Material<f32>, storage: &Storage) -> Result<Material<f32>, Error> {
        match self {
            _ if !self.fits(prediction.size()) => Ok(prediction.clone()),
            Self::Exposure(_) | Self::GroundTruth(_) => Ok(prediction.clone()),
            Self::Shift(by) => Ok(shifted(prediction, by.map(i32::saturating_neg))),
            Self::Placement(placement) => placement.applied(prediction),
            Self::Symmetry(symmetry) => symmetry.applied(prediction),
            Self::Reading(_) | Self::DiffuseFactor(_) | Self::SpecularFactor(_) => {
                self.of_values(prediction, storage)
            }
        }
    }

    /// Where the texel was that is at `texel` of a prediction of `size` (width, height) after the change, as row * width + column. A
    /// placement is between texels, and leaves them.
    pub fn before(self, texel: usize, size: [usize; 2]) -> usize {
        match self {
            Self::Shift(by) => before_shift(texel, by.map(i32::saturating_neg), size),
            Self::Symmetry(symmetry) => symmetry.before(texel, size),
            _ => texel,
        }
    }

    /// What the change does to the values of texels of a prediction, wherever these are.
    ///
    /// # Errors
    /// As [`Self::applied`].
    pub fn of_values(self, texels: &Material<f32>, storage: &Storage) -> Result<Material<f32>, Error> {
        match self {
            Self::Symmetry(symmetry) => symmetry.turned(texels),
            Self::Reading(reading) => reading.applied(texels, storage),
            Self::DiffuseFactor(factor) => scaled(texels, factor, |planes| &mut planes.diffuse),
            Self::SpecularFactor(factor) => scaled(texels, factor, |planes| &mut planes.specular),
            _ => Ok(texels.clone()),
        }
    }
}

/// Values of a map times `factor`, as far as they stay in [0, 1].
fn scaled(
    material: &Material<f32>,
    factor: f64,
    map: fn(&mut Planes<f32>) -> &mut [Vec<f32>; 3],
) -> Result<Material<f32>, Error> {
    let (mut planes, factor) = (material.planes().clone(), factor.clamp(0.0, f64::from(f32::MAX)) as f32);
    map(&mut planes).iter_mut().flatten().for_each(|value| *value = (*value * factor).min(1.0));
    Material::new(material.name(), material.width(), material.height(), planes)
}

/// `moved 3 texels left`, `rotated by 180 degrees`, `Y of normals flipped`.
impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exposure([red, green, blue]) if red == green && green == blue => {
                write!(f, "exposure {red:+.2} stops")
            }
            Self::Exposure([red, green, blue]) => {
                write!(f, "exposure {red:+.2} {green:+.2} {blue:+.2} stops")
            }
            Self::Shift(by) => write!(f, "moved {}", displacement(by.map(|by| -f64::from(by)))),
            Self::Placement(placement) => {
                let Placement { scale, by } = placement.inverse();
                // Where it is found within a 64th of a texel.
                let by = displacement(by.map(|by| (by * 20.0).round() / 20.0));
                match (by.as_str(), (scale - 1.0).abs() < 5e-5) {
                    ("", _) => write!(f, "scaled by {scale:.4}"),
                    (_, true) => write!(f, "moved {by}"),
                    (_, false) => write!(f, "scaled by {scale:.4} and moved {by}"),
                }
            }
            Self::DiffuseFactor(factor) => write!(f, "diffuse times {factor:.3}"),
            Self::SpecularFactor(factor) => write!(f, "specular times {factor:.3}"),
            Self::Symmetry(symmetry) => f.write_str(symmetry.words()),
            Self::Reading(reading) => f.write_str(reading.words()),
            Self::GroundTruth(reading) => write!(f, "ground truth with {}", reading.words()),
        }
    }
}

/// `3 texels left and 1 texel down`; a direction without a displacement is left out.
pub fn displacement([right, down]: [f64; 2]) -> String {
    let parts = [(right, ["right", "left"]), (down, ["down", "up"])];
    let parts = parts.into_iter().filter(|(count, _)| *count != 0.0);
    parts.map(|(count, names)| texels(count, names)).collect::<Vec<_>>().join(" and ")
}

fn texels(count: f64, [positive, negative]: [&str; 2]) -> String {
    let unit = if count.abs() == 1.0 { "texel" } else { "texels" };
    format!("{} {unit} {}", count.abs(), if count < 0.0 { negative } else { positive })
}

/// The material moved by (right, down) texels; what leaves on one side enters on the other.
pub fn shifted(material: &Material<f32>, by: [i32; 2]) -> Material<f32> {
    let [width, height] = material.size();
    let texels: Vec<usize> =
        (0..width * height).map(|texel| before_shift(texel, by, [width, height])).collect();
    material.gathered(&texels, [width, height])
}

/// Where the texel was that is at `texel` of a map of `size` after it was moved by (right, down).
fn before_shift(texel: usize, [right, down]: [i32; 2], [width, height]: [usize; 2]) -> usize {
    let back =
        |at: usize, by: i32, count: usize| (at as i64 - i64::from(by)).rem_euclid(count as i64) as usize;
    back(texel / width, down, height) * width + back(texel % width, right, width)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::Albedo;
    use crate::samples;

    #[test]
    fn a_change_of_a_session_file_is_read_as_it_was_written_and_never_fails_on_a_material() {
        let square = samples::load::<f32>().unwrap().ground_truth.material.resized([8, 8]).unwrap();
        let wide = square.clone().resized([12, 4]).unwrap();
        let changes = Symmetry::ALL.map(Change::Symmetry).into_iter().chain([
            Change::Exposure([0.5, 0.0, -1.0]),
            Change::Shift([i32::MIN, i32::MAX]),
            Change::Placement(Placement { scale: 1.01, by: [0.5, -1e300] }),
            Change::SpecularFactor(-1e300),
            Change::DiffuseFactor(1e300),
            Change::Reading(Reading::Gloss),
            Change::Reading(Reading::Colours(Albedo::Srgb)),
        ]);
        for change in changes {
            let text = serde_json::to_string(&change).unwrap();
            assert_eq!(serde_json::from_str::<Change>(&text).unwrap(), change, "{text}");
            for material in [&square, &wide] {
                let changed = change.applied(material, &Storage::default()).unwrap();
                assert_eq!(changed.size(), material.size());
                assert!(change.fits(material.size()) || changed == *material, "{change}");
            }
        }
        assert!(serde_json::from_str::<Change>(r#"{"symmetry":"twist"}"#).is_err());
        assert_ne!(Change::Shift([1, 0]).applied(&square, &Storage::default()).unwrap(), square);
    }
}
