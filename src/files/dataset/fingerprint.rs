//! Fingerprints of the files that a result was computed from: they tell whether the result still holds.

use std::collections::BTreeSet;
use std::fs::{self, Metadata};
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde::{Deserialize, Serialize};

use svbrdf_core::error::Error;

use crate::open::NamedFile;
use crate::read::{EXTENSIONS, Sidecar};

/// The files of a material: those that were read, its sidecar file, and all pictures of a folder or prefix, which would be read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct MaterialFiles {
    /// The path of the material.
    pub(super) path: String,
    files: Vec<Fingerprint>,
}

/// A file at the time when it was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Fingerprint {
    path: String,
    /// `None` where there is no such file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    bytes: Option<u64>,
    /// Nanoseconds since 1970; `None` where the file was written while it was read: then it counts as changed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    modified: Option<u64>,
    /// FNV-1a of the content, 64 bits in hexadecimal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    hash: Option<String>,
}

impl MaterialFiles {
    /// The files of the material `path`, of which `read` were read; reading began at `start`.
    pub(super) fn new(path: &Path, read: &[PathBuf], start: SystemTime) -> Self {
        let mut all = expected(path);
        all.extend(read.iter().cloned());
        let files = all.iter().map(|file| Fingerprint::of(file, start)).collect();
        Self { path: path.display().to_string(), files }
    }

    /// The first file that is not what it was, if the material `path` is read now.
    pub(super) fn changed(&self, path: &Path) -> Option<String> {
        if self.path != path.display().to_string() {
            return Some(path.display().to_string());
        }
        let is_known = |file: &PathBuf| self.files.iter().any(|known| Path::new(&known.path) == file);
        let added = expected(path).into_iter().find(|file| !is_known(file));
        let differs = self.files.iter().find(|file| !file.is_current()).map(|file| file.path.clone());
        differs.or_else(|| added.map(|file| file.display().to_string()))
    }
}

/// The files that decide how the material `path` is read, whether they are there or not.
fn expected(path: &Path) -> BTreeSet<PathBuf> {
    let (folder, prefix) = match path.parent() {
        _ if path.is_dir() => (path, String::new()),
        Some(folder) if !path.exists() => {
            (folder, path.file_name().unwrap_or_default().to_string_lossy().into_owned())
        }
        _ => return BTreeSet::from([path.to_owned(), Sidecar::path_for(path)]),
    };
    let is_picture = |file: &PathBuf| {
        let extension = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        EXTENSIONS.contains(&extension.as_str())
    };
    let begins =
        |file: &PathBuf| file.file_name().is_some_and(|name| name.to_string_lossy().starts_with(&prefix));
    // An empty parent is the current folder.
    let listed = fs::read_dir(if folder.as_os_str().is_empty() { Path::new(".") } else { folder });
    let names = listed.into_iter().flatten().flatten().map(|entry| folder.join(entry.file_name()));
    names.filter(is_picture).filter(begins).chain([Sidecar::path_for(path)]).collect()
}

impl Fingerprint {
    fn of(path: &Path, start: SystemTime) -> Self {
        let name = path.display().to_string();
        let Ok(metadata) = fs::metadata(path) else {
            return Self { path: name, bytes: None, modified: None, hash: None };
        };
        let unchanged = metadata.modified().is_ok_and(|modified| modified < start);
        let hash = hash(path).ok().filter(|_| unchanged);
        Self {
            path: name,
            bytes: Some(metadata.len()),
            modified: nanoseconds(&metadata).filter(|_| unchanged),
            hash,
        }
    }

    /// Whether the file is now what it was: of the same size, and of the same time or content.
    fn is_current(&self) -> bool {
        let path = Path::new(&self.path);
        let (metadata, bytes) = match (fs::metadata(path), self.bytes) {
            (Ok(metadata), Some(bytes)) => (metadata, bytes),
            (found, known) => return found.is_err() && known.is_none(),
        };
        let same_time = self.modified.is_some() && nanoseconds(&metadata) == self.modified;
        let same_content = || self.hash.is_some() && hash(path).ok() == self.hash;
        metadata.len() == bytes && (same_time || same_content())
    }
}

