//! Parts of the dialogs: path field, frame, and the file dialog of the system, which does not block the window.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use eframe::egui::{self, RichText};

use svbrdf_files::read::EXTENSIONS;

use crate::jobs::Edit;
use crate::jobs::work::Job;
use crate::jobs::work::Waker;
use crate::model::BrowseFor;
use crate::model::Model;
use crate::model::dialogs::{Dialogs, PathField};
use crate::widgets::theme;

/// The field below its label. It has the focus at first.
pub fn path_field(
    ui: &mut egui::Ui,
    state: &mut PathField,
    label: &str,
    field: egui::TextEdit<'_>,
) -> egui::Response {
    let label = ui.label(label);
    let field = ui.add(field.desired_width(f32::INFINITY)).labelled_by(label.id);
    if !std::mem::replace(&mut state.focused, true) {
        field.request_focus();
    }
    if field.changed() {
        state.problem = None;
    }
    field
}

/// What went wrong, at the end of the dialog: nothing moves where it comes and goes.
pub fn problem(ui: &mut egui::Ui, state: &PathField) {
    if let Some(problem) = &state.problem {
        ui.label(RichText::new(problem).color(theme::problem(ui.visuals())));
    }
}

/// A dialog at the top of the window; false where it was closed.
pub fn dialog(ctx: &egui::Context, title: &str, width: f32, contents: impl FnOnce(&mut egui::Ui)) -> bool {
    let mut open = true;
    egui::Window::new(title)
        .open(&mut open)
        .collapsible(false)
        .default_width(width)
        .anchor(egui::Align2::CENTER_TOP, [0.0, 40.0])
        .show(ctx, contents);
    open
}

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
