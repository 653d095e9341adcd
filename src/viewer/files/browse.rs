//! File dialog of the system, without blocking the window.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use svbrdf_files::read::EXTENSIONS;

use crate::jobs::Edit;
use crate::jobs::work::job::Job;
use crate::jobs::work::waker::Waker;
use crate::model::Model;
use crate::model::dialogs::Dialogs;
use crate::model::effect::BrowseFor;

/// Nobody cancels a dialog sooner than this.
const AT_ONCE: Duration = Duration::from_millis(300);

/// What to do without a file dialog.
const NO_DIALOG: &str = "This system has no file dialog: install zenity or a desktop portal. Type a path here, or drop files \
                         on the window.";

/// Asks for what is needed, at first in the folder `from`; the dialog that is open takes it.
pub fn start(waker: &Waker, what: BrowseFor, from: Option<&Path>) -> Job<Edit> {
    let title = if what == BrowseFor::Saving { "Save" } else { "Open materials" };
    let dialog = rfd::AsyncFileDialog::new().set_title(title);
    let dialog = from.into_iter().fold(dialog, rfd::AsyncFileDialog::set_directory);
    Job::<Edit>::start(waker, move |_| {
        let start = Instant::now();
        let chosen = match what {
            BrowseFor::Folders => pollster::block_on(dialog.pick_folders()),
            BrowseFor::Files => pollster::block_on(dialog.add_filter("materials", &EXTENSIONS).pick_files()),
            BrowseFor::Saving => pollster::block_on(dialog.save_file()).map(|file| vec![file]),
        };
        // rfd 0.17 returns `None` without a dialog, too.
        let is_cancelled = chosen.is_none() && start.elapsed() > AT_ONCE;
        let chosen = chosen.map(|all| all.iter().map(|one| one.path().to_owned()).collect::<Vec<_>>());
        let chosen = chosen.or_else(|| is_cancelled.then(Vec::new));
        Ok(Box::new(|model: &mut Model| take(&mut model.dialogs, chosen)))
    })
}

/// The save dialog takes what was chosen where it is open, otherwise the open dialog.
fn take(dialogs: &mut Dialogs, chosen: Option<Vec<PathBuf>>) {
    match (&mut dialogs.save, chosen) {
        (Some(dialog), Some(paths)) => paths.first().into_iter().for_each(|path| dialog.fill(path)),
        (Some(dialog), None) => dialog.field.fail(NO_DIALOG.to_owned()),
        (None, Some(paths)) => {
            let dialog = dialogs.open.get_or_insert_default();
            paths.iter().for_each(|path| dialog.add(path));
        }
        (None, None) => dialogs.open.get_or_insert_default().fail(NO_DIALOG.to_owned()),
    }
}
