//! Files of photographs: transfer curves, clipping, orientation, layers.

use std::fs;
use std::path::Path;

use exr::prelude::{AnyChannel, FlatSamples};
use image::{Rgb, RgbImage};
use tempfile::tempdir;

use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_files::photograph::Corners;
use svbrdf_files::read::{PhotographOptions, Transfer, read_photograph};

use super::{SCENE, compared, rectified, small};
use crate::support::pictures::{SIDE, exr as write_exr, npy, srgb};
use crate::support::png::{Png, RGB};

const AUTO: PhotographOptions = PhotographOptions { transfer: None, clip: None, light_colour: None };
const LINEAR: PhotographOptions = PhotographOptions { transfer: Some(Transfer::Linear), ..AUTO };

/// An 8-bit sRGB photograph of `material` of a half exposure.
fn save(path: &Path, factor: f32) -> Vec<[f32; 3]> {
    let [truth, ..] = small();
    let pixels = render_f32(&truth, &SCENE, &PRINTED, &Progress::default()).unwrap().pixels;
    let code = |value: f32| (255.0 * srgb(f64::from(value / factor).min(1.0))).round() as u8;
    RgbImage::from_fn(64, 64, |x, y| Rgb(pixels[(y * 64 + x) as usize].map(code))).save(path).unwrap();
    pixels
}

#[test]
fn an_8_bit_srgb_photograph_agrees_within_its_quantization() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("photo.png");
    let [truth, _, rough] = small();
    let pixels = save(&path, 2.0);
    let photograph = read_photograph(&path, &AUTO).unwrap();
    assert_eq!((photograph.transfer, photograph.transfer_from), (Transfer::Srgb, "since it stores integers"));
    let rectified = rectified(&photograph, &Corners::whole([64, 64]), &truth);
    let right = compared(&rectified, &truth);
    assert!((right.factor / 2.0 - 1.0).abs() < 5e-3, "{}", right.factor);
    // No sample is off by more than half a code, and what the factor is off by.
    let code = |value: f32| 255.0 * srgb(f64::from(value));
    for (g, p) in right.photograph.pixels.iter().zip(&pixels).filter(|(g, _)| !g[0].is_nan()) {
        for (g, p) in g.iter().zip(p) {
            let off = (code(*g / right.factor as f32) - code(*p / right.factor as f32)).abs();
            assert!(off < 0.5 + 255.0 * 5e-3 / 2.4, "{g}, {p}: {off}");
        }
    }
    let mean = |of| compared(&rectified, of).statistics(Difference::Log).unwrap().mean;
    assert!(mean(&truth) < 0.01 && mean(&rough) > 3.0 * mean(&truth), "{}, {}", mean(&truth), mean(&rough));

    // A planted fault: the wrong curve.
    let wrong = read_photograph(&path, &LINEAR).unwrap();
    assert_eq!((wrong.transfer, wrong.transfer_from), (Transfer::Linear, "as specified"));
    let wrong = super::rectified(&wrong, &Corners::whole([64, 64]), &truth);
    assert!(compared(&wrong, &truth).statistics(Difference::Log).unwrap().mean > 0.1);
}

#[test]
fn clipped_pixels_are_those_at_the_largest_integer_or_at_the_limit() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("photo.png");
    save(&path, 0.4);
    let stored = image::open(&path).unwrap().into_rgb8();
    let at = |least: u8| stored.pixels().filter(|pixel| pixel.0.iter().any(|c| *c >= least)).count();
    let clipped = |clip| {
        let photograph = read_photograph(&path, &PhotographOptions { clip, ..AUTO }).unwrap();
        photograph.clipped.iter().filter(|clipped| **clipped).count()
    };
    assert!(at(255) > 50 && at(230) > at(255), "{} and {}", at(255), at(230));
    assert_eq!(clipped(None), at(255));
    assert_eq!(clipped(Some(230.0 / 255.0)), at(230));
    assert_eq!(clipped(Some(2.0)), 0);
}

/// A picture of 3 x 2 pixels.
fn three_by_two(depth: u8, chunks: &[([u8; 4], Vec<u8>)]) -> Vec<u8> {
    Png { size: [3, 2], depth, colour: RGB, interlaced: false, chunks }
        .bytes(|x, y, c| (10 * (x + 3 * y) + c) as u16)
}

