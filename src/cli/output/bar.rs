//! A progress bar for long operations, if stderr is a terminal.

use std::io::{IsTerminal, stderr};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use svbrdf_core::progress::Progress;

/// Operations that end sooner get no bar.
const DELAY: Duration = Duration::from_millis(500);
const REFRESH: Duration = Duration::from_millis(100);

/// Runs `work`, with a progress bar of this title if it takes long and stderr is a terminal.
pub fn watched<R>(title: &str, work: impl FnOnce(&Progress) -> R) -> R {
    let progress = Progress::default();
    if !stderr().is_terminal() {
        return work(&progress);
    }
    let (working, finished) = channel::<()>();
    thread::scope(|scope| {
        let progress = &progress;
        scope.spawn(move || show(title, progress, &finished));
        let result = work(progress);
        drop(working);
        result
    })
}

/// Shows a bar until the other end of `finished` is dropped.
fn show(title: &str, progress: &Progress, finished: &Receiver<()>) {
    let waits = |time| finished.recv_timeout(time) == Err(RecvTimeoutError::Timeout);
    if !waits(DELAY) {
        return;
    }
    let bar = ProgressBar::new(0).with_message(title.to_owned()).with_style(style());
    while {
        let (done, total) = progress.counts();
        bar.set_length(total);
        bar.set_position(done);
        waits(REFRESH)
    } {}
    bar.finish_and_clear();
}

fn style() -> ProgressStyle {
    let template = "{msg} [{bar:40}] {percent}% (ready in {eta})";
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}
