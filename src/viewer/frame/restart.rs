//! Restart after a lost graphics device, or a failed start: the program starts itself anew. Its window library cannot replace a device,
//! nor make a second event loop.

use std::ffi::OsStr;
use std::path::PathBuf;
use std::process::Command;

use svbrdf_core::progress::Progress;
use svbrdf_files::disk::{atomic, own};
use svbrdf_files::session::Session;
use svbrdf_gpu::choice;

use super::crash::DeviceLoss;
use super::storage;
use crate::error::Error;

/// Why the program has started itself anew, in its environment.
const VARIABLE: &str = "SVBRDF_RESTARTED";
/// Its session among the settings.
const SESSION: &str = "restart.svbrdf-session.json";

/// Why the program has started itself anew, for its user; `None` where the user started it.
pub fn message() -> Option<String> {
    let reason = std::env::var(VARIABLE).ok()?;
    Some(format!(
        "The graphics device was lost ({reason}). The window was opened anew with the same session."
    ))
}

/// Starts the program anew: with its session, or as it was started itself where there is none. Returns where that failed, or where
/// the program was started so itself.
///
/// # Errors
/// The session cannot be written.
pub fn after_loss(DeviceLoss { reason, session, results }: &DeviceLoss) -> Result<(), Error> {
    let (None, Ok(program)) = (message(), std::env::current_exe()) else { return Ok(()) };
    let mut command = Command::new(program);
    match session.as_ref().map(stored).transpose()? {
        Some(Some(path)) => {
            command.arg("view").arg(path).arg("--allow-outside");
            command.args(results.iter().flat_map(|folder| [OsStr::new("--results"), folder.as_ref()]))
        }
        Some(None) => return Ok(()),
        None => command.args(std::env::args_os().skip(1)),
    };
    start(command.env(VARIABLE, reason));
    Ok(())
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
    let Some(folder) = storage::folder() else { return Ok(None) };
    let path = folder.join(SESSION);
    own::folder(&folder)?;
    atomic::write_text(&path, &session.text(&path)?, &Progress::default())?;
    Ok(Some(path))
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
