//! The rendering loss: the fused kernel beside the plain one, at several sizes, scene counts and instruction sets.
//!
//! First a table with the time per texel-scene ("pp": both materials rendered and compared) and the share of the
//! compute bound, which is measured in the same run; then divan's statistics. Every measured loss is asserted.

use std::hint::black_box;
use std::time::Instant;

use divan::counter::ItemsCount;
use fearless_simd::{Simd, dispatch, prelude::*};
use svbrdf::image::Image;
use svbrdf::loss::{Backend, Comparison, Fused, Plain, Request, Sampling, Texels};
use svbrdf::material::{Material, Planes};
use svbrdf::model::convention::PRINTED;
use svbrdf::model::sampler::Sampler;
use svbrdf::model::scene::Scene;
use svbrdf::progress::Progress;
use svbrdf::render::simd::Level;
use svbrdf::render::{render, render_f32};
use svbrdf::samples;

/// Floating-point operations of a well arranged pp (48 FMA, 35 multiplications, 3 divisions, 3 square roots, ...).
const FLOPS_PER_PP: f64 = 156.0;
/// Most that the fused loss may be off the plain one in f32, whose own error is 1e-7.
const TOLERANCE: f64 = 1e-6;
/// The fused loss at the best instruction set.
const FUSED: Fused = Fused { level: None };
/// Seconds that each row of the table takes, at least.
const PATIENCE: f64 = 0.5;

fn main() {
    let threads = rayon::current_num_threads();
    let bounds = [1, threads].map(|threads| on(threads, bound));
    println!("compute bound: {:.2} ns/pp on 1 thread, {:.2} on {threads}\n", bounds[0], bounds[1]);
    println!("| texels | scenes | threads | level | ms, best | median | ns/pp | of the bound | plain, ms |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for (size, near, distant) in
        [(64, 6, 3), (256, 6, 3), (1024, 6, 3), (256, 1, 0), (256, 0, 1), (256, 64, 32)]
    {
        let job = Job::new(size, near, distant);
        for (threads, bound) in [1, threads].into_iter().zip(bounds) {
            on(threads, || job.row("best", Level::best(), bound));
        }
        if (size, near) == (256, 6) {
            for (name, level) in Level::all() {
                match level {
                    Some(level) => on(1, || job.row(name, level, bounds[0])),
                    None => println!("| {size}^2 | {near} + {distant} | 1 | {name} | not on this machine |"),
                }
            }
        }
    }
    println!();
    on(1, rendering_rows);
    on(threads, rendering_rows);
    loading_row();
    on(threads, sampled_rows);
    sizes(threads);
    println!();
    divan::main();
}

/// Rendering of whole images, which may take no longer per texel than the loss in the same scene.
#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn rendering_rows() {
    let job = Job::new(1024, 6, 3);
    let texels = (job.size * job.size) as f64;
    for (what, scene) in [("near-field", job.scenes[0]), ("distant", job.scenes[6])] {
        let image = |plain: bool| {
            let render = if plain { render::<f32> } else { render_f32 };
            render(&job.materials[0], &scene, &PRINTED, &Progress::default()).expect("a picture")
        };
        let sum = |image: Image<f32>| image.pixels.iter().flatten().map(|x| f64::from(*x)).sum::<f64>();
        let (got, want) = (sum(image(false)), sum(image(true)));
        assert!((got - want).abs() <= TOLERANCE * want, "{got}, not {want}");
        let [gt, prediction] = &job.materials;
        let loss = || loss(&FUSED, [gt, prediction], &Request::Listed(vec![scene]));
        let first = loss();
        let loss = fastest(|| assert_eq!(loss(), first));
        println!(
            "rendering {}^2, {what}, {} threads: {:.2} ns/texel (plain {:.1}; the loss in this scene {:.2})",
            job.size,
            rayon::current_num_threads(),
            1e9 * fastest(|| drop(image(false))) / texels,
            1e9 * fastest(|| drop(image(true))) / texels,
            1e9 * loss / texels,
        );
    }
}

