//! The window on the built-in pair, whose device is lost: `losing always` loses each at once, `losing when-told` the current one at every
//! line of stdin. Tells each loss on stderr.

use std::process::ExitCode;
use std::sync::{Arc, Mutex, PoisonError};
use std::{env, io, thread};

use svbrdf_gpu::Gpu;
use svbrdf_viewer::{ViewerOptions, run_watched};

fn lose(gpu: &Gpu) {
    eprintln!("lost");
    gpu.lose();
}

fn main() -> ExitCode {
    let always = env::args().nth(1).as_deref() == Some("always");
    let current: Arc<Mutex<Option<Gpu>>> = Arc::default();
    let told = Arc::clone(&current);
    thread::spawn(move || {
        for _ in io::stdin().lines() {
            let gpu = told.lock().unwrap_or_else(PoisonError::into_inner).take();
            gpu.iter().for_each(lose);
        }
    });
    let opened = |gpu: &Gpu| {
        if always {
            lose(gpu);
        }
        *current.lock().unwrap_or_else(PoisonError::into_inner) = Some(gpu.clone());
    };
    match run_watched(ViewerOptions::default(), opened) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
