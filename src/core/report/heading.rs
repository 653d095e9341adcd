//! The settings that reports have in common: lines above a table, and the first keys of the JSON.

use serde::Serialize;

use crate::loss::{Sampling, Texels};
use crate::material::Material;
use crate::math::real::Real;
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::model::scene::{Kind, Scene};

/// The ground truth of a report, and the convention of its losses.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compared {
    pub ground_truth: String,
    /// Width and height in texels.
    #[serde(skip)]
    pub size: [usize; 2],
    /// The name of the convention.
    pub convention: &'static str,
    pub epsilon: f64,
}

impl Compared {
    /// Comparisons with `ground_truth` under `convention`.
    pub fn new<T: Real>(ground_truth: &Material<T>, convention: &Convention) -> Self {
        Self {
            ground_truth: ground_truth.name().to_owned(),
            size: ground_truth.size(),
            convention: convention.name,
            epsilon: convention.epsilon,
        }
    }

    /// The lines above a table of `content`, such as "rendering loss".
    pub fn heading(&self, content: &str) -> String {
        let Self { ground_truth, size: [width, height], convention, epsilon } = self;
        format!(
            "{content} against {ground_truth}, {width} x {height} texels\nconvention {convention}, epsilon {epsilon}\n"
        )
    }
}

/// The line above a table that names the scenes; `sampling` is `None` where they were listed.
pub fn scenes_line(sampling: Option<&Sampling>, scenes: &[Scene]) -> String {
    let count = |kind| scenes.iter().filter(|scene| scene.kind == kind).count();
    let counts = format!("{} near-field and {} distant scenes", count(Kind::Near), count(Kind::Distant));
    let Some(sampling) = sampling else { return counts + " from a file\n" };
    let sampler = if sampling.sampler == Sampler::Sobol { ", scrambled Sobol" } else { "" };
    let texels = match sampling.texels {
        Texels::All => String::new(),
        Texels::Sampled(1) => ", 1 random texel per scene".to_owned(),
        Texels::Sampled(count) => format!(", {count} random texels per scene"),
    };
    format!("{counts}, seed {}{sampler}{texels}\n", sampling.seed)
}

/// A position or direction as people read it.
pub fn position([x, y, z]: [f64; 3]) -> String {
    format!("({x:.3}, {y:.3}, {z:.3})")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_about_scenes_counts_kinds_and_texels() {
        let scenes: Vec<_> = [Kind::Near, Kind::Near, Kind::Distant]
            .map(|kind| Scene { kind, view: [0.0, 0.0, 1.0], light: [0.0, 0.0, 1.0] })
            .into();
        let line = |texels, sampler| {
            let sampling = Sampling { seed: 7, texels, sampler, ..Sampling::default() };
            scenes_line(Some(&sampling), &scenes)
        };
        let start = "2 near-field and 1 distant scenes";
        assert_eq!(scenes_line(None, &scenes), format!("{start} from a file\n"));
        assert_eq!(line(Texels::All, Sampler::Random), format!("{start}, seed 7\n"));
        assert_eq!(
            line(Texels::Sampled(1), Sampler::Sobol),
            format!("{start}, seed 7, scrambled Sobol, 1 random texel per scene\n")
        );
        assert!(line(Texels::Sampled(2), Sampler::Random).ends_with(", 2 random texels per scene\n"));
    }
}
