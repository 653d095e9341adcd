//! JPEG within TIFF: every strip or tile is one, whose tables may be in a tag. They are decoded as other JPEG are, since
//! tiff 0.11.3 decodes them to other values than libtiff.

use std::io::{Read as _, Seek as _, SeekFrom};

use tiff::decoder::{ChunkType, Decoder};
use tiff::tags::Tag;
use tiff::{ColorType, TiffResult};

use super::jpeg::{self, Pixels};
use super::place::DecodedFile;
use super::reader::Reader;
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
    fn of(decoder: &mut Decoder<Reader<'_>>) -> TiffResult<Option<Self>> {
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
    decoder: &mut Decoder<Reader<'_>>,
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
    use std::path::Path;

    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;

    use crate::read::decode::place::DecodedFile;
    use crate::read::decode::reader::Reader;
    use crate::read::decode::tiff;
    use crate::read::record::Subject;

    /// Pictures of 18 x 20 pixels in strips and in tiles of JPEG with halved chroma that tifffile has written, and their red, green and
    /// blue as Pillow 13.0 reads them with libtiff.
    const OF_LIBTIFF: [[&str; 2]; 2] = [
        [
            "SUkqAAgAAAAPAAABBAABAAAAEgAAAAEBBAABAAAAFAAAAAIBAwADAAAAwgAAAAMBAwABAAAABwAAAAYBAwABAAAABgAAABEBBAACAAAAyAAAABUBAwABAAAAAwAAABYBBAABAAAAEAAAABcBAwACAAAAngKOAhoBBQABAAAA0AAAABsBBQABAAAA2AAAABwBAwABAAAAAQAAACgBAwABAAAAAQAAABICAwACAAAAAgACABQCBQAGAAAA4AAAAAAAAAAIAAgACAAQAQAArgMAAAEAAAABAAAAAQAAAAEAAAAAAAAAAQAAAP8AAAABAAAAgAAAAAEAAAD/AAAAAQAAAIAAAAABAAAA/wAAAAEAAAD/2P/gABBKRklGAAEBAAABAAEAAP/bAEMADQkKCwoIDQsKCw4ODQ8TIBUTEhITJxweFyAuKTEwLiktLDM6Sj4zNkY3LC1AV0FGTE5SU1IyPlphWlBgSlFST//bAEMBDg4OExETJhUVJk81LTVPT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT//AABEIABAAEgMBIgACEQEDEQH/xAAfAAABBQEBAQEBAQAAAAAAAAAAAQIDBAUGBwgJCgv/xAC1EAACAQMDAgQDBQUEBAAAAX0BAgMABBEFEiExQQYTUWEHInEUMoGRoQgjQrHBFVLR8CQzYnKCCQoWFxgZGiUmJygpKjQ1Njc4OTpDREVGR0hJSlNUVVZXWFlaY2RlZmdoaWpzdHV2d3h5eoOEhYaHiImKkpOUlZaXmJmaoqOkpaanqKmqsrO0tba3uLm6wsPExcbHyMnK0tPU1dbX2Nna4eLj5OXm5+jp6vHy8/T19vf4+fr/xAAfAQADAQEBAQEBAQEBAAAAAAAAAQIDBAUGBwgJCgv/xAC1EQACAQIEBAMEBwUEBAABAncAAQIDEQQFITEGEkFRB2FxEyIygQgUQpGhscEJIzNS8BVictEKFiQ04SXxFxgZGiYnKCkqNTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqCg4SFhoeIiYqSk5SVlpeYmZqio6Slpqeoqaqys7S1tre4ubrCw8TFxsfIycrS09TV1tfY2dri4+Tl5ufo6ery8/T19vf4+fr/2gAMAwEAAhEDEQA/AOLtrHpxWvbWPTitC1senFa9rY9OK0gx4DH7amQLHjpRXTCx46UVvc+g+v8Amf/Z/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAA0JCgsKCA0LCgsODg0PEyAVExISEyccHhcgLikxMC4pLSwzOko+MzZGNywtQFdBRkxOUlNSMj5aYVpQYEpRUk//2wBDAQ4ODhMREyYVFSZPNS01T09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT0//wAARCAAEABIDASIAAhEBAxEB/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL/8QAtRAAAgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRolJicoKSo0NTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09fb3+Pn6/8QAHwEAAwEBAQEBAQEBAQAAAAAAAAECAwQFBgcICQoL/8QAtREAAgECBAQDBAcFBAQAAQJ3AAECAxEEBSExBhJBUQdhcRMiMoEIFEKRobHBCSMzUvAVYnLRChYkNOEl8RcYGRomJygpKjU2Nzg5OkNERUZHSElKU1RVVldYWVpjZGVmZ2hpanN0dXZ3eHl6goOEhYaHiImKkpOUlZaXmJmaoqOkpaanqKmqsrO0tba3uLm6wsPExcbHyMnK0tPU1dbX2Nna4uPk5ebn6Onq8vP09fb3+Pn6/9oADAMBAAIRAxEAPwDTtoU44rXtYU44oopwPnsA3oaAhTHSiiitz6C7P//Z",
            "BQAGDQIKGwMRKQIVNwAcRAAiUgApXQEyZgM5cgRBfgVIjAROmQFUqAFZtgFgxAFn1gJz2wB2BgcLDwoQHQsXKwobOQciRgYoUwgvXgg3aAw/cwtGgA1OjgxUmwpZqAheuAlmxglt1gp53Qh8BRUUDRcYHRgfKxcjNxQqRRMwUhU3XhVAZxhHcxlPfxpWjRpdmxdiqRZmthZsxRZz1hd/2xaCAyIcCyQgGyUnKSQrNiEwQyA2UCI/XCNGZiVPciZVfidciydjmSRqpyNutiR1wyN71CSH2SKKAC4hCTEmGDMuJjEzNC44QC4+TS9HWC9NYjNXbTNcejVkiDNqlTFxozB1szB8wDGD0TKP2C+SADspCD4uFkA2JD86Mjw+QDpETTxOVj1TYj9dbEBjekFshkBylT13ojx9sT2EwD2L0T6X1jyaAEgwCUo0F0w8JUpCM0dGP0ZMTkhWWElcY0tlbk1sek10iE17l0qApEmEs0qMv0qR0Eue10igAFE1CFQ6F1RCJVNGM1BLQFBQTlFaWFJgY1RpbVVveld4hlZ+lVODolGJsVORwFOX0VOk1lKmBF09DWBCHWFKK2FROl9XR2BdVmFnX2FtaGFzcmN6f2SDjmSKnGGPq2GUumKcx2Oj1WGs3F6vBWZDDmlIHGpQK2pVOmhbR2hhVWlqYGtxaGp3cmt9f22HjG2Nm2uTqmuauWyix2yp1Wqy22i1BnNKD3VOHXZWLHZdO3RjSXRqVnZzYHh6aHZ/cniGgXmQjnqWnHabq3agunioyHev1nW423S7BYBSDYJWHIRfKoNjOYFrSIFyVYN5YISAZ4OGcoWMf4aWjoadm4ShqYOouYSwx4S31oLA24DDAI1ZCpBeGZBmKJBrNY5yRI15UY+AXJGHY5CNbpGTe5OdipOkmZGpqJGutpK2w5O905DG2I7JAJphCJ1mGJ1uJp1zNJx5Qpt/T52HWp6PYp6UbJ6beqKkiKCql56xpp62tJ++wqDF0Z3O1pvRAKdpB6ltFqt0Jap7NKiBQ6iIUKqQWquYYqqcbaykeq6siK2zlau5pKu+tKvGwazN0KnW1qjZAK9uCbFzGLN6JrN/NrCHQrCNUrKWW7OdYrOibbOpe7ayibW4l7O/prPEtrTMw7TT0rHc17DfAMNzAsV3EcaBH8WFLcKLOcGPSMKZUcOfWcWlZsWtc8i1gce8j8bDncXHrsbQusbWy8Xh0cPkAMl5CM1+F8yHJM2MNMmSQMiWTcqgV8umYMysa820es+8h8/DlczJpMzOss3Wwc3d0c3o1svrCNOCENaHHtaQLNeVO9KbSNKfVdSpXtWvaNW1c9e9gdjFj9nMndXSrNXXutffydbm2dbx3tX0DNqIFtyNJN6XMt2bQNmhTNmlW9qvZNu1bdy7ed3Dht/Lld/SodzYsNzdwN3lzd3s39z35Nv6",
        ],
        [
            "SUkqAAgAAAAQAAABBAABAAAAEgAAAAEBBAABAAAAFAAAAAIBAwADAAAAzgAAAAMBAwABAAAABwAAAAYBAwABAAAABgAAABUBAwABAAAAAwAAABoBBQABAAAA1AAAABsBBQABAAAA3AAAABwBAwABAAAAAQAAACgBAwABAAAAAQAAAEIBBAABAAAAEAAAAEMBBAABAAAAEAAAAEQBBAAEAAAA5AAAAEUBAwAEAAAA9AAAABICAwACAAAAAgACABQCBQAGAAAA/AAAAAAAAAAIAAgACAABAAAAAQAAAAEAAAABAAAAMAEAAL0DAABVBgAA8ggAAI0CmAKdAo0CAAAAAAEAAAD/AAAAAQAAAIAAAAABAAAA/wAAAAEAAACAAAAAAQAAAP8AAAABAAAAAAAAAP/Y/+AAEEpGSUYAAQEAAAEAAQAA/9sAQwANCQoLCggNCwoLDg4NDxMgFRMSEhMnHB4XIC4pMTAuKS0sMzpKPjM2RjcsLUBXQUZMTlJTUjI+WmFaUGBKUVJP/9sAQwEODg4TERMmFRUmTzUtNU9PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09P/8AAEQgAEAAQAwEiAAIRAQMRAf/EAB8AAAEFAQEBAQEBAAAAAAAAAAABAgMEBQYHCAkKC//EALUQAAIBAwMCBAMFBQQEAAABfQECAwAEEQUSITFBBhNRYQcicRQygZGhCCNCscEVUtHwJDNicoIJChYXGBkaJSYnKCkqNDU2Nzg5OkNERUZHSElKU1RVVldYWVpjZGVmZ2hpanN0dXZ3eHl6g4SFhoeIiYqSk5SVlpeYmZqio6Slpqeoqaqys7S1tre4ubrCw8TFxsfIycrS09TV1tfY2drh4uPk5ebn6Onq8fLz9PX29/j5+v/EAB8BAAMBAQEBAQEBAQEAAAAAAAABAgMEBQYHCAkKC//EALURAAIBAgQEAwQHBQQEAAECdwABAgMRBAUhMQYSQVEHYXETIjKBCBRCkaGxwQkjM1LwFWJy0QoWJDThJfEXGBkaJicoKSo1Njc4OTpDREVGR0hJSlNUVVZXWFlaY2RlZmdoaWpzdHV2d3h5eoKDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uLj5OXm5+jp6vLz9PX29/j5+v/aAAwDAQACEQMRAD8A4u2senFa9tY9OK0LWx6cVr2tj04rSDHgMftqf//Z/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAA0JCgsKCA0LCgsODg0PEyAVExISEyccHhcgLikxMC4pLSwzOko+MzZGNywtQFdBRkxOUlNSMj5aYVpQYEpRUk//2wBDAQ4ODhMREyYVFSZPNS01T09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT0//wAARCAAQABADASIAAhEBAxEB/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL/8QAtRAAAgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRolJicoKSo0NTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09fb3+Pn6/8QAHwEAAwEBAQEBAQEBAQAAAAAAAAECAwQFBgcICQoL/8QAtREAAgECBAQDBAcFBAQAAQJ3AAECAxEEBSExBhJBUQdhcRMiMoEIFEKRobHBCSMzUvAVYnLRChYkNOEl8RcYGRomJygpKjU2Nzg5OkNERUZHSElKU1RVVldYWVpjZGVmZ2hpanN0dXZ3eHl6goOEhYaHiImKkpOUlZaXmJmaoqOkpaanqKmqsrO0tba3uLm6wsPExcbHyMnK0tPU1dbX2Nna4uPk5ebn6Onq8vP09fb3+Pn6/9oADAMBAAIRAxEAPwDgNej8rWJ09Nv/AKCKz62vGEfleJrtPTZ/6AtYtOW7NK0uapKXds//2f/Y/+AAEEpGSUYAAQEAAAEAAQAA/9sAQwANCQoLCggNCwoLDg4NDxMgFRMSEhMnHB4XIC4pMTAuKS0sMzpKPjM2RjcsLUBXQUZMTlJTUjI+WmFaUGBKUVJP/9sAQwEODg4TERMmFRUmTzUtNU9PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09P/8AAEQgAEAAQAwEiAAIRAQMRAf/EAB8AAAEFAQEBAQEBAAAAAAAAAAABAgMEBQYHCAkKC//EALUQAAIBAwMCBAMFBQQEAAABfQECAwAEEQUSITFBBhNRYQcicRQygZGhCCNCscEVUtHwJDNicoIJChYXGBkaJSYnKCkqNDU2Nzg5OkNERUZHSElKU1RVVldYWVpjZGVmZ2hpanN0dXZ3eHl6g4SFhoeIiYqSk5SVlpeYmZqio6Slpqeoqaqys7S1tre4ubrCw8TFxsfIycrS09TV1tfY2drh4uPk5ebn6Onq8fLz9PX29/j5+v/EAB8BAAMBAQEBAQEBAQEAAAAAAAABAgMEBQYHCAkKC//EALURAAIBAgQEAwQHBQQEAAECdwABAgMRBAUhMQYSQVEHYXETIjKBCBRCkaGxwQkjM1LwFWJy0QoWJDThJfEXGBkaJicoKSo1Njc4OTpDREVGR0hJSlNUVVZXWFlaY2RlZmdoaWpzdHV2d3h5eoKDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uLj5OXm5+jp6vLz9PX29/j5+v/aAAwDAQACEQMRAD8A5+Lxskf/ADC8/wDbf/7GrkXxESP/AJg2f+3n/wCwrhKKFpsc9PC0qfwr8Wf/2f/Y/+AAEEpGSUYAAQEAAAEAAQAA/9sAQwANCQoLCggNCwoLDg4NDxMgFRMSEhMnHB4XIC4pMTAuKS0sMzpKPjM2RjcsLUBXQUZMTlJTUjI+WmFaUGBKUVJP/9sAQwEODg4TERMmFRUmTzUtNU9PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09P/8AAEQgAEAAQAwEiAAIRAQMRAf/EAB8AAAEFAQEBAQEBAAAAAAAAAAABAgMEBQYHCAkKC//EALUQAAIBAwMCBAMFBQQEAAABfQECAwAEEQUSITFBBhNRYQcicRQygZGhCCNCscEVUtHwJDNicoIJChYXGBkaJSYnKCkqNDU2Nzg5OkNERUZHSElKU1RVVldYWVpjZGVmZ2hpanN0dXZ3eHl6g4SFhoeIiYqSk5SVlpeYmZqio6Slpqeoqaqys7S1tre4ubrCw8TFxsfIycrS09TV1tfY2drh4uPk5ebn6Onq8fLz9PX29/j5+v/EAB8BAAMBAQEBAQEBAQEAAAAAAAABAgMEBQYHCAkKC//EALURAAIBAgQEAwQHBQQEAAECdwABAgMRBAUhMQYSQVEHYXETIjKBCBRCkaGxwQkjM1LwFWJy0QoWJDThJfEXGBkaJicoKSo1Njc4OTpDREVGR0hJSlNUVVZXWFlaY2RlZmdoaWpzdHV2d3h5eoKDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uLj5OXm5+jp6vLz9PX29/j5+v/aAAwDAQACEQMRAD8A4HX9TGsazPqAg8gTbf3e/djCheuB6elZ1FFAH//Z",
            "BQAGDQIKGwMRKQIVNwAcRAAiUgApXQEyZgM5cgRBfgVIjAROmQFUqAFZtgFgwARl0QBlvhtsBgcLDwoQHQsXKwobOQciRgYoUwgvXgg3aAw/cwtGgA1OjgxUmwpZqAheuAlmwQxr1AZqwB9vBRUUDRcYHRgfKxcjNxQqRRMwUhU3XhVAZxhHcxlPfxpWjRpdmxdiqRZmthZswBlx2BBywiV0AyIcCyQgGyUnKSQrNiEwQyA2UCI/XCNGZiVPciZVfidciydjmSRqpyNutiR1viZ53x19xi98AC4hCTEmGDMuJjEzNC44QC4+TS9HWC9NYjNXbTNcejVkiDNqlTFxozB1szB8vDOB5C2JxzmDADspCD4uFkA2JD86Mjw+QDpETTxOVj1TYj9dbEBjekFshkBylT13ojx9sT2EukCJ5zqTyEWLAEgwCUo0F0w8JUpCM0dGP0ZMTkhWWElcY0tlbk1sek10iE17l0qApEmEs0qMu0yQ5kicxk2QAFE1CFQ6F1RCJVNGM1BLQFBQTlFaWFJgY1RpbVVveld4hlZ+lVODolGJsVORulaW4lGgwVWTBF09DWBCHWFKK2FROl9XR2BdVmFnX2FtaGFzcmN6f2SDjmSKnGGPq2GUumKcw2Wh3Fqk0nCrBWZDDmlIHGpQK2pVOmhbR2hhVWlqYGtxaGp3cmt9f22HjG2Nm2uTqmuauWyiwm+n12KozHeuBnNKD3VOHXZWLHZdO3RjSXRqVnZzYHh6aHZ/cniGgXmQjnqWnHabq3aguniow3ut2G+xyoCzBYBSDYJWHIRfKoNjOYFrSIFyVYN5YISAZ4OGcoWMf4aWjoadm4ShqYOouYSwwoe12327zYu7AI1ZCpBeGZBmKJBrNY5yRI15UY+AXJGHY5CNbpGTe5OdipOkmZGpqJGutpK2v5W74IzHzZXCAJphCJ1mGJ1uJp1zNJx5Qpt/T52HWp6PYp6UbJ6beqKkiKCql56xpp62tJ++vaLD5ZrSz5/JAKdpB6ltFqt0Jap7NKiBQ6iIUKqQWquYYqqcbaykeq6siK2zlau5pKu+tKvGva7L6aTa06bPAK9uCbFzGLN6JrN/NrCHQrCNUrKWW7OdYrOibbOpe7ayibW4l7O/prPEtrTMv7bR7arf1KrSC7xrD79uGb9zIsJ6McOEPcSMSsKUVsCaacKmdL+rgb2zjb67nL/FpsLNrsTSssXUwsLC09PTDcRyEcZ1Gsl8JsyEM82NQNCVTdCeWs2kas+vd8y1hMy+kc7GntDPqdXYsdbettjh3d3d29vbDNB8EdJ/GdaGJNiOMNuXPd2fSd6mVNysX9myaNe3dde+gdrGj93QmeDYoePfpOXh1NTUysrKLs2KMc6LN9CQPtKWSdSdUtWjW9SnZNKrgeTFiePJk+LNnOPTpuXarufgtenlt+nm9/f319fX",
        ],
    ];

    #[test]
    fn strips_and_tiles_of_jpeg_have_the_values_of_libtiff() {
        for texts in OF_LIBTIFF {
            let [file, values] = texts.map(|text| STANDARD.decode(text).unwrap());
            let place = DecodedFile::of(Path::new("m.tif"), Subject::Material);
            let raster = tiff::decode(Reader::of_bytes(&file), place).unwrap().layers.remove(0).raster;
            assert_eq!(raster.size(), [18, 20]);
            let rgb = |index| raster.rgb(index).map(|value| (255.0 * value).round() as u8);
            let read: Vec<u8> = (0..18 * 20).flat_map(rgb).collect();
            assert_eq!(read, values);
        }
    }
}
