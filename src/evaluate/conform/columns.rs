//! Columns of arrays by name.

use svbrdf_files::arrays::{Array, Arrays};

fn array<'a>(arrays: &'a Arrays, name: &str) -> Result<&'a Array, String> {
    arrays.get(name).ok_or_else(|| {
        let found = arrays.keys().map(String::as_str).collect::<Vec<_>>().join(", ");
        format!("expected the array `{name}`, found {found}")
    })
}

/// An array of `count` rows of three values.
pub(super) fn rows(arrays: &Arrays, name: &str, count: usize) -> Result<Vec<[f64; 3]>, String> {
    let array = array(arrays, name)?;
    if array.values.len() != 3 * count || array.shape.last() != Some(&3) {
        return Err(format!(
            "array `{name}`: expected {count} x 3 values, found the shape {:?}",
            array.shape
        ));
    }
    // Levels of 8 bits.
    let scale = if array.kind == "u1" { 255.0 } else { 1.0 };
    Ok(array.values.chunks_exact(3).map(|v| [v[0] / scale, v[1] / scale, v[2] / scale]).collect())
}

/// An array of `count` values.
pub(super) fn column(arrays: &Arrays, name: &str, count: usize) -> Result<Vec<f64>, String> {
    let array = array(arrays, name)?;
    if array.values.len() != count {
        return Err(format!("array `{name}`: expected {count} values, found the shape {:?}", array.shape));
    }
    Ok(array.values.clone())
}
