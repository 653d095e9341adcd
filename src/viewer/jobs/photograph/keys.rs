//! Keys of the jobs on a photograph.

use std::path::PathBuf;

use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::photograph::Corners;
use svbrdf_files::read::PhotographOptions;

/// What the samples of a photograph depend on: its file, the stamp of the file when it was opened, and how it is read.
pub type ReadKey = (PathBuf, Option<Stamp>, PhotographOptions);

/// What a photograph on the texels of a material depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct RectifiedKey {
    pub read: ReadKey,
    pub corners: Corners,
    /// Columns and rows of texels.
    pub size: [usize; 2],
}
