//! Losses with the settings that they depend on, as text: what the command line prints and the window copies.
//!
//! ```
//! use svbrdf_core::loss::{Comparison, Request};
//! use svbrdf_core::material::Material;
//! use svbrdf_core::model::brdf::Texel;
//! use svbrdf_core::model::convention::Convention;
//! use svbrdf_core::progress::Progress;
//! use svbrdf_core::report::Report;
//!
//! let texel = |roughness| Texel { normal: glam::Vec3::Z, diffuse: [0.5; 3], specular: [0.04; 3], roughness };
//! let truth = Material::uniform("truth", 64, 64, &texel(0.6))?;
//! let prediction = Material::uniform("too rough", 64, 64, &texel(0.7))?;
//! let comparison = Comparison::new(&truth, &[&prediction], Convention::default())?;
//! let outcome = comparison.run(&Request::default(), &Progress::default())?;
//! let report = Report::new(&comparison, outcome);
//! assert!(report.text().starts_with("rendering loss against truth, 64 x 64 texels, f32 on the cpu"));
//! # Ok::<(), svbrdf_core::error::Error>(())
//! ```

mod names;
pub mod table;
mod text;

pub use names::distinct_names;

use crate::loss::{Comparison, Compute, Estimate, Loss, Outcome, Texels};
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::model::scene::Kind;

/// Losses with the settings that they depend on.
#[derive(Clone, Debug)]
pub struct Report {
    /// The convention that the losses follow.
    pub convention: Convention,
    /// The name of the ground truth.
    pub ground_truth: String,
    /// Width and height in texels.
    pub size: [usize; 2],
    /// `f32` or `f64`.
    pub precision: &'static str,
    /// What computed it: `cpu` or `gpu`.
    pub backend: &'static str,
    /// The scenes and the losses.
    pub outcome: Outcome,
    /// The losses over all scenes, to +-1%: reports of a few scenes lead with them.
    pub all_scenes: Option<Outcome>,
}

impl Report {
    /// The report of an outcome of `comparison`.
    pub fn new<T: Compute>(comparison: &Comparison<'_, T>, outcome: Outcome) -> Self {
        Self {
            convention: *comparison.convention(),
            ground_truth: comparison.ground_truth().name().to_owned(),
            size: comparison.ground_truth().size(),
            precision: T::NAME,
            backend: comparison.backend().name(),
            outcome,
            all_scenes: None,
        }
    }

    /// The same report with other names: the ground truth first, then each prediction.
    #[must_use]
    pub fn renamed(mut self, names: &[String]) -> Self {
        let Some((ground_truth, predictions)) = names.split_first() else { return self };
        self.ground_truth.clone_from(ground_truth);
        for outcome in [&mut self.outcome].into_iter().chain(&mut self.all_scenes) {
            for (loss, name) in outcome.losses.iter_mut().zip(predictions) {
                loss.prediction.clone_from(name);
            }
        }
        self
    }

    /// The paired difference of each further loss from the first: `loss - first`, over the same scenes.
    pub fn differences(&self) -> Vec<(&Loss, Estimate)> {
        let others = self.outcome.losses.iter().enumerate().skip(1);
        others.map(|(index, loss)| (loss, self.outcome.difference(index, 0))).collect()
    }

    /// The seed that names the scenes; `None` where they were listed.
    pub fn seed(&self) -> Option<u64> {
        self.outcome.sampling.map(|sampling| sampling.seed)
    }

    /// How the scenes were sampled; `None` where they were listed.
    pub fn sampler(&self) -> Option<Sampler> {
        self.outcome.sampling.map(|sampling| sampling.sampler)
    }

    /// The texels that are compared in each scene.
    pub fn texels(&self) -> Texels {
        let sampled = self.outcome.sampling.and_then(|sampling| sampling.texels.sampled(self.size));
        sampled.map_or(Texels::All, Texels::Sampled)
    }

    /// The number of scenes of a kind.
    pub fn count(&self, kind: Kind) -> usize {
        self.outcome.scenes.iter().filter(|scene| scene.kind == kind).count()
    }
}
