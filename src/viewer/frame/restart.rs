//! Restart after a lost graphics device, and once hardware is there again: the program starts itself anew with its session. Its window
//! library cannot replace a device, nor make a second event loop.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use svbrdf_core::progress::Progress;
use svbrdf_files::disk::{atomic, own};
use svbrdf_files::session::Session;
use svbrdf_gpu::{HARDWARE, choice};

use super::crash::DeviceLoss;
use super::storage;
use crate::error::Error;

/// The restarts of this program, in its environment: their number, the seconds since the epoch of the last one, and the reason of the
/// loss.
const VARIABLE: &str = "SVBRDF_RESTARTED";
/// Its files among the settings. The program does not write the one that it was started with.
const SESSIONS: [&str; 2] = ["restart-1.svbrdf-session.json", "restart-2.svbrdf-session.json"];

/// Most losses that follow each other within [`BETWEEN`].
const MOST: u32 = 3;
const BETWEEN: Duration = Duration::from_secs(60);
/// How long nothing is drawn in a window that is idle, in seconds.
pub const IDLE: f64 = 30.0;
/// How long a driver that is gone, as while it is updated, is waited for.
const WAIT: Duration = Duration::from_secs(20);

/// The restarts that led to this start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Restarts {
    number: u32,
    /// The time of the last one, since the epoch.
    last: Duration,
    /// `None` where hardware was there again.
    reason: Option<String>,
}

impl Restarts {
    /// `None` where the user started the program.
    pub fn of_environment() -> Option<Self> {
        Self::parse(&std::env::var(VARIABLE).ok()?)
    }

    fn parse(text: &str) -> Option<Self> {
        let mut parts = text.splitn(3, ':');
        let (number, last) = (parts.next()?.parse().ok()?, parts.next()?.parse().ok()?);
        let reason = Some(parts.next()?).filter(|reason| !reason.is_empty());
        Some(Self { number, last: Duration::from_secs(last), reason: reason.map(str::to_owned) })
    }

    fn text(&self) -> String {
        format!("{}:{}:{}", self.number, self.last.as_secs(), self.reason.as_deref().unwrap_or_default())
    }

    /// Those with one `now`; `None` where too many have followed each other.
    fn after(before: Option<&Self>, now: Duration, reason: Option<&str>) -> Option<Self> {
        let number = before.filter(|one| now.saturating_sub(one.last) < BETWEEN).map_or(0, |one| one.number);
        (number < MOST).then(|| Self { number: number + 1, last: now, reason: reason.map(str::to_owned) })
    }

    /// Why the program started itself anew, for its user.
    pub fn message(&self) -> String {
        let reason = match &self.reason {
            Some(reason) => format!("The graphics device was lost ({reason})"),
            None => "Graphics hardware is there again".to_owned(),
        };
        format!("{reason}. The window was opened anew with the same session.")
    }

    /// Whether software took the place of a lost device: hardware is looked for, once for each loss.
    pub fn is_without_hardware(&self, is_software: bool) -> bool {
        is_software && self.reason.is_some()
    }
}

/// Looks every minute, until `found` is dropped elsewhere, whether hardware is there again. Once it is, `wake` is called at each look.
pub fn watch_for_hardware(found: Arc<AtomicBool>, wake: impl Fn() + Send + 'static) {
    watch(found, BETWEEN, has_hardware, wake);
}

fn watch(
    found: Arc<AtomicBool>,
    every: Duration,
    is_there: impl Fn() -> bool + Send + 'static,
    wake: impl Fn() + Send + 'static,
) {
    std::thread::spawn(move || {
        while Arc::strong_count(&found) > 1 {
            std::thread::sleep(every);
            if found.load(Ordering::Relaxed) || is_there() {
                found.store(true, Ordering::Relaxed);
                wake();
            }
        }
    });
}

/// Whether there is an adapter in hardware. Another process looks, which a driver that is being replaced may end.
fn has_hardware() -> bool {
    let looking = |program| Command::new(program).args(["--version", "--verbose"]).output();
    let found = std::env::current_exe().and_then(looking);
    found.is_ok_and(|found| String::from_utf8_lossy(&found.stdout).contains(&format!("({HARDWARE}, ")))
}

