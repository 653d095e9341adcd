//! Dialogs, each with what is typed and chosen in it so far.

pub mod open;
pub mod path_field;
pub mod save;

use std::path::PathBuf;

use eframe::egui;

use crate::error::Error;
use crate::jobs::browse::Browsed;
use crate::jobs::displayed::Displayed;
use crate::model::command::Command;

use open::OpenDialog;
use save::SaveDialog;

/// What to do without a file dialog.
const NO_DIALOG: &str = "This system has no file dialog: install zenity or a desktop portal. Type a path here, or drop files \
                         on the window.";

/// The dialogs that are open.
#[derive(Debug, Default)]
pub struct Dialogs {
    pub open: Option<OpenDialog>,
    pub save: Option<SaveDialog>,
}

impl Dialogs {
    /// Whether a dialog is open: the panes behind it do not move.
    pub fn is_open(&self) -> bool {
        self.open.is_some() || self.save.is_some()
    }

    /// Draws the dialogs.
    pub fn ui(&mut self, ctx: &egui::Context, displayed: Displayed<'_>) -> Vec<Command> {
        let (model, mut commands) = (displayed.model, Vec::new());
        if let Some(dialog) = &mut self.open {
            commands.extend(dialog.ui(ctx, &model.recent));
        }
        if let Some(dialog) = &mut self.save {
            commands.extend(dialog.ui(ctx, displayed.jobs.saving.as_ref()));
        }
        commands
    }

    /// Takes over what was chosen in the dialog of the system: the save dialog where it is open, otherwise the open dialog.
    pub fn browsed(&mut self, result: Result<Browsed, Error>) {
        let chosen = match result {
            Ok(Browsed::Chosen(paths)) => Ok(paths),
            Ok(Browsed::Cancelled) => Ok(Vec::new()),
            Ok(Browsed::Unavailable) => Err(NO_DIALOG.to_owned()),
            Err(error) => Err(error.to_string()),
        };
        if let Some(dialog) = &mut self.save {
            return match chosen {
                Ok(paths) => paths.first().into_iter().for_each(|path| dialog.fill(path)),
                Err(problem) => dialog.fail(problem),
            };
        }
        let dialog = self.open.get_or_insert_default();
        match chosen {
            Ok(paths) => paths.iter().for_each(|path: &PathBuf| dialog.add(&path.display().to_string())),
            Err(problem) => dialog.fail(problem),
        }
    }
}
