//! Long work on all cores, without the interpreter lock, that Ctrl+C ends.

use std::process;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::Error;
use svbrdf_files::Error as FilesError;

use crate::errors::exception;

/// How often signals are looked for and progress is reported.
const TICK: Duration = Duration::from_millis(50);

/// The threads of this process. A forked process, such as a worker of a PyTorch `DataLoader`, has none of the threads of
/// its parent and needs its own.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

fn pool() -> PyResult<Arc<ThreadPool>> {
    let process = process::id();
    let mut pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((owner, pool)) = pool.as_ref()
        && *owner == process
    {
        return Ok(pool.clone());
    }
    let started = ThreadPoolBuilder::new().build();
    let started =
        started.map_err(|e| exception(FilesError::Internal(format!("no threads can be started: {e}"))))?;
    let started = Arc::new(started);
    // That of the parent cannot be ended from here.
    std::mem::forget(pool.replace((process, started.clone())));
    Ok(started)
}

/// Runs short `work` on all cores.
///
/// # Errors
/// Those of the work.
pub fn at_once<R: Send, E: Into<Error> + Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<R, E> + Send,
) -> PyResult<R> {
    let pool = pool()?;
    py.detach(|| pool.install(work)).map_err(exception)
}

/// Runs `work` on all cores. `report`, if any, is called with (steps done, steps in all) while it runs.
///
/// # Errors
/// Those of the work; what a signal handler or `report` raises, which cancels the work.
pub fn run<R: Send, E: Into<Error> + Send>(
    py: Python<'_>,
    report: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Progress) -> Result<R, E> + Send,
) -> PyResult<R> {
    let pool = pool()?;
    let progress = Progress::default();
    let tell = || match report {
        Some(report) => report.call1(progress.counts()).map(drop),
        None => Ok(()),
    };
    let (sender, receiver) = channel();
    // A receiver cannot be shared, which waiting without the lock takes.
    let receiver = Mutex::new(receiver);
    let wait = |time| {
        let receiver = receiver.lock().unwrap_or_else(PoisonError::into_inner);
        receiver.recv_timeout(time)
    };
    let (watched, pool) = (&progress, &pool);
    let result = thread::scope(|scope| {
        scope.spawn(move || {
            let result = pool.install(|| work(watched));
            // Nobody waits for it where the work was cancelled.
            let _ = sender.send(result);
        });
        loop {
            match py.detach(|| wait(TICK)) {
                Ok(result) => return result.map_err(exception),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(exception(FilesError::Internal(
                        "a computation ended without a result".to_owned(),
                    )));
                }
            }
            if let Err(raised) = py.check_signals().and_then(|()| tell()) {
                progress.cancel();
                py.detach(|| while wait(TICK).is_err_and(|e| e == RecvTimeoutError::Timeout) {});
                return Err(raised);
            }
        }
    })?;
    tell()?;
    Ok(result)
}
