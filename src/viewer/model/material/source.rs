//! Labels of sources of materials.

use std::path::Path;

use svbrdf_files::source::{MaterialSource, Place};

/// The name that it is given, or the last part of its path.
pub fn label(source: &MaterialSource) -> String {
    match (&source.name, &source.place) {
        (Some(name), _) => name.clone(),
        (None, Place::BuiltIn(_)) => "built-in material".to_owned(),
        (None, Place::Path(path)) => file_name(path),
    }
}

/// The last part of a path, as text.
pub fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned())
}
