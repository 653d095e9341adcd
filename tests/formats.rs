//! One test for each row of the table in `docs/formats.md`: what opens, and that it is the same material.

mod arrays;
mod conventions;
pub mod decoders;
mod engines;
mod glb;
mod named_sets;
mod normals;
mod options;
mod packed;
mod pictures;
mod png;
mod practice;
mod renderers;
mod sets;
mod sidecar;
mod surfaces;
mod texture_sets;
mod variants;
mod whole_sets;
mod written;

use std::path::{Path, PathBuf};

use image::{DynamicImage, GrayImage, ImageFormat};
use tempfile::tempdir;

use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;
use svbrdf_files::read::{
    Albedo, Certainty, NonFinite, NormalY, Order, Preset, Read, ReadOptions, Roughness, What, read,
};
use svbrdf_files::write::{self, Depth, FileKind, WriteOptions};

use crate::support::pictures::{
    SIDE, gamma, layered, map_exr, multi_part, npy, npz, packed, picture, rgb_exr, srgb, stored, texel,
    windowed, write as save,
};

/// Of 8-bit codes, decoded: half a code of a normal, and of the steepest encoding.
const EIGHT_BITS: f64 = 0.006;
/// Of half floats.
const HALF: f64 = 0.001;

fn open_as(path: &Path, options: &ReadOptions) -> Read<f64> {
    read(path, options, &Progress::default()).unwrap()
}

fn open(path: &Path) -> Read<f64> {
    open_as(path, &ReadOptions::default())
}

fn refusal(path: &Path) -> String {
    read::<f64>(path, &ReadOptions::default(), &Progress::default()).unwrap_err().to_string()
}

fn chosen<T>(read: &Read<T>, what: What) -> &str {
    read.assumptions.iter().find(|a| a.what == what).map_or("", |a| &a.chosen)
}

fn certainty<T>(read: &Read<T>, what: What) -> Option<Certainty> {
    read.assumptions.iter().find(|a| a.what == what).map(|a| a.certainty)
}

/// The worst difference from the material of `texel`.
fn worst(material: &Material<f64>) -> f64 {
    assert_eq!(material.size(), [SIDE; 2]);
    let mut worst = 0.0_f64;
    for index in 0..SIDE * SIDE {
        let [n, d, r, s] = [0, 1, 2, 3].map(|map| texel(map, index % SIDE, index / SIDE));
        let got = material.texel(index);
        let pairs = got.normal.to_array().into_iter().zip(n).chain(got.diffuse.into_iter().zip(d));
        let pairs = pairs.chain(got.specular.into_iter().zip(s)).chain([(got.roughness, r[0])]);
        worst = pairs.map(|(a, b)| (a - b).abs()).fold(worst, f64::max);
    }
    worst
}

#[track_caller]
fn assert_same(read: &Read<f64>, bound: f64) {
    let worst = worst(&read.material);
    assert!(worst <= bound, "off by {worst}; {:#?}", read.assumptions);
}

fn linear(_: char, value: f64) -> f64 {
    value
}

fn colours(letter: char, value: f64) -> f64 {
    if letter == 'R' { value } else { gamma(value) }
}

fn kind(path: &Path, depth: Option<Depth>) -> FileKind {
    FileKind::new(path, &WriteOptions { depth, ..WriteOptions::default() }).unwrap()
}

/// Writes a picture of one value, the same in all channels.
fn gray(folder: &Path, name: &str, value: f64) {
    put(folder, name, |_, _| [value; 3]);
}

/// A folder of pictures of one value each.
fn grays(pictures: &[(&str, f64)]) -> tempfile::TempDir {
    let folder = tempdir().unwrap();
    pictures.iter().for_each(|(name, value)| gray(folder.path(), name, *value));
    folder
}

/// Writes the four maps as EXR files of floats, each value by `of(map, index, value)`.
fn put_exrs(folder: &Path, of: impl Fn(usize, usize, f32) -> f32) {
    for (map, name) in NAMES.iter().enumerate() {
        map_exr(&folder.join(name).with_extension("exr"), map, |i, v| of(map, i, v));
    }
}

/// Writes a picture as `NAME.png`.
fn put(folder: &Path, name: &str, at: impl Fn(usize, usize) -> [f64; 3]) -> PathBuf {
    save(folder, &format!("{name}.png"), &picture(SIDE, SIDE, at), ImageFormat::Png)
}

/// Writes the strip of the maps whose letters are in `order`, linear, as `NAME.png`.
fn put_strip(folder: &Path, name: &str, order: &str) -> PathBuf {
    save(folder, &format!("{name}.png"), &packed(order, 4, linear), ImageFormat::Png)
}

/// The normals as they are stored, with y up.
fn bumps(x: usize, y: usize) -> [f64; 3] {
    stored(0, x, y, |v| v)
}

/// As [`bumps`], with y down.
fn turned(x: usize, y: usize) -> [f64; 3] {
    let [r, g, b] = bumps(x, y);
    [r, 1.0 - g, b]
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < EIGHT_BITS
}

#[track_caller]
fn assert_near<const N: usize>(got: [f64; N], expected: [f64; N]) {
    assert!(got.into_iter().zip(expected).all(|(a, b)| near(a, b)), "{got:?}, not {expected:?}");
}

/// Notes of the reading, one a line.
fn notes<T>(read: &Read<T>) -> String {
    read.messages().collect::<Vec<_>>().join("\n")
}

#[track_caller]
fn assert_notes<T>(read: &Read<T>, parts: &[&str]) {
    for part in parts {
        assert!(notes(read).contains(part), "`{part}` is missing in\n{}", notes(read));
    }
}

#[track_caller]
fn assert_refused(path: &Path, parts: &[&str]) {
    let refused = refusal(path);
    for part in parts {
        assert!(refused.contains(part), "`{part}` is missing in {refused}");
    }
}

/// The names of the maps.
const NAMES: [&str; 4] = ["normal.png", "diffuse.png", "roughness.png", "specular.png"];

/// Writes one PNG a map under `names`, in the order normal, diffuse, roughness, specular.
fn folder_of(names: [&str; 4], folder: &Path, encode: impl Fn(usize, f64) -> f64) {
    for (map, name) in names.into_iter().enumerate() {
        let image = picture(SIDE, SIDE, |x, y| stored(map, x, y, |v| encode(map, v)));
        save(folder, name, &image, ImageFormat::Png);
    }
}
