//! What a loss is computed on.

use std::time::{Duration, Instant};

use svbrdf::convention::Convention;
use svbrdf::error::Error;
use svbrdf::loss::{Loss, losses_f32};
use svbrdf::material::Material;
use svbrdf::progress::Progress;
use svbrdf::scene::Scene;

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
    let on_cpu = predict(scenes, LONG, |scenes| job.on_cpu(scenes, &Progress::default()))?;
    if on_cpu < SHORT {
        return Ok((None, format!("about {on_cpu:.1?}, less than starting an adapter takes")));
    }
    let gpu = match Adapter::start() {
        Ok(gpu) => gpu,
        Err(problem) => return Ok((None, problem.to_string())),
    };
    // What takes longer than the whole job on the CPU is not measured further.
    match predict(scenes, LONG.min(on_cpu), |scenes| gpu.losses(job, scenes, &Progress::default())) {
        Ok(on_gpu) => {
            let why = format!("about {on_cpu:.1?} on the CPU, {on_gpu:.1?} on {}, as measured", gpu.name());
            Ok(((on_gpu < on_cpu).then_some(gpu), why))
        }
        Err(problem) => Ok((None, problem.to_string())),
    }
}

/// How long `work` takes for all of `scenes`, from measuring it on some: a part that does not depend on their number,
/// such as sending maps, and a part that is proportional to it.
fn predict<R>(
    scenes: &[Scene],
    long: Duration,
    work: impl Fn(&[Scene]) -> Result<R, Error>,
) -> Result<Duration, Error> {
    let timed = |count: usize| {
        let start = Instant::now();
        work(&scenes[..count]).map(|_| start.elapsed())
    };
    // The first run also wakes threads and compiles shaders.
    timed(1)?;
    let one = timed(1)?;
    let (mut count, mut last) = (1, one);
    while count < scenes.len() && last < long && last < 4 * one {
        count = scenes.len().min(2 * count);
        last = timed(count)?;
    }
    let each = if count == 1 { one } else { last.saturating_sub(one) / (count - 1) as u32 };
    Ok(last + each.mul_f64((scenes.len() - count) as f64))
}

/// A graphics adapter that is ready to compute losses.
#[cfg(feature = "gpu")]
struct Adapter {
    gpu: svbrdf::gpu::Gpu,
    losses: svbrdf::gpu::Losses,
}

#[cfg(feature = "gpu")]
impl Adapter {
    fn start() -> Result<Self, Error> {
        let gpu = svbrdf::gpu::Gpu::headless()?;
        Ok(Self { losses: svbrdf::gpu::Losses::new(&gpu)?, gpu })
    }

    fn name(&self) -> &str {
        &self.gpu.report.name
    }

    fn losses(&self, job: &Job<'_, f32>, scenes: &[Scene], progress: &Progress) -> Result<Vec<Loss>, Error> {
        let Job { ground_truth, predictions, convention } = job;
        self.losses.compute(&self.gpu, ground_truth, predictions, scenes, convention, progress)
    }
}

/// There is none: this program was built without the GPU layer.
#[cfg(not(feature = "gpu"))]
enum Adapter {}

#[cfg(not(feature = "gpu"))]
impl Adapter {
    fn start() -> Result<Self, Error> {
        Err(Error::NoAdapter {
            problem: "this program was built without its GPU layer".to_owned(),
            remedy: "build it with `--features gpu`, or use `--backend cpu`",
        })
    }

    fn name(&self) -> &str {
        match *self {}
    }

    fn losses(&self, _: &Job<'_, f32>, _: &[Scene], _: &Progress) -> Result<Vec<Loss>, Error> {
        match *self {}
    }
}
