//! What a loss is computed on.

use std::time::{Duration, Instant};

use svbrdf::error::Error;
use svbrdf::loss::{Loss, losses_f32};
use svbrdf::material::Material;
use svbrdf::model::convention::Convention;
use svbrdf::model::scene::Scene;
use svbrdf::progress::Progress;

use super::bar::watched;
use super::exit::tell;

/// A shorter job is not worth starting an adapter for, which takes about as long.
const SHORT: Duration = Duration::from_millis(100);
/// A measurement this long is not repeated with more scenes.
const LONG: Duration = Duration::from_millis(500);

/// What the user asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Choice {
    /// The processor: the same digits as the window
    #[default]
    Cpu,
    /// The graphics adapter: the same to about 6 digits, faster for many scenes of large maps on a fast adapter
    Gpu,
    /// Measures both on scenes of the job, and takes the faster
    Auto,
}

/// A loss to compute, except over which scenes.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a, T> {
    pub ground_truth: &'a Material<T>,
    pub predictions: &'a [&'a Material<T>],
    pub convention: &'a Convention,
}

/// The losses of `job` over `scenes`, and the name of what computed them.
///
/// # Errors
/// Those of the loss, and [`Error::NoAdapter`] where the GPU is asked for and there is none.
pub fn losses(
    choice: Choice,
    job: &Job<'_, f32>,
    scenes: &[Scene],
) -> Result<(Vec<Loss>, &'static str), Error> {
    let gpu = match choice {
        Choice::Cpu => None,
        Choice::Gpu => Some(Adapter::start()?),
        Choice::Auto => {
            let (gpu, why) = faster(job, scenes)?;
            tell(&format!("note: computed on the {}: {why}", if gpu.is_some() { "GPU" } else { "CPU" }));
            gpu
        }
    };
    watched("rendering", |progress| match gpu {
        None => Ok((job.on_cpu(scenes, progress)?, "cpu")),
        Some(gpu) => Ok((gpu.losses(job, scenes, progress)?, "gpu")),
    })
}

impl Job<'_, f32> {
    fn on_cpu(&self, scenes: &[Scene], progress: &Progress) -> Result<Vec<Loss>, Error> {
        losses_f32(self.ground_truth, self.predictions, scenes, self.convention, progress)
    }
}

/// The adapter, if it is the faster for this job, and why or why not.
fn faster(job: &Job<'_, f32>, scenes: &[Scene]) -> Result<(Option<Adapter>, String), Error> {
    let unseen = Progress::default();
    let on_cpu = predict(scenes.len(), LONG, timed(|n| job.on_cpu(&scenes[..n], &unseen)))?;
    if on_cpu < SHORT {
        return Ok((None, format!("about {on_cpu:.1?}, less than starting an adapter takes")));
    }
    let gpu = match Adapter::start() {
        Ok(gpu) => gpu,
        Err(problem) => return Ok((None, problem.to_string())),
    };
    // What takes longer than the whole job on the CPU is not measured further.
    let long = LONG.min(on_cpu);
    match predict(scenes.len(), long, timed(|n| gpu.losses(job, &scenes[..n], &unseen))) {
        Ok(on_gpu) => {
            let why = format!("measured, about {on_cpu:.1?} on the CPU and {on_gpu:.1?} on {}", gpu.name());
            Ok(((on_gpu < on_cpu).then_some(gpu), why))
        }
        Err(problem) => Ok((None, problem.to_string())),
    }
}

/// How long `work` takes for a number of scenes.
fn timed<R>(work: impl Fn(usize) -> Result<R, Error>) -> impl FnMut(usize) -> Result<Duration, Error> {
    move |scenes| {
        let start = Instant::now();
        work(scenes).map(|_| start.elapsed())
    }
}

/// How long all `scenes` take, from `measured` times of the first ones: a part that does not depend on their number,
/// such as sending maps, and a part that is proportional to it. Measurements end where one is `long`.
fn predict(
    scenes: usize,
    long: Duration,
    mut measured: impl FnMut(usize) -> Result<Duration, Error>,
) -> Result<Duration, Error> {
    // The first run also wakes threads and compiles shaders.
    measured(1)?;
    let one = measured(1)?;
    let (mut count, mut last) = (1, one);
    while count < scenes && last < long && last < 4 * one {
        count = scenes.min(2 * count);
        last = measured(count)?;
    }
    let each = if count == 1 { one } else { last.saturating_sub(one).div_f64((count - 1) as f64) };
    Ok(last + each.mul_f64((scenes - count) as f64))
}

/// A graphics adapter that is ready to compute losses.
#[cfg(feature = "gpu")]
pub struct Adapter {
    gpu: svbrdf::gpu::Gpu,
    losses: svbrdf::gpu::Losses,
}

#[cfg(feature = "gpu")]
impl Adapter {
    pub fn start() -> Result<Self, Error> {
        let gpu = svbrdf::gpu::Gpu::headless()?;
        Ok(Self { losses: svbrdf::gpu::Losses::new(&gpu)?, gpu })
    }

    pub fn name(&self) -> &str {
        &self.gpu.report.name
    }

    pub fn losses(
        &self,
        job: &Job<'_, f32>,
        scenes: &[Scene],
        progress: &Progress,
    ) -> Result<Vec<Loss>, Error> {
        let Job { ground_truth, predictions, convention } = job;
        self.losses.compute(&self.gpu, ground_truth, predictions, scenes, convention, progress)
    }
}

/// There is none: this program was built without the GPU layer.
#[cfg(not(feature = "gpu"))]
pub enum Adapter {}

#[cfg(not(feature = "gpu"))]
impl Adapter {
    pub fn start() -> Result<Self, Error> {
        Err(Error::NoAdapter {
            problem: "this svbrdf was built without the feature `gpu`".to_owned(),
            remedy: "leave out --backend, or build it with the feature",
        })
    }

    pub fn name(&self) -> &str {
        match *self {}
    }

    pub fn losses(&self, _: &Job<'_, f32>, _: &[Scene], _: &Progress) -> Result<Vec<Loss>, Error> {
        match *self {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);

    /// What is predicted, and the largest number of scenes that was measured.
    fn predicted(scenes: usize, fixed: Duration, each: Duration) -> (Duration, usize) {
        let mut most = 0;
        let time = predict(scenes, 500 * MS, |n| {
            most = most.max(n);
            Ok(fixed + each * n as u32)
        });
        (time.unwrap(), most)
    }

    #[test]
    fn what_is_done_once_is_counted_once() {
        let (time, most) = predicted(100_000, 20 * MS, MS / 100);
        assert_eq!(time, 1020 * MS);
        assert!((4096..=8192).contains(&most), "{most}");
    }

    #[test]
    fn proportional_work_is_measured_on_a_few_scenes() {
        assert_eq!(predicted(9, Duration::ZERO, 30 * MS), (270 * MS, 4));
    }

    #[test]
    fn no_more_is_measured_than_there_is_to_do_or_than_is_long() {
        assert_eq!(predicted(1, 5 * MS, MS), (6 * MS, 1));
        assert_eq!(predicted(3, 5 * MS, MS), (8 * MS, 3));
        assert_eq!(predicted(9, Duration::ZERO, 600 * MS), (5400 * MS, 1));
    }
}