fn nanoseconds(metadata: &Metadata) -> Option<u64> {
    let since = metadata.modified().ok()?.duration_since(SystemTime::UNIX_EPOCH).ok()?;
    since.as_nanos().try_into().ok()
}

/// FNV-1a (Fowler, Noll and Vo) of bytes, 64 bits.
pub(super) fn fnv1a(bytes: &[u8]) -> u64 {
    continued(BASIS, bytes)
}

const BASIS: u64 = 0xcbf2_9ce4_8422_2325;

fn continued(hash: u64, bytes: &[u8]) -> u64 {
    const PRIME: u64 = 0x0100_0000_01b3;
    bytes.iter().fold(hash, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(PRIME))
}

/// FNV-1a of the content of a file, in hexadecimal.
fn hash(path: &Path) -> Result<String, Error> {
    let (mut file, mut buffer, mut hash) = (NamedFile::by_user(path).open()?, vec![0; 1 << 16], BASIS);
    loop {
        match file.read(&mut buffer).map_err(|source| Error::unreadable(path, source))? {
            0 => return Ok(format!("{hash:016x}")),
            count => hash = continued(hash, &buffer[..count]),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    fn set_time(path: &Path, seconds: u64) {
        let time = SystemTime::UNIX_EPOCH + Duration::from_secs(seconds);
        fs::File::options().write(true).open(path).unwrap().set_modified(time).unwrap();
    }

    #[test]
    fn the_hash_is_fnv_1a() {
        let folder = tempfile::tempdir().unwrap();
        for (text, expected) in
            [("", "cbf29ce484222325"), ("a", "af63dc4c8601ec8c"), ("foobar", "85944171f73967e8")]
        {
            fs::write(folder.path().join("x"), text).unwrap();
            assert_eq!(hash(&folder.path().join("x")).unwrap(), expected);
        }
    }

    #[test]
    fn a_file_is_current_until_its_content_changes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        fs::write(&path, "12345").unwrap();
        set_time(&path, 1000);
        let files = MaterialFiles::new(&path, std::slice::from_ref(&path), SystemTime::now());
        assert_eq!(files.changed(&path), None);
        let text = serde_json::to_string(&files).unwrap();
        assert_eq!(serde_json::from_str::<MaterialFiles>(&text).unwrap(), files);
        // Copied: another time, the same content.
        set_time(&path, 2000);
        assert_eq!(files.changed(&path), None);
        let name = Some(path.display().to_string());
        for other in ["12346", "123456"] {
            fs::write(&path, other).unwrap();
            assert_eq!(files.changed(&path), name, "{other}");
        }
        fs::remove_file(&path).unwrap();
        assert_eq!(files.changed(&path), name);
        // Another path is another material.
        let other = folder.path().join("b.png");
        assert_eq!(files.changed(&other), Some(other.display().to_string()));
    }

    #[test]
    fn a_file_that_is_added_changes_a_material() {
        let folder = tempfile::tempdir().unwrap();
        let of = |name: &str| folder.path().join(name);
        fs::create_dir(of("set")).unwrap();
        fs::write(of("set/normal.png"), "n").unwrap();
        fs::write(of("wood_normal.png"), "n").unwrap();
        fs::write(of("one.png"), "n").unwrap();
        for (material, added) in [
            ("set", "set/roughness.png"),
            ("set", "set/svbrdf.json"),
            ("wood", "wood_roughness.png"),
            ("one.png", "one.svbrdf.json"),
        ] {
            let files = MaterialFiles::new(&of(material), &[], SystemTime::now());
            fs::write(of("log.txt"), material).unwrap();
            fs::write(of("set/log.txt"), material).unwrap();
            assert_eq!(files.changed(&of(material)), None, "{material}");
            fs::write(of(added), "x").unwrap();
            assert_eq!(files.changed(&of(material)), Some(of(added).display().to_string()));
        }
    }

    #[test]
    fn a_file_that_is_written_while_it_is_read_counts_as_changed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let start = SystemTime::now() - Duration::from_secs(1);
        fs::write(&path, "12345").unwrap();
        assert!(MaterialFiles::new(&path, &[], start).changed(&path).is_some());
    }
}
