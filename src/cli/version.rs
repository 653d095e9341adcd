//! `svbrdf --version --verbose`: program and machine, as a report of a fault needs them.

use std::fmt::Write as _;
use std::thread;

use svbrdf_core::render::simd::Level;

/// The version alone, or with commit, features, platform, processor and adapter.
pub fn text(verbose: bool) -> String {
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
        ("commit", option_env!("SVBRDF_COMMIT").unwrap_or("unknown").to_owned()),
        ("build", env!("SVBRDF_PROFILE").to_owned()),
        ("features", features()),
        ("platform", env!("SVBRDF_TARGET").to_owned()),
        ("processor", format!("{}, {threads} threads", Level::best().name())),
        ("adapter", adapter()),
    ]
}

fn features() -> String {
    if cfg!(feature = "viewer") { "viewer" } else { "none" }.to_owned()
}

/// The graphics adapter with its driver, or why there is none.
#[cfg(feature = "viewer")]
fn adapter() -> String {
    svbrdf_gpu::Gpu::headless().map_or_else(|error| format!("none: {error}"), |gpu| gpu.report.to_string())
}

#[cfg(not(feature = "viewer"))]
fn adapter() -> String {
    "none: this program was built without the window".to_owned()
}
