//! The distribution of a mean, from samples of what it is a mean of.
//!
//! Each empirical distribution is put on a lattice. The characteristic function of a sum of independent draws is the product of those of
//! the draws, each to the power of its count. Quantiles from it need no bootstrap, have no noise and depend on the samples alone.

use std::f64::consts::TAU;

use super::statistics::student_quantile;

/// Points of the lattice.
const BINS: usize = 1 << 12;
/// Half the width of the lattice in standard deviations of the sum, beside the farthest sample.
const REACH: f64 = 8.0;

/// Independent draws from one distribution.
#[derive(Clone, Debug)]
pub(super) struct Draws {
    /// A sample of the distribution.
    pub values: Vec<f64>,
    /// The number of draws.
    pub count: usize,
}

/// The distribution of the sum of [`Draws`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SamplingDistribution {
    /// The expectation.
    pub mean: f64,
    /// The 2.5% and the 97.5% quantile, less the expectation.
    pub quantiles95: [f64; 2],
    /// Degrees of freedom of the variance: few where the samples are few, or have few values that matter.
    pub freedom: f64,
}

impl SamplingDistribution {
    /// The distribution of the sum of all `draws`.
    ///
    /// The variances are estimates, which makes the quantiles wider: by the ratio of Student's quantile to the normal one. Its degrees
    /// of freedom nu follow from the variance of a variance, var(s^2) = (m_4 - s^4) / n = 2 s^4 / nu (Satterthwaite 1946).
    pub(super) fn of_sum(draws: &[Draws]) -> Self {
        let moments: Vec<SampleMoments> = draws.iter().map(SampleMoments::of).collect();
        let sum = |of: fn(&SampleMoments) -> f64, power| -> f64 {
            draws.iter().zip(&moments).map(|(d, m)| (d.count as f64).powi(power) * of(m)).sum()
        };
        let (mean, variance) = (sum(|m| m.mean, 1), sum(|m| m.variance, 1));
        if variance.is_nan() || variance <= 0.0 {
            return Self { mean, quantiles95: [0.0; 2], freedom: f64::INFINITY };
        }
        let freedom = (2.0 * variance * variance / sum(|m| m.variance_of_variance, 2)).max(1.0);
        let farthest = moments.iter().map(|m| m.farthest).fold(0.0, f64::max);
        let step = 2.0 * (REACH * variance.sqrt() + 2.0 * farthest) / BINS as f64;
        let wider = student_quantile(freedom) / student_quantile(f64::INFINITY);
        let quantiles = Lattice::of_sum(draws, &moments, step).quantiles([0.025, 0.975]);
        Self { mean, quantiles95: quantiles.map(|q| wider * step * q), freedom }
    }
}

/// Moments of a sample.
struct SampleMoments {
    mean: f64,
    variance: f64,
    variance_of_variance: f64,
    /// The largest distance from the mean.
    farthest: f64,
}

impl SampleMoments {
    fn of(draws: &Draws) -> Self {
        let count = draws.values.len() as f64;
        let mean = draws.values.iter().sum::<f64>() / count;
        let sum = |power| draws.values.iter().map(|x| (x - mean).powi(power)).sum::<f64>();
        let variance = sum(2) / (count - 1.0);
        Self {
            mean,
            variance,
            variance_of_variance: ((sum(4) / count - variance * variance) / count).max(0.0),
            farthest: draws.values.iter().map(|x| (x - mean).abs()).fold(0.0, f64::max),
        }
    }
}

/// The probabilities of a sum less its expectation, on a circle of [`BINS`] points.
struct Lattice(Vec<Complex>);

impl Lattice {
    /// `moments` belong to `draws`; points are `step` apart.
    fn of_sum(draws: &[Draws], moments: &[SampleMoments], step: f64) -> Self {
        let roots: Vec<Complex> = (0..BINS / 2).map(|k| Complex::root(k, BINS)).collect();
        let mut product = vec![Complex([1.0, 0.0]); BINS];
        for (draws, moments) in draws.iter().zip(moments) {
            let mut one = vec![Complex::default(); BINS];
            let count = draws.values.len() as f64;
            // Bessel's correction, as for the variance.
            let scale = (count / (count - 1.0)).sqrt() / step;
            for value in &draws.values {
                // Shared between two points, so that the mean stays.
                let at = scale * (value - moments.mean);
                let share = at - at.floor();
                let below = (at.floor() as i64).rem_euclid(BINS as i64) as usize;
                one[below].0[0] += (1.0 - share) / count;
                one[(below + 1) % BINS].0[0] += share / count;
            }
            transform(&mut one, &roots);
            for (product, one) in product.iter_mut().zip(one) {
                *product = product.times(one.power(draws.count));
            }
        }
        // The inverse, up to the direction in which the circle is numbered.
        transform(&mut product, &roots);
        Self(product)
    }

