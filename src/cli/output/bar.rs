//! The progress of long operations: a bar on a terminal, else a line a minute.

use std::io::{IsTerminal, stderr};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use svbrdf_core::progress::Progress;

use super::exit;

/// Operations that end sooner get no bar.
const DELAY: Duration = Duration::from_millis(500);
/// The time between two lines where stderr is no terminal.
const LINE: Duration = Duration::from_secs(60);
const REFRESH: Duration = Duration::from_millis(100);

/// Runs `work`; if it takes long, with a progress bar of this title, or lines where stderr is no terminal.
pub fn watched<R>(title: &str, work: impl FnOnce(&Progress) -> R) -> R {
    watched_on(&Progress::default(), title, work)
}

/// [`watched`], with a progress that others may cancel.
pub fn watched_on<R>(progress: &Progress, title: &str, work: impl FnOnce(&Progress) -> R) -> R {
    let (working, finished) = channel::<()>();
    thread::scope(|scope| {
        match stderr().is_terminal() {
            true => scope.spawn(move || show(title, progress, &finished)),
            false => scope.spawn(move || report(title, progress, &finished, LINE)),
        };
        let result = work(progress);
        drop(working);
        result
    })
}

/// Prints a line about the progress each `interval`, until the other end of `finished` is dropped.
fn report(title: &str, progress: &Progress, finished: &Receiver<()>, interval: Duration) {
    while finished.recv_timeout(interval) == Err(RecvTimeoutError::Timeout) {
        let (done, total) = progress.counts();
        exit::tell(&format!("{title}: {done} of {total}"));
    }
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
