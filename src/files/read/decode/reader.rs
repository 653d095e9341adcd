//! The source of every decoder: a file or memory.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read, Seek, SeekFrom};

/// A file, or a picture within another file that is in memory. One type for both: the libraries are compiled for each
/// type that they read from.
pub(crate) enum ByteReader<'a> {
    File(BufReader<File>),
    Memory(Cursor<&'a [u8]>),
}

impl<'a> ByteReader<'a> {
    pub(crate) fn of_bytes(bytes: &'a [u8]) -> Self {
        Self::Memory(Cursor::new(bytes))
    }

    pub(crate) fn length(&self) -> io::Result<u64> {
        match self {
            Self::File(reader) => reader.get_ref().metadata().map(|found| found.len()),
            Self::Memory(reader) => Ok(reader.get_ref().len() as u64),
        }
    }
}

impl Read for ByteReader<'_> {
    #[inline]
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::File(reader) => reader.read(buffer),
            Self::Memory(reader) => reader.read(buffer),
        }
    }

    #[inline]
    fn read_exact(&mut self, buffer: &mut [u8]) -> io::Result<()> {
        match self {
            Self::File(reader) => reader.read_exact(buffer),
            Self::Memory(reader) => reader.read_exact(buffer),
        }
    }

    fn read_to_end(&mut self, bytes: &mut Vec<u8>) -> io::Result<usize> {
        match self {
            Self::File(reader) => reader.read_to_end(bytes),
            Self::Memory(reader) => reader.read_to_end(bytes),
        }
    }
}

impl BufRead for ByteReader<'_> {
    #[inline]
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        match self {
            Self::File(reader) => reader.fill_buf(),
            Self::Memory(reader) => reader.fill_buf(),
        }
    }

    #[inline]
    fn consume(&mut self, count: usize) {
        match self {
            Self::File(reader) => reader.consume(count),
            Self::Memory(reader) => reader.consume(count),
        }
    }
}

impl Seek for ByteReader<'_> {
    #[inline]
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match self {
            Self::File(reader) => reader.seek(to),
            Self::Memory(reader) => reader.seek(to),
        }
    }

    // Without it, skipping a few bytes of a file would empty its buffer.
    #[inline]
    fn seek_relative(&mut self, by: i64) -> io::Result<()> {
        match self {
            Self::File(reader) => reader.seek_relative(by),
            Self::Memory(reader) => reader.seek_relative(by),
        }
    }
}
