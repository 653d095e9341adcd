//! What the work on a photograph depends on.

use std::path::PathBuf;

use crate::files::read::PhotographOptions;
use crate::photograph::Corners;

/// What the samples of a photograph depend on.
pub(super) type ReadKey = (PathBuf, PhotographOptions);

/// What a photograph on the texels of a material depends on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RectifiedKey {
    pub read: ReadKey,
    pub corners: Corners,
    /// Columns and rows of texels.
    pub size: [usize; 2],
}
