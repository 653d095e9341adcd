//! The interval of a mean over materials, and the signs of few paired differences.

use std::ops::RangeInclusive;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

/// Resamples.
const RESAMPLES: usize = 2000;

/// The fewest values whose mean has an interval. Where one material in ten is far worse than the others, one sample in 14 of so many
/// has none of these, and no method could tell; of 10 values it is one in three.
pub const FEWEST: usize = 25;

/// The least error of a resample, as a share of that of the values. Resamples of few values may leave out the one that differs; their
/// own error would say that the mean is known exactly.
const LEAST: f64 = 0.1;

/// The 95% interval of the mean of what `values` of any sign are a sample of, by the bootstrap-t (Efron 1981); `None` for fewer than
/// [`FEWEST`] values, and where a value is not finite.
///
/// Resamples give the distribution of the studentized mean (m* - m) / s*; its quantiles take the place of those of Student's t. The
/// resamples are always the same ones.
pub fn interval_of_mean(values: &[f64]) -> Option<[f64; 2]> {
    let is_known = values.len() >= FEWEST && values.iter().all(|value| value.is_finite());
    let Moments { mean, error } = is_known.then(|| Moments::of(values))?;
    if error == 0.0 {
        return Some([mean; 2]);
    }
    let [low, high] =
        quantiles(values, |resample| (resample.mean - mean) / resample.error.max(LEAST * error));
    Some([mean - high * error, mean - low * error])
}

/// The same of values within a range, which has their mean, too.
pub fn interval_of_mean_within(values: &[f64], range: &RangeInclusive<f64>) -> Option<[f64; 2]> {
    Some(interval_of_mean(values)?.map(|end| end.clamp(*range.start(), *range.end())))
}

/// The 95% interval of the median of what `differences` are a sample of: two order statistics of them, whatever their distribution; `None`
/// for fewer than 6. Few materials separate two methods by the signs of their differences.
pub fn interval_of_median(differences: &[f64]) -> Option<[f64; 2]> {
    let (mut sorted, count) = (differences.to_vec(), differences.len());
    sorted.sort_by(f64::total_cmp);
    // The probability that at most `place` of the values are below the median.
    let (mut term, mut below, mut place) = (0.5_f64.powi(count as i32), 0.0, None);
    for next in 0..count.div_ceil(2) {
        below += term;
        if below > 0.025 {
            break;
        }
        place = Some(next);
        term *= (count - next) as f64 / (next + 1) as f64;
    }
    place.map(|place| [sorted[place], sorted[count - 1 - place]])
}

/// Whether differences do not separate two methods: the interval of their mean, or of few materials their signs.
pub(super) fn may_be_0(differences: &[f64]) -> bool {
    let interval = interval_of_mean(differences).or_else(|| interval_of_median(differences));
    interval.is_none_or(|[low, _]| low <= 0.0)
}

/// A mean and its standard error.
#[derive(Clone, Copy)]
struct Moments {
    mean: f64,
    error: f64,
}

impl Moments {
    fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
        Self { mean, error: (squares / (count * (count - 1.0))).sqrt() }
    }
}

/// The 2.5% and 97.5% quantiles of what `studentized` makes of resamples.
fn quantiles(values: &[f64], studentized: impl Fn(Moments) -> f64) -> [f64; 2] {
    let mut generator = ChaCha8Rng::seed_from_u64(0);
    let mut resample = vec![0.0; values.len()];
    let one = |_| {
        resample.iter_mut().for_each(|value| *value = values[generator.random_range(0..values.len())]);
        studentized(Moments::of(&resample))
    };
    let mut all: Vec<f64> = (0..RESAMPLES).map(one).collect();
    all.sort_by(f64::total_cmp);
    [0.025, 0.975].map(|share| all[(share * (RESAMPLES - 1) as f64).round() as usize])
}
