//! Rendering of SVBRDF materials, and the rendering loss of predictions against a ground truth: numbers only.
//!
//! This crate knows no files, no graphics adapter, no window and no command line; analyses are in `svbrdf-evaluate`. The crate `svbrdf` is the program
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
//! | [`progress`], [`error`], [`text`] | progress and cancellation of long operations; one error variant per cause; numbers as text |
//!
//! Modules use those above them only, except that `error`, `progress` and `text` serve all; a test checks it.

mod choices;
pub mod error;
pub mod image;
pub mod loss;
pub mod material;
pub mod math;
pub mod model;
pub mod parallel;
pub mod picture;
pub mod progress;
pub mod render;
pub mod statistics;
pub mod text;
