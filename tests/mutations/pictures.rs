//! Damaged pictures.

use std::collections::BTreeSet;

use exr::prelude::Compression;

use super::*;
use crate::formats::decoders::{ETC1S, blocks, pfm};
use crate::support::pictures::{SIDE, compressed, layered, multi_part, npy, npz, stored};
use crate::support::png::{self, Png, crc32};
use crate::support::textures::{bc1_block, dds_blocks, dds_dx10, dds_plain};

/// A material in each way that a picture is stored; names begin with the kind of file.
pub fn pictures() -> Vec<(String, Vec<u8>)> {
    let eight = packed("NDRS", 4, |_, v| v);
    let [sixteen, float]: [DynamicImage; 2] = [eight.to_rgb16().into(), eight.to_rgb32f().into()];
    let (rgba, numbers) = (eight.to_rgba8(), eight.to_rgb32f());
    let bc1: Vec<u8> = (0..64).flat_map(|block| bc1_block([block / 2, block, 31 - block / 2])).collect();
    let blocks_of_16: Vec<u8> = (0..64_u8).flat_map(|k| [k | 1; 16].map(|b| b.wrapping_mul(37))).collect();
    let common = [
        ("PNG of 8 bits", &eight, ImageFormat::Png),
        ("PNG of 16 bits", &sixteen, ImageFormat::Png),
        ("JPEG", &eight, ImageFormat::Jpeg),
        ("HDR", &float, ImageFormat::Hdr),
        ("TIFF of 8 bits", &eight, ImageFormat::Tiff),
        ("TIFF of 16 bits", &sixteen, ImageFormat::Tiff),
        ("TIFF of floats", &float, ImageFormat::Tiff),
        ("BMP", &eight, ImageFormat::Bmp),
        ("WebP", &eight, ImageFormat::WebP),
        ("PNM", &eight, ImageFormat::Pnm),
        ("QOI", &eight, ImageFormat::Qoi),
    ];
    let others = [
        ("PNG of a palette", palette()),
        ("BMP of a palette", palette_bmp()),
        ("DDS", dds_plain(rgba.width(), rgba.height(), rgba.as_raw())),
        ("DDS of BC1", dds_blocks(64, 16, b"DXT1", &bc1)),
        ("DDS of BC2", dds_blocks(64, 16, b"DXT3", &blocks_of_16)),
        ("DDS of BC3", dds_blocks(64, 16, b"DXT5", &blocks_of_16)),
        ("DDS of BC7", dds_dx10(64, 16, 98, &blocks_of_16)),
        ("KTX2 of UASTC", blocks().1),
        ("KTX2 of ETC1S", ETC1S.to_vec()),
        ("EXR of one part", written(|path| layered(path, true))),
        ("EXR of four parts", written(multi_part)),
        ("PFM", pfm(&numbers, "-1", f32::to_le_bytes)),
        // Strips of JPEG with halved chroma, by tifffile.
        ("TIFF of JPEG", include_bytes!("jpeg.tif").to_vec()),
        ("npy", npy([u64::from(numbers.height()), u64::from(numbers.width()), 3], numbers.as_raw())),
        ("npz", written(npz)),
    ];
    let common = common.map(|(name, image, format)| (name, encoded(image, format)));
    let named = common.into_iter().chain(others).map(|(name, bytes)| (name.to_owned(), bytes));
    named.chain(compressed_exr()).collect()
}

/// An EXR of each compression. Of these, what does not shrink is stored as it is, and would not try the decoder.
fn compressed_exr() -> Vec<(String, Vec<u8>)> {
    use Compression::{B44, B44A, DWAA, DWAB, PIZ, PXR24, RLE, Uncompressed, ZIP1, ZIP16};
    let all = [Uncompressed, RLE, ZIP1, ZIP16, PIZ, PXR24, B44, B44A, DWAA(None), DWAB(None)];
    let exr = |one| (format!("EXR, {one}"), written(|path| compressed(path, one)));
    let all: Vec<_> = all.into_iter().map(exr).collect();
    let sizes: BTreeSet<usize> = all.iter().map(|(_, bytes)| bytes.len()).collect();
    assert!(sizes.len() == all.len() && sizes.last() == Some(&all[0].1.len()), "{sizes:?}");
    all
}

