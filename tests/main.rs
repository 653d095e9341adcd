//! Every integration test, in one binary: it links once.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod support;

mod bad_input;
mod cli;
mod end_to_end;
mod fused;
mod golden_loss;
mod golden_points;
mod gpu_parity;
mod physics;
mod reading;
mod sampling;
mod shaders;
mod ui;
