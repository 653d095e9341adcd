//! Commands about the data set of the window.

use std::path::PathBuf;

use crate::model::dataset::list::ListView;

/// The data set: which material is in the window, how the others are listed.
#[derive(Clone, Debug, PartialEq)]
pub enum DatasetCommand {
    /// Opens a data set: the first folder has the ground truths, each other one the predictions of a method; or one table of pairs.
    Open(Vec<PathBuf>),
    /// Shows a material, and reads others ahead.
    Show {
        case: usize,
        ahead: Vec<usize>,
    },
    /// Shows a material of the contact sheet, to which Escape returns.
    ShowFromSheet {
        case: usize,
        ahead: Vec<usize>,
    },
    SetList(ListView),
    /// Opens or closes the contact sheet.
    ShowSheet(bool),
    /// Sets the side of a cell of the sheet, in points.
    SetCell(f32),
    /// Marks the material in the window, or removes its mark.
    ToggleMark,
    /// Sets the note of the material in the window.
    SetNote(String),
}
