//! Options of the window: what it starts with.

use std::path::PathBuf;

use crate::model::dataset::OpenDataset;
use svbrdf_core::loss::FileScenes;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::session::Session;
use svbrdf_files::source::MaterialSource;

/// The materials that the window opens, and how it reads them.
#[derive(Clone, Debug, Default)]
pub struct ViewerOptions {
    /// A session, in place of materials.
    pub session: Option<Session>,
    /// `None` for the built-in pair.
    pub ground_truth: Option<MaterialSource>,
    pub predictions: Vec<MaterialSource>,
    /// A data set, in place of materials.
    pub dataset: Option<Box<OpenDataset>>,
    /// The results folder of the data set of the session.
    pub results: Option<PathBuf>,
    /// Whether guesses about materials are errors.
    pub strict: bool,
    /// Whether predictions of another size are resized to the ground truth.
    pub fit: bool,
    /// A photograph that renderings are compared with, or what lists several.
    pub photograph: Option<PathBuf>,
    /// The convention of renderings and loss; `None` for that of the session or the default.
    pub convention: Option<ChosenConvention>,
    /// The scenes of the loss; `None` for the scenes of the session or the settings.
    pub scenes: Option<FileScenes>,
}
