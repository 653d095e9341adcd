//! The error of a loss that was estimated from a few scenes.

use serde::Serialize;
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::model::sampler::Sampler;
use crate::model::scene::{Kind, Scene};

/// A mean over scenes and how far it may be from the mean over all scenes there are.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Estimate {
    /// The mean over the scenes.
    pub mean: f64,
    /// Standard error of `mean`; `None` (unknown) where a stratum has one independent unit.
    pub standard_error: Option<f64>,
    /// The 95% confidence interval of the mean over all scenes; `None` where the standard error is.
    pub interval95: Option<[f64; 2]>,
}

/// A part of all scenes, near-field or distant: its share of the loss, and the values of its scenes by independent
/// unit. Units are single random scenes, or the replicates of a quasi-random sequence.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stratum {
    pub weight: f64,
    pub units: Vec<Vec<f64>>,
}

impl Estimate {
    /// [`Estimate::of_sampled`] for independent scenes.
    pub fn of_scenes(scenes: &[Scene], values: &[f64]) -> Self {
        Self::of_sampled(Sampler::Random, scenes, values)
    }

    /// The estimate from the losses `values` of `scenes`, drawn by `sampler`: near-field and distant ones are two
    /// strata. For independent scenes `se = sqrt(N_S var(L_near) + N_D var(L_distant)) / (N_S + N_D)` (SPEC,
    /// Algorithm 1); quasi-random ones are dependent within a replicate, so replicates take the place of scenes
    /// (Owen, Monte Carlo theory, methods and examples, 17.4).
    ///
    /// The interval is `mean +- sqrt(t_1^2 se_1^2 + t_2^2 se_2^2)`, each stratum with Student's t at its own degrees of
    /// freedom (Banerjee 1960, Confidence interval for two-means problem based on separate estimates of variances and
    /// tabulated values of t). For normal values it covers at least 95%; those of long replicates are nearly normal, and
    /// it was measured to cover up to 97%, where one t at the degrees of freedom of Welch (1947) and Satterthwaite (1946)
    /// covers 93 to 95% (and 90 to 93% for 6 + 3 single scenes). So for long ones it is the root mean square of both.
    ///
    /// Losses are skewed: a few scenes see far more than the others, and where none of these was drawn, mean and
    /// error are both too small. So the interval is moved by `(1 + 2 z^2) k_3 / (6 se^2)` with the third cumulant k_3 of
    /// the mean and z = 1.96, the first term of the Cornish-Fisher expansion of Student's t (Johnson 1978, Modified t
    /// tests and confidence intervals for asymmetrical populations). It does not reach below 0.
    ///
    /// Few scenes do not tell how heavy their tail is: on materials that differ in kind, the interval of 6 + 3 holds the
    /// loss in 84 to 92% of the seeds. [`Comparison::run`](super::Comparison::run) takes those of few sampled scenes from
    /// a pilot instead.
    pub fn of_sampled(sampler: Sampler, scenes: &[Scene], values: &[f64]) -> Self {
        let e = Self::of_signed(sampler, scenes, values);
        Self { interval95: e.interval95.map(|[low, high]| [low.max(0.0), high]), ..e }
    }

    /// The mean of `first - second` over `scenes` that both were rendered under, with its own error: what the scenes
    /// have in common cancels, so it is known far better than either loss. Positive where `second` is closer.
    pub fn of_difference(sampler: Sampler, scenes: &[Scene], first: &[f64], second: &[f64]) -> Self {
        let differences: Vec<f64> = first.iter().zip(second).map(|(a, b)| a - b).collect();
        Self::of_signed(sampler, scenes, &differences)
    }

    /// [`Estimate::of_sampled`] of values that may be negative: the interval may reach below 0.
    pub fn of_signed(sampler: Sampler, scenes: &[Scene], values: &[f64]) -> Self {
        let stratum = |kind| {
            let units = sampler.units(scenes, values, kind);
            let count = units.iter().map(Vec::len).sum::<usize>();
            Stratum { weight: count as f64 / values.len() as f64, units }
        };
        let e = Self::of_strata(&[stratum(Kind::Near), stratum(Kind::Distant)]);
        // The same sum in its simplest order.
        Self { mean: values.iter().sum::<f64>() / values.len() as f64, ..e }
    }

