//! Errors of the crate as Python exceptions with the same text.

use std::io;

use pyo3::PyErr;
use pyo3::exceptions::{
    PyFileNotFoundError, PyKeyboardInterrupt, PyOSError, PyPermissionError, PyRuntimeError,
};
use svbrdf_files::Error as FilesError;

#[allow(missing_docs, reason = "the macro makes public items without comments")]
mod class {
    pyo3::create_exception!(
        svbrdf,
        Error,
        pyo3::exceptions::PyValueError,
        "Input that cannot be used: a file, an array, a scene or an option. The text says where, what was expected, what \
         was found and what to do."
    );
}

pub use class::Error;

/// The exception for `error`: [`Error`], an `OSError` where a file cannot be read or written, `KeyboardInterrupt` where the
/// work was cancelled.
pub fn exception(error: impl Into<svbrdf_evaluate::Error>) -> PyErr {
    let error = error.into();
    let text = error.to_string();
    match error.files() {
        Some(FilesError::Unreadable { source, .. } | FilesError::Unwritable { source, .. }) => {
            os_error(source, text)
        }
        Some(FilesError::Internal(_)) => PyRuntimeError::new_err(text),
        _ if error.is_cancelled() => PyKeyboardInterrupt::new_err(text),
        _ => Error::new_err(text),
    }
}

fn os_error(source: &io::Error, text: String) -> PyErr {
    match source.kind() {
        io::ErrorKind::NotFound => PyFileNotFoundError::new_err(text),
        io::ErrorKind::PermissionDenied => PyPermissionError::new_err(text),
        _ => PyOSError::new_err(text),
    }
}
