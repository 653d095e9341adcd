//! Crash guard: a panic in a frame, or a lost graphics device, closes the window as a normal exit does, and becomes the error of the
//! program.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui_wgpu::WgpuError;

use svbrdf_core::error::Error as CoreError;
use svbrdf_files::session::Session;

use crate::error::Error;
use crate::jobs::work::panics;

/// What ended the window.
#[derive(Clone, Debug, Default)]
pub struct CrashGuard {
    error: Arc<Mutex<Option<Error>>>,
    loss: Arc<Mutex<Option<DeviceLoss>>>,
    stopped: Arc<AtomicBool>,
}

/// A lost device.
#[derive(Clone, Debug)]
pub struct DeviceLoss {
    /// Why the device was lost.
    pub reason: String,
    /// `None` where materials were still being read.
    pub session: Option<Session>,
    /// The results folder of its data set, which is none of the session.
    pub results: Option<PathBuf>,
}

impl CrashGuard {
    /// Draws a frame, unless one has failed; false where one has.
    pub fn frame(&self, draw: impl FnOnce()) -> bool {
        if self.has_crashed() {
            return false;
        }
        let caught = panics::caught(|| {
            draw();
            Ok(())
        });
        caught.map_err(|error| self.fail(error)).is_ok()
    }

    /// Asks the window to close at a signal that ends the program; false where one has asked before.
    pub fn stop(&self) -> bool {
        !self.stopped.swap(true, Ordering::SeqCst)
    }

    /// Whether a signal ends the program.
    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::SeqCst)
    }

    /// Keeps what a restart goes on with.
    pub fn lose(&self, loss: DeviceLoss) {
        *self.loss.lock().unwrap_or_else(PoisonError::into_inner) = Some(loss);
    }

    /// The device that was lost.
    pub fn loss(&self) -> Option<DeviceLoss> {
        self.loss.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Ends the window with this error. The first one is reported.
    pub fn fail(&self, error: Error) {
        self.error.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    }

    /// Whether a frame has failed.
    pub fn has_crashed(&self) -> bool {
        self.error.lock().unwrap_or_else(PoisonError::into_inner).is_some()
    }

    /// The end of the program: `result` is that of the window library, an error where it has panicked itself.
    ///
    /// # Errors
    /// [`Error::NoWindow`] and [`CoreError::NoAdapter`] where none was opened; what a frame has failed with.
    pub fn outcome(&self, result: Result<Result<(), eframe::Error>, Error>) -> Result<(), Error> {
        let failed = self.error.lock().unwrap_or_else(PoisonError::into_inner).take();
        match (failed, result) {
            (Some(error), _) => Err(error),
            (None, Ok(result)) => result.map_err(|error| no_window(&error)),
            // winit 0.30 panics where the library of the keyboard is missing.
            (None, Err(panic)) if panic.to_string().contains("xkbcommon") => Err(Error::NoWindow {
                problem: format!("the window system failed: {panic}"),
                remedy: "install libxkbcommon0 and libxkbcommon-x11-0, then try again",
            }),
            (None, Err(panic)) => Err(panic),
        }
    }
}

/// The reason of a loss, where its driver tells one.
pub fn told(reason: &str) -> String {
    let reason = reason.trim();
    if reason.is_empty() { "no reason was given" } else { reason }.to_owned()
}

/// The end of a window whose device was lost, where the program does not start anew.
pub fn lost(reason: &str) -> Error {
    let problem = format!("the graphics device was lost ({reason})");
    let remedy = "start again, and reopen these materials with Ctrl+Shift+O; where it is lost again, update the graphics driver or \
                  set WGPU_BACKEND to another one (vulkan, gl)";
    CoreError::Gpu { problem, remedy }.into()
}

fn no_window(error: &eframe::Error) -> Error {
    let (problem, remedy) = match error {
        eframe::Error::Wgpu(WgpuError::CreateSurfaceError(_) | WgpuError::RequestAdapterError(_)) => {
            let problem = "no driver for Vulkan or OpenGL was found".to_owned();
            let remedy = "install one, for example the software driver in Debian's mesa-vulkan-drivers";
            return CoreError::NoAdapter { problem, remedy }.into();
        }
        eframe::Error::Winit(_) | eframe::Error::WinitEventLoop(_) => {
            (no_display(), "set DISPLAY or WAYLAND_DISPLAY, or start a virtual one with xvfb-run")
        }
        other => (other.to_string(), "check the graphics driver and the display"),
    };
    Error::NoWindow { problem, remedy }
}

/// Which display was tried in vain.
fn no_display() -> String {
    let value = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    let text = |name| Some(format!("{name}={}", value(name)?.display()));
    let tried: Vec<String> = ["WAYLAND_DISPLAY", "DISPLAY"].into_iter().filter_map(text).collect();
    if tried.is_empty() {
        "there is no display".to_owned()
    } else {
        format!("no display answers at {}", tried.join(" or "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_panic_is_reported_with_its_place_and_only_a_missing_library_is_advised_to_be_installed() {
        let library = |text: &'static str| panics::caught(|| panic!("{text}"));
        let guard = CrashGuard::default();
        assert!(guard.frame(|| ()) && !guard.frame(|| panic!("planted in a panel")));
        assert!(!guard.frame(|| unreachable!()), "no frame is drawn after it");
        let text = guard.outcome(library("later")).unwrap_err().to_string();
        assert!(text.contains("planted in a panel") && text.contains("crash.rs:"), "{text}");
        for (message, is_advised) in [("planted in the library", false), ("no libxkbcommon.so", true)] {
            let text = CrashGuard::default().outcome(library(message)).unwrap_err().to_string();
            assert_eq!(text.contains("install libxkbcommon0"), is_advised, "{text}");
        }
        assert!(CrashGuard::default().outcome(Ok(Ok(()))).is_ok());
    }
}
