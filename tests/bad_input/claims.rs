//! Files that claim to be what nobody can hold, or what nobody can read.

use std::io::{Cursor, Write};

use ::exr::prelude::Compression;
use zip::write::SimpleFileOptions;

use super::*;
use crate::support::exr;
use crate::support::pictures::{compressed, npy};

#[test]
fn absurd_sizes_are_refused_at_once() {
    let most = "expected at most 65536 x 16384";
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2147483648\n";
    let window = |window| exr::header(window, false);
    for (bytes, found) in [
        (header_only(30_000, 30_000), "30000 x 30000"),
        (window([0, 0, (1 << 29) - 1, 0]), "536870912 x 1"),
        (tiff_head(1 << 31, 1), "2147483648 x 1"),
        (hdr.to_vec(), "2147483648 x 1"),
        (jpeg_head(3, 65_535, 65_535), "65535 x 65535"),
    ] {
        let folder = tempdir().unwrap();
        fs::write(folder.path().join("x.png"), bytes).unwrap();
        assert_refused(&folder.path().join("x.png"), &format!("x.png .. {most} .. found {found} .. scale"));
    }
    assert_bytes_refused(&[
        (header_only(0x7fff_ffff, 1), "expected at most 4 GiB of pixels, found more .. scale"),
        (header_only(0x7fff_ffff, 0x7fff_ffff), "expected at most 4 GiB"),
        (header_only(0, 4), "expected a valid PNG"),
        (header_only(16, 0), "expected a valid PNG"),
        (exr::deep(), "expected flat samples, found a deep EXR .. flatten it"),
        (window([0, 0, i32::MAX, 0]), "cannot decode .. expected a valid EXR .. window .. again"),
        (window([5, 0, 2, 0]), "cannot decode .. expected a valid EXR .. again"),
        (window([i32::MIN, i32::MIN, i32::MAX, i32::MAX]), "cannot decode .. expected"),
        (tiff_head(u32::MAX, u32::MAX), "at most"),
        (tiff_head(0, 4), "cannot decode .. expected"),
        (jpeg_head(2, 8, 8), "expected gray, RGB or CMYK, found 2 components .. convert it to RGB"),
        (bomb(), "at most 4 GiB .. found 8 GiB"),
        (archive(65), "expected at most 64 arrays in the npz, found 65"),
    ]);
}

/// A PNG in 8-bit RGB that claims its size and holds no more than the beginning of its pixels.
fn header_only(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = png_bytes(&flat(1, 1, [0; 3]));
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    sign(&mut bytes);
    bytes
}

/// The tags of a TIFF in 8-bit gray of this size, and no pixels.
fn tiff_head(width: u32, height: u32) -> Vec<u8> {
    let entries = [256, 257, 258, 259, 262, 273, 277, 278, 279]
        .into_iter()
        .zip([width, height, 8, 1, 1, 8, 1, height, 1]);
    let mut file = b"II*\0\x08\0\0\0".to_vec();
    file.extend((entries.len() as u16).to_le_bytes());
    for (tag, value) in entries {
        file.extend(u16::to_le_bytes(tag));
        // One 32-bit integer.
        file.extend([4, 0, 1, 0, 0, 0]);
        file.extend(value.to_le_bytes());
    }
    file.extend([0; 4]);
    file
}

/// A JPEG up to the end of its frame, behind a comment.
fn jpeg_head(components: u8, width: u16, height: u16) -> Vec<u8> {
    let mut file = b"\xff\xd8\xff\xfe\0\x04hi\xff\xc0".to_vec();
    file.extend((8 + 3 * u16::from(components)).to_be_bytes());
    file.push(8);
    file.extend(height.to_be_bytes());
    file.extend(width.to_be_bytes());
    file.push(components);
    (1..=components).for_each(|number| file.extend([number, 0x11, 0]));
    file.extend(b"\xff\xda\0\x08\x01\x01\0\0\x3f\0\xff\xd9");
    file
}

/// An archive of arrays of one byte.
fn archive(count: usize) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for number in 0..count {
        zip.start_file(format!("{number}.npy"), SimpleFileOptions::default()).unwrap();
        zip.write_all(&[0; 8]).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

/// An archive of four arrays of which each claims to unpack into 2 GiB.
fn bomb() -> Vec<u8> {
    let mut bytes = archive(4);
    let directory = b"PK\x01\x02";
    for at in 0..bytes.len() - directory.len() {
        if bytes[at..].starts_with(directory) {
            bytes[at + 24..at + 28].copy_from_slice(&(1_u32 << 31).to_le_bytes());
        }
    }
    bytes
}

#[test]
fn archives_and_arrays_that_claim_too_much_are_refused_at_once() {
    let huge = npy([1, 1, 3], &[0.5; 3]);
    let text = String::from_utf8_lossy(&huge).find("(1,").unwrap();
    for claim in
        ["(99999999999, 99999999999, 3)", "(4294967296, 4294967296, 3)", "(9999999, 2, 3)", "(0, 5, 3)"]
    {
        let mut bytes = huge.clone();
        let end = bytes[text..].iter().position(|&b| b == b')').unwrap() + text + 1;
        let padding = bytes[end..].iter().take_while(|&&b| b != b'\n').count();
        let header = format!("{claim}, }}");
        let room = end - text + padding;
        assert!(header.len() <= room, "{claim} needs {} of {room}", header.len());
        bytes[text..text + room].fill(b' ');
        bytes[text..text + header.len()].copy_from_slice(header.as_bytes());
        let started = std::time::Instant::now();
        let message = read_bytes::<f32>("claims", &bytes, &ReadOptions::default()).unwrap_err().to_string();
        assert!(message.contains("claims"), "{message}");
        assert!(started.elapsed().as_secs() < 2, "{claim} took {:?}", started.elapsed());
    }
}

/// The library allocates what a block of DWA claims, and ends the program where it cannot; fuzzing found a block of a version
/// that no writer has.
#[test]
fn blocks_of_dwa_that_claim_too_much_are_refused_whatever_version_they_have() {
    const CLAIM: u64 = 1 << 61;
    let folder = tempdir().unwrap();
    for compression in [Compression::DWAA(None), Compression::DWAB(None)] {
        let path = folder.path().join("whole.exr");
        compressed(&path, compression);
        let whole = fs::read(path).unwrap();
        // A block is the row where it begins, its size, the version 2, sizes and counts.
        let number = |at: usize| u64::from_le_bytes(whole[at..at + 8].try_into().unwrap());
        let size = |at: usize| u32::from_le_bytes(whole[at + 4..at + 8].try_into().unwrap()) as usize;
        let is_block = |at: &usize| {
            number(*at) as u32 == 0
                && size(*at) > 88
                && size(*at) <= whole.len() - at - 8
                && number(at + 8) == 2
        };
        let block = (0..whole.len() - 16).find(is_block).unwrap() + 8;
        for version in [0, 1, 2, 3, 720_898, u64::MAX] {
            for field in 1..=9 {
                let mut bytes = whole.clone();
                bytes[block..block + 8].copy_from_slice(&version.to_le_bytes());
                bytes[block + 8 * field..][..8].copy_from_slice(&CLAIM.to_le_bytes());
                let error = read_bytes::<f32>("claims", &bytes, &ReadOptions::default()).unwrap_err();
                let claim = format!(
                    "claims: expected a valid EXR, found: invalid: a DWA block that claims {CLAIM} bytes"
                );
                assert!(error.to_string().contains(&claim), "version {version}, {field}: {error}");
            }
        }
        read_bytes::<f32>("whole", &whole, &ReadOptions::default()).unwrap();
    }
}
