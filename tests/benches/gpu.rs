//! The graphics adapter: sending a material, shading it, and showing it. Every answer is asserted.
//!
//! A shaded or shown picture is waited for, not read back.

#![allow(clippy::expect_used, clippy::panic, reason = "a benchmark may panic")]

#[allow(dead_code, reason = "benchmarks use a part of what the tests share")]
#[path = "../support/gpu.rs"]
mod support;

use divan::counter::ItemsCount;

use svbrdf_core::material::{Grid, Material};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render;
use svbrdf_gpu::{Encoding, Gpu, MaterialTextures, ShadeParams, Shaded, Shading};

const SIDES: [usize; 3] = [256, 1024, 2048];
/// Materials of a side, as floats or as codes.
const MATERIALS: [(usize, Held); 6] = {
    let [a, b, c] = SIDES;
    [
        (a, Held::Floats),
        (b, Held::Floats),
        (c, Held::Floats),
        (a, Held::Codes),
        (b, Held::Codes),
        (c, Held::Codes),
    ]
};
/// Most that a mean over a picture may be off the CPU's in f32, relative.
const TOLERANCE: f64 = 1e-5;
/// Lit from a corner, seen from above.
const SCENE: Scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.0], light: [0.6, 0.5, 1.0] };

fn main() {
    match support::find_gpu() {
        Ok(gpu) => {
            println!("{}\n", gpu.report);
            divan::main();
        }
        Err(problem) => println!("nothing is measured: {problem}"),
    }
}

/// How an adapter holds a material: its values are many, or as few as those of 8-bit files.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Held {
    Floats,
    Codes,
}

/// A material on the adapter and what it is shaded into.
struct Picture {
    gpu: &'static Gpu,
    material: Material<f32>,
    shading: Shading,
    target: Shaded,
}

impl Picture {
    fn new(side: usize, held: Held) -> Self {
        let gpu = support::gpu();
        let shading = Shading::new(gpu).expect("compiled");
        let target = shading.target(gpu, [side; 2]).expect("created");
        let bumpy = support::bumpy(side, side);
        let material = if held == Held::Codes { support::of_8_bits(&bumpy) } else { bumpy };
        Self { gpu, material, shading, target }
    }

    fn upload(&self) -> MaterialTextures {
        let textures = MaterialTextures::upload(self.gpu, &self.material).expect("sent");
        self.wait();
        textures
    }

    fn shade(&self, textures: &MaterialTextures) {
        let params = ShadeParams { scene: SCENE, convention: PRINTED, quantity: Quantity::Rendering };
        self.shading.draw(self.gpu, textures, &params, &self.target);
        self.wait();
    }

    fn wait(&self) {
        self.gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("done");
    }

    /// Holds what was shaded last against the CPU.
    fn assert_shaded(&self) {
        let got = self.target.read_back(self.gpu).expect("read back");
        let want = render(&self.material, &SCENE, &PRINTED, &Progress::default()).expect("rendered");
        let sum = |pixels: &[[f32; 3]]| pixels.iter().flatten().map(|&x| f64::from(x)).sum::<f64>();
        assert_close(sum(&got.pixels), sum(&want.pixels));
    }
}

fn assert_close(got: f64, want: f64) {
    assert!((got - want).abs() <= TOLERANCE * want, "{got}, not {want}");
}

#[divan::bench(args = MATERIALS, sample_count = 10)]
fn upload(bencher: divan::Bencher<'_, '_>, (side, held): (usize, Held)) {
    let picture = Picture::new(side, held);
    bencher.counter(ItemsCount::new(side * side)).bench_local(|| picture.upload());
    picture.shade(&picture.upload());
    picture.assert_shaded();
}

#[divan::bench(args = MATERIALS, sample_count = 20)]
fn shade(bencher: divan::Bencher<'_, '_>, (side, held): (usize, Held)) {
    let picture = Picture::new(side, held);
    let textures = picture.upload();
    bencher.counter(ItemsCount::new(side * side)).bench_local(|| picture.shade(&textures));
    picture.assert_shaded();
}

#[divan::bench(args = SIDES, sample_count = 20)]
fn display(bencher: divan::Bencher<'_, '_>, side: usize) {
    let picture = Picture::new(side, Held::Floats);
    picture.shade(&picture.upload());
    let (gpu, shaded) = (picture.gpu, &picture.target);
    let params = support::from_above([1.0; 2], Encoding::Radiance);
    let screen = support::Screen::new(gpu, [side as u32; 2], shaded, shaded, &params);
    bencher.counter(ItemsCount::new(side * side)).bench_local(|| {
        screen.draw(gpu);
        picture.wait();
    });
    let shown = screen.read(gpu);
    let radiances = shaded.read_back(gpu).expect("read back").pixels;
    for [column, row] in [[0, 0], [side / 2, side / 3], [side - 1, side - 1]] {
        let want = radiances[row * side + column].map(|x| 255.0 * svbrdf_core::picture::tone::srgb_encode(x));
        let got = shown.at(column, row).map(f32::from);
        assert!(got.iter().zip(want).all(|(got, want)| (got - want).abs() <= 1.0), "{got:?}, not {want:?}");
    }
}

/// As [`display`], of eight texels a pixel along both axes.
#[divan::bench(args = SIDES, sample_count = 20)]
fn display_reduced(bencher: divan::Bencher<'_, '_>, side: usize) {
    let picture = Picture::new(side, Held::Floats);
    picture.shade(&picture.upload());
    let (gpu, shaded) = (picture.gpu, &picture.target);
    let params = support::from_above(Grid { width: side, height: side }.half_extent(), Encoding::Radiance);
    let screen = support::Screen::new(gpu, [side as u32 / 8; 2], shaded, shaded, &params);
    bencher.counter(ItemsCount::new(side * side)).bench_local(|| {
        screen.draw(gpu);
        picture.wait();
    });
    let shown = screen.read(gpu);
    let radiances = shaded.read_back(gpu).expect("read back").pixels;
    let texels = (0..64).map(|index| radiances[index / 8 * side + index % 8]);
    let mean = texels.fold([0.0; 3], |sum, texel| [0, 1, 2].map(|c| sum[c] + texel[c] / 64.0));
    let want = mean.map(|x| 255.0 * svbrdf_core::picture::tone::srgb_encode(x));
    let got = shown.at(0, 0).map(f32::from);
    assert!(got.iter().zip(want).all(|(got, want)| (got - want).abs() <= 1.0), "{got:?}, not {want:?}");
}
