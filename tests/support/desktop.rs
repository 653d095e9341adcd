//! A display without a screen, and programs on it.

use std::io::{BufRead as _, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use image::{Rgb, RgbImage};

use super::surroundings::command;

/// Stops the program when the test ends, however it ends.
pub struct Running(pub Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A display and a home folder for one test.
pub struct Desktop {
    display: String,
    pub folder: tempfile::TempDir,
    _server: Running,
}

impl Desktop {
    pub fn start() -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x800x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let display = format!(":{}", number.trim());
        Self { display, folder: tempfile::tempdir().unwrap(), _server: Running(server) }
    }

    /// A program on the display, with the folder as its home. There is no session bus, and so no portal.
    pub fn command(&self, program: impl AsRef<std::ffi::OsStr>) -> Command {
        let mut command = command(program);
        command.env("DISPLAY", &self.display);
        command.env("HOME", self.folder.path()).env("XDG_RUNTIME_DIR", self.folder.path());
        command
    }

    /// An executable on the display, which finds the programs of the folder `bin` alone: without any there, no file dialog. Signals that the
    /// tests' own parent ignores are not ignored.
    pub fn program(&self, executable: &str) -> Command {
        let mut command = self.command("env");
        command.arg("--default-signal=INT,TERM,HUP").arg(format!("PATH={}", self.bin().display()));
        command.arg(executable);
        command
    }

    /// The folder of the programs that it finds.
    pub fn bin(&self) -> PathBuf {
        self.folder.path().join("bin")
    }

    pub fn xdotool(&self, arguments: &str) {
        let status = self.command("xdotool").args(arguments.split(' ')).stdout(Stdio::null()).status();
        assert!(status.unwrap().success(), "xdotool {arguments}");
        std::thread::sleep(Duration::from_millis(150));
    }

    pub fn screenshot(&self) -> RgbImage {
        let path = self.folder.path().join("screen.png");
        let status = self.command("import").args(["-window", "root"]).arg(&path).status().unwrap();
        assert!(status.success());
        image::open(&path).unwrap().to_rgb8()
    }

    /// A screenshot that equals the one before it, or a failure after a minute.
    pub fn wait_until_still(&self) -> RgbImage {
        let last = std::cell::RefCell::new(self.screenshot());
        self.wait("the window to come to rest", |picture| {
            changed(picture, &last.replace(picture.clone())) == 0
        })
    }

    /// Takes screenshots until `holds`, or fails after a minute.
    pub fn wait(&self, what: &str, holds: impl Fn(&RgbImage) -> bool) -> RgbImage {
        let start = Instant::now();
        loop {
            let picture = self.screenshot();
            if holds(&picture) {
                return picture;
            }
            if start.elapsed() > Duration::from_secs(60) {
                keep(&picture);
                panic!("waited in vain for {what}");
            }
            std::thread::sleep(Duration::from_millis(300));
        }
    }
}

/// Leaves a screenshot where it can be looked at after a failure.
fn keep(picture: &RgbImage) {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("end_to_end_failed.png");
    let _ = picture.save(&path);
    eprintln!("the screen is in {}", path.display());
}

/// How many pixels differ visibly.
pub fn changed(a: &RgbImage, b: &RgbImage) -> usize {
    let far = |(p, q): &(&Rgb<u8>, &Rgb<u8>)| (0..3).any(|c| p.0[c].abs_diff(q.0[c]) > 12);
    a.pixels().zip(b.pixels()).filter(far).count()
}

pub fn colours(picture: &RgbImage) -> usize {
    picture.pixels().collect::<std::collections::HashSet<_>>().len()
}
