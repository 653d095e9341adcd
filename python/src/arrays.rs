//! Maps between numpy arrays, which are interleaved, and the planes of the crate.

use pyo3::buffer::{Element, PyBuffer};
use pyo3::prelude::*;
use pyo3::types::PyByteArray;

/// The values of a C-contiguous array.
pub fn values<T: Element>(array: &Bound<'_, PyAny>) -> PyResult<Vec<T>> {
    PyBuffer::get(array)?.to_vec(array.py())
}

/// The planes of a map of three channels, whose values are planes already or RGB by RGB.
pub fn planes<T: Copy + Default>(values: Vec<T>, is_planar: bool) -> [Vec<T>; 3] {
    let count = values.len() / 3;
    if is_planar {
        let plane = |c: usize| values[c * count..(c + 1) * count].to_vec();
        return [plane(0), plane(1), plane(2)];
    }
    let mut planes: [Vec<T>; 3] = std::array::from_fn(|_| vec![T::default(); count]);
    let [a, b, c] = &mut planes;
    for (((rgb, a), b), c) in values.as_chunks().0.iter().zip(a).zip(b).zip(c) {
        [*a, *b, *c] = *rgb;
    }
    planes
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
