//! Every integration test, in one binary: it links once.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]
#![allow(clippy::disallowed_methods, reason = "a test reads its own files")]

mod support;

mod cli;
mod conform;
mod conventions;
mod coverage;
mod docs;
#[cfg(feature = "viewer")]
mod end_to_end;
#[cfg(feature = "viewer")]
mod gpu_parity;
mod ladder;
mod layering;
mod materials;
mod metrics;
mod mutations;
mod packages;
mod page;
mod photograph;
mod protocols;
mod rank;
mod real_files;
mod released;
mod sampling;
#[cfg(feature = "viewer")]
mod shaders;
mod study;
mod why;
mod written;
