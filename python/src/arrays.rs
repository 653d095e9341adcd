//! Maps between numpy arrays, which are interleaved, and the planes of the crate.

use pyo3::buffer::{Element, PyBuffer};
use pyo3::exceptions::PyBufferError;
use pyo3::prelude::*;
use pyo3::types::PyByteArray;

/// The values of a C-contiguous array.
///
/// # Errors
/// `BufferError` where the array has another type or layout.
pub fn values<T: Element>(array: &Bound<'_, PyAny>) -> PyResult<Vec<T>> {
    PyBuffer::get(array)?.to_vec(array.py())
}

/// The planes of a C-contiguous array, 3xHxW where `is_planar` says so and HxWx3 otherwise: one copy.
///
/// # Errors
/// `BufferError` where the array has another type or layout.
pub fn planes<T: Element>(array: &Bound<'_, PyAny>, is_planar: bool) -> PyResult<[Vec<T>; 3]> {
    if is_planar {
        let plane = |channel: usize| array.get_item(channel).and_then(|plane| values(&plane));
        return Ok([plane(0)?, plane(1)?, plane(2)?]);
    }
    let buffer = PyBuffer::<T>::get(array)?;
    let interleaved = buffer.as_slice(array.py());
    let values = interleaved.ok_or_else(|| PyBufferError::new_err("the array is not C-contiguous"))?;
    let texels = values.as_chunks::<3>().0;
    Ok(std::array::from_fn(|channel| texels.iter().map(|texel| texel[channel].get()).collect()))
}

/// A number as the bytes of an array.
pub trait Bytes: Copy {
    /// Appends its bytes in native order.
    fn put(self, bytes: &mut [u8]);
}

impl Bytes for f32 {
    fn put(self, bytes: &mut [u8]) {
        bytes.copy_from_slice(&self.to_ne_bytes());
    }
}

impl Bytes for f64 {
    fn put(self, bytes: &mut [u8]) {
        bytes.copy_from_slice(&self.to_ne_bytes());
    }
}

/// The bytes of the `count` numbers of an array.
///
/// # Errors
/// `MemoryError`.
pub fn bytes<'py, T: Bytes>(
    py: Python<'py>,
    count: usize,
    numbers: impl Iterator<Item = T>,
) -> PyResult<Bound<'py, PyByteArray>> {
    PyByteArray::new_with(py, count * size_of::<T>(), |bytes| {
        bytes.chunks_exact_mut(size_of::<T>()).zip(numbers).for_each(|(bytes, number)| number.put(bytes));
        Ok(())
    })
}