    /// The points, counted from the expectation, below which the sum is with the given `probabilities`.
    fn quantiles(&self, probabilities: [f64; 2]) -> [f64; 2] {
        const HALF: usize = BINS / 2;
        let mut quantiles = [0.0; 2];
        let mut below = 0.0;
        for point in 0..BINS {
            // Rounding leaves some that are negative by 1e-17.
            let here = (self.0[(HALF + BINS - point) % BINS].0[0] / BINS as f64).max(0.0);
            for (quantile, probability) in quantiles.iter_mut().zip(probabilities) {
                if below < probability && below + here >= probability {
                    *quantile = point as f64 - HALF as f64 - 0.5 + (probability - below) / here;
                }
            }
            below += here;
        }
        quantiles
    }
}

/// Real and imaginary part.
#[derive(Clone, Copy, Debug, Default)]
struct Complex([f64; 2]);

impl Complex {
    /// `exp(-2 pi i k / n)`.
    fn root(k: usize, n: usize) -> Self {
        let angle = -TAU * k as f64 / n as f64;
        Self([angle.cos(), angle.sin()])
    }

    fn times(self, Self([c, d]): Self) -> Self {
        let [a, b] = self.0;
        Self([a * c - b * d, a * d + b * c])
    }

    fn power(mut self, mut exponent: usize) -> Self {
        let mut result = Self([1.0, 0.0]);
        while exponent > 0 {
            if exponent % 2 == 1 {
                result = result.times(self);
            }
            self = self.times(self);
            exponent /= 2;
        }
        result
    }
}

/// The discrete Fourier transform in place (Cooley and Tukey 1965); `roots` are half of the roots of 1.
fn transform(values: &mut [Complex], roots: &[Complex]) {
    let size = values.len();
    let unused_bits = usize::BITS - size.trailing_zeros();
    for i in 0..size {
        let j = i.reverse_bits() >> unused_bits;
        if i < j {
            values.swap(i, j);
        }
    }
    let mut half = 1;
    while half < size {
        let stride = size / (2 * half);
        for block in values.chunks_exact_mut(2 * half) {
            let (low, high) = block.split_at_mut(half);
            for (k, (low, high)) in low.iter_mut().zip(high).enumerate() {
                let [a, b] = low.0;
                let [c, d] = high.times(roots[k * stride]).0;
                (low.0, high.0) = ([a + c, b + d], [a - c, b - d]);
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use statrs::distribution::{ContinuousCDF, Gamma};

    use super::*;

    /// The middles of `count` equally likely parts of an exponential distribution of mean 1.
    fn exponential(count: usize) -> Vec<f64> {
        (0..count).map(|i| -((i as f64 + 0.5) / count as f64).ln()).collect()
    }

    fn narrowed(distribution: SamplingDistribution) -> [f64; 2] {
        let wider = student_quantile(distribution.freedom) / student_quantile(f64::INFINITY);
        distribution.quantiles95.map(|q| q / wider)
    }

    #[test]
    fn sums_of_exponential_numbers_have_the_quantiles_of_the_gamma_distribution() {
        for count in [1, 9, 90, 900] {
            let distribution = SamplingDistribution::of_sum(&[Draws { values: exponential(4096), count }]);
            let gamma = Gamma::new(count as f64, 1.0).unwrap();
            for (got, p) in narrowed(distribution).into_iter().zip([0.025, 0.975]) {
                let expected = gamma.inverse_cdf(p) - count as f64;
                let error = (got - expected).abs() / (count as f64).sqrt();
                assert!(error < 0.01, "{count}, {p}: {got}, {expected}");
            }
        }
    }

    #[test]
    fn draws_from_two_distributions_add_up() {
        let values = exponential(2048);
        let part = |count| Draws { values: values.clone(), count };
        let [a, b] =
            [vec![part(9)], vec![part(6), part(3)]].map(|draws| SamplingDistribution::of_sum(&draws));
        assert!((a.mean - b.mean).abs() < 1e-12);
        for (a, b) in narrowed(a).into_iter().zip(narrowed(b)) {
            assert!((a - b).abs() < 1e-9, "{a}, {b}");
        }
    }

    #[test]
    fn a_sample_with_one_value_that_matters_has_few_degrees_of_freedom() {
        let mut values = vec![1.0; 1000];
        values[3] = 9.0;
        let rare = SamplingDistribution::of_sum(&[Draws { values, count: 9 }]).freedom;
        let common = SamplingDistribution::of_sum(&[Draws { values: exponential(1000), count: 9 }]).freedom;
        assert!(rare < 3.0 && common > 100.0, "{rare}, {common}");
    }
}
