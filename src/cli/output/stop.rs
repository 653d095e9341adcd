//! Signals, such as that of Ctrl+C, while files are written.

use std::process;

use svbrdf_core::progress::Progress;
use svbrdf_files::disk::signals;

use super::exit::INTERRUPTED;

/// Runs work that leaves temporary files when killed. Ctrl+C and the other signals that end a program cancel it, so that it
/// removes them; a second signal ends the program at once. Before this work there is nothing to remove, and signals have their default effect.
pub fn stoppable<R>(work: impl FnOnce(&Progress) -> R) -> R {
    let progress = Progress::default();
    let part = progress.part();
    signals::on_end(move || {
        if part.is_cancelled() {
            process::exit(INTERRUPTED.into());
        }
        part.cancel();
    });
    work(&progress)
}
