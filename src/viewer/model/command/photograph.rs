//! Commands about the photograph that renderings are compared with.

use std::path::PathBuf;

use svbrdf_core::model::scene::Scene;
use svbrdf_evaluate::photograph::Corners;
use svbrdf_files::read::Transfer;
use svbrdf_files::session::SessionPhotograph;

/// The photograph that renderings are compared with.
#[derive(Clone, Debug, PartialEq)]
pub enum PhotographCommand {
    ShowOpen(bool),
    /// Puts a path into the dialog.
    Fill(PathBuf),
    /// Compares renderings with this photograph, and sets light and view. A folder or JSON is a capture, of which the first
    /// photograph is compared, in its own light and view.
    Open {
        photograph: SessionPhotograph,
        light: PhotographLight,
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

/// Light and view of a photograph.
#[derive(Clone, Debug, PartialEq)]
pub enum PhotographLight {
    /// Those of the window.
    AsNow,
    /// A flash at the camera.
    Flash { fov_degrees: f64 },
    /// Those of a photograph of a capture.
    Scene(Scene),
    /// A scene of a file.
    File { path: PathBuf, number: usize },
}