/// Decoding of the three built-in materials, 256 x 256 each.
#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn loading_row() {
    let load = || samples::load::<f32>().expect("built in");
    assert_eq!(load().predictions.len(), 2);
    println!("loading the built-in materials (3 of 256^2): {:.1} ms", 1e3 * fastest(|| drop(load())));
}

/// Losses of many scenes on few texels of their own, whose time should not depend on the size of the maps.
fn sampled_rows() {
    let request = Request::Scenes(Sampling {
        near: 512,
        distant: 256,
        seed: 0,
        sampler: Sampler::Sobol,
        texels: Texels::Sampled(128),
    });
    for size in [256, 1024, 4096] {
        let [gt, prediction] = [1, 2].map(|seed| material(seed, size));
        let loss = || loss(&FUSED, [&gt, &prediction], &request);
        let first = loss();
        println!(
            "512 + 256 scenes, each on 128 texels of its own, of {size}^2, {} threads: {:.2} ms",
            rayon::current_num_threads(),
            1e3 * fastest(|| assert_eq!(loss(), first)),
        );
    }
}

/// Whether time is linear in texels, and memory what the planes need: the most the process had after each size.
fn sizes(threads: usize) {
    println!("\n| texels | ns/pp, {threads} threads | planes, MiB | most memory, MiB |\n|---|---|---|---|");
    for size in [256, 512, 1024, 2048, 4096, 8192] {
        let materials = [1, 2].map(|seed| material(seed, size));
        let [gt, prediction] = &materials;
        let loss = || loss(&FUSED, [gt, prediction], &Request::default());
        let first = loss();
        let best = on(threads, || fastest(|| assert_eq!(loss(), first)));
        let per_pp = 1e9 * best / (size * size * 9) as f64;
        let planes = (2 * 10 * 4 * size * size) >> 20;
        println!(
            "| {size}^2 | {per_pp:.2} | {planes} | {} |",
            most_memory().map_or("?".to_owned(), |m| m.to_string())
        );
    }
}

/// MiB that this process has had at most, where the system says so.
fn most_memory() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse::<usize>().ok().map(|kib| kib >> 10)
}

/// Seconds of the fastest of many runs.
fn fastest(work: impl Fn()) -> f64 {
    let start = Instant::now();
    let mut best = f64::INFINITY;
    for run in 0.. {
        if run >= 5 && start.elapsed().as_secs_f64() > PATIENCE {
            break;
        }
        best = best.min(seconds(&work));
    }
    best
}

/// Runs `work` on `threads` threads.
fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(work),
        Err(problem) => {
            eprintln!("no {threads} threads: {problem}; measured on those there are");
            work()
        }
    }
}

/// Two materials and the scenes they are compared in.
struct Job {
    size: usize,
    materials: [Material<f32>; 2],
    near: usize,
    scenes: Vec<Scene>,
    expected: f64,
}

impl Job {
    fn new(size: usize, near: usize, distant: usize) -> Self {
        let materials = [1, 2].map(|seed| material(seed, size));
        let sampling = Sampling { near, distant, ..Sampling::default() };
        #[expect(clippy::expect_used, reason = "a benchmark may panic")]
        let scenes = sampling.scenes(&PRINTED).expect("there are scenes");
        let mut job = Self { size, materials, near, scenes, expected: 0.0 };
        job.expected = job.plain();
        job
    }

    /// Texels times scenes.
    fn pp(&self) -> usize {
        self.size * self.size * self.scenes.len()
    }

    fn plain(&self) -> f64 {
        self.loss(&Plain)
    }

    fn fused(&self, level: Level) -> f64 {
        self.loss(&Fused { level: Some(level) })
    }

    fn loss(&self, backend: &dyn Backend<f32>) -> f64 {
        loss(backend, self.materials.each_ref(), &Request::Listed(self.scenes.clone()))
    }

