//! Reading and converting a material beside what its decoders and encoders need: the same files through the same
//! libraries, nothing else done.
//!
//! `cargo bench --no-default-features --bench read -- 256 2048 4096 8192` prints a row for each kind of files and size.
//! Each run is a process of its own, so that memory is touched for the first time as it is by `svbrdf`; runs of both
//! alternate; medians. Processor time is that of all threads. Memory is the peak beyond that of a process that has done
//! nothing, over the 40 bytes a texel of the planes that stay. `READ_BENCH` names another build of this benchmark, which
//! is measured instead.

#![allow(clippy::disallowed_methods, reason = "a benchmark reads its own files")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage, f16,
};
use image::{DynamicImage, GrayImage, ImageFormat, ImageReader, Limits, RgbImage};
use rayon::prelude::*;

use svbrdf_core::progress::Progress;
use svbrdf_files::read::{ReadOptions, read};
use svbrdf_files::write::{self, FileKind, WriteOptions};

/// Seconds that each row takes, at least.
const LEAST_SECONDS: f64 = 3.0;
const FILES: [&str; 4] = ["normal", "diffuse", "roughness", "specular"];
/// Numbers for each channel of a material, in bytes.
const PLANES: f64 = 40.0;

fn main() {
    let said: Vec<String> = std::env::args().skip(1).filter(|text| text != "--bench").collect();
    if let [flag, work, from, to] = said.as_slice()
        && flag == "--child"
    {
        return child(work, Path::new(from), Path::new(to));
    }
    let sizes: Vec<u32> = said.iter().filter_map(|text| text.parse().ok()).collect();
    println!(
        "| files | processor: libraries, ms | svbrdf, ms | ratio | time: libraries, ms | svbrdf, ms | ratio | peak / planes |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for size in if sizes.is_empty() { vec![256, 2048] } else { sizes } {
        rows(size);
    }
}

#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn rows(size: u32) {
    let folder = tempfile::tempdir().expect("a folder");
    let strip = folder.path().join("strip.png");
    RgbImage::from_fn(4 * size, size, |x, y| texel(x / size, x % size, y).into())
        .save_with_format(&strip, ImageFormat::Png)
        .expect("written");
    let set = folder.path().join("set");
    fs::create_dir(&set).expect("a folder");
    for (map, name) in (0..).zip(FILES) {
        let rgb = RgbImage::from_fn(size, size, |x, y| texel(map, x, y).into());
        let picture: DynamicImage = match map {
            2 => GrayImage::from_fn(size, size, |x, y| [rgb.get_pixel(x, y)[0]].into()).into(),
            _ => rgb.into(),
        };
        picture.save_with_format(set.join(name).with_extension("jpg"), ImageFormat::Jpeg).expect("written");
    }
    let [none, out, exr] = ["none", "out", "out.exr"].map(|name| folder.path().join(name));
    row(&format!("reading a packed PNG of {size}^2"), ["decode", "read"], &strip, &none, size);
    row(&format!("reading four JPEG of {size}^2"), ["decode", "read"], &set, &none, size);
    row(&format!("converting four JPEG of {size}^2 to PNG"), ["recode", "convert"], &set, &out, size);
    row(&format!("converting a packed PNG of {size}^2 to EXR"), ["recode", "convert"], &strip, &exr, size);
}

/// What a run took.
#[derive(Clone, Copy)]
struct Run {
    /// Seconds.
    time: f64,
    processor: f64,
    bytes: f64,
}

/// Measures and prints one row.
fn row(what: &str, works: [&str; 2], from: &Path, to: &Path, size: u32) {
    let start = Instant::now();
    let mut runs = [Vec::new(), Vec::new()];
    while start.elapsed().as_secs_f64() < LEAST_SECONDS || runs[0].len() < 3 {
        for (runs, work) in runs.iter_mut().zip(works) {
            runs.push(run(work, from, to));
        }
    }
    let median = |of: fn(&Run) -> f64| {
        runs.each_ref().map(|runs| {
            let mut values: Vec<f64> = runs.iter().map(of).collect();
            values.sort_by(f64::total_cmp);
            values[values.len() / 2]
        })
    };
    let [processor, time, bytes] =
        [median(|run| run.processor), median(|run| run.time), median(|run| run.bytes)];
    let pair = |[a, b]: [f64; 2]| format!("{:.1} | {:.1} | {:.2}", 1e3 * a, 1e3 * b, b / a);
    let texels = f64::from(size) * f64::from(size);
    println!("| {what} | {} | {} | {:.2} |", pair(processor), pair(time), bytes[1] / (PLANES * texels));
}

