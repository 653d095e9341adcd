//! A normal distribution in the unit cube that moves towards better points and takes the shape of the ridges that they follow.

use statrs::distribution::{ContinuousCDF, Normal};

/// Dimensions of the cube.
const N: usize = 6;
/// The share of the last covariance in the next one.
const MEMORY: f64 = 0.7;
/// What the covariance of the best points is multiplied by: these are closer together than the cloud.
const GROWTH: f64 = 1.3;
/// Least standard deviation in any direction.
const LEAST: f64 = 1e-5;

/// A cloud of points.
#[derive(Clone, Debug)]
pub(super) struct Cloud {
    mean: [f64; N],
    covariance: [[f64; N]; N],
}

impl Cloud {
    /// A round cloud with the standard deviation `reach`.
    pub(super) fn new(mean: [f64; N], reach: f64) -> Self {
        let entry = |i, j| if i == j { reach * reach } else { 0.0 };
        Self { mean, covariance: std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))) }
    }

    /// The point of the cloud at these quantiles.
    pub(super) fn point(&self, quantiles: [f64; N]) -> [f64; N] {
        let normal = Normal::standard();
        let deviates = quantiles.map(|u| normal.inverse_cdf(u.clamp(1e-6, 1.0 - 1e-6)));
        let lower = self.cholesky();
        std::array::from_fn(|i| self.mean[i] + (0..=i).map(|j| lower[i][j] * deviates[j]).sum::<f64>())
    }

    /// Moves to the mean of the `elite`. The covariance about the last mean grows in the direction of the move, as in CMA-ES (Hansen and
    /// Ostermeier 2001, Completely derandomized self-adaptation in evolution strategies). Azimuths go round at 1.
    pub(super) fn follow(&mut self, elite: &[[f64; N]], is_azimuth: impl Fn(usize) -> bool) {
        let step = |point: &[f64; N]| -> [f64; N] {
            std::array::from_fn(|i| {
                let step = point[i] - self.mean[i];
                if is_azimuth(i) { step - step.round() } else { step }
            })
        };
        let steps: Vec<[f64; N]> = elite.iter().map(step).collect();
        let count = steps.len().max(1) as f64;
        for i in 0..N {
            for j in 0..N {
                let of_elite = steps.iter().map(|step| step[i] * step[j]).sum::<f64>() / count;
                self.covariance[i][j] = MEMORY * self.covariance[i][j] + (1.0 - MEMORY) * GROWTH * of_elite;
            }
            self.covariance[i][i] += LEAST * LEAST;
        }
        for i in 0..N {
            self.mean[i] += steps.iter().map(|step| step[i]).sum::<f64>() / count;
        }
    }

    /// The lower triangle whose square is the covariance.
    fn cholesky(&self) -> [[f64; N]; N] {
        let mut lower = [[0.0; N]; N];
        for i in 0..N {
            for j in 0..=i {
                let rest = self.covariance[i][j] - (0..j).map(|k| lower[i][k] * lower[j][k]).sum::<f64>();
                lower[i][j] = if i == j { rest.max(LEAST * LEAST).sqrt() } else { rest / lower[j][j] };
            }
        }
        lower
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A curved, narrow ridge in two of the dimensions, as of Rosenbrock's function.
    #[test]
    fn a_curved_ridge_is_followed_to_its_top() {
        let value = |p: &[f64; N]| {
            let (x, y) = (2.0 * p[0] - 0.5, 2.0 * p[1] - 0.5);
            -(1.0 - x).powi(2)
                - 100.0 * (y - x * x).powi(2)
                - p[2..].iter().map(|z| (z - 0.5).powi(2)).sum::<f64>()
        };
        let mut cloud = Cloud::new([0.3, 0.2, 0.4, 0.6, 0.5, 0.5], 0.06);
        let mut best = f64::NEG_INFINITY;
        for round in 0..80 {
            let point =
                |i| cloud.point(std::array::from_fn(|d| f64::from(sobol_burley::sample(i, d as u32, round))));
            let mut points: Vec<[f64; N]> = (0..24).map(point).collect();
            points.sort_by(|a, b| value(b).total_cmp(&value(a)));
            best = best.max(value(&points[0]));
            cloud.follow(&points[..6], |_| false);
        }
        assert!(best > -1e-3, "{best}");
    }
}
