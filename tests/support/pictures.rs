//! Materials in every format that opens, written by the tests.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds,
    Layer, LayerAttributes, Text, WritableImage, f16,
};
use image::{DynamicImage, ImageFormat, RgbImage};
use smallvec::SmallVec;

/// Side of the maps.
pub const SIDE: usize = 16;

/// A bumpy material: normal (unit, y up), diffuse, roughness as gray, specular, linear, at a texel.
pub fn texel(map: usize, x: usize, y: usize) -> [f64; 3] {
    let (u, v) = (x as f64 / SIDE as f64, y as f64 / SIDE as f64);
    match map {
        0 => {
            // Height is sin(6 u) sin(5 v); v points down, y up.
            let slope = [0.5 * (6.0 * u).cos() * (5.0 * v).sin(), -0.5 * (6.0 * u).sin() * (5.0 * v).cos()];
            let length = (slope[0] * slope[0] + slope[1] * slope[1] + 1.0).sqrt();
            [-slope[0] / length, -slope[1] / length, 1.0 / length]
        }
        1 => [0.1 + 0.5 * u, 0.3, 0.2 * v],
        2 => [0.2 + 0.6 * v; 3],
        _ => [0.04, 0.04 + 0.1 * u, 0.04],
    }
}

/// The gamma 2.2 of `value`.
pub fn gamma(value: f64) -> f64 {
    value.powf(1.0 / 2.2)
}

/// sRGB of `value`.
pub fn srgb(value: f64) -> f64 {
    if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
}

/// Map number `map` in [0, 1]: normals as (n + 1) / 2, all else through `encode`.
pub fn stored(map: usize, x: usize, y: usize, encode: impl Fn(f64) -> f64) -> [f64; 3] {
    let value = texel(map, x, y);
    if map == 0 { value.map(|n| 0.5 * n + 0.5) } else { value.map(encode) }
}

/// A picture in 8 bits.
pub fn picture(width: usize, height: usize, at: impl Fn(usize, usize) -> [f64; 3]) -> DynamicImage {
    RgbImage::from_fn(width as u32, height as u32, |x, y| {
        at(x as usize, y as usize).map(|v| (255.0 * v).round() as u8).into()
    })
    .into()
}

/// A packed picture of `columns` tiles a row, of the maps whose letters are in `order`, each encoded by `encode`.
///
/// N, D, R and S are the maps, I is a photo.
pub fn packed(order: &str, columns: usize, encode: impl Fn(char, f64) -> f64) -> DynamicImage {
    let letters: Vec<char> = order.chars().collect();
    picture(columns * SIDE, letters.len() / columns * SIDE, |x, y| {
        let letter = letters[y / SIDE * columns + x / SIDE];
        match "NDRS".find(letter) {
            Some(map) => stored(map, x % SIDE, y % SIDE, |v| encode(letter, v)),
            None => [0.9, 0.1, 0.3],
        }
    })
}

pub fn write(folder: &Path, name: &str, image: &DynamicImage, format: ImageFormat) -> PathBuf {
    let path = folder.join(name);
    image.save_with_format(&path, format).unwrap();
    path
}

/// The plane of channel `channel` of map number `map`, as floats.
pub fn plane(map: usize, channel: usize) -> Vec<f32> {
    (0..SIDE * SIDE).map(|i| texel(map, i % SIDE, i / SIDE)[channel] as f32).collect()
}

/// A channel of this name.
pub fn channel(name: &str, samples: FlatSamples) -> AnyChannel<FlatSamples> {
    AnyChannel::new(Text::new_or_none(name).unwrap(), samples)
}

fn half(values: Vec<f32>) -> FlatSamples {
    FlatSamples::F16(values.into_iter().map(f16::from_f32).collect())
}

/// The channels of the layers of map number `map`: signed normals, one channel of roughness.
fn channels(map: usize, prefix: &str) -> Vec<AnyChannel<FlatSamples>> {
    let names: &[&str] = match map {
        0 => &["X", "Y", "Z"],
        2 => &["Y"],
        _ => &["R", "G", "B"],
    };
    names.iter().enumerate().map(|(c, n)| channel(&format!("{prefix}{n}"), half(plane(map, c)))).collect()
}

/// One EXR of the given parts: (name, channels).
pub fn exr(path: &Path, parts: Vec<(Option<&str>, Vec<AnyChannel<FlatSamples>>)>) {
    exr_of(path, ImageAttributes::new(IntegerBounds::from_dimensions((SIDE, SIDE))), parts);
}

/// As [`exr`], with a display window, primaries and the like of its own.
pub fn exr_of(
    path: &Path,
    attributes: ImageAttributes,
    parts: Vec<(Option<&str>, Vec<AnyChannel<FlatSamples>>)>,
) {
    let layers: SmallVec<[Layer<AnyChannels<FlatSamples>>; 2]> = parts
        .into_iter()
        .map(|(name, channels)| {
            let attributes = LayerAttributes {
                layer_name: name.and_then(Text::new_or_none),
                ..LayerAttributes::default()
            };
            let channels = AnyChannels::sort(channels.into_iter().collect());
            Layer::new((SIDE, SIDE), attributes, Encoding::FAST_LOSSLESS, channels)
        })
        .collect();
    Image::from_layers(attributes, layers).write().to_file(path).unwrap();
}

