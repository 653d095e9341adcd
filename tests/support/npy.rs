//! Arrays of NumPy.

/// An npy array of this shape, by the definition of the format: version 1, low bytes first.
pub fn npy(shape: impl AsRef<[u64]>, values: &[f32]) -> Vec<u8> {
    let sides: String = shape.as_ref().iter().map(|side| format!("{side},")).collect();
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({sides}), }}");
    // As NumPy does, spaces up to a multiple of 64 bytes.
    let header = format!("{header:117}\n");
    let length = u16::try_from(header.len()).unwrap().to_le_bytes();
    let values = values.iter().flat_map(|value| value.to_le_bytes());
    b"\x93NUMPY\x01\x00".iter().copied().chain(length).chain(header.into_bytes()).chain(values).collect()
}
