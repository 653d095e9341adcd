//! Lengths, sizes and counts in the headers of files, for each format: what a file claims and does not hold is an error of that file, within
//! the limit of memory, and the run goes on.

mod fields;

use std::fs;
use std::io::{Cursor, Write as _};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use image::{DynamicImage, ImageFormat, Rgb, RgbImage};
use tempfile::TempDir;
use zip::write::SimpleFileOptions;

use fields::{FIELDS, READ, SHORT, SIZES, TEXT_SIZES, TEXTS};

use super::{folder, limited, text};
use crate::materials::{Case, seeds};
use crate::mutations::sign;
use crate::support::npy::npy;
use crate::support::png::{Png, RGB, zlib};

/// A file whose size is text.
fn of_text(text: &str, [width, height]: [u64; 2]) -> Vec<u8> {
    let text = text.replace("<w>", &width.to_string()).replace("<h>", &height.to_string());
    let length = (text.len() as u16).to_le_bytes();
    let before =
        if text.starts_with('{') { [b"\x93NUMPY\x01\0", length.as_slice()].concat() } else { Vec::new() };
    [before.as_slice(), text.as_bytes(), &[0; 768]].concat()
}

/// An EXR of samples in depth, up to its table of blocks.
const DEEP: &str = "di8xAQIIAABjaGFubmVscwBjaGxpc3QAEwAAAFkAAgAAAAAAAAABAAAAAQAAAABjb21wcmVzc2lvbgBjb21wcmVzc2lvbgABAAAAAGRh\
                    dGFXaW5kb3cAYm94MmkAEAAAAAAAAAAAAAAAAAAAAAAAAABkaXNwbGF5V2luZG93AGJveDJpABAAAAAAAAAAAAAAAAAAAAAAAAAAbGlu\
                    ZU9yZGVyAGxpbmVPcmRlcgABAAAAAHBpeGVsQXNwZWN0UmF0aW8AZmxvYXQABAAAAAAAgD9zY3JlZW5XaW5kb3dDZW50ZXIAdjJmAAgA\
                    AAAAAAAAAAAAAHNjcmVlbldpbmRvd1dpZHRoAGZsb2F0AAQAAAAAAIA/bmFtZQBzdHJpbmcABAAAAHBhcnR0eXBlAHN0cmluZwAMAAAA\
                    ZGVlcHNjYW5saW5ldmVyc2lvbgBpbnQABAAAAAEAAABjaHVua0NvdW50AGludAAEAAAAAQAAAG1heFNhbXBsZXNQZXJQaXhlbABpbnQA\
                    BAAAAAEAAAAA";
/// A JPEG of two components.
const TWO: &[u8] = b"\xff\xd8\xff\xfe\0\x04hi\xff\xc0\0\x0e\x08\0\x08\0\x08\x02\x01\x11\0\x02\x11\0\xff\xda\0\x08\x01\x01\0\0\x3f\0\xff\xd9";
/// One of four, as of CMYK.
const FOUR: &[u8] = b"\xff\xd8\xff\xfe\0\x04hi\xff\xc0\0\x14\x08\0\x08\0\x08\x04\x01\x11\0\x02\x11\0\x03\x11\0\x04\x11\0\xff\xda\0\x08\x01\x01\0\0\x3f\0\xff\xd9";
/// A WebP with loss of 16383 x 16383 texels, and nothing more.
const LOSSY: &[u8] =
    b"RIFF\x20\0\0\0WEBPVP8 \x14\0\0\0\x50\x01\0\x9d\x01\x2a\xff\x3f\xff\x3f\0\0\0\0\0\0\0\0\0\0";