fn try_kinds(kinds: &[&str]) {
    let of_kind = |name: &str| kinds.iter().any(|kind| name.starts_with(kind));
    let all: Vec<_> = pictures().into_iter().filter(|(name, _)| of_kind(name)).collect();
    assert!(all.len() >= kinds.len());
    for (name, whole) in all {
        let is_strip = ["BMP", "WebP", "PNM", "QOI", "DDS", "KTX2"].iter().any(|kind| name.starts_with(kind));
        let options = if is_strip { &STRIP } else { &OPTIONS };
        try_all(&name, &whole, damaged, |bytes| read_bytes("damaged", bytes, options), of_picture);
    }
}

#[test]
fn damaged_pictures_never_panic() {
    try_kinds(&["PNG of 8", "PNG of 16", "JPEG", "HDR", "TIFF", "np"]);
}

#[test]
fn damaged_textures_of_games_never_panic() {
    try_kinds(&["BMP", "WebP", "PNM", "QOI", "PFM", "DDS", "KTX2"]);
}

#[test]
fn damaged_exr_never_panics() {
    try_kinds(&["EXR"]);
}

/// An interlaced PNG of a palette of 256 grays.
fn palette() -> Vec<u8> {
    let chunks = [(*b"PLTE", (0..=255).flat_map(|k| [k; 3]).collect()), (*b"gAMA", vec![0, 0, 0xb1, 0x8f])];
    let (size, colour) = ([4 * SIDE, SIDE], png::PALETTE);
    let png = Png { size, depth: 8, colour, interlaced: true, chunks: &chunks };
    png.bytes(|x, y, _| (255.0 * stored(x / SIDE, x % SIDE, y, |v| v)[2]) as u16)
}

#[test]
fn damaged_png_with_right_checksums_never_panics() {
    let signed = |whole: &[u8], random: &mut ChaCha8Rng| {
        let mut bytes = damaged(whole, random);
        sign(&mut bytes);
        bytes
    };
    try_all("PNG of a palette, signed again", &palette(), signed, in_memory, of_picture);
    let eight = encoded(&packed("NDRS", 4, |_, v| v), ImageFormat::Png);
    try_all("PNG of 8 bits, signed again", &eight, signed, in_memory, of_picture);
}

/// Makes the checksum of every chunk of a PNG right, as far as there are chunks.
fn sign(png: &mut [u8]) {
    let mut start = 8;
    while let Some(length) = png.get(start..start + 4) {
        let length = u32::from_be_bytes([length[0], length[1], length[2], length[3]]) as usize;
        let end = start + 8 + length;
        let Some(checksum) = png.get(start + 4..end).map(crc32) else { return };
        let Some(place) = png.get_mut(end..end + 4) else { return };
        place.copy_from_slice(&checksum.to_be_bytes());
        start = end + 4;
    }
}

#[test]
fn damaged_tga_never_panics() {
    // A TGA begins with nothing of its own.
    let strip = packed("NDRS", 4, |_, v| v);
    let of_tga = |error: &Error| match error {
        Error::BadImage { path, .. } => named_damaged(path),
        other => {
            of_picture(other)
                || matches!(
                    other,
                    Error::NotPacked { .. } | Error::NotAMaterial { .. } | Error::MissingMap { .. }
                )
        }
    };
    for (what, tga) in
        [("TGA", encoded(&strip, ImageFormat::Tga)), ("TGA of runs", tga_of_runs(strip.to_rgb8().as_raw()))]
    {
        try_all(what, &tga, damaged, |bytes| read_bytes("damaged.tga", bytes, &STRIP), of_tga);
    }
}

/// A TGA whose every pixel is a run of its own, 64 x 16 pixels.
fn tga_of_runs(pixels: &[u8]) -> Vec<u8> {
    let mut file = vec![0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4 * SIDE as u8, 0, SIDE as u8, 0, 24, 0x20];
    for pixel in pixels.chunks_exact(3) {
        file.push(0x80);
        file.extend(pixel.iter().rev());
    }
    file
}

/// A BMP of 8 bits with a palette of grays, 64 x 16 pixels.
fn palette_bmp() -> Vec<u8> {
    const HEAD: u32 = 14 + 40 + 4 * 256;
    let [width, height] = [4 * SIDE as u32, SIDE as u32];
    let mut file = b"BM".to_vec();
    let word = |file: &mut Vec<u8>, word: u32| file.extend(word.to_le_bytes());
    [HEAD + width * height, 0, HEAD, 40, width, height, 1 | 8 << 16, 0, width * height, 0, 0, 256, 0]
        .into_iter()
        .for_each(|n| word(&mut file, n));
    (0..256).for_each(|gray| word(&mut file, gray * 0x01_0101));
    file.extend((0..width * height).map(|i| (i * 7) as u8));
    file
}