#[test]
fn the_curve_is_that_of_the_option_of_the_file_or_of_the_kind_of_samples() {
    let folder = tempdir().unwrap();
    let of = |name: &str, bytes: &[u8], options: &PhotographOptions| {
        fs::write(folder.path().join(name), bytes).unwrap();
        let photograph = read_photograph(&folder.path().join(name), options).unwrap();
        (photograph.transfer, photograph.transfer_from, photograph.notes.len())
    };
    let gamma = [(*b"gAMA", 100_000_u32.to_be_bytes().to_vec())];
    let srgb = PhotographOptions { transfer: Some(Transfer::Srgb), ..AUTO };
    let (integers, specified) = ("since it stores integers", "as specified");
    assert_eq!(of("8.png", &three_by_two(8, &[]), &AUTO), (Transfer::Srgb, integers, 0));
    assert_eq!(of("16.png", &three_by_two(16, &[]), &AUTO), (Transfer::Srgb, integers, 0));
    let declared = of("g.png", &three_by_two(16, &gamma), &AUTO);
    assert_eq!(declared, (Transfer::Linear, "declared by its gAMA chunk", 0));
    // What the option overrides is said.
    assert_eq!(of("g.png", &three_by_two(16, &gamma), &srgb), (Transfer::Srgb, specified, 1));
    let floats = npy([2, 3, 3], &[0.25; 18]);
    assert_eq!(of("f.npy", &floats, &AUTO), (Transfer::Linear, "since it stores floats", 0));
    assert_eq!(of("f.npy", &floats, &srgb), (Transfer::Srgb, specified, 0));
}

#[test]
fn a_photograph_is_turned_as_its_exif_orientation_says() {
    let folder = tempdir().unwrap();
    // Orientation 6: row 0 is the right side.
    let exif = b"MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0".to_vec();
    let path = folder.path().join("turned.png");
    fs::write(&path, three_by_two(8, &[(*b"eXIf", exif)])).unwrap();
    let photograph = read_photograph(&path, &LINEAR).unwrap();
    assert_eq!((photograph.size(), photograph.notes.len()), ([2, 3], 0));
    let red: Vec<u32> = photograph.image.pixels.iter().map(|rgb| (255.0 * rgb[0]).round() as u32).collect();
    assert_eq!(red, [30, 0, 40, 10, 50, 20]);
}

#[test]
fn samples_that_are_not_finite_are_clipped_and_gray_stands_for_all_channels() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("gray.npy");
    fs::write(&path, npy([1, 4, 1], &[0.5, f32::NAN, 7.0, f32::INFINITY])).unwrap();
    let photograph = read_photograph(&path, &AUTO).unwrap();
    assert_eq!(photograph.clipped, [false, true, false, true]);
    assert_eq!(photograph.image.pixels, [[0.5; 3], [0.0; 3], [7.0; 3], [0.0; 3]]);
}

#[test]
fn what_is_no_photograph_is_refused_with_its_reason() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("text.png"), "not an image").unwrap();
    let channel = |name: &str| AnyChannel::new(name, FlatSamples::F32(vec![0.5; SIDE * SIDE]));
    write_exr(&at("layers.exr"), vec![(None, vec![channel("beauty.Y"), channel("depth.Y")])]);
    write_exr(&at("xy.exr"), vec![(None, vec![channel("X"), channel("Y")])]);
    write_exr(&at("unnamed.exr"), vec![(None, vec![channel("Y"), channel("depth.Y")])]);
    assert_eq!(read_photograph(&at("unnamed.exr"), &AUTO).unwrap().size(), [SIDE; 2]);
    for (name, words) in [
        ("text.png", "photograph: expected PNG"),
        ("absent.png", "cannot read"),
        ("xy.exr", "photograph: expected gray or RGB, found 2 channels; convert it to RGB"),
        ("layers.exr", "photograph: expected one picture, found the layers beauty, depth; save the layer"),
    ] {
        let refusal = read_photograph(&at(name), &AUTO).unwrap_err().to_string();
        assert!(refusal.contains(words) && refusal.contains(name), "{name}: {refusal}");
    }
}