/// Whole files, and the words of their refusal.
fn whole_files() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let profile = [(*b"iCCP", [b"name\0\0".as_slice(), &zlib(&vec![7; 65 << 20])].concat())];
    let of_profile = Png { size: [1, 1], depth: 8, colour: RGB, interlaced: false, chunks: &profile };
    // Four arrays of 2 GiB.
    let mut bomb = archive(4);
    let entry = |bytes: &&[u8]| bytes.starts_with(b"PK\x01\x02");
    let entries: Vec<_> = (0..bomb.len()).filter(|at| entry(&&bomb[*at..])).collect();
    entries.iter().for_each(|at| bomb[at + 24..at + 28].copy_from_slice(b"\0\0\0\x80"));
    vec![
        ("exr", STANDARD.decode(DEEP).unwrap(), "expected flat samples, found a deep EXR; flatten it"),
        ("jpg", TWO.to_vec(), "expected gray or RGB, found 2 components; convert it to RGB"),
        ("jpg", FOUR.to_vec(), "expected gray or RGB, found 4 components; convert it to RGB"),
        ("webp", LOSSY.to_vec(), SHORT),
        ("npz", bomb, "expected at most 4 GiB in the npz, found 8 GiB"),
        ("npz", archive(65), "expected at most 64 arrays in the npz, found 65"),
        ("png", of_profile.bytes(|_, _, _| 0), "expected at most 64 MiB of profiles and texts, found more"),
    ]
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

/// A valid file of a format.
fn valid(extension: &str, seeds: &[(Case, TempDir, PathBuf)]) -> Vec<u8> {
    let picture =
        DynamicImage::from(RgbImage::from_fn(32, 8, |x, y| Rgb([128, 100 + x as u8, 90 + y as u8])));
    match extension {
        "png" => {
            let profile = [b"name\0\0".as_slice(), &zlib(&[7; 40])].concat();
            let chunks = [(*b"iCCP", profile), (*b"tEXt", b"Title\0tiles".to_vec())];
            let png = Png { size: [32, 8], depth: 8, colour: RGB, interlaced: false, chunks: &chunks };
            png.bytes(|x, y, c| [128, 100 + x as u16, 90 + y as u16][c])
        }
        "npy" => npy([8, 32, 3], &[0.5; 768]),
        "glb" => {
            let json = br#"{"asset":{"version":"2.0"},"materials":[{}]}"#;
            let lengths = [2, 20 + json.len() as u32, json.len() as u32].map(u32::to_le_bytes);
            [b"glTF".as_slice(), lengths.as_flattened(), b"JSON", json].concat()
        }
        "exr" | "npz" | "dds" => {
            let is_of = |path: &PathBuf| path.extension().is_some_and(|own| own == extension);
            let (.., path) = seeds.iter().find(|(.., path)| is_of(path)).unwrap();
            fs::read(path).unwrap()
        }
        _ => {
            let mut bytes = Cursor::new(Vec::new());
            picture.write_to(&mut bytes, ImageFormat::from_extension(extension).unwrap()).unwrap();
            bytes.into_inner()
        }
    }
}

/// The file with other bytes.
fn changed(mut file: Vec<u8>, changes: &[(&[u8], isize, &[u8])]) -> Vec<u8> {
    for (before, behind, value) in changes {
        let found = file.windows(before.len().max(1)).position(|part| part.starts_with(before));
        let found = found.unwrap_or_else(|| panic!("no {before:x?}"));
        let at = found.strict_add_signed(*behind);
        file[at..at + value.len()].copy_from_slice(value);
    }
    if file.starts_with(b"\x89PNG") {
        sign(&mut file);
    }
    file
}

