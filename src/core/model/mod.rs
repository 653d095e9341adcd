//! The BRDF, the scenes and the conventions: pure functions of numbers.
//!
//! ```
//! use svbrdf_core::model::convention::{Convention, PRINTED};
//! use svbrdf_core::model::sampler::Sampler;
//! use svbrdf_core::model::scene::Kind;
//!
//! let convention: Convention = "printed".parse()?;
//! assert_eq!(convention, PRINTED);
//! // 6 near-field and 3 distant scenes of seed 0.
//! let scenes = Sampler::Random.scenes(0, 6, 3, &convention);
//! assert_eq!(scenes.iter().filter(|scene| scene.kind == Kind::Near).count(), 6);
//! # Ok::<(), svbrdf_core::error::Error>(())
//! ```

pub mod brdf;
pub mod convention;
pub mod grammar;
mod hemisphere_points;
pub mod named_conventions;
pub mod named_scenes;
pub mod sampler;
pub mod scene;
pub mod terms;
