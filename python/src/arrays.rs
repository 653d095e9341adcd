//! Maps between numpy arrays, which are interleaved, and the planes of the crate.

use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::PyBufferError;
use pyo3::prelude::*;

/// The values of an array where they lie in the memory of numpy.
///
/// Nothing may write to that memory meanwhile. Code in Python cannot while the interpreter lock is held: whoever reads the
/// values keeps the lock. Native code that writes without the lock would race with every other reader, too.
///
/// # Errors
/// `BufferError` where the array is not C-contiguous and aligned.
fn values<'a, T: Element>(array: &'a PyReadonlyArrayDyn<'_, T>) -> PyResult<&'a [T]> {
    // `as_slice` also takes arrays with columns first.
    let values = if array.is_c_contiguous() { array.as_slice().ok() } else { None };
    values.ok_or_else(|| PyBufferError::new_err("expected an aligned C-contiguous array"))
}

/// The plane of a map of one channel, of a C-contiguous array.
///
/// # Errors
/// `TypeError` where the array has numbers of another type, `BufferError` where it has another layout.
pub fn plane<T: Element + Copy>(array: &Bound<'_, PyAny>) -> PyResult<Vec<T>> {
    values(&array.extract()?).map(<[T]>::to_vec)
}

/// The planes of a map of three channels, HxWx3: of a C-contiguous array, or of one of 3xHxW whose channels were moved to the end.
///
/// # Errors
/// As [`plane`].
pub fn planes<T: Element + Copy>(array: &Bound<'_, PyAny>) -> PyResult<[Vec<T>; 3]> {
    let array: PyReadonlyArrayDyn<'_, T> = array.extract()?;
    if array.is_c_contiguous() {
        return Ok(separated(values(&array)?.as_chunks::<3>().0));
    }
    let planar = array.permute(Some([2, 0, 1]))?.readonly();
    let (first, others) = values(&planar)?.split_at(planar.len() / 3);
    let (second, third) = others.split_at(first.len());
    Ok([first, second, third].map(<[T]>::to_vec))
}

/// The planes of texels.
fn separated<T: Copy>(texels: &[[T; 3]]) -> [Vec<T>; 3] {
    /// Texels that stay in the nearest cache.
    const FEW: usize = 1 << 10;
    let mut planes = [(); 3].map(|()| Vec::with_capacity(texels.len()));
    for few in texels.chunks(FEW) {
        for (channel, plane) in planes.iter_mut().enumerate() {
            plane.extend(few.iter().map(|texel| texel[channel]));
        }
    }
    planes
}

/// Numbers as an array: height x width x channels, or height x width of one channel.
///
/// # Errors
/// `ValueError` where there are more or fewer.
pub fn array<'py, T: Element>(
    py: Python<'py>,
    numbers: impl Iterator<Item = T>,
    [width, height]: [usize; 2],
    channels: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let array = PyArray1::from_vec(py, numbers.collect());
    match channels {
        1 => Ok(array.reshape([height, width])?.into_any()),
        _ => Ok(array.reshape([height, width, channels])?.into_any()),
    }
}
