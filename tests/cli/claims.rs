//! Lengths in the headers of files, for each format: a claim of gigabytes is an error of its file, and a run goes on.

use std::fs;
use std::io::Cursor;

use image::{DynamicImage, ImageFormat, Rgb, RgbImage};

use super::{folder, limited, text};
use crate::materials::seeds;
use crate::mutations::sign;

/// A field: the bytes before or at it, how far behind their beginning it lies, and its own bytes.
type Field = (&'static [u8], isize, usize);

/// The fields that say how much follows, by the extension of the file.
const FIELDS: [(&str, &[Field]); 12] = [
    // Length, width and height of IHDR; the length of the pixels.
    ("png", &[(b"IHDR", -4, 4), (b"IHDR", 4, 4), (b"IHDR", 8, 4), (b"IDAT", -4, 4)]),
    // The lengths of tables, frame and scan; height and width.
    (
        "jpg",
        &[
            (b"\xff\xdb", 2, 2),
            (b"\xff\xc4", 2, 2),
            (b"\xff\xc0", 2, 2),
            (b"\xff\xda", 2, 2),
            (b"\xff\xc0", 5, 2),
            (b"\xff\xc0", 7, 2),
        ],
    ),
    // The offset of the directory; its length; count and value of each tag.
    (
        "tif",
        &[
            (b"II*\0", 4, 4),
            (b"\x00\x01", 4, 4),
            (b"\x00\x01", 8, 4),
            (b"\x01\x01", 4, 4),
            (b"\x01\x01", 8, 4),
            (b"\x02\x01", 4, 4),
            (b"\x11\x01", 4, 4),
            (b"\x11\x01", 8, 4),
            (b"\x16\x01", 8, 4),
            (b"\x17\x01", 4, 4),
            (b"\x17\x01", 8, 4),
        ],
    ),
    // The offset of the pixels; the length of the header; width and height; the length of the pixels; the number of colours.
    (
        "bmp",
        &[(b"BM", 10, 4), (b"BM", 14, 4), (b"BM", 18, 4), (b"BM", 22, 4), (b"BM", 34, 4), (b"BM", 46, 4)],
    ),
    // Length of the comment, length of the palette, width and height.
    ("tga", &[(b"", 0, 1), (b"", 5, 2), (b"", 12, 2), (b"", 14, 2)]),
    // The lengths of file and chunk; the sizes.
    ("webp", &[(b"RIFF", 4, 4), (b"RIFF", 16, 4), (b"RIFF", 21, 4)]),
    ("qoi", &[(b"qoif", 4, 4), (b"qoif", 8, 4)]),
    // The lengths of header and pixel format; height, width and pitch; depth and levels.
    (
        "dds",
        &[
            (b"DDS ", 4, 4),
            (b"DDS ", 76, 4),
            (b"DDS ", 12, 4),
            (b"DDS ", 16, 4),
            (b"DDS ", 20, 4),
            (b"DDS ", 24, 4),
            (b"DDS ", 28, 4),
        ],
    ),
    // The lengths of attributes; the windows; the offset of a block. Those within blocks of DWA: tests/bad_input.rs.
    (
        "exr",
        &[
            (b"chlist\0", 7, 4),
            (b"compression\0compression\0", 24, 4),
            (b"dataWindow\0box2i\0", 17, 4),
            (b"dataWindow\0box2i\0", 21, 4),
            (b"dataWindow\0box2i\0", 29, 4),
            (b"dataWindow\0box2i\0", 33, 4),
            (b"displayWindow\0box2i\0", 32, 4),
        ],
    ),
    // The length of the header.
    ("npy", &[(b"\x93NUMPY", 8, 2)]),
    // Packed and unpacked size, lengths of name and extra field, of a file and of its entry; entries, size, offset and comment of the directory.
    (
        "npz",
        &[
            (b"PK\x03\x04", 18, 4),
            (b"PK\x03\x04", 22, 4),
            (b"PK\x03\x04", 26, 2),
            (b"PK\x03\x04", 28, 2),
            (b"PK\x01\x02", 20, 4),
            (b"PK\x01\x02", 24, 4),
            (b"PK\x01\x02", 28, 2),
            (b"PK\x01\x02", 30, 2),
            (b"PK\x01\x02", 42, 4),
            (b"PK\x05\x06", 10, 2),
            (b"PK\x05\x06", 12, 4),
            (b"PK\x05\x06", 16, 4),
            (b"PK\x05\x06", 20, 2),
        ],
    ),
    // The lengths of the file and of its JSON.
    ("glb", &[(b"glTF", 8, 4), (b"glTF", 12, 4)]),
];

/// Sizes as text, by the extension.
const TEXTS: [(&str, &str); 3] = [
    ("ppm", "P6\nSIZE\n255\n"),
    ("pfm", "PF\nSIZE\n-1.0\n"),
    ("hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\nSIZE\n"),
];
const SIZES: [[u64; 2]; 4] = [[65_536, 16_384], [16_384, 4_294_967_295], [u64::MAX, 1], [1 << 32, 1 << 32]];

/// A valid file of a format.
fn valid(extension: &str) -> Vec<u8> {
    let picture =
        DynamicImage::from(RgbImage::from_fn(16, 4, |x, y| Rgb([128, 100 + x as u8, 90 + y as u8])));
    let arrays = "{'descr': '<f4', 'fortran_order': False, 'shape': (4, 16, 3), }\n";
    match extension {
        "npy" => [
            b"\x93NUMPY\x01\0".as_slice(),
            &(arrays.len() as u16).to_le_bytes(),
            arrays.as_bytes(),
            &[0; 768],
        ]
        .concat(),
        "glb" => {
            let json = br#"{"asset":{"version":"2.0"},"materials":[{}]}"#;
            let lengths = [2, 20 + json.len() as u32, json.len() as u32].map(u32::to_le_bytes);
            [b"glTF".as_slice(), lengths.as_flattened(), b"JSON", json].concat()
        }
        "exr" | "npz" | "dds" => {
            let is_of = |path: &std::path::Path| path.extension().is_some_and(|own| own == extension);
            let (.., path) = &seeds().into_iter().find(|(.., path)| is_of(path)).unwrap();
            fs::read(path).unwrap()
        }
        _ => {
            let mut bytes = Cursor::new(Vec::new());
            picture.write_to(&mut bytes, ImageFormat::from_extension(extension).unwrap()).unwrap();
            bytes.into_inner()
        }
    }
}

/// Every file with a claim, by its name.
fn claims() -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for (extension, fields) in FIELDS {
        let whole = valid(extension);
        for (number, (before, behind, length)) in fields.iter().enumerate() {
            let found = whole.windows(before.len().max(1)).position(|part| part.starts_with(before));
            let at =
                found.unwrap_or_else(|| panic!("{extension}: no {before:x?}")).strict_add_signed(*behind);
            for (end, claim) in [[0xff, 0xff, 0xff, 0x7f], [0x7f, 0xff, 0xff, 0xff]].iter().enumerate() {
                let mut file = whole.clone();
                file[at..at + length].copy_from_slice(&claim[..*length]);
                if extension == "png" {
                    sign(&mut file);
                }
                files.push((format!("{extension}{number}_{end}.{extension}"), file));
            }
        }
    }
    for (extension, header) in TEXTS {
        for (number, [width, height]) in SIZES.into_iter().enumerate() {
            let size = if extension == "hdr" {
                format!("-Y {height} +X {width}")
            } else {
                format!("{width} {height}")
            };
            let file = [header.replace("SIZE", &size).as_bytes(), &[0; 800]].concat();
            files.push((format!("{extension}{number}.{extension}"), file));
        }
    }
    files
}

