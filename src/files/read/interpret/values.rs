//! Samples that no map may have: NaN, infinity, and what lies outside [0, 1].

use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::options::{NonFinite, ReadOptions};
use crate::files::read::samples::Outside;
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
            for (index, value) in channel.not_finite() {
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

/// `value` in [0, 1], or `instead` of NaN and infinity.
pub fn unit(value: f64, instead: f64) -> f64 {
    finite(value, instead).clamp(0.0, 1.0)
}

/// Values that lay outside [0, 1], how many for each map, and how far.
#[derive(Debug, Default)]
pub struct Clamped {
    maps: Vec<(&'static str, Outside)>,
}

impl Clamped {
    /// Adds what lies outside [0, 1] in the map `map`.
    pub fn add(&mut self, outside: Outside, map: &'static str) {
        match self.maps.iter_mut().find(|(name, _)| *name == map) {
            Some((_, sum)) => *sum = sum.merged(outside),
            None if outside.count > 0 => self.maps.push((map, outside)),
            None => (),
        }
    }

    /// Says what has been clamped.
    pub fn say(self, found: &mut Found) {
        for (map, Outside { count, low, high }) in self.maps {
            let why = format!("{count} samples of the {map} map lie outside, between {low} and {high}");
            let clamped = Assumption::new(What::Values, "clamped to [0, 1]", why, Certainty::Unsure);
            found.assumptions.push(clamped);
        }
    }
}