fn now() -> Duration {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default()
}

/// Starts the program anew: with its session, or as it was started itself where there is none. Returns where that failed, or where
/// devices are lost again and again.
///
/// # Errors
/// The session cannot be written.
pub fn after_loss(DeviceLoss { reason, session, results }: &DeviceLoss) -> Result<(), Error> {
    let Some(restarts) = Restarts::after(Restarts::of_environment().as_ref(), now(), reason.as_deref())
    else {
        return Ok(());
    };
    let Ok(program) = std::env::current_exe() else { return Ok(()) };
    let mut command = Command::new(program);
    match session.as_ref().map(stored).transpose()? {
        Some(Some(path)) => {
            command.arg("view").arg(path).arg("--allow-outside");
            command.args(results.iter().flat_map(|folder| [OsStr::new("--results"), folder.as_ref()]))
        }
        Some(None) => return Ok(()),
        None => command.args(std::env::args_os().skip(1)),
    };
    // The interface that loses its device again and again comes last.
    let failed = if restarts.number > 1 { choice::failed_with_taken() } else { None };
    start(command.env(VARIABLE, restarts.text()).envs(failed.map(|failed| (choice::FAILED, failed))));
    Ok(())
}

/// Tries again where there is no adapter soon after a loss.
pub fn while_driver_is_gone() {
    let is_recent = Restarts::of_environment().is_some_and(|one| now().saturating_sub(one.last) < WAIT);
    if let (true, Ok(program)) = (is_recent, std::env::current_exe()) {
        std::thread::sleep(Duration::from_secs(1));
        start(Command::new(program).args(std::env::args_os().skip(1)));
    }
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
    let is_open = |path: &PathBuf| std::env::args_os().any(|argument| Path::new(&argument) == path);
    let Some(folder) = storage::folder() else { return Ok(None) };
    let path = SESSIONS.iter().map(|name| folder.join(name)).find(|path| !is_open(path));
    if let Some(path) = &path {
        own::folder(&folder)?;
        atomic::write_text(path, &session.text(path)?, &Progress::default())?;
    }
    Ok(path)
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
    fn hardware_that_is_gone_for_a_while_is_found_once_it_is_there() {
        let (found, looks) = (Arc::new(AtomicBool::new(false)), std::sync::atomic::AtomicU32::new(0));
        let (woken, wakes) = std::sync::mpsc::channel();
        let is_there = move || looks.fetch_add(1, Ordering::Relaxed) == 10;
        watch(found.clone(), Duration::from_millis(1), is_there, move || {
            let _ = woken.send(());
        });
        // Again and again, until the window is idle.
        for _ in 0..3 {
            wakes.recv_timeout(Duration::from_secs(60)).unwrap();
            assert!(found.load(Ordering::Relaxed));
        }
        drop(found);
        while wakes.recv().is_ok() {}
    }

    #[test]
    fn devices_that_are_lost_again_and_again_end_the_program() {
        let seconds = Duration::from_secs;
        let mut restarts = None;
        for number in 1..=MOST {
            restarts =
                Restarts::after(restarts.as_ref(), seconds(1000 + u64::from(number)), Some("reset: a : b"));
            let text = restarts.as_ref().unwrap().text();
            assert_eq!(Restarts::parse(&text), restarts, "{text}");
            assert_eq!(restarts.as_ref().unwrap().number, number);
        }
        assert_eq!(Restarts::after(restarts.as_ref(), seconds(1010), Some("again")), None);
        for (reason, words) in [(Some("again"), "(again). The "), (None, "hardware is there again. The ")] {
            let later = Restarts::after(restarts.as_ref(), seconds(1010) + BETWEEN, reason).unwrap();
            assert_eq!(later.number, 1);
            assert!(later.message().contains(words));
            assert_eq!([true, false].map(|is| later.is_without_hardware(is)), [reason.is_some(), false]);
            assert_eq!(Restarts::parse(&later.text()), Some(later));
        }
        for text in ["", "1", "1:2", "x:2:y", "-1:2:y"] {
            assert_eq!(Restarts::parse(text), None, "{text}");
        }
    }
}
