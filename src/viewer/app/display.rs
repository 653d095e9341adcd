//! Display of the window: of Wayland, or of X11 where no Wayland compositor answers.

use std::ffi::OsString;

use crate::error::Error;

/// What the environment says about displays.
#[derive(Clone, Debug, Default)]
struct Displays {
    wayland: Option<OsString>,
    /// A connection that is handed over to this program.
    wayland_socket: Option<OsString>,
    x11: Option<OsString>,
}

impl Displays {
    fn of_environment() -> Self {
        let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty());
        Self {
            wayland: variable("WAYLAND_DISPLAY"),
            wayland_socket: variable("WAYLAND_SOCKET"),
            x11: variable("DISPLAY"),
        }
    }

    /// Whether X11 is used, which winit tries only without Wayland: where both are named, and no Wayland compositor `answers`.
    #[cfg_attr(not(all(unix, not(target_os = "macos"))), allow(dead_code, reason = "there is one display"))]
    fn is_stale(&self, answers: impl Fn(&OsString) -> bool) -> bool {
        let stale = self.wayland.as_ref().is_some_and(|wayland| !answers(wayland));
        stale && self.wayland_socket.is_none() && self.x11.is_some()
    }

    /// Which display was tried in vain.
    fn problem(&self) -> String {
        let named = [("WAYLAND_DISPLAY", &self.wayland), ("DISPLAY", &self.x11)];
        let tried: Vec<String> = named
            .into_iter()
            .filter_map(|(name, value)| Some(format!("{name}={}", value.as_ref()?.display())))
            .collect();
        if tried.is_empty() {
            "there is no display".to_owned()
        } else {
            format!("no display answers at {}", tried.join(" or "))
        }
    }
}

/// Chooses the display of the event loop.
#[cfg(all(unix, not(target_os = "macos")))]
pub fn choose(options: &mut eframe::NativeOptions) {
    use winit::platform::x11::EventLoopBuilderExtX11 as _;

    if Displays::of_environment().is_stale(answers) {
        options.event_loop_builder = Some(Box::new(|builder| {
            builder.with_x11();
        }));
    }
}

/// Chooses the display of the event loop: there is one.
#[cfg(not(all(unix, not(target_os = "macos"))))]
pub fn choose(_: &mut eframe::NativeOptions) {}

/// Whether a compositor listens at this name, or path, of a socket.
#[cfg(all(unix, not(target_os = "macos")))]
fn answers(wayland: &OsString) -> bool {
    // A path stays as it is.
    let folder = std::env::var_os("XDG_RUNTIME_DIR").unwrap_or_default();
    let path = std::path::Path::new(&folder).join(wayland);
    path.is_absolute() && std::os::unix::net::UnixStream::connect(path).is_ok()
}

/// The error of a start on which no display answers.
pub fn none() -> Error {
    Error::NoWindow {
        problem: Displays::of_environment().problem(),
        remedy: "set DISPLAY or WAYLAND_DISPLAY, or start a virtual one with xvfb-run",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn displays([wayland, wayland_socket, x11]: [&str; 3]) -> Displays {
        let [wayland, wayland_socket, x11] =
            [wayland, wayland_socket, x11].map(|name| (!name.is_empty()).then(|| name.into()));
        Displays { wayland, wayland_socket, x11 }
    }

    #[test]
    fn x11_takes_the_place_of_a_wayland_display_that_does_not_answer() {
        let stale = displays(["wayland-0", "", ":0"]);
        assert!(stale.is_stale(|_| false) && !stale.is_stale(|_| true));
        for others in [["wayland-0", "", ""], ["", "", ":0"], ["wayland-0", "7", ":0"], ["", "", ""]] {
            assert!(!displays(others).is_stale(|_| false), "{others:?}");
        }
    }

    #[test]
    fn the_displays_that_were_tried_are_named() {
        assert_eq!(displays(["", "", ""]).problem(), "there is no display");
        let both = displays(["wayland-0", "", ":0"]).problem();
        assert_eq!(both, "no display answers at WAYLAND_DISPLAY=wayland-0 or DISPLAY=:0");
    }
}
