//! The description of a capture in its folder.

use std::fs;
use std::path::{Path, PathBuf};

use svbrdf_core::error::Error;

use super::{Calibration, Capture};
use crate::open::NamedFile;

/// The name of the project's own description.
const OWN: &str = "capture.json";

/// The capture in `folder`.
pub fn in_folder(folder: &Path) -> Result<Capture, Error> {
    let own = folder.join(OWN);
    if own.exists() {
        return Capture::parse(&own, &NamedFile::by_file(&own, folder).text()?);
    }
    let mut found: Vec<(PathBuf, Calibration, String)> = Vec::new();
    for path in json_files(folder)? {
        let text = NamedFile::by_file(&path, folder).text()?;
        let Ok(calibration) = serde_json::from_str::<Calibration>(&text) else { continue };
        if !found.iter().any(|(_, other, _)| *other == calibration) {
            found.push((path, calibration, text));
        }
    }
    let problem = match found.as_slice() {
        [(path, _, text)] => return Capture::parse(path, text),
        [] => "found neither of them".to_owned(),
        several => {
            let name = |(path, ..): &(PathBuf, Calibration, String)| {
                path.file_name().unwrap_or_default().to_string_lossy().into_owned()
            };
            let names: Vec<_> = several.iter().map(name).collect();
            format!("found several that differ: {}; name one of these files", names.join(", "))
        }
    };
    Err(Error::BadCapture { path: folder.to_owned(), problem })
}

/// The JSON files of a folder, by name.
fn json_files(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let unreadable = |source| Error::unreadable(folder, source);
    let entries = fs::read_dir(folder).map_err(unreadable)?;
    let paths = entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<Vec<_>, _>>();
    let mut paths = paths.map_err(unreadable)?;
    paths.retain(|path| Capture::is_named(path) && path.is_file());
    paths.sort();
    Ok(paths)
}
