//! Rendering of SVBRDF materials, and the rendering loss of predictions against a ground truth.
//!
//! A material is four maps: normal, diffuse, specular and roughness. The headless core renders it under a light and a
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
//! # Modules
//!
//! | module | content |
//! |---|---|
//! | [`math`], [`image`] | the two precisions and their vectors; RGB images of linear radiance |
//! | [`model::convention`] | the differences between the printed algorithms and the released codes, as data |
//! | [`model::brdf`] | Algorithm 3 at one point, one function per term |
//! | [`model::scene`], [`model::sampler`] | Algorithm 2: scenes as functions of a point of the unit cube; random points, or scrambled Sobol sequences |
//! | [`model::scene_file`] | files of scenes |
//! | [`material`] | the four maps, validated once |
//! | [`render`] | Algorithm 3 over a whole material |
//! | [`picture`] | renderings as PNG and EXR files |
//! | [`files`] | reading and writing materials |
//! | [`loss`] | Algorithm 1: a `Comparison`, a `Request`, an `Outcome` with confidence intervals |
//! | [`backend`] | the processor or a graphics adapter, whichever is faster |
//! | [`report`] | results with their settings as values, and as text, JSON, CSV and LaTeX |
//! | [`why`] | what a loss comes from: maps, scenes, directions of light, texels; the worst scene |
//! | [`metrics`] | differences of maps and renderings, each with its convention in its name |
//! | [`photograph`] | renderings against a photograph: four corners, one exposure factor |
//! | [`rank`] | many predictions of one ground truth, best first |
//! | [`dataset`] | many materials and methods: result files, means with intervals over materials |
//! | [`study`] | speed against accuracy, measured for one pair on one machine |
//! | [`samples`] | built-in materials |
//! | [`source`] | where a material comes from and how it is read: files, built-in materials, entries of sessions |
//! | [`progress`], [`error`] | progress and cancellation of long operations; one error variant per cause |
#![cfg_attr(feature = "gpu", doc = "| [`gpu`] | rendering and loss on a graphics adapter |")]
#![cfg_attr(feature = "viewer", doc = "| [`open_viewer`] | the window |")]
//!
//! Modules use lower layers only; a test checks it. The core does not depend on graphics, `gpu` depends on the core, `viewer` on
//! both, and the command line is part of the binary. Without default features the crate is the core with the command line.
//! The feature `testing` makes internals public for the tests of this repository; it has no stable interface.

pub mod backend;

// Until all callers name the crates themselves.
pub use svbrdf_core::{
    error, image, loss, material, math, metrics, progress, rank, render, report, text, why,
};
pub use svbrdf_files as files;
pub use svbrdf_files::{dataset, photograph, samples, source};
#[cfg(feature = "gpu")]
pub use svbrdf_gpu as gpu;

pub mod model {
    pub use svbrdf_core::model::*;
    pub use svbrdf_files::scene_file;
}

pub mod picture {
    pub use svbrdf_core::picture::*;
    pub use svbrdf_files::export;
    pub use svbrdf_files::export::strip;
}

pub mod study {
    pub use svbrdf_core::study::*;
    pub use svbrdf_files::export::{study_csv, study_plot as plot};
}

#[cfg(all(feature = "viewer", not(feature = "testing")))]
mod viewer;
#[cfg(feature = "testing")]
pub mod viewer;

#[cfg(feature = "viewer")]
pub use viewer::{ViewerOptions, run as open_viewer};
