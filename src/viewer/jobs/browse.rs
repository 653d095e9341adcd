//! File dialog of the system, without blocking the window.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use svbrdf_files::read::EXTENSIONS;

use crate::jobs::work::job::Job;
use crate::jobs::work::waker::Waker;
use crate::model::effect::BrowseFor;

/// Nobody cancels a dialog sooner than this.
const AT_ONCE: Duration = Duration::from_millis(300);

/// How a dialog ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Browsed {
    Chosen(Vec<PathBuf>),
    Cancelled,
    /// There was no dialog.
    Unavailable,
}

/// Asks for what is needed, at first in the folder `from`.
pub fn start(waker: &Waker, what: BrowseFor, from: Option<&Path>) -> Job<Browsed> {
    let title = if what == BrowseFor::Saving { "Save" } else { "Open materials" };
    let dialog = rfd::AsyncFileDialog::new().set_title(title);
    let dialog = from.into_iter().fold(dialog, rfd::AsyncFileDialog::set_directory);
    Job::start(waker, move |_| {
        let start = Instant::now();
        let chosen = match what {
            BrowseFor::Folders => pollster::block_on(dialog.pick_folders()),
            BrowseFor::Files => pollster::block_on(dialog.add_filter("materials", &EXTENSIONS).pick_files()),
            BrowseFor::Saving => pollster::block_on(dialog.save_file()).map(|file| vec![file]),
        };
        Ok(match chosen {
            Some(handles) => Browsed::Chosen(handles.iter().map(|handle| handle.path().to_owned()).collect()),
            None if has_dialog(start.elapsed(), has_bus(), has_zenity()) => Browsed::Cancelled,
            None => Browsed::Unavailable,
        })
    })
}

/// Whether a dialog that returned nothing after this time was there: rfd 0.17 returns `None` for both.
fn has_dialog(elapsed: Duration, bus: bool, zenity: bool) -> bool {
    if cfg!(target_os = "linux") { zenity || (bus && elapsed > AT_ONCE) } else { true }
}

/// Whether the session bus is there, over which portals are asked.
fn has_bus() -> bool {
    let at = |folder: std::ffi::OsString| Path::new(&folder).join("bus").exists();
    std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some()
        || std::env::var_os("XDG_RUNTIME_DIR").is_some_and(at)
}

fn has_zenity() -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join("zenity").is_file())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn a_dialog_that_ends_at_once_or_cannot_exist_was_not_there() {
        let (soon, later) = (Duration::from_millis(80), Duration::from_secs(2));
        assert!(!has_dialog(soon, false, false));
        assert!(!has_dialog(later, false, false), "without a bus there is no portal");
        assert!(!has_dialog(soon, true, false), "the portal did not answer");
        assert!(has_dialog(later, true, false));
        assert!(has_dialog(later, false, true));
    }
}
