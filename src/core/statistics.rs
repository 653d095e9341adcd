//! Order statistics: the one definition of a quantile and of a median, and the one sort by a number.

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

/// The indices of `numbers`, the least number first; NaN is larger than all others. Equal numbers keep their order.
pub fn order(numbers: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..numbers.len()).collect();
    order.sort_by(|&a, &b| numbers[a].total_cmp(&numbers[b]));
    order
}

/// Sorts by a number of each, as [`order`]: one sort of indices is compiled for all types.
pub fn sort_by_number<T>(all: &mut Vec<T>, number: impl FnMut(&T) -> f64) {
    let order = order(&all.iter().map(number).collect::<Vec<_>>());
    let mut unsorted: Vec<_> = std::mem::take(all).into_iter().map(Some).collect();
    all.extend(order.into_iter().filter_map(|index| unsorted[index].take()));
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn equal_numbers_keep_their_order() {
        let mut all = vec![("a", 1.0), ("b", f64::NAN), ("c", -0.5), ("d", 1.0), ("e", -0.5)];
        sort_by_number(&mut all, |(_, number)| *number);
        assert_eq!(all.iter().map(|(name, _)| *name).collect::<String>(), "ceadb");
    }
}
