//! Arrays of NumPy: the header of a `.npy` file, read and written, and its values.
//!
//! The format is that of `numpy.lib.format`, versions 1 to 3: a magic word, the length of the header, and the text of a Python
//! dictionary with the keys `descr`, `fortran_order` and `shape`.

use std::io::{self, Read};

const MAGIC: &[u8; 6] = b"\x93NUMPY";
/// Longest header that is read, in bytes. That of a plain array has about 120.
const LONGEST: usize = 1 << 16;
/// Values that are read at a time: memory grows with what is there, not with what a header claims.
const VALUES_AT_A_TIME: usize = 1 << 13;
/// The values of a file begin at a multiple of this.
const ALIGNMENT: usize = 64;

/// What an array holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// Kind and size of the values as NumPy names them, such as `f4`; empty for a record.
    pub kind: String,
    /// Whether values of several bytes have the high one first.
    pub is_big_endian: bool,
    /// Whether the first index changes fastest.
    pub is_fortran: bool,
    pub shape: Vec<u64>,
}

impl Header {
    /// Reads the header; the values come next.
    ///
    /// # Errors
    /// `UnexpectedEof` where the file ends, `InvalidData` where it is no header.
    pub fn read(mut reader: impl Read) -> io::Result<Self> {
        let mut start = [0; 8];
        reader.read_exact(&mut start)?;
        if &start[..6] != MAGIC {
            return Err(invalid("it does not begin as an array of NumPy does"));
        }
        let mut length = [0; 4];
        match start[6] {
            1 => reader.read_exact(&mut length[..2])?,
            2 | 3 => reader.read_exact(&mut length)?,
            version => return Err(invalid(&format!("expected version 1 to 3, found {version}"))),
        }
        let length = u32::from_le_bytes(length) as usize;
        if length > LONGEST {
            return Err(invalid(&format!("expected a header of at most {LONGEST} bytes, found {length}")));
        }
        let mut text = vec![0; length];
        reader.read_exact(&mut text)?;
        Self::parse(&String::from_utf8_lossy(&text))
            .ok_or_else(|| invalid("its header has no descr, fortran_order and shape"))
    }

    fn parse(text: &str) -> Option<Self> {
        let descr = value(text, "descr")?;
        let (order, kind) = match descr.strip_prefix(['\'', '"']) {
            Some(rest) => rest[..rest.find(['\'', '"'])?].split_at_checked(1)?,
            // The list of the fields of a record.
            None => ("|", ""),
        };
        let is_fortran = match value(text, "fortran_order")? {
            rest if rest.starts_with("True") => true,
            rest if rest.starts_with("False") => false,
            _ => return None,
        };
        let shape = value(text, "shape")?.strip_prefix('(')?;
        let sides = shape[..shape.find(')')?].split(',').map(str::trim).filter(|side| !side.is_empty());
        let shape = sides.map(|side| side.trim_end_matches('L').parse().ok()).collect::<Option<_>>()?;
        let is_big_endian = order == ">" || (order == "=" && cfg!(target_endian = "big"));
        Some(Self { kind: kind.to_owned(), is_big_endian, is_fortran, shape })
    }

    /// The number of values; `None` where it is too large for a number.
    pub fn count(&self) -> Option<u64> {
        self.shape.iter().try_fold(1_u64, |product, &side| product.checked_mul(side))
    }

    /// The values, each of `N` bytes, of which `of` takes the low one first.
    ///
    /// # Errors
    /// `UnexpectedEof` where the file ends.
    pub fn values<T, const N: usize>(
        &self,
        mut reader: impl Read,
        of: impl Fn([u8; N]) -> T,
    ) -> io::Result<Vec<T>> {
        let count = self.count().and_then(|count| usize::try_from(count).ok());
        let count = count.ok_or(io::ErrorKind::UnexpectedEof)?;
        let mut values = Vec::new();
        let mut bytes = vec![[0; N]; VALUES_AT_A_TIME.min(count)];
        while values.len() < count {
            let next = &mut bytes[..VALUES_AT_A_TIME.min(count - values.len())];
            reader.read_exact(next.as_flattened_mut())?;
            if self.is_big_endian {
                next.iter_mut().for_each(|bytes| bytes.reverse());
            }
            values.extend(next.iter().map(|&bytes| of(bytes)));
        }
        Ok(values)
    }

