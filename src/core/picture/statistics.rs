//! Statistics and histograms of a quantity over the texels of a material.

use crate::statistics::{median, quantile};

/// Bins of a histogram.
const BINS: usize = 128;
/// How far the axis of histograms goes beyond the automatic range.
const BEYOND: f64 = 1.5;

/// Statistics of the finite values of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    pub mean: f64,
    pub minimum: f64,
    pub median: f64,
    /// The 95th percentile.
    pub p95: f64,
    pub maximum: f64,
    /// How many values are NaN or infinite, which the other statistics leave out.
    pub not_finite: usize,
}

impl Statistics {
    /// The statistics of `values`; `None` where none is finite.
    pub fn of(values: &[f32]) -> Option<Self> {
        let mut finite: Vec<f32> = values.iter().copied().filter(|value| value.is_finite()).collect();
        let sum: f64 = finite.iter().map(|value| f64::from(*value)).sum();
        Some(Self {
            mean: sum / finite.len() as f64,
            minimum: quantile(&mut finite, 0.0)?,
            median: median(&mut finite)?,
            p95: quantile(&mut finite, 0.95)?,
            maximum: quantile(&mut finite, 1.0)?,
            not_finite: values.len() - finite.len(),
        })
    }
}

/// Numbers of values in bins of equal width from `low` to `high`.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    pub low: f64,
    pub high: f64,
    pub counts: Vec<u64>,
    /// Values below `low`.
    pub below: u64,
    /// Values above `high`.
    pub above: u64,
}

impl Histogram {
    /// The histogram of the finite `values`; `high` counts to the last bin.
    pub fn of(values: &[f32], [low, high]: [f64; 2], bins: usize) -> Self {
        let mut histogram = Self { low, high, counts: vec![0; bins], below: 0, above: 0 };
        let per_unit = bins as f64 / (high - low);
        for value in values.iter().filter(|value| value.is_finite()).map(|value| f64::from(*value)) {
            if value < low {
                histogram.below += 1;
            } else if value > high {
                histogram.above += 1;
            } else {
                let bin = ((value - low) * per_unit) as usize;
                histogram.counts[bin.min(bins - 1)] += 1;
            }
        }
        histogram
    }
}

/// The distributions of a quantity in several materials, on one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Distributions {
    /// Of each material; `None` where no value is finite.
    pub statistics: Vec<Option<Statistics>>,
    pub histograms: Vec<Histogram>,
    /// The 99th percentile of the magnitude, of the material where it is largest: in each, about 1% of the texels or
    /// fewer lie beyond it. Positive.
    pub auto_range: f64,
}

impl Distributions {
    /// The distributions of the `values` of each material. The axis is symmetric about 0 where `signed`, and otherwise
    /// starts at 0.
    pub fn of(values: &[Vec<f32>], signed: bool) -> Self {
        let magnitude = |values: &Vec<f32>| {
            let mut finite: Vec<f32> = values.iter().map(|v| v.abs()).filter(|v| v.is_finite()).collect();
            quantile(&mut finite, 0.99).unwrap_or(0.0)
        };
        let largest = values.iter().map(magnitude).fold(0.0, f64::max);
        let auto_range = if largest > 0.0 { largest } else { 1.0 };
        let high = BEYOND * auto_range;
        let low = if signed { -high } else { 0.0 };
        Self {
            statistics: values.iter().map(|values| Statistics::of(values)).collect(),
            histograms: values.iter().map(|values| Histogram::of(values, [low, high], BINS)).collect(),
            auto_range,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values without order, from 0 to 999, each once.
    fn shuffled() -> Vec<f32> {
        (0..1000).map(|i| (i * 387 % 1000) as f32).collect()
    }

    #[test]
    fn statistics_are_those_of_the_sorted_values() {
        let mut values = shuffled();
        values.extend([f32::NAN, f32::INFINITY]);
        let got = Statistics::of(&values).unwrap();
        let expected = Statistics {
            mean: 499.5,
            minimum: 0.0,
            median: 499.5,
            p95: 949.05,
            maximum: 999.0,
            not_finite: 2,
        };
        assert_eq!(got, expected);
        // A planted fault: one value more moves what it should.
        values.push(2000.0);
        let moved = Statistics::of(&values).unwrap();
        assert!(moved.maximum == 2000.0 && moved.mean > got.mean && moved.median == 500.0, "{moved:?}");
        assert_eq!(Statistics::of(&[f32::NAN]), None);
        assert_eq!(Statistics::of(&[]), None);
        let one = Statistics::of(&[0.25]).unwrap();
        assert_eq!([one.minimum, one.median, one.p95, one.maximum, one.mean], [0.25; 5]);
    }

    #[test]
    fn every_finite_value_is_in_one_bin_of_a_histogram() {
        let mut values = shuffled();
        values.extend([-1.0, 1000.0, 1001.0, f32::NAN]);
        let histogram = Histogram::of(&values, [0.0, 1000.0], 10);
        assert_eq!(histogram.counts, [100, 100, 100, 100, 100, 100, 100, 100, 100, 101]);
        assert_eq!((histogram.below, histogram.above), (1, 1));
    }

    #[test]
    fn distributions_share_the_range_of_the_widest() {
        let narrow: Vec<f32> = shuffled().iter().map(|v| v / 2000.0).collect();
        let wide: Vec<f32> = shuffled().iter().map(|v| -v / 1000.0).collect();
        let both = Distributions::of(&[narrow.clone(), wide], true);
        assert!((both.auto_range - 0.989_01).abs() < 1e-6, "{}", both.auto_range);
        for histogram in &both.histograms {
            assert_eq!([histogram.low, histogram.high], [-1.5 * both.auto_range, 1.5 * both.auto_range]);
            assert_eq!(histogram.counts.iter().sum::<u64>(), 1000);
        }
        let alone = Distributions::of(&[narrow], false);
        assert!((alone.auto_range - 0.494_505).abs() < 1e-6 && alone.histograms[0].low == 0.0);
        assert_eq!(Distributions::of(&[vec![0.0; 9]], false).auto_range, 1.0, "nothing differs");
    }
}
