//! Samples outside the range of a map: NaN, infinity, and values outside [0, 1].

use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::options::{NonFinite, ReadOptions};
use crate::files::read::raster::Samples;
use crate::files::read::reason::Reason;
use crate::files::read::role::Role;
use crate::files::read::stored::{StoredMap, StoredMaterial};

/// Refuses the first NaN or infinity of any map, or records how many will be replaced, as `options` specify.
///
/// # Errors
/// [`Error::NotFinite`].
pub fn check(found: &mut StoredMaterial, options: &ReadOptions) -> Result<(), Error> {
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
            let Samples::Floats(values) = channel else { continue };
            for (index, &value) in values.iter().enumerate().filter(|(_, v)| !v.is_finite()) {
                count.first = count.first.or(Some((index, value)));
                if value.is_nan() { count.nans += 1 } else { count.infinities += 1 }
            }
        }
        count
    }
}

/// `value`, or `instead` if it is NaN or infinite.
pub fn finite(value: f64, instead: f64) -> f64 {
    if value.is_finite() { value } else { instead }
}

/// Values that lay outside [0, 1], how many for each map, and how far.
#[derive(Debug, Default)]
pub struct Clamped {
    maps: Vec<(Role, usize, f64, f64)>,
}

impl Clamped {
    /// `value` in [0, 1].
    pub fn unit(&mut self, value: f64, map: Role) -> f64 {
        if (0.0..=1.0).contains(&value) {
            return value;
        }
        let place = self.maps.iter().position(|m| m.0 == map).unwrap_or_else(|| {
            self.maps.push((map, 0, 0.0, 1.0));
            self.maps.len() - 1
        });
        let entry = &mut self.maps[place];
        *entry = (map, entry.1 + 1, entry.2.min(value), entry.3.max(value));
        value.clamp(0.0, 1.0)
    }

    /// Records what has been clamped.
    pub fn record(self, found: &mut StoredMaterial) {
        for (map, count, low, high) in self.maps {
            let why = Reason::OutsideUnit { map, count, low, high };
            let clamped = Assumption::new(What::Values, "clamped to [0, 1]", why, Certainty::Unsure);
            found.assumptions.push(clamped);
        }
    }
}
