//! Pointers of Git LFS: small texts in place of files that were not fetched.

use std::path::Path;

use crate::error::Error;

/// Refuses a pointer in place of the file `path`, which begins with `head`.
///
/// # Errors
/// [`Error::BadImage`].
pub(crate) fn refuse_pointer(path: &Path, head: &[u8]) -> Result<(), Error> {
    if !head.starts_with(b"version https://git-lfs.github.com/spec/") {
        return Ok(());
    }
    Err(Error::BadImage {
        path: path.to_owned(),
        problem: "expected its content, found a pointer of Git LFS".to_owned(),
        remedy: "run git lfs pull in the repository".to_owned(),
    })
}
