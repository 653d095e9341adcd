//! Crash guard: a panic in a frame closes the window as a normal exit does, and becomes the error of the program.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui_wgpu::WgpuError;

use svbrdf_core::error::Error as CoreError;
use svbrdf_files::Error as FilesError;

use super::display;
use crate::error::Error;
use crate::jobs::work::panics;

/// How far the window has come, and the panic that ended it.
#[derive(Clone, Debug, Default)]
pub struct CrashGuard {
    /// Whether a frame has been drawn.
    has_drawn: Arc<AtomicBool>,
    /// Whether somebody has used the window: until then it starts.
    is_used: Arc<AtomicBool>,
    problem: Arc<Mutex<Option<Error>>>,
}

impl CrashGuard {
    /// Draws a frame, unless one has panicked; false where one has.
    pub fn frame(&self, draw: impl FnOnce()) -> bool {
        let is_sound = !self.has_crashed() && self.attempt(draw);
        self.has_drawn.fetch_or(is_sound, Ordering::SeqCst);
        is_sound
    }

    /// Does something that may panic; false where it does. The first panic is the one that is reported.
    pub fn attempt(&self, work: impl FnOnce()) -> bool {
        let caught = panics::caught(|| {
            work();
            Ok(())
        });
        let is_sound = caught.is_ok();
        if let Err(error) = caught {
            self.problem.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        }
        is_sound
    }

    /// Whether a frame has panicked.
    pub fn has_crashed(&self) -> bool {
        self.problem.lock().unwrap_or_else(PoisonError::into_inner).is_some()
    }

    /// Ends the start of the window: somebody uses it.
    pub fn begin_use(&self) {
        self.is_used.store(true, Ordering::SeqCst);
    }

    /// Forgets a panic that a lost device has caused.
    pub fn forgive(&self) {
        self.take();
    }

    fn take(&self) -> Option<Error> {
        self.problem.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// The end of the program: `result` is that of the window library, an error where it has panicked itself. A start that has panicked
/// calls `move_settings`, which moves the settings aside: they may be its reason.
///
/// # Errors
/// [`Error::NoWindow`] and [`CoreError::NoAdapter`] where no frame was drawn, [`FilesError::Internal`] after a panic later on.
pub fn outcome(
    guard: &CrashGuard,
    result: Result<Result<(), eframe::Error>, Error>,
    move_settings: impl FnOnce() -> Option<PathBuf>,
) -> Result<(), Error> {
    let [has_drawn, is_used] = [&guard.has_drawn, &guard.is_used].map(|flag| flag.load(Ordering::SeqCst));
    let panic = match (guard.take(), result) {
        (None, Ok(result)) => return result.map_err(|error| no_window(&error)),
        (None, Err(panic)) if !has_drawn && is_of_keyboard(&panic) => {
            return Err(Error::NoWindow {
                problem: format!("the window system failed: {panic}"),
                remedy: "install libxkbcommon0 and libxkbcommon-x11-0, then try again",
            });
        }
        (Some(panic), _) | (None, Err(panic)) => panic,
    };
    Err(if is_used { panic } else { failed_start(panic, move_settings()) })
}

/// Whether the library of the keyboard is missing, for which winit panics.
fn is_of_keyboard(panic: &Error) -> bool {
    panic.to_string().contains("xkbcommon")
}

/// The error of a start that has panicked, with the place of the settings that it has moved aside.
fn failed_start(panic: Error, moved: Option<PathBuf>) -> Error {
    match (panic.files(), moved) {
        (Some(FilesError::Internal(problem)), Some(moved)) => Error::internal(format!(
            "{problem}, as the window opened. Its settings were moved to {}; the next start has the default ones",
            moved.display()
        )),
        _ => panic,
    }
}

fn no_window(error: &eframe::Error) -> Error {
    match error {
        eframe::Error::Wgpu(WgpuError::CreateSurfaceError(_) | WgpuError::RequestAdapterError(_)) => {
            let problem = "no driver for Vulkan or OpenGL was found".to_owned();
            let remedy = "install one, for example the software driver in Debian's mesa-vulkan-drivers";
            CoreError::NoAdapter { problem, remedy }.into()
        }
        eframe::Error::Winit(_) | eframe::Error::WinitEventLoop(_) => display::none(),
        other => Error::NoWindow {
            problem: other.to_string(),
            remedy: "check the graphics driver and the display",
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The end of a window that is used before its frame number `used`, and whose library then panics where it has a message.
    fn end(frames: &[fn()], used: usize, library: Option<&'static str>) -> (Result<(), Error>, bool) {
        let guard = CrashGuard::default();
        for (number, frame) in frames.iter().enumerate() {
            if number == used {
                guard.begin_use();
            }
            guard.frame(frame);
        }
        let library = || library.map_or(Ok(Ok(())), |message| panic!("{message}"));
        let moved = std::cell::Cell::new(false);
        let move_settings = || {
            moved.set(true);
            Some(PathBuf::from("app.ron.damaged"))
        };
        (outcome(&guard, panics::caught(library), move_settings), moved.get())
    }

    const PLANTED: fn() = || panic!("planted in a panel");
    const NEVER: usize = usize::MAX;

    #[test]
    fn only_a_missing_library_of_the_keyboard_is_advised_to_be_installed() {
        let (end, moved) = end(&[], NEVER, Some("Library libxkbcommon.so could not be loaded."));
        let error = end.unwrap_err();
        assert!(matches!(&error, Error::NoWindow { .. }) && !moved, "{error}");
        assert!(error.to_string().contains("install libxkbcommon0"), "{error}");
    }

    #[test]
    fn a_start_that_panics_moves_the_settings_aside_and_says_so() {
        let library = Some("planted in the library");
        /// Its frames, the panic of its library, and what is reported.
        type Start = (&'static [fn()], Option<&'static str>, &'static str);
        let starts: [Start; 4] = [
            (&[], library, "planted in the library"),
            (&[|| ()], library, "planted in the library"),
            (&[PLANTED], None, "planted in a panel"),
            (&[|| (), || (), PLANTED, || unreachable!()], None, "planted in a panel"),
        ];
        for (frames, library, cause) in starts {
            let (end, moved) = end(frames, NEVER, library);
            let text = end.unwrap_err().to_string();
            assert!(moved && text.contains("app.ron.damaged") && !text.contains("install"), "{text}");
            assert!(text.contains(cause) && text.contains("crash.rs:"), "{text}");
        }
        assert!(matches!(end(&[|| ()], NEVER, None), (Ok(()), false)));
    }

    #[test]
    fn a_panic_of_a_window_in_use_is_reported_with_message_and_location_and_leaves_the_settings() {
        for frames in [&[PLANTED][..], &[|| (), PLANTED, || unreachable!()]] {
            let (end, moved) = end(frames, 0, None);
            let error = end.unwrap_err();
            let text = error.to_string();
            assert!(matches!(error.files(), Some(FilesError::Internal(_))) && !moved, "{text}");
            assert!(text.contains("planted in a panel") && text.contains("crash.rs:"), "{text}");
        }
    }
}
