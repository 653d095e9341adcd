//! Image files that the tests write themselves.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use image::{DynamicImage, ImageFormat, RgbImage};

use svbrdf_files::read::{Albedo, NormalY, ReadOptions, Roughness};

/// Width and height of the maps of the fixtures.
pub const SIDE: u32 = 4;

/// The four maps, in the order of packed strips, with the words that name their files here.
pub const MAPS: [&str; 4] = ["normals", "diffuse", "roughness", "specular"];

/// The bytes of map number `map` of [`MAPS`] in column `x` of row `y`: no two texels and no two maps are alike.
pub fn bytes_at(map: usize, x: u32, y: u32) -> [u8; 3] {
    let (x, y) = (x as u8, y as u8);
    match map {
        0 => [120 + 7 * x, 110 + 9 * y, 240 + x],
        1 => [10 + x, 90 + 3 * y, 100 + x + y],
        2 => [40 + x + 4 * y; 3],
        _ => [5 + y, 60 + x, 3 * x + 17 * y],
    }
}

/// Map number `map` of [`MAPS`] in 8-bit RGB.
pub fn map(map: usize) -> DynamicImage {
    RgbImage::from_fn(SIDE, SIDE, |x, y| bytes_at(map, x, y).into()).into()
}

/// The packed strip of the four maps behind `photos` photos.
pub fn strip(photos: u32) -> DynamicImage {
    let pixel = |x: u32, y| match (x / SIDE).checked_sub(photos) {
        Some(map) => bytes_at(map as usize, x % SIDE, y).into(),
        None => [251, 1, 252].into(),
    };
    RgbImage::from_fn((photos + 4) * SIDE, SIDE, pixel).into()
}

/// The maps as they are stored: nothing is left to be found out.
pub const LINEAR: ReadOptions = ReadOptions {
    albedo: Some(Albedo::Linear),
    normal_y: Some(NormalY::Up),
    roughness: Some(Roughness::R),
    ..ReadOptions::AUTO
};

/// An image of one colour.
pub fn flat(width: u32, height: u32, rgb: [u8; 3]) -> DynamicImage {
    RgbImage::from_pixel(width, height, rgb.into()).into()
}

/// Writes `image` as PNG; returns where it is.
pub fn save(folder: &Path, name: &str, image: &DynamicImage) -> PathBuf {
    let path = folder.join(name);
    image.save_with_format(&path, ImageFormat::Png).unwrap();
    path
}

/// Writes the four maps as `{prefix}normals.png` and so on.
pub fn save_maps(folder: &Path, prefix: &str) {
    for (i, name) in MAPS.iter().enumerate() {
        save(folder, &format!("{prefix}{name}.png"), &map(i));
    }
}

/// `image` as the bytes of a PNG file.
pub fn png_bytes(image: &DynamicImage) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}
