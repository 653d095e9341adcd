//! The real program in a real window on a display without a screen (Xvfb), with a simulated mouse and keyboard.

mod dialogs;
mod sessions;
mod starts;

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use image::RgbImage;
use svbrdf_needs::has;

use crate::support::desktop::{Desktop, Running, changed, colours};
use crate::support::gpu::STALE_BUILD;

impl Desktop {
    /// `svbrdf` on the display.
    fn svbrdf(&self) -> Command {
        self.program(env!("CARGO_BIN_EXE_svbrdf"))
    }

    /// Starts `svbrdf` on these arguments in the folder, and waits for the materials to be drawn.
    fn open(&self, arguments: &[&str]) -> Running {
        self.run(self.svbrdf(), arguments)
    }

    fn run(&self, mut command: Command, arguments: &[&str]) -> Running {
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

#[test]
fn the_build_knows_whether_the_window_can_be_tested() {
    let found =
        |program: &&str| Command::new("which").arg(program).stdout(Stdio::null()).status().unwrap().success();
    let there = ["Xvfb", "xdotool", "import"].iter().all(found);
    assert_eq!(has!(desktop), there, "{STALE_BUILD}");
    assert!(there || std::env::var_os("CI").is_none(), "CI must have Xvfb, xdotool and import");
}
