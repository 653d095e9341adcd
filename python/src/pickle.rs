//! Pickles: how the files of a material store it, as text.

use pyo3::prelude::*;
use svbrdf_evaluate::diagnose::{Storage, StoredEncoding};

use crate::errors::Error;

/// The fields of [`Storage`] in their order.
type Fields = (StoredEncoding, StoredEncoding, bool, bool, Option<String>, bool, [f64; 4]);

/// The text of a storage.
///
/// # Errors
/// [`Error`] where a number has no text.
pub fn text(storage: &Storage) -> PyResult<String> {
    let Storage { colours, specular, base_colour, normal_down, roughness, unscaled, steps } = storage.clone();
    let fields: Fields = (colours, specular, base_colour, normal_down, roughness, unscaled, steps);
    serde_json::to_string(&fields).map_err(|e| Error::new_err(e.to_string()))
}

/// The storage of a text.
///
/// # Errors
/// [`Error`] where the text is that of another version.
pub fn storage(text: &str) -> PyResult<Storage> {
    let fields: Fields = serde_json::from_str(text)
        .map_err(|e| Error::new_err(format!("the pickle is of another version of svbrdf: {e}")))?;
    let (colours, specular, base_colour, normal_down, roughness, unscaled, steps) = fields;
    Ok(Storage { colours, specular, base_colour, normal_down, roughness, unscaled, steps })
}
