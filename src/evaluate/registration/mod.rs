//! Registration: which part of a ground truth a prediction is, and at which size both are compared.
//!
//! Methods crop and reduce: the centre 256 x 256 of 288 x 288, or 512 of a scan of 4096. The part is found by the maps themselves, and held
//! by all materials of a method.

pub(crate) mod find;

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use svbrdf_core::error::Error;
use svbrdf_core::loss::check_same_size;
use svbrdf_core::material::resize::Kernel;
use svbrdf_core::material::{Mask, Material};
use svbrdf_core::math::real::Real;

pub(crate) use find::correlations;
pub use find::{Found, Registered, common, found, registered};

/// How a prediction lies on its ground truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Registration {
    /// The same surface in another size: the larger one is reduced to the size of the smaller one.
    Resize(Kernel),
    /// The prediction is the centre of the ground truth.
    CentreCrop,
    /// The prediction is the part of the ground truth, reduced by `reduced`, whose upper left texel is at (x, y).
    Crop { x: usize, y: usize, reduced: usize },
}

impl Registration {
    /// The ground truth and the prediction in one size.
    ///
    /// # Errors
    /// [`Error::SizesDiffer`] where the prediction is no such part, and those of [`Material::resized`].
    pub fn applied<T: Real>(self, pair: [&Material<T>; 2]) -> Result<[Material<T>; 2], Error> {
        let [truth, prediction] = pair;
        let Place { whole, at, size, kernel } = self.place(pair.map(Material::size));
        let truth = truth.clone().resized_by(whole, kernel)?;
        let prediction = prediction.clone().resized_by(size, kernel)?;
        if (0..2).any(|axis| at[axis] + size[axis] > whole[axis]) {
            check_same_size(&truth, &prediction)?;
        }
        if whole == size {
            return Ok([truth, prediction]);
        }
        let row = |y: usize| (0..size[0]).map(move |x| (at[1] + y) * whole[0] + at[0] + x);
        let texels: Vec<usize> = (0..size[1]).flat_map(row).collect();
        Ok([truth.gathered(&texels, size), prediction])
    }

    /// The part of a ground truth that is compared, as shares of its width and height: least and greatest; by the sizes of the ground truth
    /// and the prediction.
    pub fn part(self, sizes: [[usize; 2]; 2]) -> [[f32; 2]; 2] {
        let Place { whole, at, size, .. } = self.place(sizes);
        [[0; 2], size]
            .map(|corner| [0, 1].map(|axis| (at[axis] + corner[axis]) as f32 / whole[axis].max(1) as f32))
    }

    /// The part of the mask of a ground truth that a prediction of this size is compared with; `None` where it keeps no texel.
    pub fn of_mask(self, mask: &Mask, prediction: [usize; 2]) -> Option<Mask> {
        let Place { whole, at, size, .. } = self.place([mask.size(), prediction]);
        mask.resized(whole)?.part(at, size)
    }

    /// Where a prediction lies, by the sizes of the ground truth and its own.
    fn place(self, [truth, prediction]: [[usize; 2]; 2]) -> Place {
        let kernel = if let Self::Resize(kernel) = self { kernel } else { Kernel::Area };
        let (whole, at, size) = match self {
            Self::Resize(_) if truth[0] < prediction[0] => (truth, [0; 2], truth),
            Self::Resize(_) => (prediction, [0; 2], prediction),
            Self::CentreCrop => {
                let at = [0, 1].map(|axis| truth[axis].saturating_sub(prediction[axis]) / 2);
                (truth, at, prediction)
            }
            Self::Crop { x, y, reduced } => {
                (truth.map(|side| (side / reduced.max(1)).max(1)), [x, y], prediction)
            }
        };
        Place { whole, at, size, kernel }
    }
}

/// A material in one size with others, or why there is none; `None` where it stays as it is.
pub type InOneSize<T> = Option<Result<Material<T>, Error>>;

/// A ground truth and its predictions in one size.
pub type AllInOneSize<T> = (Material<T>, Vec<InOneSize<T>>);

/// A ground truth and its predictions, each with how it is registered, in the size of the first one whose registration is known and
/// that has another size than the ground truth; `None` without one. An error where that one is no such part of the ground truth.
pub fn in_one_size<T: Real>(
    truth: &Material<T>,
    predictions: &[(Option<&Material<T>>, Option<Registration>)],
) -> Option<Result<AllInOneSize<T>, Error>> {
    let is_other = |one: &&Material<T>| one.size() != truth.size();
    let (way, sample) = predictions.iter().find_map(|(one, way)| Some(((*way)?, one.filter(is_other)?)))?;
    let part = |whole: &Material<T>| way.applied([whole, sample]).map(|[part, _]| part);
    let of = |(one, its): &(Option<&Material<T>>, Option<Registration>)| match one.filter(is_other) {
        None => one.map(part),
        Some(other) => {
            (*its == Some(way)).then(|| way.applied([truth, other]).map(|[_, prediction]| prediction))
        }
    };
    Some(part(truth).map(|cut| (cut, predictions.iter().map(of).collect())))
}

/// The place of a prediction on its ground truth.
struct Place {
    /// The size that the ground truth is resized to.
    whole: [usize; 2],
    /// The upper left texel of its part.
    at: [usize; 2],
    /// The size of this part, which the prediction is resized to.
    size: [usize; 2],
    kernel: Kernel,
}

/// As it is typed: `resize`, `resize=cubic`, `centre-crop`, `crop=16,16` or `crop=16,16/4`.
impl fmt::Display for Registration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Resize(Kernel::Area) => f.write_str("resize"),
            Self::Resize(Kernel::Cubic) => f.write_str("resize=cubic"),
            Self::CentreCrop => f.write_str("centre-crop"),
            Self::Crop { x, y, reduced: 1 } => write!(f, "crop={x},{y}"),
            Self::Crop { x, y, reduced } => write!(f, "crop={x},{y}/{reduced}"),
        }
    }
}

impl FromStr for Registration {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let crop = || {
            let (place, reduced) = text.strip_prefix("crop=")?.split_once('/').unwrap_or((&text[5..], "1"));
            let (x, y) = place.split_once(',')?;
            let reduced = reduced.parse().ok().filter(|reduced| (1..=64).contains(reduced))?;
            Some(Self::Crop { x: x.parse().ok()?, y: y.parse().ok()?, reduced })
        };
        let known = match text {
            "resize" => Some(Self::Resize(Kernel::Area)),
            "resize=cubic" => Some(Self::Resize(Kernel::Cubic)),
            "centre-crop" => Some(Self::CentreCrop),
            _ => crop(),
        };
        let ways = "resize, resize=cubic, centre-crop, crop=X,Y or crop=X,Y/N of a ground truth reduced by N";
        known.ok_or_else(|| Error::unknown_name("registration", text, ways))
    }
}

impl Serialize for Registration {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Registration {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}
