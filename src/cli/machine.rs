//! Program and machine: `svbrdf adapters`, and `svbrdf --version --verbose`, as a report of a fault needs them.

use std::fmt::Write as _;
use std::thread;
use svbrdf_core::render::simd::Level;

use super::output::CommandError;
#[cfg(feature = "viewer")]
use super::output::exit::put_text;

/// Lists the graphics adapters, the one of the window first
///
/// With what each renders to, the largest material that it takes, and why the first is taken. `svbrdf view --adapter NAME` takes another one,
/// WGPU_BACKEND leaves out graphics interfaces, and WGPU_POWER_PREF=low prefers the adapter that saves power.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct AdaptersArgs {}

/// Prints to stdout.
#[cfg(feature = "viewer")]
pub fn list(AdaptersArgs {}: AdaptersArgs) -> Result<(), CommandError> {
    let line = |one: svbrdf_gpu::AdapterReport| {
        let (side, format) = (one.max_texture_side, one.shading_format);
        format!("{one}\n  renders to {format:?}; materials of at most {side} x {side} texels\n")
    };
    Ok(put_text(&svbrdf_gpu::Gpu::adapters()?.into_iter().map(line).collect::<String>())?)
}

#[cfg(not(feature = "viewer"))]
pub fn list(AdaptersArgs {}: AdaptersArgs) -> Result<(), CommandError> {
    Err(CommandError::NoWindow)
}

/// The version alone, or with commit, features, platform, processor and adapter.
pub fn version(verbose: bool) -> String {
    let mut text = format!("svbrdf {}\n", env!("CARGO_PKG_VERSION"));
    if verbose {
        for (name, value) in facts() {
            let _ = writeln!(text, "{name}: {value}");
        }
    }
    text
}

fn facts() -> [(&'static str, String); 6] {
    let threads = thread::available_parallelism().map_or(1, usize::from);
    [
        ("commit", super::output::COMMIT.unwrap_or("unknown").to_owned()),
        ("build", env!("SVBRDF_PROFILE").to_owned()),
        ("features", features()),
        ("platform", env!("SVBRDF_TARGET").to_owned()),
        ("processor", format!("{}, {threads} threads", Level::best().name())),
        ("adapter", first_adapter()),
    ]
}

fn features() -> String {
    if cfg!(feature = "viewer") { "viewer" } else { "none" }.to_owned()
}

/// The graphics adapter with its driver, or why there is none.
#[cfg(feature = "viewer")]
fn first_adapter() -> String {
    svbrdf_gpu::Gpu::headless().map_or_else(|error| format!("none: {error}"), |gpu| gpu.report.to_string())
}

#[cfg(not(feature = "viewer"))]
fn first_adapter() -> String {
    "none: this program was built without the window".to_owned()
}
