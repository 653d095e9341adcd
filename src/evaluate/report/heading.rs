//! Settings of reports, the command that repeats them, and accuracies that are not reached.

use serde::Serialize;

use std::fmt;
use svbrdf_core::loss::{Estimate, Sampling};
use svbrdf_core::material::Material;
use svbrdf_core::math::real::Real;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::named_scenes::NamedScenes;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::text::percent;
use svbrdf_files::disk::atomic::SOFTWARE;
use svbrdf_files::read::Storage;

/// The ground truth of a report, and the convention of its losses.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Compared {
    pub ground_truth: String,
    /// Width and height in texels.
    #[serde(skip)]
    pub size: [usize; 2],
    /// How many texels the mask keeps; `None` without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub masked: Option<usize>,
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
            masked: None,
            convention: convention.name,
            epsilon: convention.epsilon,
        }
    }

    /// The lines above a table of `content`, such as "rendering loss".
    pub fn heading(&self, content: &str) -> String {
        let Self { ground_truth, size: [width, height], convention, epsilon, .. } = self;
        let masked = in_mask(self.masked);
        format!(
            "{content} against {ground_truth}, {width} x {height} texels{masked}\nconvention {convention}, epsilon {epsilon}\n"
        )
    }
}

/// How many texels a mask keeps, as it follows their number.
pub(crate) fn in_mask(masked: Option<usize>) -> String {
    masked.map_or_else(String::new, |kept| format!(", {kept} in the mask"))
}

/// The numbers of scenes, how they were sampled and the texels of each, for materials of `size`: a line. `None` for `sampling`: the
/// scenes are listed, and may be a set with a name.
pub fn scenes_line(sampling: Option<&Sampling>, scenes: &[Scene], size: [usize; 2]) -> String {
    let count = |kind| scenes.iter().filter(|scene| scene.kind == kind).count();
    let counts = format!("{} near-field and {} distant scenes", count(Kind::Near), count(Kind::Distant));
    let Some(sampling) = sampling else {
        let named = NamedScenes::of(scenes).map(NamedScenes::description);
        return named.map_or(counts.clone() + ", listed\n", |named| format!("{counts}: {named}\n"));
    };
    let sampler = if sampling.sampler == Sampler::Sobol { ", scrambled Sobol" } else { "" };
    let texels = match sampling.texels.sampled(size) {
        None => String::new(),
        Some(1) => ", 1 random texel per scene".to_owned(),
        Some(count) => format!(", {count} random texels per scene"),
    };
    format!("{counts}, seed {}{sampler}{texels}\n", sampling.seed)
}

/// The floor of the ground truth: a line.
pub fn floor_line(floor: &Estimate) -> String {
    format!(
        "floor of the ground truth {:.6}: smaller losses and differences are not resolvable\n",
        floor.mean
    )
}

/// What the losses of a convention that renders normals as stored leave out: a sentence, where stored lengths are not 1.
pub fn stored_normals_note<'a>(
    convention: &Convention,
    storages: impl IntoIterator<Item = &'a Storage>,
) -> Option<String> {
    let off = storages.into_iter().map(|storage| storage.off_unit).fold(0.0, f64::max);
    (off > 0.0 && convention.has_stored_normals()).then(|| {
        format!(
            "{} renders normals as stored. Their lengths differ from 1 by {off:.3} on average, and are made 1 here: losses differ from \
             those of the authors' code",
            convention.name
        )
    })
}

/// A position or direction as people read it.
pub fn position([x, y, z]: [f64; 3]) -> String {
    format!("({x:.3}, {y:.3}, {z:.3})")
}

/// A sentence about a loss over `scenes` scenes whose 95% interval reaches further from it than `target`, a share of it.
pub fn missed(target: f64, prediction: &str, loss: &Estimate, scenes: usize) -> Option<String> {
    let reached = loss.relative_error95();
    (reached > target).then(|| {
        format!(
            "{prediction} is known to +-{}, not to the target of +-{}: {scenes} scenes, the limit, are not enough; go by the \
             interval, or set a larger target",
            percent(reached),
            percent(target)
        )
    })
}

/// As [`missed`], of that of the losses, each beside its prediction, which is known least.
pub fn missed_by_any<'a>(
    target: f64,
    losses: impl Iterator<Item = (&'a str, Estimate)>,
    scenes: usize,
) -> Option<String> {
    let error = |(_, loss): &(&str, Estimate)| loss.relative_error95();
    let (prediction, loss) = losses.max_by(|a, b| error(a).total_cmp(&error(b)))?;
    missed(target, prediction, &loss, scenes)
}

/// How to repeat a result.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Repetition {
    /// The program and its version, with the commit that it is built from where that is known.
    pub software: String,
    /// The command line.
    pub command: String,
}

impl Repetition {
    /// By `command` and this version of the program.
    pub fn new(command: String) -> Self {
        Self { software: SOFTWARE.to_owned(), command }
    }

    /// The same by a program that is built from this commit, of which the beginning is named.
    #[must_use]
    pub fn at(self, commit: Option<&str>) -> Self {
        let commit = commit.map_or(String::new(), |commit| format!("+{commit:.12}"));
        Self { software: self.software + &commit, ..self }
    }
}

impl fmt::Display for Repetition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "repeat with {}: {}", self.software, self.command)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_core::loss::Texels;
    use svbrdf_core::model::named_scenes::flash_9;

    #[test]
    fn a_line_about_scenes_has_the_texels_that_are_compared() {
        let line = |texels| {
            let sampling = Sampling { texels, ..Sampling::default() };
            scenes_line(Some(&sampling), &[], [2, 2])
        };
        let of_all = "0 near-field and 0 distant scenes, seed 0\n";
        assert_eq!(line(Texels::All), of_all);
        assert_eq!(line(Texels::Sampled(4)), of_all, "the maps have no more");
        assert!(line(Texels::Sampled(3)).ends_with(", 3 random texels per scene\n"));
        assert!(line(Texels::Sampled(1)).ends_with(", 1 random texel per scene\n"));
        assert_eq!(scenes_line(None, &[], [2, 2]), "0 near-field and 0 distant scenes, listed\n");
        let nine = scenes_line(None, &flash_9(), [2, 2]);
        assert!(nine.starts_with("9 near-field and 0 distant scenes: flash at the camera in nine"), "{nine}");
    }
}