const NAMES: [&str; 4] = ["normal", "diffuse", "roughness", "specular"];

/// A material in one part with layers, with or without a preview.
pub fn layered(path: &Path, preview: bool) {
    let mut all: Vec<_> = (0..4).flat_map(|map| channels(map, &format!("{}.", NAMES[map]))).collect();
    if preview {
        all.extend(channels(1, ""));
    }
    exr(path, vec![(None, all)]);
}

/// A material in one part with layers, two of them of no use here.
pub fn layered_with_more(path: &Path) {
    let mut all: Vec<_> = (0..4).flat_map(|map| channels(map, &format!("{}.", NAMES[map]))).collect();
    all.extend(["opacity", "height"].into_iter().flat_map(|name| channels(2, &format!("{name}."))));
    exr(path, vec![(None, all)]);
}

/// A material in one part with layers, four times as wide and high, compressed in one of the ways of EXR.
pub fn compressed(path: &Path, compression: Compression) {
    const SCALE: usize = 4;
    let side = SCALE * SIDE;
    let names = [["X", "Y", "Z"], ["R", "G", "B"], ["R", "G", "B"], ["R", "G", "B"]];
    let channels = (0..4).flat_map(|map| (0..3).map(move |c| (map, c))).map(|(map, c)| {
        let value = |i: usize| texel(map, i % side / SCALE, i / side / SCALE)[c] as f32;
        channel(&format!("{}.{}", NAMES[map], names[map][c]), half((0..side * side).map(value).collect()))
    });
    let encoding = Encoding { compression, ..Encoding::SMALL_LOSSLESS };
    let channels = AnyChannels::sort(channels.collect());
    let layer = Layer::new((side, side), LayerAttributes::default(), encoding, channels);
    Image::from_layer(layer).write().to_file(path).unwrap();
}

/// A material in one part for each map.
pub fn multi_part(path: &Path) {
    exr(path, (0..4).map(|map| (Some(NAMES[map]), channels(map, ""))).collect());
}

/// One map as an EXR: a single channel named `Y` or R, G and B, in 32-bit floats.
pub fn map_exr(path: &Path, map: usize, damage: impl Fn(usize, f32) -> f32) {
    let names: &[&str] = if map == 2 { &["Y"] } else { &["R", "G", "B"] };
    let values = |c| plane(map, c).into_iter().enumerate().map(|(i, v)| damage(i, v)).collect();
    exr(
        path,
        vec![(
            None,
            names.iter().enumerate().map(|(c, n)| channel(n, FlatSamples::F32(values(c)))).collect(),
        )],
    );
}

/// A picture as an EXR of 32-bit floats.
pub fn rgb_exr(path: &Path, image: &image::Rgb32FImage) {
    let plane = |c: usize| FlatSamples::F32(image.pixels().map(|rgb| rgb.0[c]).collect());
    exr(path, vec![(None, ["R", "G", "B"].iter().enumerate().map(|(c, n)| channel(n, plane(c))).collect())]);
}

/// An npy array of this shape, by the definition of the format: version 1, low bytes first.
pub fn npy(shape: impl AsRef<[u64]>, values: &[f32]) -> Vec<u8> {
    let sides: String = shape.as_ref().iter().map(|side| format!("{side},")).collect();
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({sides}), }}");
    // As NumPy does, spaces up to a multiple of 64 bytes.
    let header = format!("{header:117}\n");
    let length = u16::try_from(header.len()).unwrap().to_le_bytes();
    let values = values.iter().flat_map(|value| value.to_le_bytes());
    b"\x93NUMPY\x01\x00".iter().copied().chain(length).chain(header.into_bytes()).chain(values).collect()
}

/// A material as an npz of named arrays.
pub fn npz(path: &Path) {
    let mut zip = zip::ZipWriter::new(File::create(path).unwrap());
    for (map, name) in NAMES.iter().enumerate() {
        let values: Vec<f32> =
            (0..SIDE * SIDE).flat_map(|i| texel(map, i % SIDE, i / SIDE).map(|v| v as f32)).collect();
        zip.start_file(format!("{name}.npy"), zip::write::SimpleFileOptions::default()).unwrap();
        zip.write_all(&npy([SIDE as u64, SIDE as u64, 3], &values)).unwrap();
    }
    zip.finish().unwrap();
}

/// A material in one part whose data begin `at` (column, row) of the display window, which is `display` wide and high.
pub fn windowed(path: &Path, at: (i32, i32), display: usize) {
    let channels = (0..4).flat_map(|map| channels(map, &format!("{}.", NAMES[map])));
    let attributes = LayerAttributes { layer_position: at.into(), ..LayerAttributes::default() };
    let channels = AnyChannels::sort(channels.collect());
    let layer = Layer::new((SIDE, SIDE), attributes, Encoding::FAST_LOSSLESS, channels);
    let layers: SmallVec<[Layer<AnyChannels<FlatSamples>>; 2]> = [layer].into_iter().collect();
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions((display, display)));
    Image::from_layers(attributes, layers).write().to_file(path).unwrap();
}
