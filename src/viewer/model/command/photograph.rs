//! Commands about the photograph that renderings are compared with.

use std::path::PathBuf;

use svbrdf_files::photograph::{Corners, SessionPhotograph};
use svbrdf_files::read::Transfer;
use svbrdf_files::scene_file::PhotographLight;

/// The photograph that renderings are compared with.
#[derive(Clone, Debug, PartialEq)]
pub enum PhotographCommand {
    ShowOpen(bool),
    /// Puts a path into the dialog.
    Fill(PathBuf),
    /// Compares renderings with this photograph, and sets light and view; `None` for those of the window. A folder or JSON is a
    /// capture, of which the first photograph is compared, in its own light and view.
    Open {
        photograph: SessionPhotograph,
        light: Option<PhotographLight>,
    },
    /// Compares with the ground truth again.
    Close,
    /// `None`: by the file.
    SetTransfer(Option<Transfer>),
    /// Shows the photograph as it was taken, with handles on the corners of the material, or as it is compared.
    EditCorners(bool),
    /// `None`: the whole picture.
    SetCorners(Option<Corners>),
    /// Whether the falloff of the light is divided out.
    SetFalloff(bool),
}