/// Decoders allocate by themselves: beyond this limit of the system the program would abort.
#[test]
fn a_length_that_a_file_claims_is_an_error_of_that_file() {
    let folder = folder();
    let mut table = "ground_truth,prediction,method\n".to_owned();
    let claims = claims();
    for (name, bytes) in &claims {
        fs::write(folder.path().join(name), bytes).unwrap();
        table += &format!("gt.png,{name},m\n");
    }
    table += "gt.png,a.png,m\n";
    fs::write(folder.path().join("claims.csv"), table).unwrap();
    let args =
        "rank --pairs claims.csv --near 2 --distant 2 --format json --read order=ndrs --max-memory 64MiB";
    let output = limited(folder.path(), "-v 900000", args);
    let said = text(&output.stderr);
    assert!(matches!(output.status.code(), Some(0 | 1)), "{:?}: {said}", output.status);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let predictions = report["results"][0]["predictions"].as_array().unwrap();
    assert_eq!(predictions.len(), claims.len() + 1, "{said}");
    assert!(predictions.last().unwrap()["loss"].is_number(), "{said}");
    let failed: Vec<_> =
        predictions.iter().filter_map(|one| Some((one["path"].as_str()?, one["error"].as_str()?))).collect();
    assert!(failed.len() > claims.len() / 2, "{said}");
    for (path, error) in failed {
        let name = path.split_once('.').unwrap().0;
        assert!(error.contains(name), "{path}: {error}");
    }
}
