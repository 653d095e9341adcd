//! The one door for files: what may be opened and how much of it, and how files are written, completely or not at all.

pub mod atomic;
pub mod inputs;
pub mod memory;
pub mod open;
pub mod own;
pub mod paths;
pub mod signals;
pub mod stamp;

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::Once;

use crate::error::Error;

/// Refuses a pointer of Git LFS, a small text in place of a file that was not fetched, in place of the file `path`, which begins with `head`.
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

thread_local! {
    static SILENT: Cell<bool> = const { Cell::new(false) };
}

/// What the `work` of a library returns, or an error where it panics, without a word on stderr.
pub(crate) fn caught<T>(work: impl FnOnce() -> T) -> std::thread::Result<T> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !SILENT.get() {
                usual(info);
            }
        }));
    });
    SILENT.set(true);
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    SILENT.set(false);
    result
}
