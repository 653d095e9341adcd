//! JPEG within TIFF: every strip or tile is one, whose tables may be in a tag. They are decoded as other JPEG are, since
//! tiff 0.11.3 decodes them to other values than libtiff.

use std::io::{Read as _, Seek as _, SeekFrom};

use tiff::decoder::{ChunkType, Decoder};
use tiff::tags::Tag;
use tiff::{ColorType, TiffResult};

use super::jpeg::{self, Pixels};
use super::place::{ByteReader, DecodedFile};
use crate::error::Error;

/// The compression of JPEG in the way of today.
const JPEG: u16 = 7;
/// A JPEG begins and ends with two bytes each.
const MARKER: usize = 2;

/// Where the strips or tiles of a picture are.
struct Chunks {
    size: [usize; 2],
    chunk: [usize; 2],
    /// Offset and length of each in the file.
    places: Vec<(u64, u64)>,
    tables: Vec<u8>,
}

impl Chunks {
    /// `None` of another compression, or of planes.
    fn of(decoder: &mut Decoder<ByteReader<'_>>) -> TiffResult<Option<Self>> {
        let is_jpeg = decoder.find_tag_unsigned::<u16>(Tag::Compression)? == Some(JPEG);
        if !is_jpeg || decoder.find_tag_unsigned::<u16>(Tag::PlanarConfiguration)? == Some(2) {
            return Ok(None);
        }
        let tags = match decoder.get_chunk_type() {
            ChunkType::Strip => [Tag::StripOffsets, Tag::StripByteCounts],
            ChunkType::Tile => [Tag::TileOffsets, Tag::TileByteCounts],
        };
        let [offsets, lengths] = [decoder.get_tag_u64_vec(tags[0])?, decoder.get_tag_u64_vec(tags[1])?];
        let tables = decoder.find_tag(Tag::JPEGTables)?.map(|tables| tables.into_u8_vec()).transpose()?;
        let side = |(width, height): (u32, u32)| [width as usize, height as usize];
        Ok(Some(Self {
            size: side(decoder.dimensions()?),
            chunk: side(decoder.chunk_dimensions()),
            places: offsets.into_iter().zip(lengths).collect(),
            tables: tables.unwrap_or_default(),
        }))
    }

    /// The JPEG of a strip or tile: the tables of the tag before its own, and the marker of Adobe that tells its colours.
    fn whole(&self, own: &[u8], is_ycbcr: bool) -> Vec<u8> {
        let tables = self.tables.get(MARKER..self.tables.len().saturating_sub(MARKER)).unwrap_or_default();
        let adobe = [b"\xff\xd8\xff\xee\x00\x0eAdobe\x00\x64\x00\x00\x00\x00".as_slice(), &[is_ycbcr.into()]];
        [&adobe.concat(), tables, own.get(MARKER..).unwrap_or_default()].concat()
    }
}

