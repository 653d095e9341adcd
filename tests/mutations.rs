//! Damaged files of every binary format: an error that names the file or a valid material, never a panic.
//!
//! `SVBRDF_MUTATIONS=100000 cargo test mutations -- --nocapture` tries more than the usual number for each format.

use std::io::Cursor;
use std::path::Path;

use image::ImageFormat;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use svbrdf::material::read::{NonFinite, ReadOptions, read_bytes};
use tempfile::tempdir;

use crate::support::pictures::{layered, multi_part, npy, npz, packed};

/// Inputs for each format in a usual run.
const BUDGET: usize = 400;

fn budget() -> usize {
    std::env::var("SVBRDF_MUTATIONS").ok().and_then(|n| n.parse().ok()).unwrap_or(BUDGET)
}

fn written(write: impl Fn(&Path)) -> Vec<u8> {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m");
    write(&path);
    std::fs::read(path).unwrap()
}

fn encoded(format: ImageFormat) -> Vec<u8> {
    let image = packed("NDRS", 4, |_, v| v);
    let image = if format == ImageFormat::Hdr { image.to_rgb32f().into() } else { image };
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// A damaged copy of `bytes`: truncated, bits flipped, a stretch overwritten with extremes, or a part doubled.
fn damaged(bytes: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let mut below = |limit: usize| random.next_u32() as usize % limit.max(1);
    // Headers decide most: half of the damage goes to them.
    let reach = if below(2) == 0 { bytes.len().min(400) } else { bytes.len() };
    let at = below(reach);
    match below(5) {
        0 => bytes.truncate(at),
        1 => (0..=below(8)).for_each(|_| {
            let place = below(reach);
            bytes[place] ^= 1 << below(8);
        }),
        2 => {
            let extreme = [0x00, 0xff, 0x7f, 0x80][below(4)];
            let end = bytes.len().min(at + 1 + below(8));
            bytes[at..end].fill(extreme);
        }
        3 => {
            let part = bytes[at..bytes.len().min(at + 64)].to_vec();
            bytes.splice(at..at, part);
        }
        _ => {
            let end = bytes.len().min(at + 1 + below(16));
            bytes.drain(at..end);
        }
    }
    bytes
}

fn try_all(format: &str, whole: &[u8]) {
    let options = ReadOptions { non_finite: NonFinite::Replace, ..ReadOptions::default() };
    read_bytes::<f32>("whole", whole, &options).unwrap_or_else(|e| panic!("{format}: {e}"));
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let (mut opened, mut refused) = (0, 0);
    for _ in 0..budget() {
        match read_bytes::<f32>("damaged", &damaged(whole, &mut random), &options) {
            Ok(read) => {
                let planes = read.material.planes();
                assert!(planes.roughness.iter().all(|r| (0.0..=1.0).contains(r)));
                opened += 1;
            }
            Err(error) => {
                assert!(error.to_string().contains("damaged"), "{format}: {error}");
                refused += 1;
            }
        }
    }
    println!("{format}: {opened} opened, {refused} refused");
    assert!(refused > 0, "{format}");
}

#[test]
fn damaged_pictures_never_panic() {
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Hdr, ImageFormat::Tiff] {
        try_all(&format!("{format:?}"), &encoded(format));
    }
}

#[test]
fn damaged_layered_exr_never_panics() {
    try_all("EXR of one part", &written(|path| layered(path, true)));
    try_all("EXR of four parts", &written(multi_part));
}

#[test]
fn damaged_numpy_files_never_panic() {
    let image = packed("NDRS", 4, |_, v| v).to_rgb32f();
    let shape = [u64::from(image.height()), u64::from(image.width()), 3];
    try_all("npy", &npy(shape, image.as_raw()));
    try_all("npz", &written(npz));
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
