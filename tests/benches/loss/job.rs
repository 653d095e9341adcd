//! Jobs of the benchmark: scenes, materials and precision of each measured loss.

use std::time::Instant;

use svbrdf_core::loss::{Backend, Comparison, Fused, Plain, Request, Sampling};
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::simd::Level;

/// Largest relative difference of the fused loss from the plain one in f32, whose own error is 1e-7.
pub const TOLERANCE: f64 = 1e-6;
/// The fused loss at the best instruction set.
pub const FUSED: Fused = Fused { level: None };
/// Seconds that each row of a table takes, at least.
const LEAST_SECONDS: f64 = 0.5;

/// Seconds of the fastest of many runs.
pub fn fastest(work: impl Fn()) -> f64 {
    let start = Instant::now();
    let mut best = f64::INFINITY;
    for run in 0.. {
        if run >= 5 && start.elapsed().as_secs_f64() > LEAST_SECONDS {
            break;
        }
        best = best.min(seconds(&work));
    }
    best
}

/// Runs `work` on `threads` threads.
pub fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(work),
        Err(problem) => {
            eprintln!("no {threads} threads: {problem}; measured on the default pool");
            work()
        }
    }
}

/// Two materials and the scenes they are compared in.
pub struct Job {
    pub size: usize,
    pub materials: [Material<f32>; 2],
    near: usize,
    pub scenes: Vec<Scene>,
    expected: f64,
}

impl Job {
    pub fn new(size: usize, near: usize, distant: usize) -> Self {
        let materials = [1, 2].map(|seed| material(seed, size));
        let sampling = Sampling { near, distant, ..Sampling::default() };
        #[expect(clippy::expect_used, reason = "a benchmark may panic")]
        let scenes = sampling.scenes(&PRINTED).expect("there are scenes");
        let mut job = Self { size, materials, near, scenes, expected: 0.0 };
        job.expected = job.plain();
        job
    }

    /// Texels times scenes.
    pub fn pp(&self) -> usize {
        self.size * self.size * self.scenes.len()
    }

    pub fn plain(&self) -> f64 {
        self.loss(&Plain)
    }

    fn fused(&self, level: Level) -> f64 {
        self.loss(&Fused { level: Some(level) })
    }

    pub fn loss(&self, backend: &dyn Backend<f32>) -> f64 {
        loss(backend, self.materials.each_ref(), &Request::Listed(self.scenes.clone()))
    }

    /// Measures and prints one row of the table.
    pub fn row(&self, name: &str, level: Level, bound: f64) {
        let plain = seconds(|| self.assert(self.plain()));
        let mut times = Vec::new();
        let start = Instant::now();
        while start.elapsed().as_secs_f64() < LEAST_SECONDS || times.len() < 5 {
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

    pub fn assert(&self, got: f64) {
        assert!((got - self.expected).abs() <= TOLERANCE * self.expected, "{got}, not {}", self.expected);
    }
}

/// The loss without the interval from a pilot.
#[expect(clippy::expect_used, reason = "a benchmark may panic")]
pub fn loss(backend: &dyn Backend<f32>, materials: [&Material<f32>; 2], request: &Request) -> f64 {
    let [ground_truth, prediction] = materials;
    let comparison = Comparison::new(ground_truth, &[prediction], PRINTED).expect("of one size").on(backend);
    let outcome =
        comparison.without_pilot().run(request, &Progress::default()).expect("the loss can be computed");
    outcome.losses[0].estimate.mean
}

pub fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// A plausible material: normals around +z, roughness in [0.05, 0.9].
#[expect(clippy::expect_used, reason = "a benchmark may panic")]
pub fn material(seed: u32, size: usize) -> Material<f32> {
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
