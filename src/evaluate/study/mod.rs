//! Speed against accuracy: the time and the error of settings of the loss, for one pair on this machine.
//!
//! ```no_run
//! use svbrdf_core::loss::Comparison;
//! use svbrdf_core::material::Material;
//! use svbrdf_core::model::brdf::Texel;
//! use svbrdf_core::model::convention::Convention;
//! use svbrdf_core::progress::Progress;
//! use svbrdf_evaluate::study;
//!
//! let texel = |roughness: f32| Texel { normal: glam::Vec3::Z, diffuse: [0.5; 3], specular: [0.04; 3], roughness };
//! let truth = Material::uniform("truth", 64, 64, &texel(0.6))?;
//! let prediction = Material::uniform("too rough", 64, 64, &texel(0.7))?;
//! let comparison = Comparison::new(&truth, &[&prediction], Convention::default())?;
//! let study = study::run(&comparison, &Progress::default())?;
//! if let Some(point) = study.cheapest(0.01) {
//!     println!("1% takes {:.4} s: {}", point.seconds, point.command());
//! }
//! # Ok::<(), svbrdf_evaluate::Error>(())
//! ```
//!
//! The error of a setting is the root mean square, over seeds, of its relative difference from a reference over far more
//! scenes, corrected to f64. The time is the median of the runs; it includes the sampling of scenes and excludes the reading
//! of files. Errors are the same in every run of a study. Times are not, so neither is the list of settings that were not
//! measured because they would take too long.

mod measure;

pub use measure::run;

use svbrdf_core::loss::{Sampling, Texels};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::statistics::sort_by_number;
use svbrdf_core::text::{percent, time};

use crate::report::{Field, Reader, Table};

/// Errors below this many standard errors of the reference are not significantly different from 0.
const RESOLVED: f64 = 3.0;
/// Target errors of the summary, as shares of the loss.
const TARGETS: [f64; 4] = [0.1, 0.03, 0.01, 0.003];

svbrdf_core::choices! {
    /// Settings that differ in their numbers of scenes only. In the order of measurement.
    Family, "family":
    FewTexels = "Sobol, 128 texels each",
    MoreTexels = "Sobol, 1024 texels each",
    Sobol = "Sobol scenes",
    Random = "random scenes",
}

impl Family {
    fn texels(self) -> Texels {
        match self {
            Self::FewTexels => Texels::Sampled(128),
            Self::MoreTexels => Texels::Sampled(1024),
            Self::Sobol | Self::Random => Texels::All,
        }
    }

    /// A setting of this many scenes, near-field and distant 2 : 1, of seed 0.
    fn setting(self, scenes: usize) -> Sampling {
        let sampler = if self == Self::Random { Sampler::Random } else { Sampler::Sobol };
        Sampling { near: scenes / 3 * 2, distant: scenes / 3, seed: 0, sampler, texels: self.texels() }
    }

    /// The settings that are measured, by growing numbers of scenes: of Sobol ones a power of two of each kind for each scrambling.
    fn settings(self) -> impl Iterator<Item = Sampling> {
        let counts: Vec<usize> = match self {
            Self::Random => vec![9, 90, 900, 9000],
            Self::Sobol => (0..9).map(|power| 24 << power).collect(),
            Self::FewTexels | Self::MoreTexels => (0..11).map(|power| 24 << power).collect(),
        };
        counts.into_iter().map(move |scenes| self.setting(scenes))
    }
}

/// The reference that errors are measured against: the loss in f32 over 8 times the scenes of any setting, from another seed,
/// on random texel subsets, plus the mean difference between f64 and f32 over a few scenes. Settings on all texels show that the
/// subsets introduce no bias.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    pub loss: f64,
    /// Relative standard error of `loss`.
    pub error: f64,
    pub scenes: usize,
}

/// A measured setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudyPoint {
    pub family: Family,
    pub sampling: Sampling,
    /// Median time of one loss in seconds.
    pub seconds: f64,
    /// Root mean square of (loss - reference) / reference over `seeds`.
    pub error: f64,
    /// The number of seeds, from 0 on.
    pub seeds: usize,
    /// Whether the point is on the Pareto front: every setting that is as fast is less accurate.
    pub pareto: bool,
}

impl StudyPoint {
    /// The number of scenes of both kinds.
    pub fn scenes(&self) -> usize {
        self.sampling.near + self.sampling.distant
    }

    /// The command that computes a loss with this setting.
    pub fn command(&self) -> String {
        let Sampling { near, distant, sampler, texels, .. } = self.sampling;
        let sampler = if sampler == Sampler::Sobol { " --sampler sobol" } else { "" };
        let texels = if texels == Texels::All { String::new() } else { format!(" --texels {texels}") };
        format!("svbrdf loss{sampler} --near {near} --distant {distant}{texels}")
    }
}

