//! The claims of DWA blocks in an EXR, which exr 1.74.2 allocates unchecked: a damaged one would end the
//! program.

use std::io::Seek as _;

use exr::block::chunk::CompressedBlock;
use exr::compression::Compression;
use exr::error::{Error, Result};
use exr::meta::MetaData;
use exr::meta::header::Header;

use super::reader::Reader;

/// How many 8-byte numbers a block begins with: the version, then sizes and counts.
const NUMBERS: usize = 11;

/// Checks that no block claims to unpack into more than `most` bytes; leaves `reader` at its beginning.
///
/// # Errors
/// Those of the library, and where a block claims more.
pub(crate) fn check(reader: &mut Reader<'_>, meta: &MetaData, most: u64) -> Result<()> {
    let is_dwa = |compression| matches!(compression, Compression::DWAA(_) | Compression::DWAB(_));
    if meta.headers.iter().any(|header| is_dwa(header.compression)) {
        for chunk in exr::block::read(&mut *reader, false)?.filter_chunks(false, |_, _, _| true)? {
            let chunk = chunk?;
            let header = meta.headers.get(chunk.layer_index);
            if let Some(header) = header.filter(|header| is_dwa(header.compression)) {
                check_block(header, &chunk.compressed_block, most)?;
            }
        }
        reader.rewind()?;
    }
    Ok(())
}

fn check_block(header: &Header, block: &CompressedBlock, most: u64) -> Result<()> {
    let bytes = match block {
        CompressedBlock::ScanLine(block) => &block.compressed_pixels_le,
        CompressedBlock::Tile(block) => &block.compressed_pixels_le,
        _ => return Ok(()),
    };
    // The library takes a block of just this many bytes for the pixels themselves, and every other one for a packed one.
    let place = header.get_absolute_block_pixel_coordinates(header.get_block_data_indices(block)?)?;
    if bytes.len() == place.size.area() * header.channels.bytes_per_pixel {
        return Ok(());
    }
    let numbers = bytes.as_chunks::<8>().0.iter().take(NUMBERS).skip(1);
    match numbers.map(|eight| u64::from_le_bytes(*eight)).max() {
        Some(largest) if largest > most => {
            Err(Error::Invalid(format!("a DWA block that claims {largest} bytes").into()))
        }
        _ => Ok(()),
    }
}
