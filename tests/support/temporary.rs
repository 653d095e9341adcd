//! Temporary files of the program while it writes.

use std::path::Path;

/// Whether a process has a temporary file in `folder`, which mostly has no name, or a temporary folder.
pub fn is_writing(folder: &Path, process: u32) -> bool {
    let is_temporary = |path: &Path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        path.parent() == Some(folder) && (name.starts_with(".svbrdf-") || name.ends_with(" (deleted)"))
    };
    let paths =
        |folder: &Path| std::fs::read_dir(folder).into_iter().flatten().flatten().map(|one| one.path());
    let open = paths(format!("/proc/{process}/fd").as_ref()).filter_map(|file| file.read_link().ok());
    open.chain(paths(folder)).any(|path| is_temporary(&path))
}
