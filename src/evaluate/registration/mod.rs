//! Registration: which part of a ground truth a prediction is, and at which size both are compared.
//!
//! Methods crop and reduce: the centre 256 x 256 of 288 x 288, or 512 of a scan of 4096. The part is found by the maps themselves, and held
//! by all materials of a method.

pub(crate) mod find;

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use svbrdf_core::error::Error;
use svbrdf_core::material::Material;
use svbrdf_core::material::resize::Kernel;
use svbrdf_core::math::real::Real;

pub(crate) use find::correlation;
pub use find::{Found, common, found};

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
        let [of_truth, of_prediction] = pair.map(Material::size);
        match self {
            Self::Resize(kernel) if of_truth[0] < of_prediction[0] => {
                Ok([truth.clone(), prediction.clone().resized_by(of_truth, kernel)?])
            }
            Self::Resize(kernel) => {
                Ok([truth.clone().resized_by(of_prediction, kernel)?, prediction.clone()])
            }
            Self::CentreCrop => {
                let at = [0, 1].map(|axis| of_truth[axis].saturating_sub(of_prediction[axis]) / 2);
                Ok([part(truth, prediction, at)?, prediction.clone()])
            }
            Self::Crop { x, y, reduced } => {
                let size = of_truth.map(|side| (side / reduced.max(1)).max(1));
                Ok([part(&truth.clone().resized(size)?, prediction, [x, y])?, prediction.clone()])
            }
        }
    }
}

/// The part of `truth` from `at` on that has the size of `prediction`.
fn part<T: Real>(
    truth: &Material<T>,
    prediction: &Material<T>,
    at: [usize; 2],
) -> Result<Material<T>, Error> {
    let ([width, height], size) = (truth.size(), prediction.size());
    if at[0] + size[0] > width || at[1] + size[1] > height {
        svbrdf_core::loss::check_same_size(truth, prediction)?;
    }
    let row = |y: usize| (0..size[0]).map(move |x| (at[1] + y) * width + at[0] + x);
    let texels: Vec<usize> = (0..size[1]).flat_map(row).collect();
    Ok(truth.gathered(&texels, size))
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
