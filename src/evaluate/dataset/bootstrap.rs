//! The interval of a mean over materials, whose losses are skewed.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

/// Resamples.
const RESAMPLES: usize = 2000;

/// The fewest values whose mean has an interval: of four exponential values it is four times as wide as of five.
pub const FEWEST: usize = 5;

/// The least error of a resample, as a share of that of the values. Resamples of few values may leave out the one that differs; their
/// own error would say that the mean is known exactly.
const LEAST: f64 = 0.1;

/// The 95% interval of the mean of what `values` of any sign are a sample of, by the bootstrap-t (Efron 1981); `None` for fewer than
/// [`FEWEST`] values, and where an end is not finite.
///
/// Resamples give the distribution of the studentized mean (m* - m) / s*; its quantiles take the place of those of Student's t. For
/// means of few skewed values it covers better than BCa. The resamples are always the same ones.
pub fn interval_of_mean(values: &[f64]) -> Option<[f64; 2]> {
    let Moments { mean, error } = sample(values)?;
    if error == 0.0 {
        return Some([mean; 2]);
    }
    let [low, high] =
        quantiles(values, |resample| (resample.mean - mean) / resample.error.max(LEAST * error));
    finite([mean - high * error, mean - low * error])
}

/// The 95% interval of the mean of what `values` of 0 or more are a sample of, as [`interval_of_mean`], but of the logarithm of the mean
/// (whose error is s / m): its ends are positive, as the mean is.
pub fn interval_of_positive_mean(values: &[f64]) -> Option<[f64; 2]> {
    let Moments { mean, error } = sample(values)?;
    if error == 0.0 {
        return Some([mean; 2]);
    }
    let relative = error / mean;
    let studentized = |resample: Moments| {
        (resample.mean / mean).ln() / (resample.error / resample.mean).max(LEAST * relative)
    };
    let [low, high] = quantiles(values, studentized);
    finite([high, low].map(|quantile| mean * (-quantile * relative).exp()))
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

/// The moments of values that have an interval.
fn sample(values: &[f64]) -> Option<Moments> {
    (values.len() >= FEWEST && values.iter().all(|value| value.is_finite())).then(|| Moments::of(values))
}

/// The 2.5% and 97.5% quantiles of what `studentized` makes of resamples.
fn quantiles(values: &[f64], studentized: impl Fn(Moments) -> f64) -> [f64; 2] {
    let mut generator = ChaCha8Rng::seed_from_u64(0);
    let mut resample = vec![0.0; values.len()];
    let one = |_| {
        resample.iter_mut().for_each(|value| *value = values[generator.random_range(0..values.len())]);
        let t = studentized(Moments::of(&resample));
        // The logarithm of a mean of 0, over no error.
        if t.is_nan() { f64::NEG_INFINITY } else { t }
    };
    let mut all: Vec<f64> = (0..RESAMPLES).map(one).collect();
    all.sort_by(f64::total_cmp);
    [0.025, 0.975].map(|share| all[(share * (RESAMPLES - 1) as f64).round() as usize])
}

/// An interval with ends.
fn finite(ends: [f64; 2]) -> Option<[f64; 2]> {
    ends.iter().all(|end| end.is_finite()).then_some(ends)
}
