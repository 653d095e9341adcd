//! The real program in a real window on a display without a screen (Xvfb), with a simulated mouse and keyboard.

mod arguments;
mod dialogs;
mod sessions;
mod starts;

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use image::RgbImage;
use svbrdf_needs::{has, needs};

use crate::support::desktop::{Desktop, Running, changed, colours};
use crate::support::gpu::STALE_BUILD;

impl Desktop {
    /// `svbrdf` on the display.
    fn svbrdf(&self) -> Command {
        self.program(env!("CARGO_BIN_EXE_svbrdf"))
    }

    /// Starts `svbrdf` on these arguments in the folder, and waits for the materials to be drawn.
    fn open(&self, arguments: &[&str]) -> Running {
        let mut command = self.svbrdf();
        let log = std::fs::File::create(self.folder.path().join("log")).unwrap();
        command.args(arguments).current_dir(self.folder.path()).stdout(Stdio::null()).stderr(log);
        let program = command.spawn().map(Running).unwrap();
        // An empty screen has one colour, the window without materials a few hundred.
        self.wait("the materials to be drawn", |p| colours(p) > 3000);
        self.xdotool("search --sync --name svbrdf windowfocus");
        self.wait_until_still();
        program
    }

    /// Opens a dialog by its key, and waits until it is there.
    fn dialog(&self, key: &str) {
        let before = self.wait_until_still();
        self.xdotool(&format!("key {key}"));
        self.wait("the dialog", |picture| changed(picture, &before) > 20_000);
        self.wait_until_still();
    }

    /// Presses keys, each in a frame of its own: the focus moves once a frame.
    fn keys(&self, keys: &[&str]) {
        for key in keys {
            self.xdotool(&format!("key {key}"));
            self.wait_until_still();
        }
    }
}

/// Whether a program is on the PATH.
fn installed(program: &str) -> bool {
    let found = Command::new("which").arg(program).stdout(Stdio::null()).status();
    found.is_ok_and(|status| status.success())
}

#[test]
fn one_changed_pixel_is_counted_and_rounding_is_not() {
    let still = RgbImage::from_pixel(4, 3, image::Rgb([100; 3]));
    for (level, expected) in [(100, 0), (112, 0), (113, 1), (87, 1)] {
        let mut planted = still.clone();
        planted.put_pixel(3, 2, image::Rgb([100, level, 100]));
        assert_eq!(changed(&planted, &still), expected, "{level}");
    }
}

#[test]
fn the_build_knows_whether_the_window_can_be_tested() {
    let there = ["Xvfb", "xdotool", "import"].iter().all(|program| installed(program));
    assert_eq!(has!(desktop), there, "{STALE_BUILD}");
    assert!(there || std::env::var_os("CI").is_none(), "CI must have Xvfb, xdotool and import");
}

#[needs(f32_adapter, desktop)]
#[test]
fn the_window_opens_follows_the_mouse_and_obeys_a_key() {
    let desktop = Desktop::start();
    let log = std::fs::File::create(desktop.folder.path().join("log")).unwrap();
    let program = desktop.svbrdf().stdout(Stdio::null()).stderr(log).spawn().map(Running).unwrap();
    // An empty screen has one colour, the window without materials a few hundred.
    desktop.wait("the built-in pair to be drawn", |p| colours(p) > 3000);
    let before = desktop.wait_until_still();

    desktop.xdotool("mousemove 200 300");
    desktop.xdotool("mousedown 1");
    desktop.xdotool("mousemove 260 220");
    desktop.xdotool("mousemove 330 180");
    desktop.xdotool("mouseup 1");
    let after = desktop.wait("the light to follow the drag", |p| changed(p, &before) > 20_000);

    desktop.xdotool("search --sync --name svbrdf windowfocus");
    desktop.xdotool("key m");
    desktop.wait("the normal map to be shown", |p| changed(p, &after) > 60_000);

    let mut program = program;
    assert!(program.0.try_wait().unwrap().is_none(), "the program still runs");
}
