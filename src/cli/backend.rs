//! The device that computes a loss.

use std::time::{Duration, Instant};

use svbrdf::error::Error;
use svbrdf::loss::{Backend, Comparison, Outcome, Request, Sampling, Texels};
use svbrdf::model::scene::Scene;
use svbrdf::progress::Progress;
use svbrdf::report::LossReport;

use super::bar::watched;
use super::exit::tell;

/// Starting an adapter takes about this long: shorter losses stay on the CPU.
const SHORT: Duration = Duration::from_millis(100);
/// Measurements end with one that takes this long.
const LONG: Duration = Duration::from_millis(500);

/// The requested device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum DeviceChoice {
    /// The CPU, which the window uses, too
    #[default]
    Cpu,
    /// The graphics adapter: equal to about 6 digits; faster for many scenes and large maps on a fast adapter
    Gpu,
    /// Measures both on a few scenes and uses the faster one
    Auto,
}

/// The report of `request`, computed on the chosen backend.
///
/// # Errors
/// Those of the loss, and [`Error::NoAdapter`] where the GPU is asked for and there is none.
pub fn run(
    choice: DeviceChoice,
    comparison: Comparison<'_, f32>,
    request: &Request,
) -> Result<LossReport, Error> {
    let gpu = match (choice, on_all_texels(&comparison, request)?) {
        (DeviceChoice::Cpu, _) | (DeviceChoice::Auto, None) => None,
        (DeviceChoice::Gpu, _) => Some(Adapter::start()?),
        (DeviceChoice::Auto, Some(scenes)) => {
            let (gpu, why) = faster(&comparison, &scenes)?;
            tell(&format!("note: computed on the {}: {why}", if gpu.is_some() { "GPU" } else { "CPU" }));
            gpu
        }
    };
    let comparison = match &gpu {
        Some(gpu) => comparison.on(gpu.backend()),
        None => comparison,
    };
    let outcome = watched("rendering", |progress| comparison.run(request, progress))?;
    Ok(LossReport::new(&comparison, request, outcome))
}

/// The scenes of a request that an adapter can compute: a fixed number of scenes on all texels.
fn on_all_texels(comparison: &Comparison<'_, f32>, request: &Request) -> Result<Option<Vec<Scene>>, Error> {
    match request {
        Request::Listed(scenes) => Ok(Some(scenes.clone())),
        Request::Scenes(sampling @ Sampling { texels: Texels::All, .. }) => {
            sampling.scenes(comparison.convention()).map(Some)
        }
        _ => Ok(None),
    }
}

/// The losses over the first `count` of `scenes`.
fn over_first(
    comparison: &Comparison<'_, f32>,
    scenes: &[Scene],
) -> impl Fn(usize) -> Result<Outcome, Error> {
    |count| comparison.run(&Request::Listed(scenes[..count].to_vec()), &Progress::default())
}

/// The adapter, if it is the faster for this comparison, and why or why not.
fn faster(comparison: &Comparison<'_, f32>, scenes: &[Scene]) -> Result<(Option<Adapter>, String), Error> {
    let on_cpu = predict(scenes.len(), LONG, timed(over_first(comparison, scenes)))?;
    if on_cpu < SHORT {
        return Ok((None, format!("about {}, less than starting an adapter takes", milliseconds(on_cpu))));
    }
    let gpu = match Adapter::start() {
        Ok(gpu) => gpu,
        Err(problem) => return Ok((None, problem.to_string())),
    };
    // A measurement that takes longer than the whole loss on the CPU is the last.
    let long = LONG.min(on_cpu);
    let compared = comparison.clone().on(gpu.backend());
    match predict(scenes.len(), long, timed(over_first(&compared, scenes))) {
        Ok(on_gpu) => {
            let [cpu, adapter] = [on_cpu, on_gpu].map(milliseconds);
            let why = format!("measured, about {cpu} on the CPU and {adapter} on {}", gpu.name());
            Ok(((on_gpu < on_cpu).then_some(gpu), why))
        }
        Err(problem) => Ok((None, problem.to_string())),
    }
}

fn milliseconds(time: Duration) -> String {
    format!("{:.1} ms", 1e3 * time.as_secs_f64())
}

/// How long `work` takes for a number of scenes.
fn timed<R>(work: impl Fn(usize) -> Result<R, Error>) -> impl FnMut(usize) -> Result<Duration, Error> {
    move |scenes| {
        let start = Instant::now();
        work(scenes).map(|_| start.elapsed())
    }
}

/// Predicts the time of all `scenes` from `measured` times of the first ones: a constant part, such as the upload of maps, plus
/// a part that is proportional to their number. Measurements end with one that takes at least `long`.
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
pub struct Adapter(svbrdf::gpu::GpuLosses);

#[cfg(feature = "gpu")]
impl Adapter {
    pub fn start() -> Result<Self, Error> {
        Ok(Self(svbrdf::gpu::GpuLosses::new(&svbrdf::gpu::Gpu::headless()?)?))
    }

    pub fn name(&self) -> &str {
        self.0.adapter()
    }

    pub fn backend(&self) -> &dyn Backend<f32> {
        &self.0
    }
}

/// No adapter: this program was built without the GPU layer.
#[cfg(not(feature = "gpu"))]
pub enum Adapter {}

#[cfg(not(feature = "gpu"))]
impl Adapter {
    pub fn start() -> Result<Self, Error> {
        Err(Error::NoAdapter {
            problem: "this program was built without GPU support".to_owned(),
            remedy: "leave out --backend, or build with the feature `gpu`",
        })
    }

    pub fn name(&self) -> &str {
        match *self {}
    }

    pub fn backend(&self) -> &dyn Backend<f32> {
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