    /// The weighted sum of the means of strata, whose units are independent. Strata without units do not count.
    pub(crate) fn of_strata(strata: &[Stratum]) -> Self {
        let moments: Vec<_> = strata.iter().filter(|s| !s.units.is_empty()).map(Stratum::moments).collect();
        let mean = moments.iter().map(|m| m.mean).sum();
        if moments.iter().any(|m| m.freedom < 1.0) {
            return Self { mean, standard_error: None, interval95: None };
        }
        let variance: f64 = moments.iter().map(|m| m.variance).sum();
        let standard_error = variance.sqrt();
        let nearly_normal = strata.iter().flat_map(|s| &s.units).all(|unit| unit.len() >= LONG);
        let part = |m: &StratumMoments| student_quantile(m.freedom).powi(2) * m.variance;
        let by_stratum: f64 = moments.iter().map(part).sum();
        let reach = if nearly_normal && variance > 0.0 {
            let inverse: f64 = moments.iter().map(|m| m.variance.powi(2) / m.freedom).sum();
            let together = student_quantile(variance.powi(2) / inverse).powi(2) * variance;
            (0.5 * (by_stratum + together)).sqrt()
        } else {
            by_stratum.sqrt()
        };
        let cumulant: f64 = moments.iter().map(|m| m.third_cumulant).sum();
        let shift = if variance > 0.0 { SKEWNESS * cumulant / variance } else { 0.0 };
        let interval95 = Some([mean + shift - reach, mean + shift + reach]);
        Self { mean, standard_error: Some(standard_error), interval95 }
    }

    /// The same with an interval that reaches `factor` times as far to either side, but not below 0.
    pub(super) fn widened(self, factor: f64) -> Self {
        let end = |end: f64| self.mean + factor * (end - self.mean);
        Self { interval95: self.interval95.map(|[low, high]| [end(low).max(0.0), end(high)]), ..self }
    }

    /// How far the 95% interval reaches from the mean, over the mean; infinite where it is unknown, 0 where it has no
    /// width.
    pub fn relative_error95(&self) -> f64 {
        match self.interval95 {
            None => f64::INFINITY,
            Some([low, high]) if low == high => 0.0,
            Some([low, high]) => (high - self.mean).max(self.mean - low) / self.mean.abs(),
        }
    }

    /// Mean, standard error and interval as people read them, in the window and on the command line alike.
    pub fn texts(&self) -> [String; 3] {
        let unknown = || "unknown".to_owned();
        [
            format!("{:.6}", self.mean),
            self.standard_error.map_or_else(unknown, |e| format!("{e:.6}")),
            self.interval95.map_or_else(unknown, |[low, high]| format!("{low:.6} to {high:.6}")),
        ]
    }
}

/// What a stratum adds to an estimate.
struct StratumMoments {
    mean: f64,
    /// The variance of `mean`, with `freedom` degrees of freedom.
    variance: f64,
    freedom: f64,
    /// That of `mean`; 0 where there are too few units to tell.
    third_cumulant: f64,
}

impl Stratum {
    /// Units of more scenes count for more: where scenes are independent, the variance is then without bias for units
    /// of any sizes.
    fn moments(&self) -> StratumMoments {
        let count = self.units.iter().map(Vec::len).sum::<usize>() as f64;
        let mean = self.units.iter().flatten().sum::<f64>() / count;
        let units = self.units.len() as f64;
        let freedom = units - 1.0;
        // Deviations of units as if all had the same number of scenes.
        let deviation = |unit: &Vec<f64>| {
            let size = unit.len() as f64;
            (units * size / count).sqrt() * (unit.iter().sum::<f64>() / size - mean)
        };
        let sum = |power| self.units.iter().map(|unit| deviation(unit).powi(power)).sum::<f64>();
        let third = if units > 2.0 { sum(3) / (units * freedom * (units - 2.0)) } else { 0.0 };
        StratumMoments {
            mean: self.weight * mean,
            variance: self.weight.powi(2) * sum(2) / (units * freedom),
            freedom,
            third_cumulant: self.weight.powi(3) * third,
        }
    }
}

/// The mean of a replicate of so many scenes is taken to be nearly normal.
const LONG: usize = 8;

/// (1 + 2 z^2) / 6 at the 97.5% quantile z of the normal distribution.
const SKEWNESS: f64 = 1.447_153;

