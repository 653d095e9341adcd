//! The result of a study: points of time and error, and the Pareto front among them.

use super::choice::Choice;
use svbrdf_core::material::Depth;
use svbrdf_core::model::convention::Convention;

/// Errors below this many standard errors of the reference are not significantly different from 0.
const RESOLVED: f64 = 3.0;

/// Errors whose ratio is closer to 1 count as equal: f64 or an adapter moves all losses of a choice by next to nothing.
const SAME: f64 = 0.99;

/// The reference that errors are measured against: the loss in f32 over 8 times the scenes of any choice, from another seed,
/// on random texel subsets, plus the mean difference between f64 and f32 over a few scenes. Choices on all texels show that the
/// subsets introduce no bias.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    pub loss: f64,
    /// Relative standard error of `loss`.
    pub error: f64,
    pub scenes: usize,
    /// The time that it took.
    pub seconds: f64,
}

/// A measured choice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub choice: Choice,
    /// Median time of one loss in seconds. For half and 8-bit maps, that of float maps, which they become when read.
    pub seconds: f64,
    /// Root mean square of (loss - reference) / reference over `seeds`.
    pub error: f64,
    /// Mean relative difference from f32 and float maps over the same scenes.
    pub shift: f64,
    /// The number of seeds of `error`.
    pub seeds: usize,
    /// The number of runs. Where it is below `seeds`, the other losses are those of f32 with float maps over the
    /// same scenes, plus `shift`.
    pub runs: usize,
    /// Whether the point is on the Pareto front: every choice that is as fast is less accurate by more than 1%. The depth of
    /// the maps is given, not chosen, so points of half and 8-bit maps are never on the front.
    pub pareto: bool,
}

/// The result of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// The names of the ground truth and of the prediction.
    pub names: [String; 2],
    /// Width and height in texels.
    pub size: [usize; 2],
    pub convention: Convention,
    /// Number of CPU threads.
    pub threads: usize,
    pub reference: Reference,
    pub points: Vec<Point>,
    /// The choices that were not measured, with the reason.
    pub left_out: Vec<String>,
}

impl Study {
    /// Adds a point and marks the new front.
    pub(super) fn add(&mut self, point: Point) {
        self.points.push(point);
        mark(&mut self.points);
    }

    /// The fastest point of the front whose error is at most `error`.
    pub fn cheapest(&self, error: f64) -> Option<&Point> {
        let enough = self.points.iter().filter(|p| p.pareto && p.error <= error);
        enough.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }

    /// The points of the Pareto front, the fastest first.
    pub fn front(&self) -> Vec<&Point> {
        let mut front: Vec<_> = self.points.iter().filter(|p| p.pareto).collect();
        front.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        front
    }

    /// The least error that differs significantly from 0, given the error of the reference.
    pub fn least_error(&self) -> f64 {
        RESOLVED * self.reference.error
    }
}

/// Marks the points of the Pareto front: from the fastest on, each that is more accurate than all before it.
fn mark(points: &mut [Point]) {
    let mut settings = Vec::new();
    for point in points {
        point.pareto = false;
        if point.choice.maps == Depth::Float {
            settings.push(point);
        }
    }
    settings.sort_by(|a, b| a.seconds.total_cmp(&b.seconds).then(a.error.total_cmp(&b.error)));
    let mut least = f64::INFINITY;
    for point in settings {
        point.pareto = point.error < SAME * least;
        if point.pareto {
            least = point.error;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Family;

    fn point(seconds: f64, error: f64, family: Family) -> Point {
        let Some(choice) = family.choices().next() else { panic!("no choice") };
        Point { choice, seconds, error, shift: 0.0, seeds: 1, runs: 1, pareto: false }
    }

    fn marks(points: &[Point]) -> Vec<bool> {
        let mut points = points.to_vec();
        mark(&mut points);
        points.iter().map(|p| p.pareto).collect()
    }

    #[test]
    fn the_front_holds_the_points_that_no_faster_point_beats() {
        let p = |seconds, error| point(seconds, error, Family::Sobol);
        let good = [p(1.0, 0.1), p(2.0, 0.2), p(3.0, 0.01), p(3.0, 0.02), p(0.5, 0.1), p(4.0, 0.01)];
        assert_eq!(marks(&good), [false, false, true, false, true, false]);
        // The same error but for the rounding of f64 is not worth its time.
        assert_eq!(marks(&[p(1.0, 0.1), p(40.0, 0.099_999)]), [true, false]);
        // A planted fault: one point too good to be true takes the whole front.
        let faulty = [&good[..], &[p(0.4, 0.001)]].concat();
        assert_eq!(marks(&faulty), [false, false, false, false, false, false, true]);
    }

    #[test]
    fn points_of_stored_maps_are_never_on_the_front() {
        let points = [point(1.0, 0.1, Family::Sobol), point(0.5, 0.05, Family::EightBitMaps)];
        assert_eq!(marks(&points), [true, false]);
    }

    #[test]
    fn the_cheapest_point_is_on_the_front_and_accurate_enough() {
        let mut points: Vec<_> = [(1.0, 0.1), (2.0, 0.02), (4.0, 0.005)]
            .map(|(seconds, error)| point(seconds, error, Family::Sobol))
            .into();
        mark(&mut points);
        let study = Study {
            names: Default::default(),
            size: [1, 1],
            convention: Convention::default(),
            threads: 1,
            reference: Reference { loss: 1.0, error: 1e-4, scenes: 24, seconds: 1.0 },
            points,
            left_out: Vec::new(),
        };
        let seconds = |error| study.cheapest(error).map(|p| p.seconds);
        assert_eq!([0.1, 0.03, 0.01, 0.001].map(seconds), [Some(1.0), Some(2.0), Some(4.0), None]);
    }
}
