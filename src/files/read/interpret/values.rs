//! Samples that no map may have: NaN, infinity, and what lies outside [0, 1].

use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::options::{NonFinite, ReadOptions};
use crate::files::read::raster::Samples;
use crate::files::read::stored::{Found, Source};

/// Refuses the first NaN or infinity of any map, or says how many will be replaced, as `options` have it.
///
/// # Errors
/// [`Error::OutOfRange`].
pub fn check(found: &mut Found, options: &ReadOptions) -> Result<(), Error> {
    let mut said = Vec::new();
    for (map, source) in found.sources() {
        let count = NotFinite::of(source);
        let Some((index, value)) = count.first else { continue };
        let NotFinite { nans, infinities, .. } = count;
        match options.non_finite.unwrap_or_default() {
            NonFinite::Refuse => {
                return Err(Error::OutOfRange {
                    whose: source.file.display().to_string(),
                    map,
                    column: index % source.raster.width,
                    row: index / source.raster.width,
                    expected: "finite numbers (--non-finite replace puts others in their place)",
                    found: format!("{value}, one of {nans} NaN and {infinities} infinite samples"),
                });
            }
            NonFinite::Replace => {
                let why = format!("{} samples of the {map} map are NaN or infinite", nans + infinities);
                said.push(Assumption::new(What::Values, NonFinite::Replace, why, Certainty::Given));
            }
        }
    }
    found.assumptions.extend(said);
    Ok(())
}

/// How many samples of a map are no numbers, and the first of them.
#[derive(Default)]
struct NotFinite {
    first: Option<(usize, f32)>,
    nans: usize,
    infinities: usize,
}

impl NotFinite {
    fn of(source: &Source) -> Self {
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

/// `value`, or `instead` of NaN and infinity.
pub fn finite(value: f64, instead: f64) -> f64 {
    if value.is_finite() { value } else { instead }
}

/// Values that lay outside [0, 1], how many for each map, and how far.
#[derive(Debug, Default)]
pub struct Clamped {
    maps: Vec<(&'static str, usize, f64, f64)>,
}

impl Clamped {
    /// `value` in [0, 1].
    pub fn unit(&mut self, value: f64, map: &'static str) -> f64 {
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

    /// Says what has been clamped.
    pub fn say(self, found: &mut Found) {
        for (map, count, low, high) in self.maps {
            let why = format!("{count} samples of the {map} map lie outside, between {low} and {high}");
            let clamped = Assumption::new(What::Values, "clamped to [0, 1]", why, Certainty::Unsure);
            found.assumptions.push(clamped);
        }
    }
}
