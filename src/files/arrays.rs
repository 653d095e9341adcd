//! Arrays of numbers by name: npz files that are no pictures.

use std::collections::BTreeMap;
use std::io::{self, Cursor, ErrorKind, Read, Write as _};
use std::path::Path;

use exr::prelude::f16;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use svbrdf_core::progress::Progress;

use crate::disk::open::NamedFile;
use crate::disk::{atomic, inputs, memory};
use crate::error::Error;
use crate::npy::Header;

const MOST_VALUES: u64 = 1 << 23;
const MOST_ARRAYS: usize = 64;

/// An array: its values with the last index fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    pub shape: Vec<usize>,
    pub values: Vec<f64>,
    /// The type that they are stored as, as NumPy names it: `f4`, `u1`.
    pub kind: String,
}

/// Arrays by their names.
pub type Arrays = BTreeMap<String, Array>;

impl Array {
    /// Doubles of this shape.
    pub fn new(shape: &[usize], values: Vec<f64>) -> Self {
        Self { shape: shape.to_vec(), values, kind: "f8".to_owned() }
    }
}

/// Reads the arrays of an npz file. Arrays of text are left out.
///
/// # Errors
/// Where it cannot be read, is no npz, or holds arrays of other kinds than numbers.
pub fn read(path: &Path) -> Result<Arrays, Error> {
    let bytes = NamedFile::by_user(path).bytes()?;
    inputs::protect(path);
    parse(&bytes).map_err(|problem| Error::BadArrays { path: path.to_owned(), problem })
}

/// The arrays of the bytes of an npz file.
///
/// # Errors
/// What is wrong.
pub fn parse(bytes: &[u8]) -> Result<Arrays, String> {
    let mut archive = ZipArchive::new(Cursor::new(bytes))
        .map_err(|_| "expected an npz file, as numpy.savez writes it, found no archive")?;
    if archive.len() > MOST_ARRAYS {
        return Err(format!("expected at most {MOST_ARRAYS} arrays, found {}", archive.len()));
    }
    let mut arrays = Arrays::new();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).map_err(|e| e.to_string())?;
        let name = file.name().unwrap_or_default().into_owned();
        let Some(name) = name.strip_suffix(".npy").map(str::to_owned) else { continue };
        if let Some(array) = array(&mut file).map_err(|problem| format!("array {name}: {problem}"))? {
            arrays.insert(name, array);
        }
    }
    Ok(arrays)
}

/// An array; `None` of text.
fn array(mut file: impl Read) -> Result<Option<Array>, String> {
    let header = Header::read(&mut file).map_err(|e| e.to_string())?;
    if header.kind.starts_with(['U', 'S']) {
        return Ok(None);
    }
    let count = header.count().filter(|count| *count <= MOST_VALUES);
    let count = count
        .ok_or_else(|| format!("expected at most {MOST_VALUES} values, found shape {:?}", header.shape))?;
    let shape = header.shape.iter().map(|&side| side as usize).collect();
    let values = values(file, &header, count as usize)?;
    let values = if header.is_fortran { last_fastest(&values, &header.shape) } else { values };
    Ok(Some(Array { shape, values, kind: header.kind }))
}

fn values(file: impl Read, header: &Header, count: usize) -> Result<Vec<f64>, String> {
    let _reserved =
        memory::reserve(16 * count as u64, || "reading an array".to_owned()).map_err(|e| e.to_string())?;
    let values = match header.kind.as_str() {
        "b1" | "u1" => header.values(file, |[byte]| byte.into()),
        "f2" => header.values(file, |bytes| f16::from_le_bytes(bytes).to_f64()),
        "u2" => header.values(file, |bytes| u16::from_le_bytes(bytes).into()),
        "f4" => header.values(file, |bytes| f32::from_le_bytes(bytes).into()),
        "i4" => header.values(file, |bytes| i32::from_le_bytes(bytes).into()),
        "f8" => header.values(file, f64::from_le_bytes),
        "i8" => header.values(file, |bytes| i64::from_le_bytes(bytes) as f64),
        kind => return Err(format!("expected numbers (f2, f4, f8, u1, u2, i4, i8 or b1), found {kind}")),
    };
    values.map_err(|error| match error.kind() {
        ErrorKind::UnexpectedEof => format!("expected {count} values, found fewer: the file is truncated"),
        _ => error.to_string(),
    })
}

/// Values whose first index is fastest, with the last index fastest.
fn last_fastest(values: &[f64], shape: &[u64]) -> Vec<f64> {
    let at = |index: usize| {
        let (mut rest, mut stride, mut at) = (index, values.len(), 0);
        for side in shape.iter().rev().map(|&side| side as usize) {
            stride /= side;
            at += rest % side * stride;
            rest /= side;
        }
        at
    };
    (0..values.len()).map(|index| values[at(index)]).collect()
}

/// Writes arrays as doubles.
///
/// # Errors
/// [`Error::Unwritable`].
pub fn write(path: &Path, arrays: &Arrays, progress: &Progress) -> Result<(), Error> {
    let bytes = bytes(arrays).map_err(|e| Error::Internal(e.to_string()))?;
    atomic::replace(path, progress, |writer| writer.write_all(&bytes))
}

/// The bytes of an npz file.
///
/// # Errors
/// None but of the archive.
pub fn bytes(arrays: &Arrays) -> io::Result<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
    for (name, array) in arrays {
        archive.start_file(format!("{name}.npy"), options)?;
        archive.write_all(&Header::of_doubles(&array.shape))?;
        for value in &array.values {
            archive.write_all(&value.to_le_bytes())?;
        }
    }
    Ok(archive.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_are_read_as_they_were_written() {
        let array = Array::new(&[2, 3], vec![1.0, -0.5, f64::NAN, 1e300, 0.1, 3.0]);
        let arrays = Arrays::from([("radiance".to_owned(), array.clone())]);
        let read = &parse(&bytes(&arrays).unwrap()).unwrap()["radiance"];
        assert_eq!((&read.shape, &read.kind), (&array.shape, &array.kind));
        let bits = |array: &Array| array.values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(read), bits(&array));
    }

    #[test]
    fn fortran_order_is_undone() {
        assert_eq!(last_fastest(&[1.0, 4.0, 2.0, 5.0, 3.0, 6.0], &[2, 3]), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    }

    #[test]
    fn what_is_no_archive_of_numbers_is_an_error() {
        assert!(parse(b"PK no archive").unwrap_err().contains("found no archive"));
        let array = Array::new(&[4], vec![1.0; 4]);
        let whole = bytes(&Arrays::from([("a".to_owned(), array)])).unwrap();
        assert!(parse(&whole[..whole.len() / 2]).is_err());
        let lies = Array { shape: vec![5], ..Array::new(&[4], vec![1.0; 4]) };
        let lies = bytes(&Arrays::from([("a".to_owned(), lies)])).unwrap();
        assert!(parse(&lies).unwrap_err().contains("truncated"), "a header that claims more");
    }
}
