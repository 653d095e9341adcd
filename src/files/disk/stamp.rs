//! Stamps of files: times and sizes that tell whether files have changed.

use std::fs::{self, Metadata};
use std::path::Path;
use std::time::{Duration, SystemTime};

/// The number and size of files, and when the latest of them was written. Files that change have another stamp.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Stamp {
    pub files: usize,
    pub bytes: u64,
    /// `None` where the system does not tell.
    pub modified: Option<SystemTime>,
}

impl Stamp {
    /// The stamp of a file, or of the files in a folder; `None` where there is none.
    pub fn of(path: &Path) -> Option<Self> {
        let metadata = fs::metadata(path).ok()?;
        if !metadata.is_dir() {
            return Some(Self::of_file(&metadata));
        }
        let entries = fs::read_dir(path).ok()?;
        let files = entries.flatten().filter_map(|entry| fs::metadata(entry.path()).ok());
        Some(
            files
                .filter(Metadata::is_file)
                .fold(Self::default(), |stamp, file| stamp.with(Self::of_file(&file))),
        )
    }

    pub(crate) fn of_file(metadata: &Metadata) -> Self {
        Self { files: 1, bytes: metadata.len(), modified: metadata.modified().ok() }
    }

    /// The stamp of the files of both.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            files: self.files + other.files,
            bytes: self.bytes + other.bytes,
            modified: self.modified.max(other.modified),
        }
    }

    /// Whether a file was written less than `time` before `now`.
    pub fn is_younger_than(&self, time: Duration, now: SystemTime) -> bool {
        self.modified.is_some_and(|modified| match now.duration_since(modified) {
            Ok(age) => age < time,
            // The clock of a file server may be a little ahead.
            Err(lead) => lead.duration() < time,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_has_the_stamp_of_all_its_files() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(Stamp::of(folder.path()), Some(Stamp::default()));
        assert_eq!(Stamp::of(&folder.path().join("none")), None);
        let paths = ["a.png", "b.png"].map(|name| folder.path().join(name));
        for (path, seconds) in paths.iter().zip([1000, 2000]) {
            fs::write(path, "12345").unwrap();
            let time = SystemTime::UNIX_EPOCH + Duration::from_secs(seconds);
            fs::File::options().write(true).open(path).unwrap().set_modified(time).unwrap();
        }
        fs::create_dir(folder.path().join("inner")).unwrap();
        let stamp = Stamp::of(folder.path()).unwrap();
        let latest = SystemTime::UNIX_EPOCH + Duration::from_secs(2000);
        assert_eq!(stamp, Stamp { files: 2, bytes: 10, modified: Some(latest) });
        let [a, b] = paths.map(|path| Stamp::of(&path).unwrap());
        assert_eq!(a.with(b), stamp);
    }
}
