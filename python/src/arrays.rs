//! Maps between numpy arrays, which are interleaved, and the planes of the crate.

use pyo3::buffer::{Element, PyBuffer};
use pyo3::prelude::*;
use pyo3::types::PyByteArray;

/// The values of a C-contiguous array.
///
/// # Errors
/// `BufferError` where the array has another type or layout.
pub fn values<T: Element>(array: &Bound<'_, PyAny>) -> PyResult<Vec<T>> {
    PyBuffer::get(array)?.to_vec(array.py())
}

/// The values of a map of three channels.
#[derive(Debug)]
pub enum Channels<T> {
    /// As the crate has them.
    Planes([Vec<T>; 3]),
    /// RGB by RGB.
    Interleaved(Vec<T>),
}

impl<T: Element> Channels<T> {
    /// Those of a C-contiguous array, 3xHxW or HxWx3: one copy.
    ///
    /// # Errors
    /// `BufferError` where the array has another type or layout.
    pub fn of(array: &Bound<'_, PyAny>, is_planar: bool) -> PyResult<Self> {
        if !is_planar {
            return values(array).map(Self::Interleaved);
        }
        let plane = |channel: usize| array.get_item(channel).and_then(|plane| values(&plane));
        Ok(Self::Planes([plane(0)?, plane(1)?, plane(2)?]))
    }

    /// The planes: another copy of values that are interleaved.
    pub fn planes(self) -> [Vec<T>; 3] {
        match self {
            Self::Planes(planes) => planes,
            Self::Interleaved(values) => {
                let values = values.as_chunks::<3>().0;
                std::array::from_fn(|channel| values.iter().map(|rgb| rgb[channel]).collect())
            }
        }
    }
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
