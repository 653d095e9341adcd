//! The window on the built-in pair, whose device is lost in the middle of frames: `losing always` in each, `losing drag` in drags.

use std::env;
use std::process::ExitCode;

use svbrdf_viewer::{ViewerOptions, run_watched};

fn main() -> ExitCode {
    let always = env::args().nth(1).as_deref() == Some("always");
    let closed = run_watched(ViewerOptions::default(), move |ctx, gpu| {
        if always || ctx.input(|input| input.pointer.is_decidedly_dragging()) {
            gpu.lose();
        }
    });
    match closed {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
