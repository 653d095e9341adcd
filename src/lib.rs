//! What SVBRDF predictions look like beside their ground truth, and how far they are from it.
//!
//! A material is four maps: normal, diffuse, specular, roughness. The headless core renders it under a light and a
//! view (Algorithm 3 of Deschaintre et al. 2018-2020) and computes the rendering loss between two materials over
//! sampled scenes (Algorithms 1 and 2):
//!
//! ```
//! use svbrdf::loss::{Comparison, Request};
//! use svbrdf::model::convention::Convention;
//! use svbrdf::progress::Progress;
//! use svbrdf::samples;
//!
//! let built_in = samples::load::<f32>()?;
//! let prediction = &built_in.predictions[0].material;
//! let comparison = Comparison::new(&built_in.ground_truth.material, &[prediction], Convention::default())?;
//! let outcome = comparison.run(&Request::default(), &Progress::default())?;
//! let estimate = &outcome.losses[0].estimate;
//! assert!((estimate.mean - 0.3712).abs() < 1e-4);
//! assert!(estimate.standard_error.is_some_and(|error| error < 0.05));
//! # Ok::<(), svbrdf::error::Error>(())
//! ```
//!
//! # The map
//!
//! | module | what |
//! |---|---|
//! | [`material`] | the four maps, checked once; [`files::read`] opens files; [`samples`] are built in |
//! | [`model::convention`] | what differs between the printed algorithms and the released codes, as data |
//! | [`model::brdf`] | Algorithm 3 at one point, a function a term, over [`math::real`] and [`math::vec3`] |
//! | [`model::scene`] | Algorithm 2 and the scenes of Algorithm 1, functions of a point of the unit cube |
//! | [`model::sampler`] | where the points of the unit cube come from: random, or scrambled Sobol sequences |
//! | [`render`] | Algorithm 3 over a whole material |
//! | [`loss`] | Algorithm 1: one `Comparison`, one `Request`, one `Outcome` with its errors; plain and fused |
//! | [`study`] | speed against accuracy, measured for one pair on one machine |
//! | [`picture::tone`], [`picture::colour_map`], [`picture::export`] | what a screen shows, of radiance and of differences; pictures as PNG and EXR files |
//! | [`picture::camera`], [`picture::quantity`] | where in a pane the material is seen; rendering or which map |
//! | [`report`] | losses with what gives them a meaning, as text |
//! | [`progress`], [`error`] | long work watched and cancelled; one error variant a cause |
#![cfg_attr(
    feature = "gpu",
    doc = "| [`gpu`] | the shaders (twins of `brdf`), the two passes, a probe for numbers |"
)]
#![cfg_attr(
    feature = "viewer",
    doc = "| [`viewer`] | the window: panels return commands, one place carries them out |"
)]
//!
//! The core knows no graphics; `gpu` knows the core; `viewer` knows both; the command line is in the binary. Cargo's
//! features enforce it: `--no-default-features` is the core with the command line.

pub mod error;
pub mod files;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod image;
pub mod loss;
pub mod material;
pub mod math;
pub mod model;
pub mod picture;
pub mod progress;
pub mod render;
pub mod report;
pub mod samples;
pub mod study;
pub mod text;
#[cfg(feature = "viewer")]
pub mod viewer;
