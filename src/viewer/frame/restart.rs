//! Restart after a lost graphics device: the program starts itself anew with its session. Its window library cannot replace a device,
//! nor make a second event loop.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use svbrdf_core::progress::Progress;
use svbrdf_files::disk::{atomic, own};
use svbrdf_files::session::Session;

use super::crash::DeviceLoss;
use super::storage;
use crate::error::Error;

/// The restarts of this program, in its environment: their number, the seconds since the epoch of the last loss, and its reason.
const VARIABLE: &str = "SVBRDF_RESTARTED";
/// Its files among the settings. The program does not write the one that it was started with.
const SESSIONS: [&str; 2] = ["restart-1.svbrdf-session.json", "restart-2.svbrdf-session.json"];

/// Most losses that follow each other within [`BETWEEN`].
const MOST: u32 = 3;
const BETWEEN: Duration = Duration::from_secs(60);
/// How long a driver that is gone, as while it is updated, is waited for.
const WAIT: Duration = Duration::from_secs(20);

/// The restarts that led to this start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Restarts {
    number: u32,
    /// Of the last loss, since the epoch.
    last: Duration,
    reason: String,
}

impl Restarts {
    /// `None` where the user started the program.
    pub fn of_environment() -> Option<Self> {
        Self::parse(&std::env::var(VARIABLE).ok()?)
    }

    fn parse(text: &str) -> Option<Self> {
        let mut parts = text.splitn(3, ':');
        let (number, last) = (parts.next()?.parse().ok()?, parts.next()?.parse().ok()?);
        Some(Self { number, last: Duration::from_secs(last), reason: parts.next()?.to_owned() })
    }

    fn text(&self) -> String {
        format!("{}:{}:{}", self.number, self.last.as_secs(), self.reason)
    }

    /// Those with a loss `now`; `None` where too many have followed each other.
    fn after(before: Option<&Self>, now: Duration, reason: &str) -> Option<Self> {
        let number = before.filter(|one| now.saturating_sub(one.last) < BETWEEN).map_or(0, |one| one.number);
        (number < MOST).then(|| Self { number: number + 1, last: now, reason: reason.to_owned() })
    }

    /// Why the program started itself anew, for its user.
    pub fn message(&self) -> String {
        format!(
            "The graphics device was lost ({}). The window was opened anew with the same session.",
            self.reason
        )
    }
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
    let Some(restarts) = Restarts::after(Restarts::of_environment().as_ref(), now(), reason) else {
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
    start(command.env(VARIABLE, restarts.text()));
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
    fn a_restart_opens_its_files_as_sessions() {
        assert!(SESSIONS.iter().all(|name| Session::is_named(Path::new(name))));
    }

    #[test]
    fn devices_that_are_lost_again_and_again_end_the_program() {
        let seconds = Duration::from_secs;
        let mut restarts = None;
        for number in 1..=MOST {
            restarts = Restarts::after(restarts.as_ref(), seconds(1000 + u64::from(number)), "reset: a : b");
            let text = restarts.as_ref().unwrap().text();
            assert_eq!(Restarts::parse(&text), restarts, "{text}");
            assert_eq!(restarts.as_ref().unwrap().number, number);
        }
        assert_eq!(Restarts::after(restarts.as_ref(), seconds(1010), "again"), None);
        let later = Restarts::after(restarts.as_ref(), seconds(1010) + BETWEEN, "again").unwrap();
        assert_eq!(later.number, 1);
        assert!(later.message().contains("(again)"));
        for text in ["", "1", "1:2", "x:2:y", "-1:2:y"] {
            assert_eq!(Restarts::parse(text), None, "{text}");
        }
    }
}
