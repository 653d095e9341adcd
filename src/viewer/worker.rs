//! Slow work, off the window's thread.

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::time::{Duration, Instant};

use eframe::egui;

use super::background;
use crate::error::Error;
use crate::progress::Progress;

/// How often the progress of a running task is looked at.
const LOOK_AGAIN: Duration = Duration::from_millis(250);

/// One piece of work on its own thread. Dropping it cancels the work: the latest request wins.
#[derive(Debug)]
pub struct Task<T> {
    progress: Arc<Progress>,
    result: Receiver<Result<T, Error>>,
    started: Instant,
}

impl<T: Send + 'static> Task<T> {
    /// Starts `work`; the window is drawn again when it ends.
    pub fn start(
        ctx: &egui::Context,
        work: impl FnOnce(&Progress) -> Result<T, Error> + Send + 'static,
    ) -> Self {
        Self::start_with(ctx, Progress::default(), work)
    }

    /// As [`Task::start`], with a progress that is known before the work.
    pub fn start_with(
        ctx: &egui::Context,
        progress: Progress,
        work: impl FnOnce(&Progress) -> Result<T, Error> + Send + 'static,
    ) -> Self {
        let progress = Arc::new(progress);
        let (sender, result) = mpsc::channel();
        let (ctx, seen) = (ctx.clone(), progress.clone());
        ctx.request_repaint_after(LOOK_AGAIN);
        std::thread::spawn(move || {
            background::lower_this_thread();
            // Where the window has dropped this task, the result is not wanted.
            let _ = sender.send(work(&seen));
            ctx.request_repaint();
        });
        Self { progress, result, started: Instant::now() }
    }

    /// The result, once; `None` while the work goes on. A worker that ends without a result is an error.
    pub fn poll(&self, ctx: &egui::Context) -> Option<Result<T, Error>> {
        match self.result.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Empty) => {
                ctx.request_repaint_after(LOOK_AGAIN);
                None
            }
            Err(TryRecvError::Disconnected) => {
                Some(Err(Error::Internal("the work ended without a result".to_owned())))
            }
        }
    }

    /// The progress of the work, to cancel it from elsewhere.
    pub fn progress(&self) -> Arc<Progress> {
        self.progress.clone()
    }

    /// Waits for the end of the work.
    ///
    /// # Errors
    /// Those of the work.
    pub fn wait(&self) -> Result<T, Error> {
        self.result
            .recv()
            .unwrap_or_else(|_| Err(Error::Internal("the work ended without a result".to_owned())))
    }

    /// Share of the work that is done, in [0, 1].
    pub fn fraction(&self) -> f32 {
        let (done, total) = self.progress.counts();
        if total == 0 { 0.0 } else { done as f32 / total as f32 }
    }

    pub fn elapsed(&self) -> Duration {
        self.started.elapsed()
    }

    pub fn cancel(&self) {
        self.progress.cancel();
    }
}

impl<T> Drop for Task<T> {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}
