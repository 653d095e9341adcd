//! Dialogs that open and save.

pub mod open;
pub mod path_field;
pub mod save;

use eframe::egui;

use crate::error::Error;
use crate::jobs::browse::Browsed;
use crate::jobs::displayed::Displayed;
use crate::model::Model;
use crate::model::dialogs::Dialogs;

/// What to do without a file dialog.
const NO_DIALOG: &str = "This system has no file dialog: install zenity or a desktop portal. Type a path here, or drop files \
                         on the window.";

/// Draws the dialogs.
pub fn ui(ctx: &egui::Context, shown: Displayed<'_>, next: &mut Model) {
    open::ui(ctx, next);
    save::ui(ctx, shown.jobs.saving.as_ref(), next);
}

/// Takes over what was chosen in the dialog of the system: the save dialog where it is open, otherwise the open dialog.
pub fn browsed(dialogs: &mut Dialogs, result: Result<Browsed, Error>) {
    let chosen = match result {
        Ok(Browsed::Chosen(paths)) => Ok(paths),
        Ok(Browsed::Cancelled) => Ok(Vec::new()),
        Ok(Browsed::Unavailable) => Err(NO_DIALOG.to_owned()),
        Err(error) => Err(error.to_string()),
    };
    if let Some(dialog) = &mut dialogs.save {
        return match chosen {
            Ok(paths) => paths.first().into_iter().for_each(|path| dialog.fill(path)),
            Err(problem) => dialog.field.fail(problem),
        };
    }
    let dialog = dialogs.open.get_or_insert_default();
    match chosen {
        Ok(paths) => paths.iter().for_each(|path| dialog.add(path)),
        Err(problem) => dialog.fail(problem),
    }
}
