//! Evidence of heights about the direction of y in the normals beside them.
//!
//! A map of heights is decoded here, and only where the user and the names leave the direction open, or the normals
//! contradict their name.

use std::path::PathBuf;

use crate::read::decode;
use crate::read::measure;
use crate::read::options::{NormalY, ReadOptions};
use crate::read::raster::Raster;
use crate::read::record::{Certainty, Subject};
use crate::read::stored::{StoredHeight, StoredMaterial};

/// Least correlation of both slopes that tells a direction: of the sets of libraries that were measured 10 of 11 lie
/// above it, and all of them are right.
const TELLING: f64 = 0.15;
/// Below this curl correlation a map contradicts a name that states y up, above its opposite one that states y down.
const CONTRADICTS: f64 = 0.3;

/// The direction of y that the heights of a material show.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::read) struct HeightEvidence {
    pub file: PathBuf,
    /// Correlations of the slopes with x and with y of the normals.
    pub correlations: [f64; 2],
}

impl HeightEvidence {
    pub(in crate::read) fn y(&self) -> NormalY {
        let [x, y] = self.correlations;
        if x * y > 0.0 { NormalY::Up } else { NormalY::Down }
    }
}

/// The evidence of the heights of a material that is to be read with `options`.
pub(super) fn evidence(found: &StoredMaterial, options: &ReadOptions) -> Option<HeightEvidence> {
    let (normal, height) = (&found.normal.as_ref()?.raster, found.height.as_ref()?);
    let is_specified = options.normal_y.or(options.preset.and_then(|p| p.options().normal_y)).is_some();
    if is_specified || is_named(found, normal) {
        return None;
    }
    let (raster, file) = match height {
        StoredHeight::File(file) => {
            (decode::one(file, Subject::Picture).ok()?.0.raster, file.path().to_owned())
        }
        StoredHeight::Picture { raster, file } => (raster.clone(), file.clone()),
    };
    let correlations = measure::slope_correlations(normal, &raster)?;
    let is_telling = correlations.iter().all(|one| one.abs() >= TELLING);
    is_telling.then_some(HeightEvidence { file, correlations })
}

/// Whether a name or a specification states the direction, and the normals do not contradict it.
fn is_named(found: &StoredMaterial, normal: &Raster) -> bool {
    let Some((y, _, Certainty::Sure)) = &found.inferred.normal_y else { return false };
    let curl = measure::curl(normal.width, normal.height, |index| normal.rgb(index).map(|c| 2.0 * c - 1.0));
    !curl.is_some_and(|curl| if *y == NormalY::Up { curl < -CONTRADICTS } else { curl > CONTRADICTS })
}
