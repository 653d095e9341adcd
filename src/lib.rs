//! Rendering of SVBRDF materials, and the rendering loss of predictions against a ground truth.
//!
//! A material is four maps: normal, diffuse, specular and roughness. The library renders it under a light and a view
//! (Algorithm 3 of Deschaintre et al. 2018-2020) and computes the rendering loss between two materials over sampled
//! scenes (Algorithms 1 and 2):
//!
//! ```
//! use svbrdf::{Comparison, Convention, Progress, Request, built_in};
//!
//! let materials = built_in::<f32>()?;
//! let prediction = &materials.predictions[0].material;
//! let comparison = Comparison::new(&materials.ground_truth.material, &[prediction], Convention::default())?;
//! let outcome = comparison.run(&Request::default(), &Progress::default())?;
//! let estimate = &outcome.losses[0].estimate;
//! assert!((estimate.mean - 0.3712).abs() < 1e-4);
//! assert!(estimate.standard_error.is_some_and(|error| error < 0.05));
//! # Ok::<(), svbrdf::Error>(())
//! ```
//!
//! The root has what a first program needs. Everything else is in the crates that this one is made of; each depends on
//! those above it only:
//!
//! | crate | folder | content |
//! |---|---|---|
//! | `svbrdf_assets` | `assets` | what the program embeds: the built-in materials and the icon |
//! | [`svbrdf_core`] | `src/core` | numbers only: BRDF, scenes, materials, rendering, pictures, loss |
//! | [`svbrdf_files`] | `src/files` | reading and writing: materials, renderings, sessions, photographs, the built-in materials |
//! | [`svbrdf_evaluate`] | `src/evaluate` | analyses, each a computation and a report: what a loss comes from, diagnoses, metrics, rankings, data sets, photographs |
//! | `svbrdf_shaders` | `shaders` | the WGSL of adapters, and the GLSL of pages |
//! | [`svbrdf_page`] | `src/page` | reports and rankings as HTML pages |
//! | `svbrdf_gpu` (feature `viewer`) | `src/gpu` | rendering on a graphics adapter |
//! | `svbrdf_viewer` (feature `viewer`) | `src/viewer` | the window |
//! | `svbrdf` | `src` | the command line in `src/cli`, which is part of the binary |
//!
//! In `src/viewer`, `model` is what the window displays, changed by commands alone; `jobs` computes in the background; `ui` reads
//! the hand and draws. The compiler guards the order of the crates, `tests/layering.rs` that of the modules within.
//! `docs/architecture.md` follows a loss, a drag and a folder through them.

pub use svbrdf_core::loss::{Comparison, Estimate, Loss, Outcome, Request, Sampling, Texels};
pub use svbrdf_core::material::{Map, Material, Planes};
pub use svbrdf_core::model::convention::Convention;
pub use svbrdf_core::model::sampler::Sampler;
pub use svbrdf_core::model::scene::{Kind, Scene};
pub use svbrdf_core::progress::Progress;
pub use svbrdf_core::render::render_f32 as render;
pub use svbrdf_evaluate::Error;
pub use svbrdf_evaluate::why::attribute;
pub use svbrdf_files::read::{Read, ReadOptions, read};
pub use svbrdf_files::samples::load as built_in;
pub use svbrdf_files::write::{FileKind, write};

#[cfg(feature = "viewer")]
pub use svbrdf_viewer::{OpenDataset, ViewerOptions, run as open_viewer};
