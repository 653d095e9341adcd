//! Rendering of SVBRDF materials, and the rendering loss of predictions against a ground truth: numbers only.
//!
//! This crate knows no files, no graphics adapter, no window and no command line. The crate `svbrdf` is the program
//! and the library for users; its documentation has an example and the map of all crates.
//!
//! | module | content |
//! |---|---|
//! | [`statistics`] | quantiles |
//! | [`math`], [`image`] | the two precisions and their vectors; RGB images of linear radiance |
//! | [`model::convention`] | the differences between the printed algorithms and the released codes, as data |
//! | [`model::brdf`] | Algorithm 3 at one point, one function per term |
//! | [`model::scene`], [`model::sampler`] | Algorithm 2: scenes as functions of a point of the unit cube; random points, or scrambled Sobol sequences |
//! | [`material`] | the four maps, validated once |
//! | [`render`] | Algorithm 3 over a whole material |
//! | [`picture`] | what a picture shows of materials: quantities, differences, tone and colour maps |
//! | [`loss`] | Algorithm 1: a `Comparison`, a `Request`, an `Outcome` with confidence intervals |
//! | [`why`] | what a loss comes from: maps, scenes, directions of light, texels; the worst scene |
//! | [`diagnose`] | whether exposure, alignment or reading explain a loss; what the ground truth resolves |
//! | [`metrics`] | differences of maps and renderings, each with its convention in its name |
//! | [`rank`] | many predictions of one ground truth, best first |
//! | [`study`] | speed against accuracy, measured for one pair on one machine |
//! | [`report`] | results with their settings as values, and as text, JSON, CSV and LaTeX |
//! | [`progress`], [`error`], [`text`] | progress and cancellation of long operations; one error variant per cause; numbers as text |
//!
//! Modules use those above them only, except that `error`, `progress` and `text` serve all; a test checks it.

pub mod diagnose;
pub mod error;
pub mod image;
pub mod loss;
pub mod material;
pub mod math;
pub mod metrics;
pub mod model;
pub mod picture;
pub mod progress;
pub mod rank;
pub mod render;
pub mod report;
pub mod statistics;
pub mod study;
pub mod text;
pub mod why;
