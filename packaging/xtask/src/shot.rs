//! A screenshot of the real window on the built-in materials, under Xvfb.

use std::fs;
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::{command, finish};

/// States of the window: a name, the settings that it starts with, and the keys that are pressed.
const STATES: [(&str, &str, &[&str]); 9] = [
    ("loss", "{}", &[]),
    ("why", r#"{"tab":"Why"}"#, &[]),
    ("metrics", r#"{"tab":"Why","sections":["metrics"]}"#, &[]),
    ("files", r#"{"tab":"Files"}"#, &[]),
    ("light", r#"{"dark":false}"#, &[]),
    ("difference", "{}", &["d"]),
    ("map", "{}", &["m"]),
    ("help", "{}", &["F1"]),
    ("pinned", "{}", &["i"]),
];
/// The longest that the window takes to come to rest.
const PATIENCE: Duration = Duration::from_secs(120);

/// Ends the program where the screenshot is taken, or fails.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        drop(self.0.kill());
        drop(self.0.wait());
    }
}

/// The screen with its own home folder.
struct Desktop {
    display: String,
    home: PathBuf,
    _server: Running,
}

pub fn help() -> String {
    let names: Vec<_> = STATES.iter().map(|(name, ..)| *name).collect();
    format!("shot writes STATE.png: the window of 1360x860 points in a state, one of {}", names.join(", "))
}

/// Takes a screenshot of a state.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let option = |name: &str| {
        let at = arguments.iter().position(|argument| argument == name);
        at.and_then(|at| arguments.get(at + 1)).map(String::as_str)
    };
    let state = arguments.first().and_then(|name| STATES.iter().find(|(known, ..)| known == name));
    let Some((name, settings, keys)) = state else { return Err(help()) };
    let size = option("--size").unwrap_or("1360x860");
    let Some((width, height)) = size.split_once('x') else {
        return Err(format!("--size: expected WIDTHxHEIGHT, found {size}"));
    };
    let output = option("--output").map_or_else(|| format!("{name}.png"), str::to_owned);
    let output = std::path::absolute(output).map_err(|problem| problem.to_string())?;
    finish(command("cargo").arg("build"))?;
    let desktop = Desktop::start(size, settings)?;
    let _window = desktop.open()?;
    desktop.xdotool(&[
        "search",
        "--sync",
        "--name",
        "svbrdf",
        "windowmove",
        "0",
        "0",
        "windowsize",
        width,
        height,
    ])?;
    desktop.still()?;
    desktop.xdotool(&["search", "--name", "svbrdf", "windowfocus"])?;
    for key in *keys {
        desktop.xdotool(&["key", key])?;
    }
    fs::write(&output, desktop.still()?).map_err(|problem| format!("{}: {problem}", output.display()))?;
    eprintln!("{}", output.display());
    Ok(())
}

impl Drop for Desktop {
    fn drop(&mut self) {
        drop(fs::remove_dir_all(&self.home));
    }
}

impl Desktop {
    /// A screen of this size, and a home folder with these settings.
    fn start(size: &str, settings: &str) -> Result<Self, String> {
        let home = std::env::temp_dir().join(format!("svbrdf-shot-{}", std::process::id()));
        let stored = home.join(".local/share/svbrdf");
        fs::create_dir_all(&stored).map_err(|problem| problem.to_string())?;
        let text = format!("{{\"settings\":{settings}}}");
        fs::write(stored.join("settings.json"), text).map_err(|problem| problem.to_string())?;
        let mut server = command("Xvfb");
        server.args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0", &format!("{size}x24")]);
        let mut server = start(server.stdout(Stdio::piped()).stderr(Stdio::null()))?;
        let mut number = String::new();
        let lines = server.0.stdout.take().ok_or("Xvfb has no output")?;
        BufReader::new(lines).read_line(&mut number).map_err(|problem| problem.to_string())?;
        Ok(Self { display: format!(":{}", number.trim()), home, _server: server })
    }

    fn command(&self, program: impl AsRef<Path>) -> Command {
        let mut command = command(&program.as_ref().to_string_lossy());
        command.env("DISPLAY", &self.display).env("HOME", &self.home).env("XDG_RUNTIME_DIR", &self.home);
        command.env_remove("WAYLAND_DISPLAY").env_remove("XDG_DATA_HOME").stdin(Stdio::null());
        command
    }

    fn open(&self) -> Result<Running, String> {
        let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| "target".into(), PathBuf::from);
        let program = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(target).join("debug/svbrdf");
        start(self.command(program).stdout(Stdio::null()))
    }

    fn xdotool(&self, arguments: &[&str]) -> Result<(), String> {
        finish(self.command("xdotool").args(arguments).stdout(Stdio::null()))
    }

    /// The screen as PNG once it has not changed for three seconds.
    fn still(&self) -> Result<Vec<u8>, String> {
        let start = Instant::now();
        let mut last = Vec::new();
        while start.elapsed() < PATIENCE {
            sleep(Duration::from_secs(3));
            let mut import = self.command("import");
            let output =
                import.args(["-window", "root", "-define", "png:exclude-chunks=date,time", "png:-"]).output();
            let picture = output.map_err(|problem| format!("{import:?}: {problem}"))?.stdout;
            if picture == last {
                return Ok(picture);
            }
            last = picture;
        }
        Err(format!("the window has not come to rest in {PATIENCE:?}"))
    }
}

fn start(command: &mut Command) -> Result<Running, String> {
    command.spawn().map(Running).map_err(|problem| format!("{command:?}: {problem}"))
}
