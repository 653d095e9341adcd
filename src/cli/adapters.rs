//! `svbrdf adapters`: the graphics adapters of this machine.

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
pub fn run(AdaptersArgs {}: AdaptersArgs) -> Result<(), CommandError> {
    let line = |one: svbrdf_gpu::AdapterReport| {
        let (side, format) = (one.max_texture_side, one.shading_format);
        format!("{one}\n  renders to {format:?}; materials of at most {side} x {side} texels\n")
    };
    Ok(put_text(&svbrdf_gpu::Gpu::adapters()?.into_iter().map(line).collect::<String>())?)
}

#[cfg(not(feature = "viewer"))]
pub fn run(AdaptersArgs {}: AdaptersArgs) -> Result<(), CommandError> {
    Err(CommandError::NoWindow)
}
