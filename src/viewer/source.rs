//! Where the materials in the window come from.

use std::path::{Path, PathBuf};

use crate::files::read::ReadOptions;

/// Where a material came from.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    /// The built-in material of this number, 0 for the ground truth.
    BuiltIn(usize),
    Path(PathBuf),
}

/// Where a material comes from and how it is read: what it takes to open it again.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    pub origin: Origin,
    /// The options specified; the sidecar file completes them.
    pub asked: ReadOptions,
    /// The options chosen since, which alone count.
    pub exactly: Option<ReadOptions>,
    /// Whether it is resized to the ground truth.
    pub fit: bool,
}

impl Source {
    pub fn file(path: PathBuf, asked: ReadOptions) -> Self {
        Self { origin: Origin::Path(path), asked, exactly: None, fit: false }
    }

    /// The built-in material of this number, 0 for the ground truth.
    pub fn built_in(number: usize) -> Self {
        Self { origin: Origin::BuiltIn(number), asked: ReadOptions::AUTO, exactly: None, fit: false }
    }

    /// The last part of its path.
    pub fn name(&self) -> String {
        match &self.origin {
            Origin::BuiltIn(_) => "built-in material".to_owned(),
            Origin::Path(path) => file_name(path),
        }
    }
}

/// The last part of a path, as text.
pub fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned())
}
