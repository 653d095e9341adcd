//! Values of samples: choices about them, recorded as assumptions, and those outside the range of a map.

use std::fmt::Display;

use crate::error::Error;
use crate::read::options::{NonFinite, ReadOptions, Role};
use crate::read::raster::OutOfRange;
use crate::read::record::{Assumption, Certainty, Reason, What};
use crate::read::stored::{Inferred, StoredMap, StoredMaterial};

/// Refuses the first NaN or infinity of any map, or records how many will be replaced, as `options` specify.
///
/// # Errors
/// [`Error::NotFinite`].
pub(crate) fn check(found: &mut StoredMaterial, options: &ReadOptions) -> Result<(), Error> {
    let mut replaced = Vec::new();
    for (map, source) in found.sources() {
        let count = NotFinite::of(source);
        let Some((index, value)) = count.first else { continue };
        let NotFinite { nans, infinities, .. } = count;
        match options.non_finite.unwrap_or_default() {
            NonFinite::Refuse => {
                return Err(Error::NotFinite {
                    path: source.file.clone(),
                    map: map.name(),
                    column: index % source.raster.width,
                    row: index / source.raster.width,
                    value,
                    nans,
                    infinities,
                });
            }
            NonFinite::Replace => {
                let why = Reason::NotFinite { map, count: nans + infinities };
                replaced.push(Assumption::new(What::Values, NonFinite::Replace, why, Certainty::Given));
            }
        }
    }
    found.assumptions.extend(replaced);
    Ok(())
}

/// How many samples of a map are not finite, and the first of them.
#[derive(Default)]
struct NotFinite {
    first: Option<(usize, f32)>,
    nans: usize,
    infinities: usize,
}

impl NotFinite {
    fn of(source: &StoredMap) -> Self {
        let mut count = Self::default();
        for channel in &source.raster.channels {
            for (index, value) in channel.not_finite() {
                count.first = count.first.or(Some((index, value)));
                if value.is_nan() { count.nans += 1 } else { count.infinities += 1 }
            }
        }
        count
    }
}

/// `value`, or `instead` if it is NaN or infinite.
pub(crate) fn finite(value: f64, instead: f64) -> f64 {
    if value.is_finite() { value } else { instead }
}

/// `value` in [0, 1], or `instead` of NaN and infinity.
pub(crate) fn unit(value: f64, instead: f64) -> f64 {
    finite(value, instead).clamp(0.0, 1.0)
}

/// Values that lay outside [0, 1], how many for each map, and how far.
#[derive(Debug, Default)]
pub(crate) struct Clamped {
    maps: Vec<(Role, OutOfRange)>,
}

impl Clamped {
    /// Adds the numbers of the map `map` that lie outside [0, 1].
    pub(crate) fn add(&mut self, numbers: OutOfRange, map: Role) {
        match self.maps.iter_mut().find(|(role, _)| *role == map) {
            Some((_, sum)) => *sum = sum.merged(numbers),
            None if numbers.count > 0 => self.maps.push((map, numbers)),
            None => (),
        }
    }

    /// Records the values that have been clamped.
    pub(crate) fn record(self, assumptions: &mut Vec<Assumption>) {
        for (map, OutOfRange { count, low, high }) in self.maps {
            let why = Reason::OutsideUnit { map, count, low, high };
            let clamped = Assumption::new(What::Values, "clamped to [0, 1]", why, Certainty::Unsure);
            assumptions.push(clamped);
        }
    }
}

/// The `specified` value, else the `inferred`, else the `detected` one; recorded.
pub(crate) fn decide<T: Copy + Display>(
    assumptions: &mut Vec<Assumption>,
    what: What,
    specified: Option<T>,
    inferred: Inferred<T>,
    detected: impl FnOnce() -> (T, Reason, Certainty),
) -> T {
    if let Some(value) = specified {
        assumptions.push(Assumption::given(what, value));
        return value;
    }
    let (value, why, certainty) = inferred.unwrap_or_else(detected);
    assumptions.push(Assumption::new(what, value, why, certainty));
    value
}