    /// Measures and prints one row of the table.
    fn row(&self, name: &str, level: Level, bound: f64) {
        let plain = seconds(|| self.assert(self.plain()));
        let mut times = Vec::new();
        let start = Instant::now();
        while start.elapsed().as_secs_f64() < PATIENCE || times.len() < 5 {
            times.push(seconds(|| self.assert(self.fused(level))));
        }
        times.sort_by(f64::total_cmp);
        let per_pp = times[0] * 1e9 / self.pp() as f64;
        println!(
            "| {}^2 | {} + {} | {} | {name} | {:.3} | {:.3} | {per_pp:.2} | {:.0}% | {:.1} |",
            self.size,
            self.near,
            self.scenes.len() - self.near,
            rayon::current_num_threads(),
            times[0] * 1e3,
            times[times.len() / 2] * 1e3,
            100.0 * bound / per_pp,
            plain * 1e3,
        );
    }

    fn assert(&self, got: f64) {
        assert!((got - self.expected).abs() <= TOLERANCE * self.expected, "{got}, not {}", self.expected);
    }
}

#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn loss(backend: &dyn Backend<f32>, materials: [&Material<f32>; 2], request: &Request) -> f64 {
    let [ground_truth, prediction] = materials;
    let comparison = Comparison::new(ground_truth, &[prediction], PRINTED).expect("of one size").on(backend);
    let outcome = comparison.run(request, &Progress::default()).expect("the loss can be computed");
    outcome.losses[0].estimate.mean
}

fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// A plausible material: normals around +z, roughness in [0.05, 0.9].
#[expect(clippy::expect_used, reason = "a benchmark may panic")]
fn material(seed: u32, size: usize) -> Material<f32> {
    let mut state = seed.wrapping_mul(0x9e37_79b9) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        (state >> 8) as f32 / (1u32 << 24) as f32
    };
    let mut planes = Planes::default();
    let all = planes.normal.iter_mut().chain(&mut planes.diffuse).chain(&mut planes.specular);
    all.chain([&mut planes.roughness]).for_each(|plane| plane.reserve_exact(size * size));
    for _ in 0..size * size {
        planes.normal[0].push(0.6 * next() - 0.3);
        planes.normal[1].push(0.6 * next() - 0.3);
        planes.normal[2].push(1.0);
        for channel in 0..3 {
            planes.diffuse[channel].push(next());
            planes.specular[channel].push(0.5 * next());
        }
        planes.roughness.push(0.05 + 0.85 * next());
    }
    Material::new(format!("material {seed}"), size, size, planes).expect("a material")
}

/// Nanoseconds per pp at the throughput of multiply-adds that this machine shows now on the threads there are.
fn bound() -> f64 {
    let once = || rayon::broadcast(|_| dispatch!(fearless_simd::Level::new(), simd => multiply_add(simd)));
    let flops: usize = once().into_iter().sum();
    FLOPS_PER_PP * 1e9 * fastest(|| drop(black_box(once()))) / flops as f64
}

/// Many independent multiply-adds; says how many operations they are.
#[inline(always)]
fn multiply_add<S: Simd>(simd: S) -> usize {
    const CHAINS: usize = 12;
    const STEPS: usize = 100_000;
    let splat = |x: f32| S::f32s::splat(simd, black_box(x));
    let (factor, term) = (splat(0.5), splat(1.5));
    let mut chains: [S::f32s; CHAINS] = std::array::from_fn(|i| splat(i as f32));
    for _ in 0..STEPS {
        for chain in &mut chains {
            *chain = chain.mul_add(factor, term);
        }
    }
    let sum = chains.into_iter().fold(term, |sum, chain| sum + chain);
    black_box(sum[0]);
    2 * CHAINS * STEPS * S::f32s::LEN
}

#[divan::bench(args = [64, 256, 1024])]
fn fused(bencher: divan::Bencher<'_, '_>, size: usize) {
    let job = Job::new(size, 6, 3);
    bencher.counter(ItemsCount::new(job.pp())).bench_local(|| {
        job.assert(job.loss(&FUSED));
    });
}

#[divan::bench(args = [64, 256], sample_count = 20)]
fn plain(bencher: divan::Bencher<'_, '_>, size: usize) {
    let job = Job::new(size, 6, 3);
    bencher.counter(ItemsCount::new(job.pp())).bench_local(|| job.assert(job.plain()));
}
