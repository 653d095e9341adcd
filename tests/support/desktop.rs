//! A display without a screen, and programs on it.

use std::io::{BufRead as _, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};

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

    /// `svbrdf` on the display, which finds the programs of the folder `bin` alone: without any there, no file dialog. Signals that the
    /// tests' own parent ignores are not ignored.
    pub fn svbrdf(&self) -> Command {
        let mut command = self.command("env");
        command.arg("--default-signal=INT,TERM,HUP").arg(format!("PATH={}", self.bin().display()));
        command.arg(env!("CARGO_BIN_EXE_svbrdf"));
        command
    }

    /// The folder of the programs that `svbrdf` finds.
    pub fn bin(&self) -> PathBuf {
        self.folder.path().join("bin")
    }
}
