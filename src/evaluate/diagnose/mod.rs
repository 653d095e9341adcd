//! Diagnosis: whether an error of exposure, alignment, scale or reading explains a loss, and how far the ground truth resolves it.
//!
//! Free values (stops, factors, placements) are fitted in the scenes of a pilot and evaluated in other scenes, so that their intervals
//! are valid after the search. `docs/diagnose.md` describes each line.
//!
//! ```
//! use svbrdf_evaluate::diagnose::{Storage, diagnose};
//! use svbrdf_core::material::Material;
//! use svbrdf_core::model::brdf::Texel;
//! use svbrdf_core::model::convention::Convention;
//! use svbrdf_core::progress::Progress;
//!
//! let texel = |roughness: f32| Texel { normal: glam::Vec3::Z, diffuse: [0.5; 3], specular: [0.04; 3], roughness };
//! let truth = Material::uniform("truth", 32, 32, &texel(0.3))?;
//! let glossiness = Material::uniform("glossiness", 32, 32, &texel(0.7))?;
//! let storage = Storage::default();
//! let found = diagnose([&truth, &glossiness], [&storage; 2], &Convention::default(), 0.0, 0, &Progress::default())?;
//! assert!(found.marked().next().is_some_and(|finding| finding.hypothesis.name() == "roughness"));
//! # Ok::<(), svbrdf_evaluate::Error>(())
//! ```

mod alignment;
mod corrected;
mod dither;
mod evaluation;
mod explanation;
mod exposure;
mod factor;
mod finding;
mod floor;
mod marking;
mod proposals;
mod samples;
mod search;
mod sentence;
mod trials;

#[cfg(test)]
pub(crate) mod tests;

pub use dither::dithered;
pub use evaluation::holm;
pub use finding::{Alternative, Diagnosis, Finding, Hypothesis, Value};
pub use floor::floor;
pub use search::{Explained, SCENES, diagnose};
pub use sentence::{sentence, sentence_of};
pub use svbrdf_files::changes::{Change, Placement, Reading, Symmetry, shifted};
pub use svbrdf_files::read::Storage;
