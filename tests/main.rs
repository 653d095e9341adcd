//! Every integration test, in one binary: it links once.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]
#![allow(clippy::disallowed_methods, reason = "a test reads its own files")]

mod support;

mod bad_input;
mod cli;
mod conform;
mod conventions;
mod coverage;
mod detection;
mod docs;
#[cfg(feature = "viewer")]
mod end_to_end;
mod formats;
#[cfg(feature = "viewer")]
mod gpu_parity;
mod ladder;
mod layering;
mod metrics;
mod mutations;
mod packages;
mod page;
mod photograph;
mod rank;
mod reading;
mod real_files;
mod sampling;
mod scene_files;
#[cfg(feature = "viewer")]
mod shaders;
mod shared_materials;
mod study;
mod validators;
mod why;