/// The 97.5% quantile of Student's t with `freedom` degrees of freedom.
///
/// From 1e6 degrees on, the quantile of the normal distribution, which then differs by less than 3e-6: the library's search
/// does not end at infinity.
pub(super) fn student_quantile(freedom: f64) -> f64 {
    const LEVEL: f64 = 0.975;
    if freedom < 1e6
        && let Ok(student) = StudentsT::new(0.0, 1.0, freedom)
    {
        return student.inverse_cdf(LEVEL);
    }
    Normal::standard().inverse_cdf(LEVEL)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(kind: Kind) -> Scene {
        Scene { kind, view: [0.0, 0.0, 1.0], light: [0.0, 0.0, 1.0] }
    }

    #[test]
    fn two_strata_give_the_error_of_the_specification() {
        let scenes = [Kind::Near, Kind::Near, Kind::Near, Kind::Distant, Kind::Distant].map(scene);
        let e = Estimate::of_scenes(&scenes, &[1.0, 2.0, 3.0, 5.0, 7.0]);
        // var near = 1, var distant = 2: sqrt(3 * 1 + 2 * 2) / 5
        let se = 7f64.sqrt() / 5.0;
        assert_eq!(e.mean, 3.6);
        assert!((e.standard_error.unwrap() - se).abs() < 1e-15);
        // t_2 = 4.302653 on 3 * 1, t_1 = 12.706205 on 2 * 2
        let reach = (4.302653f64.powi(2) * 3.0 + 12.706205f64.powi(2) * 4.0).sqrt() / 5.0;
        let [low, high] = e.interval95.unwrap();
        assert!((high - (3.6 + reach)).abs() < 1e-5, "{high}");
        assert_eq!(low, 0.0, "3.6 - {reach} is no loss");
    }

    #[test]
    fn the_interval_of_skewed_losses_reaches_further_up() {
        let scenes = [Kind::Near; 4].map(scene);
        let e = Estimate::of_scenes(&scenes, &[2.0, 2.0, 2.0, 6.0]);
        // Deviations -1, -1, -1, 3: variance 4 / 4, third cumulant 4 * 24 / (3 * 2) / 4^2 = 1, t_3 = 3.182446.
        let [low, high] = e.interval95.unwrap();
        assert!((high - (3.0 + 1.447153 + 3.182446)).abs() < 1e-5, "{high}");
        assert!((low - (3.0 + 1.447153 - 3.182446)).abs() < 1e-5, "{low}");
        let mirrored = Estimate::of_scenes(&scenes, &[6.0, 6.0, 6.0, 2.0]);
        assert!((mirrored.interval95.unwrap()[0] - (8.0 - high)).abs() < 1e-12);
    }

    #[test]
    fn long_replicates_share_their_degrees_of_freedom() {
        let scenes =
            [[Kind::Near; 64], [Kind::Distant; 64]].concat().into_iter().map(scene).collect::<Vec<_>>();
        // Replicate i of either kind is all +-1 or all +-2: variance 4 * (1 + 4) / 7 each, no skewness.
        let values: Vec<f64> = (0..128).map(|i| [1.0, -1.0, 2.0, -2.0][i % 4] + 9.0).collect();
        let e = Estimate::of_sampled(Sampler::Sobol, &scenes, &values);
        let se = (0.5 * 20.0 / 7.0 / 8.0f64).sqrt();
        assert!((e.standard_error.unwrap() - se).abs() < 1e-12);
        // t_14 = 2.144787, t_7 = 2.364624.
        let quantile = (0.5 * (2.144787f64.powi(2) + 2.364624f64.powi(2))).sqrt();
        assert!((e.interval95.unwrap()[1] - (9.0 + quantile * se)).abs() < 1e-5, "{e:?}");
    }

    #[test]
    fn a_difference_of_equal_losses_is_0_and_one_may_be_negative() {
        let scenes = [Kind::Near; 3].map(scene);
        let difference = |a, b| Estimate::of_difference(Sampler::Random, &scenes, a, b);
        assert_eq!(difference(&[1.0, 2.0, 3.0], &[1.0, 2.0, 3.0]).interval95, Some([0.0, 0.0]));
        let e = difference(&[1.0, 2.0, 3.1], &[2.0, 3.0, 4.0]);
        assert!((e.mean + 0.966_666_666).abs() < 1e-8 && e.interval95.unwrap()[1] < 0.0, "{e:?}");
    }

    #[test]
    fn sobol_scenes_are_judged_by_their_scramblings() {
        let scenes = [Kind::Near; 16].map(scene);
        let values: Vec<f64> = (0..16).map(|i| if i < 8 { 1.0 } else { 3.0 }).collect();
        let of = |sampler| Estimate::of_sampled(sampler, &scenes, &values).standard_error.unwrap();
        assert_eq!(of(Sampler::Sobol), 0.0, "every scrambling has the mean 2");
        assert!(of(Sampler::Random) > 0.2);
    }

    #[test]
    fn a_stratum_of_one_scene_has_an_unknown_error() {
        let scenes = [Kind::Near, Kind::Near, Kind::Distant].map(scene);
        let e = Estimate::of_scenes(&scenes, &[1.0, 2.0, 3.0]);
        assert_eq!((e.standard_error, e.interval95), (None, None));
    }
}