const FIELDS: [Field<StudyPoint>; 10] = [
    ("scenes", "", |p| p.scenes().into()),
    ("near", "", |p| p.sampling.near.into()),
    ("distant", "", |p| p.sampling.distant.into()),
    ("sampler", "", |p| p.sampling.sampler.to_string().into()),
    ("texels", "", |p| p.sampling.texels.to_string().into()),
    ("seconds", "", |p| p.seconds.into()),
    ("error", "", |p| p.error.into()),
    ("seeds", "", |p| p.seeds.into()),
    ("pareto", "", |p| p.pareto.into()),
    ("command", "", |p| p.command().into()),
];

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
    pub points: Vec<StudyPoint>,
    /// The settings that were not measured, with the reason.
    pub left_out: Vec<String>,
}

impl Study {
    /// The fastest point of the front whose error is at most `error`.
    pub fn cheapest(&self, error: f64) -> Option<&StudyPoint> {
        let good = self.points.iter().filter(|point| point.pareto && point.error <= error);
        good.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }

    /// Marks the points of the Pareto front: from the fastest on, each that is more accurate than all before it.
    fn mark(&mut self) {
        let mut points: Vec<_> = self.points.iter_mut().collect();
        sort_by_number(&mut points, |point| point.error);
        sort_by_number(&mut points, |point| point.seconds);
        let mut least = f64::INFINITY;
        for point in points {
            point.pareto = point.error < least;
            least = least.min(point.error);
        }
    }

    /// The least error that differs significantly from 0, given the error of the reference.
    fn least_error(&self) -> f64 {
        RESOLVED * self.reference.error
    }

    /// Every point, a row each.
    pub fn table(&self) -> Table {
        Table::fields(&FIELDS, &self.points, Reader::Program)
    }

    /// The cheapest setting for each of a few target errors, with the command that computes a loss with it.
    pub fn summary(&self) -> String {
        let Self { names: [ground_truth, prediction], size: [width, height], threads, reference, .. } = self;
        let rows = TARGETS.map(|target| match self.cheapest(target) {
            Some(p) => [percent(target), time(p.seconds), percent(p.error), p.command()],
            None => [percent(target), "-".into(), "-".into(), "no measured setting".into()],
        });
        let heading = ["target", "time", "error", "command"].map(str::to_owned);
        let table: String = [heading]
            .into_iter()
            .chain(rows)
            .map(|[target, time, error, command]| format!("{target:>6}  {time:>7}  {error:>8}  {command}\n"))
            .collect();
        let mut lines = vec![
            "Errors are root mean squares over seeds; 95% of losses are off by less than about twice that."
                .to_owned(),
        ];
        if self.points.iter().any(|p| p.error < self.least_error()) {
            let least = percent(self.least_error());
            lines.push(format!(
                "Errors below {least} are not significantly different from 0: the reference is not known better."
            ));
        }
        lines.extend(self.left_out.iter().map(|what| format!("Not measured: {what}")));
        format!(
            "{prediction} against {ground_truth}, {width} x {height} texels, convention {}, {threads} threads\n\
             loss {:.6} +- {} by {} scenes\n\n{table}\n{}\n",
            self.convention.name,
            reference.loss,
            percent(reference.error),
            reference.scenes,
            lines.join("\n")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_holds_the_points_that_no_faster_point_beats_and_the_cheapest_is_on_it() {
        let point = |(seconds, error)| {
            let family = Family::Sobol;
            StudyPoint { family, sampling: family.setting(24), seconds, error, seeds: 1, pareto: false }
        };
        let mut study = Study {
            names: Default::default(),
            size: [1, 1],
            convention: Convention::default(),
            threads: 1,
            reference: Reference { loss: 1.0, error: 1e-4, scenes: 24 },
            points: [(1.0, 0.1), (2.0, 0.2), (3.0, 0.01), (3.0, 0.02), (0.5, 0.1), (4.0, 0.01)]
                .map(point)
                .into(),
            left_out: Vec::new(),
        };
        let marks = |study: &mut Study| {
            study.mark();
            study.points.iter().map(|p| p.pareto).collect::<Vec<_>>()
        };
        assert_eq!(marks(&mut study), [false, false, true, false, true, false]);
        let seconds = [0.1, 0.03, 0.01, 0.001].map(|error| study.cheapest(error).map(|p| p.seconds));
        assert_eq!(seconds, [Some(0.5), Some(3.0), Some(3.0), None]);
        // A planted fault: one point too good to be true takes the whole front.
        study.points.push(point((0.4, 0.001)));
        assert_eq!(marks(&mut study), [false, false, false, false, false, false, true]);
    }
}