/// One run in a process of its own.
#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn run(work: &str, from: &Path, to: &Path) -> Run {
    let program = std::env::var_os("READ_BENCH").map(PathBuf::from);
    let program = program.unwrap_or_else(|| std::env::current_exe().expect("this program"));
    let output = Command::new(program).arg("--child").arg(work).args([from, to]).output().expect("a run");
    assert!(output.status.success(), "{work}: {}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout);
    let mut numbers = text.split_whitespace().filter_map(|word| word.parse::<f64>().ok());
    let mut next = || numbers.next().expect("a number");
    let run = Run { time: next(), processor: next(), bytes: next() };
    let _ = fs::remove_file(to).or_else(|_| fs::remove_dir_all(to));
    run
}

#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn child(work: &str, from: &Path, to: &Path) {
    let before = (Instant::now(), processor(), memory("VmRSS:"));
    match work {
        "decode" => files(from).par_iter().for_each(|file| drop(decoded(file))),
        "read" => drop(read::<f32>(from, &ReadOptions::AUTO, &Progress::default()).expect("a material")),
        "recode" => recode(&files(from), to),
        _ => {
            let read = read::<f32>(from, &ReadOptions::AUTO, &Progress::default()).expect("a material");
            let kind = FileKind::new(to, &WriteOptions::default()).expect("a kind");
            write::write(&read.material, to, kind).expect("written");
        }
    }
    let time = before.0.elapsed().as_secs_f64();
    println!("{time} {} {}", processor() - before.1, memory("VmHWM:") - before.2);
}

fn files(path: &Path) -> Vec<PathBuf> {
    if path.is_dir() {
        FILES.map(|name| path.join(name).with_extension("jpg")).to_vec()
    } else {
        vec![path.to_owned()]
    }
}

#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn decoded(file: &Path) -> DynamicImage {
    let mut reader = ImageReader::open(file).expect("a file");
    reader.limits(Limits::no_limits());
    reader.decode().expect("an image")
}

/// Decodes the files and encodes as many samples as a conversion writes: as PNG a file, or as 10 channels of halves.
#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn recode(files: &[PathBuf], to: &Path) {
    let pictures: Vec<RgbImage> = files.par_iter().map(|file| decoded(file).into_rgb8()).collect();
    if to.extension().is_none() {
        fs::create_dir(to).expect("a folder");
        return pictures.par_iter().enumerate().for_each(|(number, picture)| {
            let file = fs::File::create(to.join(format!("{number}.png"))).expect("a file");
            let mut encoder =
                png::Encoder::new(std::io::BufWriter::new(file), picture.width(), picture.height());
            encoder.set_color(png::ColorType::Rgb);
            let mut writer = encoder.write_header().expect("a header");
            writer.write_image_data(picture.as_raw()).expect("written");
        });
    }
    let [strip] = pictures.as_slice() else { return };
    let side = strip.height() as usize;
    let channel = |number: usize| {
        let rows = strip
            .as_raw()
            .chunks_exact(12 * side)
            .flat_map(|row| row[3 * side * (number / 3)..].iter().skip(number % 3).step_by(3).take(side));
        let samples = rows.map(|&code| f16::from_f32(f32::from(code) / 255.0)).collect();
        AnyChannel::new(exr::prelude::Text::new_or_panic(format!("{number}")), FlatSamples::F16(samples))
    };
    let channels = AnyChannels::sort((0..10).map(channel).collect());
    let layer = Layer::new((side, side), LayerAttributes::default(), Encoding::SMALL_LOSSLESS, channels);
    Image::from_layer(layer).write().to_file(to).expect("written");
}

/// Seconds of processor of this process, where the system says so: of the threads that live exactly, of all in ticks.
fn processor() -> f64 {
    let tasks = fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let exactly = |task: fs::DirEntry| {
        let text = fs::read_to_string(task.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse::<f64>().ok()
    };
    let living = 1e-9 * tasks.filter_map(exactly).sum::<f64>();
    let stat = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    let ticks = fields.filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / 100.0;
    living.max(ticks - 0.02)
}

/// Bytes of memory that this process has, by the `key` of its status; 0 where the system does not say it.
fn memory(key: &str) -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(key));
    let number = line.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
    1024.0 * number.unwrap_or(0.0)
}

/// A texel of map number `map`, with as much grain as photographs have.
fn texel(map: u32, x: u32, y: u32) -> [u8; 3] {
    let noise = (x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b)).wrapping_mul(0xc2b2_ae35);
    let [grain, other] = [(noise >> 27) as u8, (noise >> 22) as u8 % 32];
    let slow = (x / 8 + y / 16) as u8 % 64;
    match map {
        0 => [112 + grain, 112 + other, 250],
        1 => [100 + grain + slow, 80 + slow + other, 60 + grain],
        2 => [90 + grain + slow; 3],
        _ => [52 + grain / 4; 3],
    }
}
