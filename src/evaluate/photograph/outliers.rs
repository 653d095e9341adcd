//! PhotoOutliers among the photographs of a capture.

use schemars::JsonSchema;
use serde::Serialize;

use svbrdf_core::statistics::{median, outlier_limit};

/// With fewer photographs, none of them is an outlier.
const FEWEST: usize = 5;
/// Least distance of an exposure from the median, in stops.
const LEAST_EV: f64 = 0.1;
/// Least distance of a log difference from the median, and the least as a share of the median.
const LEAST_LOG: f64 = 0.02;
const LEAST_SHARE: f64 = 0.5;

/// In what a photograph differs from the others of its capture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct PhotoOutlier {
    /// The exposure that fits it alone: brighter or darker than the others.
    pub exposure: bool,
    /// Its log difference: larger than of the others.
    pub difference: bool,
}

impl PhotoOutlier {
    /// Whether the photograph is one.
    pub fn is_any(self) -> bool {
        self.exposure || self.difference
    }

    /// Of each photograph, by its own exposure in stops and its log difference.
    pub(super) fn among(exposures: &[Option<f64>], differences: &[Option<f64>]) -> Vec<Self> {
        let exposure = far(exposures, |distance, _| distance.abs() > LEAST_EV);
        let is_large = |distance: f64, median: f64| distance > LEAST_LOG && distance > LEAST_SHARE * median;
        let difference = far(differences, is_large);
        exposure
            .into_iter()
            .zip(difference)
            .map(|(exposure, difference)| Self { exposure, difference })
            .collect()
    }
}

/// Which of the values are far from their median, and `matter` by their distance from it and the median.
fn far(values: &[Option<f64>], matter: impl Fn(f64, f64) -> bool) -> Vec<bool> {
    let mut known: Vec<f64> = values.iter().flatten().copied().collect();
    if known.len() < FEWEST {
        return vec![false; values.len()];
    }
    let middle = median(&mut known).unwrap_or(f64::NAN);
    let mut distances: Vec<f64> = known.iter().map(|value| (value - middle).abs()).collect();
    let limit = outlier_limit(known.len()) * median(&mut distances).unwrap_or(f64::NAN);
    let is_far = |value: f64| (value - middle).abs() > limit && matter(value - middle, middle);
    values.iter().map(|value| value.is_some_and(is_far)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn among(exposures: [f64; 6], differences: [f64; 6]) -> Vec<PhotoOutlier> {
        PhotoOutlier::among(&exposures.map(Some), &differences.map(Some))
    }

    #[test]
    fn what_is_far_from_the_others_and_matters_is_an_outlier() {
        let [even, log] = [[1.0, 1.02, 0.98, 1.01, 0.99, 1.0], [0.1, 0.12, 0.11, 0.09, 0.1, 0.1]];
        assert!(among(even, log).iter().all(|one| !one.is_any()));
        let mut darker = even;
        darker[2] = 2.0;
        let mut worse = log;
        worse[4] = 0.4;
        let found = among(darker, worse);
        assert_eq!(found[2], PhotoOutlier { exposure: true, difference: false });
        assert_eq!(found[4], PhotoOutlier { exposure: false, difference: true });
        assert_eq!(found.iter().filter(|one| one.is_any()).count(), 2);
        // Far from the others, which agree to the last digit, but by too little.
        let found = among([1.0, 1.0, 1.0, 1.0, 1.0, 1.05], [0.1, 0.1, 0.1, 0.1, 0.1, 0.14]);
        assert!(found.iter().all(|one| !one.is_any()), "{found:?}");
        // A photograph that is closer than the others is none.
        assert!(!among(even, [0.1, 0.11, 0.1, 0.09, 0.1, 0.0])[5].is_any());
    }

    #[test]
    fn few_photographs_and_unknown_values_have_no_outliers() {
        let few = [0.0, 0.0, 0.0, 9.0].map(Some);
        assert!(PhotoOutlier::among(&few, &few).iter().all(|one| !one.is_any()));
        let mut unknown = [0.0, 0.0, 0.0, 0.0, 9.0, 0.0].map(Some);
        unknown[0] = None;
        let found = PhotoOutlier::among(&unknown, &unknown);
        assert_eq!(
            found.iter().map(|one| one.is_any()).collect::<Vec<_>>(),
            [false, false, false, false, true, false]
        );
    }
}