/// The library allocates what a block of DWA claims, and ends the program where it cannot; fuzzing found a block of a version that no writer
/// has.
fn blocks_of_dwa(seeds: &[(Case, TempDir, PathBuf)]) -> Vec<Vec<u8>> {
    let claims = |(.., path): &(Case, TempDir, PathBuf)| {
        let whole = fs::read(path).unwrap();
        // A block is the row where it begins, its size, the version 2, sizes and counts.
        let number = |at: usize| u64::from_le_bytes(whole[at..at + 8].try_into().unwrap());
        let size = |at: usize| (number(at) >> 32) as usize;
        let is_block = |at: &usize| {
            let is_first = number(*at) as u32 == 0 && number(at + 8) == 2;
            is_first && size(*at) > 88 && size(*at) <= whole.len() - at - 8
        };
        let block = (0..whole.len() - 16).find(is_block).unwrap() + 8;
        let of_version = |version: u64| {
            let of_field = |field: usize| {
                let mut bytes = whole.clone();
                bytes[block..block + 8].copy_from_slice(&version.to_le_bytes());
                bytes[block + 8 * field..][..8].copy_from_slice(&(1_u64 << 61).to_le_bytes());
                bytes
            };
            (1..=9).map(of_field).collect::<Vec<_>>()
        };
        [0, 1, 2, 3, 720_898, u64::MAX].into_iter().flat_map(of_version).collect::<Vec<_>>()
    };
    let are_dwa = seeds.iter().filter(|(case, ..)| case.name.contains("dwa"));
    are_dwa.flat_map(claims).collect()
}

/// Every file with its name and the words of its refusal.
fn claims() -> Vec<(String, Vec<u8>, &'static str)> {
    let seeds = seeds();
    let mut files = Vec::new();
    let mut add = |name: String, extension: &str, file: Vec<u8>, words| {
        files.push((format!("{:03} {name}.{extension}", files.len()), file, words));
    };
    for (extension, name, before, behind, length, words) in FIELDS {
        for (first, words) in [0x7f, 0xff].into_iter().zip(words) {
            let mut claim = vec![0xff; length];
            let is_big = matches!(extension, "png" | "jpg" | "qoi");
            claim[if is_big { 0 } else { length - 1 }] = first;
            let file = changed(valid(extension, &seeds), &[(before, behind, &claim)]);
            add(format!("{name} {first:x}"), extension, file, words);
        }
    }
    for (extension, changes, words) in SIZES {
        add("size".to_owned(), extension, changed(valid(extension, &seeds), changes), words);
    }
    for (extension, text) in TEXTS {
        for (size @ [width, height], words) in TEXT_SIZES {
            add(format!("{width} x {height}"), extension, of_text(text, size), words);
        }
    }
    whole_files()
        .into_iter()
        .for_each(|(extension, file, words)| add("file".to_owned(), extension, file, words));
    let of_dwa = "expected a valid EXR, found: invalid: a DWA block that claims 2305843009213693952 bytes";
    blocks_of_dwa(&seeds).into_iter().for_each(|file| add("block".to_owned(), "exr", file, of_dwa));
    files
}

/// Decoders allocate by themselves: beyond this limit of the system the program would abort.
#[test]
fn what_a_file_claims_and_does_not_hold_is_an_error_of_that_file() {
    let folder = folder();
    let mut table = "ground_truth,prediction,method\n".to_owned();
    let claims = claims();
    for (name, bytes, _) in &claims {
        fs::write(folder.path().join(name), bytes).unwrap();
        table += &format!("gt.png,{name},m\n");
    }
    table += "gt.png,a.png,m\n";
    fs::write(folder.path().join("claims.csv"), table).unwrap();
    let args =
        "rank --pairs claims.csv --near 2 --distant 2 --format json --read order=ndrs --max-memory 64MiB";
    let started = Instant::now();
    let output = limited(folder.path(), "-v 900000", args);
    let said = text(&output.stderr);
    assert!(started.elapsed() < Duration::from_secs(120), "{:?}", started.elapsed());
    assert_eq!(output.status.code(), Some(1), "{said}");
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let predictions = report["results"][0]["predictions"].as_array().unwrap();
    assert_eq!(predictions.len(), claims.len() + 1, "{said}");
    assert!(predictions.last().unwrap()["loss"].is_number(), "{said}");
    let mut wrong = Vec::new();
    for (&(ref name, _, words), found) in claims.iter().zip(predictions) {
        let error = found["error"].as_str().unwrap_or_default();
        let is_read = error.is_empty() || error.contains("sizes differ");
        let is_right = if words == READ { is_read } else { error.contains(words) };
        if !is_right || !is_read && !error.contains(name.as_str()) {
            wrong.push(format!("{name}: expected \"{words}\", found \"{error}\"\n"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.concat());
}
