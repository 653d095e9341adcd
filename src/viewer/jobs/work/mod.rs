//! The mechanism of all background work: jobs on their own threads, with updates on the way, progress and cancellation, and the waker of
//! the window.

pub mod threads;

use std::fmt;
use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;

use crate::error::Error;
use threads::{caught, lower_this_thread};

/// How often the progress of a running job is looked at.
const LOOK_AGAIN: Duration = Duration::from_millis(250);

/// Work on a thread, which ends in a `T` and reports `U`s on the way. Dropping it cancels the work: the latest request wins.
pub struct Job<T, U = ()> {
    progress: Arc<Progress>,
    updates: Arc<Mutex<Vec<U>>>,
    result: Receiver<Result<T, Error>>,
    started: Instant,
    /// Whether its progress is looked at, now and then.
    has_progress: bool,
    waker: Waker,
}

/// The side of a job that works.
#[derive(Debug)]
pub struct Worker<U> {
    pub progress: Arc<Progress>,
    updates: Arc<Mutex<Vec<U>>>,
    waker: Waker,
}

impl<U> Worker<U> {
    /// Reports an update, and wakes the window.
    ///
    /// # Errors
    /// [`CoreError::Cancelled`] where the job was cancelled or dropped.
    pub fn report(&self, update: U) -> Result<(), Error> {
        self.post(|updates| updates.push(update))
    }

    /// Reports an update in the place of those that have not been taken, and wakes the window.
    ///
    /// # Errors
    /// As [`Worker::report`].
    pub fn replace(&self, update: U) -> Result<(), Error> {
        self.post(|updates| *updates = vec![update])
    }

    /// Wakes the window.
    pub fn wake(&self) {
        self.waker.wake();
    }

    fn post(&self, change: impl FnOnce(&mut Vec<U>)) -> Result<(), Error> {
        if self.progress.is_cancelled() {
            return Err(CoreError::Cancelled.into());
        }
        change(&mut self.updates.lock().unwrap_or_else(PoisonError::into_inner));
        self.wake();
        Ok(())
    }
}

impl<T: Send + 'static> Job<T> {
    /// Starts `work`, which has no updates; the window is woken when it ends.
    pub fn start(waker: &Waker, work: impl FnOnce(&Progress) -> Result<T, Error> + Send + 'static) -> Self {
        Self::stream(waker, move |worker| work(&worker.progress))
    }
}

impl<T: Send + 'static, U: Send + 'static> Job<T, U> {
    /// Starts `work`; the window is woken at every update and when it ends. A panic ends it with an error.
    pub fn stream(waker: &Waker, work: impl FnOnce(&Worker<U>) -> Result<T, Error> + Send + 'static) -> Self {
        waker.wake_after(LOOK_AGAIN);
        Self::spawn(waker, true, work)
    }

    /// Starts `work` that goes on until the job is dropped: the window is woken at updates alone.
    pub fn watch(waker: &Waker, work: impl FnOnce(&Worker<U>) -> Result<T, Error> + Send + 'static) -> Self {
        Self::spawn(waker, false, work)
    }

    fn spawn(
        waker: &Waker,
        has_progress: bool,
        work: impl FnOnce(&Worker<U>) -> Result<T, Error> + Send + 'static,
    ) -> Self {
        let (progress, updates) = (Arc::new(Progress::default()), Arc::new(Mutex::new(Vec::new())));
        let (sender, result) = mpsc::channel();
        let worker = Worker { progress: progress.clone(), updates: updates.clone(), waker: waker.clone() };
        std::thread::spawn(move || {
            lower_this_thread();
            // Where the window has dropped this job, the result is not wanted.
            let _ = sender.send(caught(|| work(&worker)));
            worker.wake();
        });
        Self { progress, updates, result, started: Instant::now(), has_progress, waker: waker.clone() }
    }

    /// The result, once; `None` while the work goes on. Every update is there before it.
    pub fn poll(&self) -> Option<Result<T, Error>> {
        match self.result.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Empty) => {
                if self.has_progress {
                    self.waker.wake_after(LOOK_AGAIN);
                }
                None
            }
            Err(TryRecvError::Disconnected) => Some(Err(taken())),
        }
    }

    /// The updates since the last call, the latest last.
    pub fn updates(&self) -> Vec<U> {
        std::mem::take(&mut self.updates.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Waits for the end of the work.
    ///
    /// # Errors
    /// Those of the work.
    pub fn wait(&self) -> Result<T, Error> {
        self.result.recv().unwrap_or_else(|_| Err(taken()))
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

impl<T, U> fmt::Debug for Job<T, U> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Job").field(&self.progress).finish()
    }
}

impl<T, U> Drop for Job<T, U> {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

fn taken() -> Error {
    Error::internal("the result of a job was taken twice")
}

/// Asks for a frame after a while.
#[derive(Clone)]
pub struct Waker(Arc<dyn Fn(Duration) + Send + Sync>);

impl Waker {
    /// `ask` asks for a frame after this time at the latest.
    pub fn new(ask: impl Fn(Duration) + Send + Sync + 'static) -> Self {
        Self(Arc::new(ask))
    }

    /// Asks for a frame at once.
    pub fn wake(&self) {
        self.wake_after(Duration::ZERO);
    }

    /// Asks for a frame after this time at the latest.
    pub fn wake_after(&self, time: Duration) {
        (self.0)(time);
    }
}

impl Default for Waker {
    /// A waker of no window.
    fn default() -> Self {
        Self::new(|_| {})
    }
}

impl fmt::Debug for Waker {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Waker")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn updates_come_before_the_result_and_wake_the_window() {
        let (sender, wakes) = mpsc::channel();
        let waker = Waker::new(move |after| {
            let _ = sender.send(after);
        });
        let job = Job::stream(&waker, |worker| {
            worker.report(1)?;
            worker.report(2)?;
            Ok("done")
        });
        assert_eq!(job.wait().unwrap(), "done");
        assert_eq!(job.updates(), [1, 2]);
        assert_eq!(wakes.iter().take(3).collect::<Vec<_>>(), [LOOK_AGAIN, Duration::ZERO, Duration::ZERO]);
    }

    #[test]
    fn the_latest_update_can_stand_for_all() {
        let job = Job::stream(&Waker::default(), |worker| (0..1000).try_for_each(|i| worker.replace(i)));
        job.wait().unwrap();
        assert_eq!(job.updates(), [999]);
    }

    #[test]
    fn a_dropped_job_is_cancelled() {
        let (started, ready) = mpsc::channel();
        let (ended, result) = mpsc::channel();
        let job = Job::<()>::start(&Waker::default(), move |progress| {
            started.send(()).unwrap();
            while !progress.is_cancelled() {
                std::thread::yield_now();
            }
            ended.send(progress.step().is_err()).unwrap();
            Ok(())
        });
        ready.recv().unwrap();
        drop(job);
        assert!(result.recv().unwrap());
    }
}
