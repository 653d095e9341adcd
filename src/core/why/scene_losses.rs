//! Scenes of a loss, worst first, and the distribution of their losses.

use crate::loss::Outcome;
use crate::model::scene::Scene;
use crate::statistics::{median, quantile};

/// A scene and its losses.
#[derive(Clone, Debug, PartialEq)]
pub struct RankedScene {
    /// Its number among the scenes of the loss, from 0.
    pub index: usize,
    pub scene: Scene,
    /// The loss of each prediction in this scene.
    pub losses: Vec<f64>,
}

impl RankedScene {
    fn total(&self) -> f64 {
        self.losses.iter().sum()
    }
}

/// The scenes of a loss, worst first: by the mean of the losses of all predictions. Equal ones keep their order.
pub fn worst_first(outcome: &Outcome) -> Vec<RankedScene> {
    let one = |(index, scene): (usize, &Scene)| {
        let losses = outcome.losses.iter().map(|loss| loss.per_scene[index]).collect();
        RankedScene { index, scene: *scene, losses }
    };
    let mut ranked: Vec<_> = outcome.scenes.iter().enumerate().map(one).collect();
    ranked.sort_by(|a, b| b.total().total_cmp(&a.total()));
    ranked
}

/// How the losses of the scenes of one prediction are distributed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distribution {
    pub least: f64,
    pub median: f64,
    pub percentile95: f64,
    pub largest: f64,
    /// The share of the loss that the worst tenth of the scenes adds.
    pub worst_tenth: f64,
}

impl Distribution {
    /// The distribution of `losses`; `None` where there are none.
    pub fn of(losses: &[f64]) -> Option<Self> {
        let mut sorted = losses.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (&least, &largest) = (sorted.first()?, sorted.last()?);
        let tenth = sorted.len().div_ceil(10);
        let total: f64 = sorted.iter().sum();
        let worst: f64 = sorted[sorted.len() - tenth..].iter().sum();
        Some(Self {
            least,
            median: median(&mut sorted)?,
            percentile95: quantile(&mut sorted, 0.95)?,
            largest,
            worst_tenth: if total > 0.0 { worst / total } else { 0.0 },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distribution_of_known_losses() {
        let losses: Vec<f64> = (0..=20).rev().map(f64::from).collect();
        let d = Distribution::of(&losses).unwrap();
        assert_eq!([d.least, d.median, d.percentile95, d.largest], [0.0, 10.0, 19.0, 20.0]);
        // The worst tenth of 21 scenes are 3.
        assert!((d.worst_tenth - (20.0 + 19.0 + 18.0) / 210.0).abs() < 1e-15);
        assert_eq!(Distribution::of(&[]), None);
    }
}
