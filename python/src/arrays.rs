//! Maps between numpy arrays, which are interleaved, and the planes of the crate.

use numpy::{Element, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::PyBufferError;
use pyo3::prelude::*;
use pyo3::types::PyByteArray;

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

/// The planes of a map of three channels, of a C-contiguous array: 3xHxW where it is planar, or HxWx3.
///
/// # Errors
/// As [`plane`].
pub fn planes<T: Element + Copy>(array: &Bound<'_, PyAny>, is_planar: bool) -> PyResult<[Vec<T>; 3]> {
    let array = array.extract()?;
    let values = values(&array)?;
    if is_planar {
        let (first, others) = values.split_at(values.len() / 3);
        let (second, third) = others.split_at(first.len());
        return Ok([first, second, third].map(<[T]>::to_vec));
    }
    Ok(separated(values.as_chunks::<3>().0))
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
