//! The interval of a mean over materials, whose losses are skewed.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

/// Resamples.
const RESAMPLES: usize = 2000;

/// The 95% interval of the mean of what `values` are a sample of, by the bootstrap-t (Efron 1981); `None` for fewer than 3
/// values, and where one is infinite.
///
/// Resamples give the distribution of the studentized mean (m* - m) / s*; its quantiles take the place of those of Student's t. For
/// means of few skewed values it covers better than BCa. The resamples are always the same ones.
pub fn interval_of_mean(values: &[f64]) -> Option<[f64; 2]> {
    if values.len() < 3 || values.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let (mean, error) = moments(values.iter().copied(), values.len());
    if error == 0.0 {
        return Some([mean; 2]);
    }
    let mut generator = ChaCha8Rng::seed_from_u64(0);
    let mut resample = vec![0.0; values.len()];
    let mut studentized: Vec<f64> = Vec::with_capacity(RESAMPLES);
    for _ in 0..RESAMPLES {
        resample.iter_mut().for_each(|value| *value = values[generator.random_range(0..values.len())]);
        let (m, e) = moments(resample.iter().copied(), values.len());
        // All values of the resample are the same: its t is unbounded on the side where it is.
        studentized.push(if e > 0.0 { (m - mean) / e } else { f64::INFINITY.copysign(m - mean) });
    }
    studentized.sort_by(f64::total_cmp);
    let quantile = |share: f64| studentized[(share * (RESAMPLES - 1) as f64).round() as usize];
    let [low, high] = [0.975, 0.025].map(|share| mean - quantile(share) * error);
    Some([low, high])
}

/// Mean and standard error.
fn moments(values: impl Iterator<Item = f64> + Clone, count: usize) -> (f64, f64) {
    let count = count as f64;
    let mean = values.clone().sum::<f64>() / count;
    let squares = values.map(|value| (value - mean).powi(2)).sum::<f64>();
    (mean, (squares / (count * (count - 1.0))).sqrt())
}
