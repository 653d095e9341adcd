//! Inputs: the files that a result is made from, which no output may replace.
//!
//! A command protects every file that it reads, by [`protect_all`]: whatever reads maps, documents, lists, results, scenes, sessions,
//! photographs or captures names their files here, and [`crate::disk::atomic`], which writes every output, refuses to replace them. Files
//! that are only looked at, such as other materials of a folder, are not named. The window and Python, which read and write for hours,
//! name the inputs of an output themselves.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::error::Error;

/// The files that are protected; `None`: none are.
static PROTECTED: Mutex<Option<HashMap<FileId, PathBuf>>> = Mutex::new(None);

/// Protects every file that is read from now on, in all of this process, from being replaced by an output.
pub fn protect_all() {
    protected().get_or_insert_default();
}

/// Protects the file `path`, which was read, where [`protect_all`] asks for it.
pub fn protect(path: &Path) {
    if let Some(protected) = protected().as_mut()
        && let Some(id) = FileId::of(path)
    {
        protected.insert(id, path.to_owned());
    }
}

/// Refuses to write `output` where it is a protected file, by this name or another one.
///
/// # Errors
/// [`Error::ReplacesInput`].
pub fn check_output(output: &Path) -> Result<(), Error> {
    let Some(replaced) = FileId::of(output) else { return Ok(()) };
    let input = protected().as_ref().and_then(|protected| protected.get(&replaced).cloned());
    // Not one that has got the number of a file that is gone.
    check_output_of(output, input)
}

/// Refuses to write `output` where it is one of the files `inputs`, by this name or another one: through a link, hard or symbolic, or
/// in other letters on a file system that ignores case.
///
/// # Errors
/// [`Error::ReplacesInput`].
pub fn check_output_of<P: AsRef<Path>>(
    output: &Path,
    inputs: impl IntoIterator<Item = P>,
) -> Result<(), Error> {
    let Some(replaced) = FileId::of(output) else { return Ok(()) };
    let mut inputs = inputs.into_iter();
    match inputs.find(|input| FileId::of(input.as_ref()).as_ref() == Some(&replaced)) {
        Some(input) => {
            Err(Error::ReplacesInput { path: output.to_owned(), input: input.as_ref().to_owned() })
        }
        None => Ok(()),
    }
}

fn protected() -> MutexGuard<'static, Option<HashMap<FileId, PathBuf>>> {
    PROTECTED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The identity of a file, whatever its name.
#[derive(Debug, PartialEq, Eq, Hash)]
enum FileId {
    #[cfg(unix)]
    Inode { device: u64, inode: u64 },
    /// Where the system has no stable number for a file: the path without links.
    #[cfg_attr(unix, expect(dead_code, reason = "elsewhere"))]
    Path(PathBuf),
}

impl FileId {
    /// That of a regular file; `None` where there is none: a device or a pipe is written to, not replaced.
    fn of(path: &Path) -> Option<Self> {
        let metadata = fs::metadata(path).ok().filter(fs::Metadata::is_file)?;
        #[cfg(unix)]
        {
            use std::os::unix::fs::MetadataExt as _;
            Some(Self::Inode { device: metadata.dev(), inode: metadata.ino() })
        }
        #[cfg(not(unix))]
        {
            drop(metadata);
            fs::canonicalize(path).ok().map(Self::Path)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_known_by_all_its_names() {
        let folder = tempfile::tempdir().unwrap();
        let of = |name: &str| folder.path().join(name);
        fs::write(of("gt.png"), "a").unwrap();
        fs::write(of("other.png"), "a").unwrap();
        fs::hard_link(of("gt.png"), of("hard.png")).unwrap();
        fs::create_dir(of("folder")).unwrap();
        let inputs = [of("none.png"), of("gt.png")];
        let refused = |output: &str| check_output_of(&of(output), &inputs).is_err();
        assert!(refused("gt.png") && refused("folder/../gt.png"));
        assert!(!refused("other.png") && !refused("none.png") && !refused("folder"));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("gt.png", of("link.png")).unwrap();
            assert!(refused("link.png") && refused("hard.png"));
        }
        let error = check_output_of(&of("folder/../gt.png"), &inputs).unwrap_err().to_string();
        assert!(error.contains("gt.png") && error.contains("another"), "{error}");
    }
}
