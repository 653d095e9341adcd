//! Failures of the device as values: the default handler of wgpu 30 for errors that no scope catches panics.

use std::fmt;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use wgpu::{Device, ErrorFilter};

use svbrdf_core::error::Error;

/// What to do where the driver fails and nothing more is known.
pub(super) const DRIVER_REMEDY: &str = "update the graphics driver, or use the CPU";

/// The first failure that no error scope caught, and the loss of the device.
#[derive(Clone, Default)]
pub(super) struct Faults(Arc<Watched>);

#[derive(Default)]
struct Watched {
    first: Mutex<Option<Error>>,
    /// Why the device was lost.
    loss: OnceLock<String>,
    at_loss: OnceLock<Box<dyn Fn() + Send + Sync>>,
}

impl Faults {
    /// Catches from now on what `device` would panic about, and its loss.
    pub(super) fn watch(device: &Device) -> Self {
        let faults = Self::default();
        let uncaptured = faults.clone();
        device.on_uncaptured_error(Arc::new(move |error| uncaptured.note(from_wgpu("drawing", &error))));
        // The device holds its callbacks, which would hold it.
        let lost = Arc::downgrade(&faults.0);
        device.set_device_lost_callback(move |_, message| {
            if let Some(lost) = lost.upgrade() {
                Self(lost).note_loss(message);
            }
        });
        faults
    }

    pub(super) fn take(&self) -> Option<Error> {
        self.0.first.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Why the device was lost, where it was.
    pub(super) fn loss(&self) -> Option<&str> {
        self.0.loss.get().map(String::as_str)
    }

    /// Calls `then` once the device is lost, on any thread. Only the first call has an effect.
    pub(super) fn at_loss(&self, then: impl Fn() + Send + Sync + 'static) {
        let _ = self.0.at_loss.set(Box::new(then));
    }

    fn note_loss(&self, message: String) {
        self.note(failed(format!("the device was lost: {message}")));
        let _ = self.0.loss.set(message);
        self.0.at_loss.get().into_iter().for_each(|then| then());
    }

    fn note(&self, error: Error) {
        self.0.first.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    }
}

impl fmt::Debug for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Faults").field(&self.0.first).field(&self.0.loss).finish()
    }
}

/// An [`Error::Gpu`] about the driver.
pub(super) fn failed(problem: String) -> Error {
    Error::Gpu { problem, remedy: DRIVER_REMEDY }
}

/// Runs `work` with every failure of `device` caught; `doing` says in the error what it was.
pub(super) fn scoped<T>(device: &Device, doing: &str, work: impl FnOnce() -> T) -> Result<T, Error> {
    let memory = device.push_error_scope(ErrorFilter::OutOfMemory);
    let internal = device.push_error_scope(ErrorFilter::Internal);
    let validation = device.push_error_scope(ErrorFilter::Validation);
    let result = work();
    // Scopes are a stack: the last is popped first.
    let validation = pollster::block_on(validation.pop());
    let internal = pollster::block_on(internal.pop());
    let memory = pollster::block_on(memory.pop());
    match memory.or(validation).or(internal) {
        None => Ok(result),
        Some(error) => Err(from_wgpu(doing, &error)),
    }
}

fn from_wgpu(doing: &str, error: &wgpu::Error) -> Error {
    match error {
        wgpu::Error::OutOfMemory { .. } => Error::Gpu {
            problem: format!("out of memory while {doing}"),
            remedy: "close other programs, use a smaller material, or use the CPU",
        },
        error => failed(format!("{doing}: {error}")),
    }
}
