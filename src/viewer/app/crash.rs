//! Crash guard: a panic in a frame closes the window as a normal exit does, and becomes the error of the program.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui_wgpu::WgpuError;

use svbrdf_core::error::Error;

use crate::viewer::jobs::work::panics;

/// Whether a frame has been drawn, and the panic that ended the window.
#[derive(Clone, Debug, Default)]
pub struct CrashGuard {
    has_drawn: Arc<AtomicBool>,
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

    /// Forgets a panic that a lost device has caused.
    pub fn forgive(&self) {
        self.take();
    }

    fn take(&self) -> Option<Error> {
        self.problem.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// The end of the program: `result` is that of the window library, an error where it has panicked itself.
///
/// # Errors
/// [`Error::NoWindow`] and [`Error::NoAdapter`] where no frame was drawn, [`Error::Internal`] after a panic later on.
pub fn outcome(guard: &CrashGuard, result: Result<Result<(), eframe::Error>, Error>) -> Result<(), Error> {
    let has_drawn = guard.has_drawn.load(Ordering::SeqCst);
    match (guard.take(), result) {
        (Some(crash), _) => Err(crash),
        (None, Ok(result)) => result.map_err(|error| no_window(&error)),
        (None, Err(panic)) if has_drawn => Err(panic),
        (None, Err(Error::Internal(problem))) => Err(Error::NoWindow {
            problem: format!("the window system failed: {problem}"),
            remedy: "install libxkbcommon0 and libxkbcommon-x11-0, then try again",
        }),
        (None, Err(error)) => Err(error),
    }
}

fn no_window(error: &eframe::Error) -> Error {
    match error {
        eframe::Error::Wgpu(WgpuError::CreateSurfaceError(_) | WgpuError::RequestAdapterError(_)) => {
            Error::NoAdapter {
                problem: "no driver for Vulkan or OpenGL was found".to_owned(),
                remedy: "install one, for example the software driver in Debian's mesa-vulkan-drivers",
            }
        }
        eframe::Error::Winit(_) | eframe::Error::WinitEventLoop(_) => Error::NoWindow {
            problem: "there is no display".to_owned(),
            remedy: "set DISPLAY or WAYLAND_DISPLAY, or start a virtual one with xvfb-run",
        },
        other => Error::NoWindow {
            problem: other.to_string(),
            remedy: "check the graphics driver and the display",
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The end of a window whose frames are these, and whose library then panics where `library_panics`.
    fn end(frames: &[fn()], library_panics: bool) -> Result<(), Error> {
        let guard = CrashGuard::default();
        for frame in frames {
            guard.frame(frame);
        }
        let library = || if library_panics { panic!("planted in the library") } else { Ok(Ok(())) };
        outcome(&guard, panics::caught(library))
    }

    #[test]
    fn only_a_panic_before_the_first_frame_is_a_missing_window() {
        let error = end(&[], true).unwrap_err();
        assert!(matches!(&error, Error::NoWindow { .. }), "{error}");
        assert!(error.to_string().contains("planted in the library"), "{error}");
        let error = end(&[|| ()], true).unwrap_err();
        assert!(matches!(&error, Error::Internal(_)), "{error}");
        assert!(end(&[|| ()], false).is_ok());
    }

    #[test]
    fn a_panic_of_a_frame_is_reported_with_message_and_location_and_ends_all_frames() {
        let planted: fn() = || panic!("planted in a panel");
        for frames in [vec![planted], vec![|| (), planted, || unreachable!()]] {
            let error = end(&frames, false).unwrap_err();
            let text = error.to_string();
            assert!(matches!(error, Error::Internal(_)), "{text}");
            assert!(text.contains("planted in a panel") && text.contains("crash.rs:"), "{text}");
        }
    }
}
