//! Files that claim to be what nobody can hold, or what nobody can read: refused at once, with their claim.

use std::fs;
use std::io::{Cursor, Write as _};

use tempfile::tempdir;
use zip::write::SimpleFileOptions;

use svbrdf_files::read::{ReadOptions, read_bytes};

use crate::materials::seeds;
use crate::mutations::sign;
use crate::support::npy::npy;
use crate::support::png::{Png, RGB};

/// The message of a refusal, which comes soon.
fn refusal(bytes: &[u8]) -> String {
    let started = std::time::Instant::now();
    let message = match read_bytes::<f32>("claims", bytes, &ReadOptions::AUTO) {
        Ok(_) => panic!("it was read"),
        Err(error) => error.to_string(),
    };
    assert!(started.elapsed().as_secs() < 2, "{message} took {:?}", started.elapsed());
    message
}

#[test]
fn absurd_sizes_are_refused_at_once() {
    let most = "expected at most 65536 x 16384";
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2147483648\n";
    let window = |window| exr_head(window, false);
    for (bytes, words) in [
        (png_head(30_000, 30_000), [most, "30000 x 30000"]),
        (window([0, 0, (1 << 29) - 1, 0]), [most, "536870912 x 1"]),
        (tiff_head(1 << 31, 1), [most, "2147483648 x 1"]),
        (hdr.to_vec(), [most, "2147483648 x 1"]),
        (jpeg_head(3, 65_535, 65_535), [most, "65535 x 65535"]),
        (png_head(0x7fff_ffff, 1), ["expected at most 4 GiB of pixels, found more", "scale"]),
        (png_head(0x7fff_ffff, 0x7fff_ffff), ["expected at most 4 GiB", "scale"]),
        (png_head(0, 4), ["expected a valid PNG", "again"]),
        (window([0, 0, i32::MAX, 0]), ["expected a valid EXR", "again"]),
        (window([5, 0, 2, 0]), ["expected a valid EXR", "again"]),
        (window([i32::MIN, i32::MIN, i32::MAX, i32::MAX]), ["cannot decode", "expected"]),
        (exr_head([0; 4], true), ["expected flat samples, found a deep EXR", "flatten it"]),
        (tiff_head(u32::MAX, u32::MAX), ["cannot decode", "at most"]),
        (tiff_head(0, 4), ["cannot decode", "expected"]),
        (jpeg_head(2, 8, 8), ["expected gray, RGB or CMYK, found 2 components", "convert it to RGB"]),
        (bomb(), ["at most 4 GiB", "found 8 GiB"]),
        (archive(65), ["expected at most 64 arrays in the npz", "found 65"]),
        (png_of_profile(), ["at most 64 MiB of profiles", "write it again without them"]),
    ] {
        let message = refusal(&bytes);
        for word in words.iter().chain(&["claims"]) {
            assert!(message.contains(word), "`{word}` is not in: {message}");
        }
    }
}

/// A PNG in 8-bit RGB that claims its size and holds no more than the beginning of its pixels.
fn png_head(width: u32, height: u32) -> Vec<u8> {
    let mut bytes =
        Png { size: [1, 1], depth: 8, colour: RGB, interlaced: false, chunks: &[] }.bytes(|_, _, _| 0);
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    sign(&mut bytes);
    bytes
}

/// A PNG whose profile unpacks to more than any profile.
fn png_of_profile() -> Vec<u8> {
    let chunks =
        [(*b"iCCP", [b"name\0\0".as_slice(), &crate::support::png::zlib(&vec![7; 65 << 20])].concat())];
    Png { size: [1, 1], depth: 8, colour: RGB, interlaced: false, chunks: &chunks }.bytes(|_, _, _| 0)
}

/// The beginning of an EXR of one channel `Y` of 32-bit floats, up to its table of blocks; `deep` makes it one of samples in depth. The
/// window is (x least, y least, x most, y most).
fn exr_head(window: [i32; 4], deep: bool) -> Vec<u8> {
    let mut file = vec![0x76, 0x2f, 0x31, 0x01];
    file.extend((if deep { 0x802_u32 } else { 2 }).to_le_bytes());
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        file.extend([name, kind].map(|text| format!("{text}\0")).concat().bytes());
        file.extend((value.len() as u32).to_le_bytes());
        file.extend(value);
    };
    let int = |n: i32| n.to_le_bytes().to_vec();
    // Name, type float, linear, three bytes of nothing, sampling of 1 x 1, and the end of the list.
    attribute("channels", "chlist", &[b"Y\0".to_vec(), int(2), vec![0; 4], int(1), int(1), vec![0]].concat());
    attribute("compression", "compression", &[0]);
    let window: Vec<u8> = window.into_iter().flat_map(i32::to_le_bytes).collect();
    attribute("dataWindow", "box2i", &window);
    attribute("displayWindow", "box2i", &window);
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &1_f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1_f32.to_le_bytes());
    if deep {
        attribute("name", "string", b"part");
        attribute("type", "string", b"deepscanline");
        for name in ["version", "chunkCount", "maxSamplesPerPixel"] {
            attribute(name, "int", &int(1));
        }
    }
    file.push(0);
    file
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
fn arrays_that_claim_too_much_are_refused_at_once() {
    let huge = npy([1, 1, 3], &[0.5; 3]);
    let text = String::from_utf8_lossy(&huge).find("(1,").unwrap();
    for claim in
        ["(99999999999, 99999999999, 3)", "(4294967296, 4294967296, 3)", "(9999999, 2, 3)", "(0, 5, 3)"]
    {
        let mut bytes = huge.clone();
        let end = bytes[text..].iter().position(|&b| b == b'\n').unwrap() + text;
        bytes[text..end].fill(b' ');
        let claim = format!("{claim}, }}");
        bytes[text..text + claim.len()].copy_from_slice(claim.as_bytes());
        assert!(refusal(&bytes).contains("claims"));
    }
}

/// The library allocates what a block of DWA claims, and ends the program where it cannot; fuzzing found a block of a version
/// that no writer has.
#[test]
fn blocks_of_dwa_that_claim_too_much_are_refused_whatever_version_they_have() {
    const CLAIM: u64 = 1 << 61;
    let seeds = seeds();
    for compression in ["dwaa", "dwab"] {
        let (.., path) = seeds.iter().find(|(case, ..)| case.name.contains(compression)).unwrap();
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
                let claim = format!(
                    "claims: expected a valid EXR, found: invalid: a DWA block that claims {CLAIM} bytes"
                );
                let message = refusal(&bytes);
                assert!(message.contains(&claim), "version {version}, {field}: {message}");
            }
        }
    }
}

#[test]
fn a_long_listing_is_cut() {
    let folder = tempdir().unwrap();
    (0..40).for_each(|i| fs::write(folder.path().join(format!("{i:02}.txt")), "x").unwrap());
    let read = svbrdf_files::read::read::<f32>(folder.path(), &ReadOptions::AUTO, &Default::default());
    assert!(read.is_err_and(|error| error.to_string().contains("11.txt and 28 more")));
}
