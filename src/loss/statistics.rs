//! The error of a loss that was estimated from a few scenes.

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::scene::{Kind, Scene};

/// A mean over scenes and how far it may be from the mean over all scenes there are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The mean over the scenes.
    pub mean: f64,
    /// Standard error of `mean`; `None` (unknown) where a stratum has one scene.
    pub standard_error: Option<f64>,
    /// The 95% confidence interval of the mean over all scenes; `None` where the standard error is.
    pub interval95: Option<[f64; 2]>,
}

/// Count, mean and sample variance of one stratum.
struct Stratum {
    count: f64,
    variance: f64,
}

impl Estimate {
    /// The estimate from the losses `values` of `scenes`: the near-field and the distant ones are two strata,
    /// `se = sqrt(N_S var(L_near) + N_D var(L_distant)) / (N_S + N_D)` (SPEC, Algorithm 1).
    ///
    /// The interval is `mean +- t se` with Student's t at the degrees of freedom of Welch (1947) and Satterthwaite
    /// (1946), since a normal quantile is too narrow for a few scenes; it does not reach below 0.
    pub fn of_scenes(scenes: &[Scene], values: &[f64]) -> Self {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let of_kind = |kind| {
            let of = scenes.iter().zip(values).filter(move |(s, _)| s.kind == kind);
            stratum(&of.map(|(_, v)| *v).collect::<Vec<_>>())
        };
        let strata = [of_kind(Kind::Near), of_kind(Kind::Distant)];
        let Some((standard_error, freedom)) = standard_error(&strata, values.len()) else {
            return Self { mean, standard_error: None, interval95: None };
        };
        let reach = standard_error * student_quantile(freedom);
        Self {
            mean,
            standard_error: Some(standard_error),
            interval95: Some([(mean - reach).max(0.0), mean + reach]),
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

/// `None` where there are no values; a variance of NaN where there is one.
fn stratum(values: &[f64]) -> Option<Stratum> {
    if values.is_empty() {
        return None;
    }
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    Some(Stratum { count, variance: squares / (count - 1.0) })
}

/// (standard error of the mean over all `count` values, its degrees of freedom); `None` where unknown.
fn standard_error(strata: &[Option<Stratum>], count: usize) -> Option<(f64, f64)> {
    let strata = || strata.iter().flatten();
    if strata().any(|s| s.count < 2.0) {
        return None;
    }
    let part = |s: &Stratum| s.count * s.variance;
    let total: f64 = strata().map(part).sum();
    let spread: f64 = strata().map(|s| part(s).powi(2) / (s.count - 1.0)).sum();
    let freedom = if spread > 0.0 { total * total / spread } else { f64::INFINITY };
    Some((total.sqrt() / count as f64, freedom))
}

/// The 97.5% quantile of Student's t with `freedom` degrees of freedom.
///
/// From 1e6 degrees on, that of the normal distribution, which then differs by less than 3e-6: the library's search
/// does not end at infinity.
fn student_quantile(freedom: f64) -> f64 {
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
        // (3 + 4)^2 / (9 / 2 + 16 / 1) = 2.3902 degrees of freedom
        let [low, high] = e.interval95.unwrap();
        let quantile = student_quantile(49.0 / 20.5);
        assert!((high - (3.6 + se * quantile)).abs() < 1e-12);
        assert!((low - (3.6 - se * quantile)).abs() < 1e-12);
        assert!(quantile > 3.182 && quantile < 4.303, "between t_3 and t_2, got {quantile}");
    }

    #[test]
    fn a_stratum_of_one_scene_has_an_unknown_error() {
        let scenes = [Kind::Near, Kind::Near, Kind::Distant].map(scene);
        let e = Estimate::of_scenes(&scenes, &[1.0, 2.0, 3.0]);
        assert_eq!((e.standard_error, e.interval95), (None, None));
    }

    #[test]
    fn equal_values_have_no_error() {
        let scenes = [Kind::Near; 3].map(scene);
        let e = Estimate::of_scenes(&scenes, &[0.0; 3]);
        assert_eq!(e.standard_error, Some(0.0));
        assert_eq!(e.interval95, Some([0.0, 0.0]));
    }
}
