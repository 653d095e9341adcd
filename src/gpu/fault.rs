//! Failures of the device as values: wgpu would panic.

use std::sync::{Arc, Mutex, PoisonError};

use wgpu::{Device, ErrorFilter};

use svbrdf_core::error::Error;

/// What to do where the driver fails and nothing more is known.
pub(super) const DRIVER_REMEDY: &str = "update the graphics driver, or use the CPU";

/// The first failure that no error scope caught.
#[derive(Clone, Debug, Default)]
pub(super) struct Faults(Arc<Mutex<Option<Error>>>);

impl Faults {
    /// Catches from now on what `device` would panic about, and its loss.
    pub(super) fn watch(device: &Device) -> Self {
        let faults = Self::default();
        let uncaptured = faults.clone();
        device.on_uncaptured_error(Arc::new(move |error| uncaptured.note(from_wgpu("drawing", &error))));
        let lost = faults.clone();
        device.set_device_lost_callback(move |_, message| {
            lost.note(failed(format!("the device was lost: {message}")));
        });
        faults
    }

    pub(super) fn take(&self) -> Option<Error> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    fn note(&self, error: Error) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
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
