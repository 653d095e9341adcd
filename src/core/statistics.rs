//! Order statistics: the one definition of a quantile and of a median; outliers.

use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::math::real::Real;

/// The quantile of `values` for a probability in [0, 1], with linear interpolation between the two nearest order statistics
/// (type 7 of Hyndman and Fan 1996, the default of NumPy); `None` without values. Reorders the values; NaN counts as
/// larger than all others.
pub fn quantile<T: Real>(values: &mut [T], probability: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    let rank = probability.clamp(0.0, 1.0) * last as f64;
    let order = T::total_cmp;
    let (_, low, above) = values.select_nth_unstable_by(rank.floor() as usize, order);
    let low = low.f64();
    let high = above.iter().copied().min_by(order).map_or(low, Real::f64);
    // Not between infinities, whose difference is NaN.
    Some(if rank.fract() > 0.0 && high != low { low + (high - low) * rank.fract() } else { low })
}

/// The median of `values`: their [`quantile`] for the probability 1/2.
pub fn median<T: Real>(values: &mut [T]) -> Option<f64> {
    quantile(values, 0.5)
}

/// The standard deviation of a normal distribution over its median absolute deviation.
const DEVIATION: f64 = 1.4826;
/// The efficiency of the median absolute deviation: the share of values that a standard deviation as exact would take.
const EFFICIENCY: f64 = 0.37;

/// The distance from the median, in median absolute deviations, that at most 5% of sets of `count` normal values exceed anywhere: the
/// quantile of Student's t by Bonferroni, with the degrees of freedom of the deviation. `count` is at least 2.
pub fn outlier_limit(count: usize) -> f64 {
    let freedom = EFFICIENCY * count.saturating_sub(1).max(1) as f64;
    let probability = 1.0 - 0.05 / (2 * count.max(1)) as f64;
    DEVIATION * StudentsT::new(0.0, 1.0, freedom).map_or(f64::INFINITY, |t| t.inverse_cdf(probability))
}

#[cfg(test)]
mod tests {
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt as _, SeedableRng as _};

    use super::*;

    #[test]
    fn at_most_5_percent_of_normal_sets_have_an_outlier() {
        let mut generator = ChaCha8Rng::seed_from_u64(3);
        let mut normal = || {
            let [u, v] = [(); 2].map(|()| generator.random::<f64>());
            (-2.0 * (1.0 - u).ln()).sqrt() * (std::f64::consts::TAU * v).cos()
        };
        for count in [5, 6, 9, 20, 50] {
            let mut rate = |limit: f64| {
                let has_outlier = |_: &usize| {
                    let values: Vec<f64> = (0..count).map(|_| normal()).collect();
                    let middle = median(&mut values.clone()).unwrap();
                    let far: Vec<f64> = values.iter().map(|value| (value - middle).abs()).collect();
                    let deviation = median(&mut far.clone()).unwrap();
                    far.iter().any(|far| *far > limit * deviation)
                };
                (0..2000).filter(has_outlier).count() as f64 / 2000.0
            };
            let [found, fixed] = [outlier_limit(count), 3.5 * DEVIATION].map(&mut rate);
            assert!(found > 0.001 && found <= 0.05, "{count}: {found}");
            assert!(fixed > 0.06, "a planted fault, the same limit for any count: {count}: {fixed}");
        }
    }

    #[test]
    fn quantiles_are_those_of_numpy() {
        // numpy.quantile([3, 1, 4, 1, 5, 9, 2, 6], p)
        for (probability, expected) in [(0.0, 1.0), (0.25, 1.75), (0.5, 3.5), (0.95, 7.95), (1.0, 9.0)] {
            let mut values = [3.0, 1.0, 4.0, 1.0, 5.0, 9.0, 2.0, 6.0];
            let found = quantile::<f64>(&mut values, probability).unwrap();
            assert!((found - expected).abs() < 1e-12, "{probability}: {found}");
        }
        assert_eq!([median(&mut [0.25_f32]), median(&mut [2.0_f32, 1.0, 9.0])], [Some(0.25), Some(2.0)]);
        assert_eq!(quantile::<f32>(&mut [], 0.5), None);
        assert_eq!(median(&mut [f64::INFINITY, f64::INFINITY]), Some(f64::INFINITY));
        assert_eq!(median(&mut [f64::NAN, 1.0, 2.0]), Some(2.0));
    }
}