/// The samples of a picture of JPEG, texel by texel; `None` of another compression.
pub(super) fn pixels(
    decoder: &mut Decoder<ByteReader<'_>>,
    colour: ColorType,
    count: usize,
    place: DecodedFile<'_>,
) -> Result<Option<Vec<u8>>, Error> {
    let chunks = Chunks::of(decoder).map_err(|error| place.invalid("TIFF", error))?;
    let Some(chunks) = chunks.filter(|_| colour.bit_depth() == 8) else { return Ok(None) };
    let [width, height] = chunks.size;
    let [across, down] = chunks.chunk.map(|side| side.max(1));
    let mut all = vec![0; width * height * count];
    for (number, (offset, length)) in chunks.places.iter().enumerate() {
        let columns = width.div_ceil(across);
        let (left, top) = (number % columns * across, number / columns * down);
        if top >= height {
            break;
        }
        let _reserved = place.reserve(*length)?;
        let mut own = Vec::new();
        let reader = decoder.inner();
        reader.seek(SeekFrom::Start(*offset)).map_err(|error| Error::unreadable(place.path, error))?;
        reader.take(*length).read_to_end(&mut own).map_err(|error| Error::unreadable(place.path, error))?;
        let Pixels { size, count: found, values, .. } =
            jpeg::pixels(&chunks.whole(&own, matches!(colour, ColorType::YCbCr(_))), [across, down], place)?;
        if found != count {
            return Err(place.invalid("TIFF", "a JPEG in it of another shape"));
        }
        let rows = values.chunks_exact(size[0] * count).take(down.min(height - top));
        for (row, stored) in rows.enumerate() {
            let texels = size[0].min(width - left) * count;
            let start = ((top + row) * width + left) * count;
            all[start..start + texels].copy_from_slice(&stored[..texels]);
        }
    }
    Ok(Some(all))
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;
    use std::path::Path;

    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;

    use crate::read::decode::place::DecodedFile;
    use crate::read::decode::{reader, tiff};
    use crate::read::record::Subject;

    /// A picture of 18 x 20 pixels in tiles of JPEG with halved chroma and common tables, and its red, green and blue as Pillow 13.0 reads
    /// them with libtiff.
    const OF_LIBTIFF: [&str; 2] = [
        "SUkqAAgAAAANAAABBAABAAAAEgAAAAEBBAABAAAAFAAAAAIBAwADAAAAqgAAAAMBAwABAAAABwAAAAYBAwABAAAABgAAABUBAwABAAAAAwAAABwBAwABAAAAAQAAAEIBBAABAAAAEAAAAEMBBAABAAAAEAAAAEQBBAAEAAAA/gIAAEUBBAAEAAAAsAAAAFsBBwA+AgAAwAAAABICAwACAAAAAgACAAAAAAAIAAgACABDAAAAQQAAAD4AAAA3AAAA/9j/2wBDAAoHBwgHBgoICAgLCgoLDhgQDg0NDh0VFhEYIx8lJCIfIiEmKzcvJik0KSEiMEExNDk7Pj4+JS5ESUM8SDc9Pjv/2wBDAQoLCw4NDhwQEBw7KCIoOzs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozv/xAAfAAABBQEBAQEBAQAAAAAAAAAAAQIDBAUGBwgJCgv/xAC1EAACAQMDAgQDBQUEBAAAAX0BAgMABBEFEiExQQYTUWEHInEUMoGRoQgjQrHBFVLR8CQzYnKCCQoWFxgZGiUmJygpKjQ1Njc4OTpDREVGR0hJSlNUVVZXWFlaY2RlZmdoaWpzdHV2d3h5eoOEhYaHiImKkpOUlZaXmJmaoqOkpaanqKmqsrO0tba3uLm6wsPExcbHyMnK0tPU1dbX2Nna4eLj5OXm5+jp6vHy8/T19vf4+fr/xAAfAQADAQEBAQEBAQEBAAAAAAAAAQIDBAUGBwgJCgv/xAC1EQACAQIEBAMEBwUEBAABAncAAQIDEQQFITEGEkFRB2FxEyIygQgUQpGhscEJIzNS8BVictEKFiQ04SXxFxgZGiYnKCkqNTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqCg4SFhoeIiYqSk5SVlpeYmZqio6Slpqeoqaqys7S1tre4ubrCw8TFxsfIycrS09TV1tfY2dri4+Tl5ufo6ery8/T19vf4+fr/2Q4DAABSAwAAlAMAANIDAAD/2P/AABEIABAAEAMBIgACEQEDEQH/2gAMAwEAAhEDEQA/APObPTOny1u2emdPlrSs9M6fLW5Z6Z0+WmjXK8x21P/ZAP/Y/8AAEQgAEAAQAwEiAAIRAQMRAf/aAAwDAQACEQMRAD8AyRpnA+Wl/sz/AGa64aZwPlo/sz/Zq7n2n9o+Z//ZAP/Y/8AAEQgAEAAQAwEiAAIRAQMRAf/aAAwDAQACEQMRAD8A0LO3j44rds7ePjisaz7Vu2fahHy2Vyemp//Z/9j/wAARCAAQABADASIAAhEBAxEB/9oADAMBAAIRAxEAPwD0AW8eBxR9nj9KkHQUtUa8z7n/2QA=",
        "AQAABwEBFgMJIgINMAERPwEWTAIdVwIhYwEnbwIrfQQxiQM1mQE6pgI/sgNEugVI1gBS2QBVBAYDCgkHFwsPJQsUMwkXQAkcUAokWwsoZgsucQsygAs3jgw8mwpBqApFtgxLvQ5P2gVZ2wdbBhMMDBUQGRcYJhccNRUgQhYlURYsXBYwZxY2chc6ghhAkBhFnBZJqhdOtxdTvxtY3BFg3RRiBB4TCyAXGCMfJSMkNCEnQiEsUSI0XCI4ZyI+cyJCgSNHjiRMnCJRqCJVtyRbvyZf2x1n3R9pACkZBysdFi0lIy4qMSstPywyTS06WS0+ZC1Eby1IfS5NjC5Smi1XpixbtC5huzFl1yht2SpvADUhBzglFDgsIjkxMTc1PTc5TThBWDhFYzhLbjhPfjlVijlZmDhepjljszloujxs1zJ02TZ3AUEpCUMtGEQ1JUU6MkM9P0NCT0RKWkVOZUVUcEVYf0VdjEZimkRnpkRrtUZxvEh12T972kJ9AkswC0w0F047JU5AM01EQExITk5QWk1UZU1acE5ef1BkjU9omk1tqE5ytU93vFF72EmB20yEBVU4DVc8GVhDKFhINldMQ1ZQUlhYXVhcZ1dhclhlf1hqjlhvnFd0qFd4t1l+v1qC2lSH3VeKBV4+DGFCGmJKJ2JONmBSQ2FXUmFeXWFiZmFncmFrgWJxjWJ1nGB6qmF/t2GEvmSI3F6O3mCQB2tHDm1LG25SKW9XOG1bRG1fVG1nX25raW1wdG10gm55kG5+nm2Dq2yHuW6NwHGR3WmW4GyZBnZODHlSG3paJ3peN3hiRXhnU3luXnlyaHh3dHh7g3mBj3mFnXiKqnmPuHmUwHuY3nWe3nigAoFUCoNYGIRgJYRkNIJoQoNtT4R0W4N4ZYJ9cIOBf4SHi4SLmoKQqIOVtYSavIae2oCj2oOlAoxbCo9gF5BnJJBsM45vQI50UI98W5CAZI6EcI+JfZCOi5CTmY2Xpo6ctZCivJKm2Iyq2Y6sBJhkC5toGZxwJZx0NZp4Qpt9UZuEXJuIZpqNcZuRf5yXjJybm5qgqJultpuqvZ6u2piz25u1B6FrD6NvG6R2KqR7N6N/RaKDVKSLX6SPaqOUdaOYgaSdkKSinqOnrKKruaWxwaa13KC536O8ALBwCLJ0FLN5IbR+MLKEPbKIS7OQVrOUY7OYbrScfLWkibWomLOupbOzsbW4ube80rDB1bPEA7d2C7l6GLp/JruENLmKQLmOTrqWW7qaZruecbuif7yqjbuum7q0qLu5tru+vb7C1rfH2brKB8J+DcSCHMaIKMaMNsSSRcSXUsWeXcWiaMWmdcWqg8eykMa2ncW8q8bBuMbGwMjK2cHP3MTSB8qED8yIHs6OKs6SOMyYRc2dU82kX82oas6sdc6whM+4kc68n83Crc7Hus7MwdHQ28nV3c3Y",
    ];

    #[test]
    fn tiles_of_jpeg_have_the_values_of_libtiff() {
        let [file, values] = OF_LIBTIFF.map(|text| STANDARD.decode(text).unwrap());
        let place = DecodedFile::of(Path::new("m.tif"), Subject::Material);
        let raster = tiff::decode(reader(Cursor::new(file)), place).unwrap().layers.remove(0).raster;
        assert_eq!(raster.size(), [18, 20]);
        let rgb = |index| raster.rgb(index).map(|value| (255.0 * value).round() as u8);
        let read: Vec<u8> = (0..18 * 20).flat_map(rgb).collect();
        assert_eq!(read, values);
    }
}
