//! Ctrl+C while files are written.

use std::process;

use svbrdf::progress::Progress;

use super::exit::INTERRUPTED;

/// Does work that leaves temporary files where it is killed: on Ctrl+C, SIGTERM and SIGHUP it is cancelled, so that it
/// takes them away; a second one ends the program at once. Before, there is nothing to take away, and a signal ends the
/// program as any other.
pub fn stoppable<R>(work: impl FnOnce(&Progress) -> R) -> R {
    let progress = Progress::default();
    let part = progress.part();
    // An error: a signal is handled or ignored already, as under nohup, and stays so.
    let _ = ctrlc::try_set_handler(move || {
        if part.is_cancelled() {
            process::exit(INTERRUPTED.into());
        }
        part.cancel();
    });
    work(&progress)
}