    /// The first bytes of a file of 64-bit floats, low byte first, with the last index fastest.
    pub fn of_doubles(shape: &[usize]) -> Vec<u8> {
        let mut sides = shape.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
        if shape.len() == 1 {
            sides.push(',');
        }
        let mut text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({sides}), }}");
        let before = MAGIC.len() + 4;
        let padding = ALIGNMENT - (before + text.len() + 1) % ALIGNMENT;
        text.extend(std::iter::repeat_n(' ', padding));
        text.push('\n');
        // A few numbers of at most 20 digits are far shorter than 64 KiB.
        let length = (text.len() as u16).to_le_bytes();
        [MAGIC.as_slice(), &[1, 0], &length, text.as_bytes()].concat()
    }
}

/// What follows a key of the dictionary.
fn value<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let at = ['\'', '"'].iter().find_map(|quote| text.split_once(&format!("{quote}{key}{quote}:")));
    at.map(|(_, rest)| rest.trim_start())
}

fn invalid(problem: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, problem)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of this version with the text as its header.
    fn file(version: u8, text: &str) -> Vec<u8> {
        let length = (text.len() as u32).to_le_bytes();
        let length = if version == 1 { &length[..2] } else { &length };
        [MAGIC.as_slice(), &[version, 0], length, text.as_bytes()].concat()
    }

    #[test]
    fn headers_that_numpy_writes_are_read() {
        let of = |kind: &str, is_big_endian, is_fortran, shape: &[u64]| Header {
            kind: kind.to_owned(),
            is_big_endian,
            is_fortran,
            shape: shape.to_vec(),
        };
        for (version, text, expected) in [
            (
                1,
                "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }   \n",
                of("f4", false, false, &[3, 4]),
            ),
            (2, "{'descr': '>f8', 'fortran_order': True, 'shape': (7,), }\n", of("f8", true, true, &[7])),
            (3, "{\"descr\": \"|u1\", \"fortran_order\": False, \"shape\": ()}", of("u1", false, false, &[])),
            (
                1,
                "{'shape': (2L, 3L), 'fortran_order': False, 'descr': '|b1'}",
                of("b1", false, false, &[2, 3]),
            ),
            (
                1,
                "{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (2,), }",
                of("", false, false, &[2]),
            ),
        ] {
            assert_eq!(Header::read(file(version, text).as_slice()).unwrap(), expected, "{text}");
        }
    }

    #[test]
    fn what_is_no_header_is_an_error() {
        let kind = |bytes: &[u8]| Header::read(bytes).unwrap_err().kind();
        for text in [
            "",
            "{'descr': '<f4', 'fortran_order': False, }",
            "{'descr': '', 'fortran_order': False, 'shape': (1,)}",
            "{'descr': 'é4', 'fortran_order': No, 'shape': (1,)}",
            "{'descr': '<f4', 'fortran_order': False, 'shape': (-1,)}",
            "{'descr': '<f4', 'fortran_order': False, 'shape': (1",
        ] {
            assert_eq!(kind(&file(1, text)), io::ErrorKind::InvalidData, "{text}");
        }
        assert_eq!(kind(b"no array of numbers"), io::ErrorKind::InvalidData);
        assert_eq!(kind(&file(4, "")), io::ErrorKind::InvalidData);
        assert_eq!(kind(&file(2, "")[..9]), io::ErrorKind::UnexpectedEof);
        assert_eq!(kind(b"\x93NUMPY\x02\x00\xff\xff\xff\xff"), io::ErrorKind::InvalidData);
    }

    #[test]
    fn a_written_header_is_read_as_it_was_and_aligned() {
        for shape in [&[2, 3, 4][..], &[5], &[1_000_000_007, 1, 65536, 3]] {
            let bytes = Header::of_doubles(shape);
            assert_eq!(bytes.len() % ALIGNMENT, 0);
            let header = Header::read(bytes.as_slice()).unwrap();
            assert_eq!(header.shape, shape.iter().map(|&side| side as u64).collect::<Vec<_>>());
            assert_eq!((header.kind.as_str(), header.is_fortran, header.is_big_endian), ("f8", false, false));
        }
        assert_eq!(
            Header { shape: vec![u64::MAX, 2], ..Header::read(Header::of_doubles(&[1]).as_slice()).unwrap() }
                .count(),
            None
        );
    }
}
