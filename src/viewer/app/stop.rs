//! Stop at a signal that ends a program: what is being written is cancelled, and the window closes.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::time::Duration;

use eframe::egui;

use svbrdf_core::progress::Progress;

use super::context::CurrentContext;
use svbrdf_files::disk::signals;

/// How long the window may take to close after a signal.
const TIME_TO_CLOSE: Duration = Duration::from_secs(5);
/// The exit code after a signal, as of the command line.
const INTERRUPTED: i32 = 130;

/// Whether a signal has come, and the writing that it cancels.
#[derive(Clone, Debug, Default)]
pub struct Stop {
    stopped: Arc<AtomicBool>,
    writing: Arc<Mutex<Weak<Progress>>>,
}

impl Stop {
    /// Listens for signals; a second one ends the program at once.
    pub fn listen(&self, window: &CurrentContext) {
        let (stop, window) = (self.clone(), window.clone());
        signals::on_end(move || {
            if stop.stopped.swap(true, Ordering::SeqCst) {
                std::process::exit(INTERRUPTED);
            }
            stop.cancel();
            let ctx = window.get();
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            ctx.request_repaint();
            // A window that hangs does not close.
            let stop = stop.clone();
            std::thread::spawn(move || {
                std::thread::sleep(TIME_TO_CLOSE);
                while stop.is_writing() {
                    std::thread::sleep(Duration::from_millis(50));
                }
                std::process::exit(INTERRUPTED);
            });
        });
    }

    /// From now on, a signal cancels the work of this progress.
    pub fn cancels(&self, progress: &Arc<Progress>) {
        *self.writing.lock().unwrap_or_else(PoisonError::into_inner) = Arc::downgrade(progress);
        if self.is_stopped() {
            self.cancel();
        }
    }

    /// Whether a signal has come.
    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::SeqCst)
    }

    fn cancel(&self) {
        if let Some(progress) = self.writing.lock().unwrap_or_else(PoisonError::into_inner).upgrade() {
            progress.cancel();
        }
    }

    fn is_writing(&self) -> bool {
        self.writing.lock().unwrap_or_else(PoisonError::into_inner).strong_count() > 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_cancelled_even_if_it_starts_after_the_signal() {
        let stop = Stop::default();
        let before = Arc::new(Progress::default());
        stop.cancels(&before);
        assert!(!before.is_cancelled() && stop.is_writing());
        stop.stopped.store(true, Ordering::SeqCst);
        stop.cancel();
        assert!(before.is_cancelled());
        let after = Arc::new(Progress::default());
        stop.cancels(&after);
        assert!(after.is_cancelled());
        drop((before, after));
        assert!(!stop.is_writing());
    }
}
