//! Crash guard: a panic in a frame, or a lost graphics device, closes the window as a normal exit does, and becomes the error of the
//! program. After a lost device, or a failed start, the program starts itself anew: its window library cannot replace a device, nor make
//! a second event loop.

use std::ffi::OsStr;
use std::path::PathBuf;
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui_wgpu::WgpuError;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;
use svbrdf_files::disk::{atomic, own};
use svbrdf_files::session::Session;
use svbrdf_gpu::choice;

use super::storage;
use crate::error::Error;
use crate::jobs::work::threads;

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
        let caught = threads::caught(|| {
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

/// Why the program has started itself anew, in its environment.
const VARIABLE: &str = "SVBRDF_RESTARTED";
/// Its session among the settings.
const SESSION: &str = "restart.svbrdf-session.json";

/// Why the program has started itself anew, for its user; `None` where the user started it.
pub fn message() -> Option<String> {
    let reason = std::env::var(VARIABLE).ok()?;
    Some(format!(
        "The graphics device was lost ({reason}). The window was opened anew with the same session."
    ))
}

/// Starts the program anew: with its session, or as it was started itself where there is none. Returns where that failed, or where
/// the program was started so itself.
///
/// # Errors
/// The session cannot be written.
pub fn after_loss(DeviceLoss { reason, session, results }: &DeviceLoss) -> Result<(), Error> {
    let (None, Ok(program)) = (message(), std::env::current_exe()) else { return Ok(()) };
    let mut command = Command::new(program);
    match session.as_ref().map(stored).transpose()? {
        Some(Some(path)) => {
            command.arg("view").arg(path).arg("--allow-outside");
            command.args(results.iter().flat_map(|folder| [OsStr::new("--results"), folder.as_ref()]))
        }
        Some(None) => return Ok(()),
        None => command.args(std::env::args_os().skip(1)),
    };
    start(command.env(VARIABLE, reason));
    Ok(())
}

/// Starts the program anew, as it was started, with another graphics interface than that which has just failed to open a window. Returns
/// where each has failed.
pub fn with_another_interface() {
    if let (Some(failed), Ok(program)) = (choice::failed_with_taken(), std::env::current_exe()) {
        start(Command::new(program).args(std::env::args_os().skip(1)).env(choice::FAILED, failed));
    }
}

/// The file that a session was written to; `None` without a folder of settings.
fn stored(session: &Session) -> Result<Option<PathBuf>, Error> {
    let Some(folder) = storage::folder() else { return Ok(None) };
    let path = folder.join(SESSION);
    own::folder(&folder)?;
    atomic::write_text(&path, &session.text(&path)?, &Progress::default())?;
    Ok(Some(path))
}

/// Puts the command in the place of this process; returns where that failed.
#[cfg(unix)]
fn start(command: &mut Command) {
    use std::os::unix::process::CommandExt as _;
    let _ = command.exec();
}

/// Runs the command to its end, and ends as it does; returns where it cannot be started.
#[cfg(not(unix))]
fn start(command: &mut Command) {
    if let Ok(status) = command.status() {
        std::process::exit(status.code().unwrap_or(1));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_panic_is_reported_with_its_place_and_only_a_missing_library_is_advised_to_be_installed() {
        let library = |text: &'static str| threads::caught(|| panic!("{text}"));
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
