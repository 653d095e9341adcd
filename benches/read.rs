//! Reading a material beside what its decoders need: the same files through the same libraries, pixels thrown away.
//!
//! `cargo bench --no-default-features --bench read -- 256 2048` prints a row for a packed PNG and for a set of JPEG
//! files of each size. Runs of both alternate; medians. Processor time is that of all threads.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use image::{GrayImage, ImageFormat, RgbImage};
use rayon::prelude::*;
use svbrdf::files::read::{ReadOptions, read};
use svbrdf::progress::Progress;

/// Seconds of decoding and of reading that each row takes, at least.
const PATIENCE: f64 = 2.0;
const FILES: [&str; 4] = ["normal", "diffuse", "roughness", "specular"];

#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn main() {
    let said: Vec<u32> = std::env::args().filter_map(|text| text.parse().ok()).collect();
    let sizes = if said.is_empty() { vec![256, 2048] } else { said };
    println!(
        "| files | decoders, ms | reading, ms | ratio | processor: decoders, ms | reading, ms | ratio |"
    );
    println!("|---|---|---|---|---|---|---|");
    for size in sizes {
        let folder = tempfile::tempdir().expect("a folder");
        let strip = folder.path().join("strip.png");
        RgbImage::from_fn(4 * size, size, |x, y| texel(x / size, x % size, y).into())
            .save_with_format(&strip, ImageFormat::Png)
            .expect("written");
        row(&format!("packed PNG of {size}^2"), &strip, std::slice::from_ref(&strip));
        let set = folder.path().join("set");
        fs::create_dir(&set).expect("a folder");
        let files = FILES.map(|name| set.join(format!("{name}.jpg")));
        for (map, file) in (0..).zip(&files) {
            let rgb = RgbImage::from_fn(size, size, |x, y| texel(map, x, y).into());
            if map == 2 {
                let gray = GrayImage::from_fn(size, size, |x, y| [rgb.get_pixel(x, y)[0]].into());
                gray.save_with_format(file, ImageFormat::Jpeg).expect("written");
            } else {
                rgb.save_with_format(file, ImageFormat::Jpeg).expect("written");
            }
        }
        row(&format!("four JPEG of {size}^2"), &set, &files);
    }
}

/// Measures and prints one row.
fn row(what: &str, path: &Path, files: &[PathBuf]) {
    let start = Instant::now();
    let (mut decoders, mut readings) = (Vec::new(), Vec::new());
    while start.elapsed().as_secs_f64() < 2.0 * PATIENCE || decoders.len() < 3 {
        decoders.push(measured(|| decode(files)));
        readings.push(measured(|| open(path)));
    }
    let [wall, processor] = [0, 1].map(|which| [&decoders, &readings].map(|runs| median(runs, which)));
    println!(
        "| {what} | {:.1} | {:.1} | {:.2} | {:.1} | {:.1} | {:.2} |",
        wall[0],
        wall[1],
        wall[1] / wall[0],
        processor[0],
        processor[1],
        processor[1] / processor[0]
    );
}

#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn decode(files: &[PathBuf]) {
    files.par_iter().for_each(|file| drop(image::open(file).expect("an image")));
}

#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn open(path: &Path) {
    drop(read::<f32>(path, &ReadOptions::AUTO, &Progress::default()).expect("a material"));
}

/// Milliseconds of (time, processor).
fn measured(work: impl Fn()) -> [f64; 2] {
    // Clock ticks are 10 ms: what is short is repeated.
    let start = (Instant::now(), processor());
    let mut runs = 0;
    while runs == 0 || start.0.elapsed().as_secs_f64() < 0.2 {
        work();
        runs += 1;
    }
    let per_run = 1e3 / f64::from(runs);
    [start.0.elapsed().as_secs_f64() * per_run, (processor() - start.1) * per_run]
}

/// Seconds of processor that this process has used, where the system says so.
fn processor() -> f64 {
    let stat = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    fields.filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / 100.0
}

fn median(runs: &[[f64; 2]], which: usize) -> f64 {
    let mut values: Vec<f64> = runs.iter().map(|run| run[which]).collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// A texel of map number `map`, with grain that keeps the files from being small.
fn texel(map: u32, x: u32, y: u32) -> [u8; 3] {
    let grain =
        ((x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b)).wrapping_mul(0xc2b2_ae35) >> 28) as u8;
    let slow = (x / 8 + y / 16) as u8 % 64;
    match map {
        0 => [120 + grain, 122 + slow / 8, 250],
        1 => [100 + grain + slow, 80 + slow, 60 + grain],
        2 => [90 + grain + slow; 3],
        _ => [56 + grain / 4; 3],
    }
}
