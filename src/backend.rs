//! Devices that compute a loss: the processor, a graphics adapter, or the faster of the two.
//!
//! ```no_run
//! use svbrdf::{Comparison, Convention, Progress, Request, backend, built_in};
//!
//! let materials = built_in::<f32>()?;
//! let prediction = &materials.predictions[0].material;
//! let comparison = Comparison::new(&materials.ground_truth.material, &[prediction], Convention::default())?;
//! let request = Request::default();
//! let fastest = backend::fastest(&comparison, &request)?;
//! let comparison = match &fastest.adapter {
//!     Some(adapter) => comparison.on(adapter.backend()),
//!     None => comparison,
//! };
//! let outcome = comparison.run(&request, &Progress::default())?;
//! # Ok::<(), svbrdf::Error>(())
//! ```

use std::fmt;
use std::time::{Duration, Instant};

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Backend, Comparison, Outcome, Request, Sampling, Texels};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;

/// Starting an adapter takes about this long: shorter losses stay on the CPU.
const SHORT: Duration = Duration::from_millis(100);
/// Measurements end with one that takes this long.
const LONG: Duration = Duration::from_millis(500);

/// The faster device for a loss.
#[derive(Debug)]
pub struct Fastest {
    /// The graphics adapter; `None` where the processor is faster, or there is no adapter.
    pub adapter: Option<Adapter>,
    /// The measured times, or why nothing was measured on an adapter.
    pub reason: String,
}

impl fmt::Display for Fastest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let device = if self.adapter.is_some() { "GPU" } else { "CPU" };
        write!(f, "computed on the {device}: {}", self.reason)
    }
}

/// The faster device for `request`, by measurements over a few of its scenes.
///
/// An adapter computes a fixed number of scenes on all texels; other requests are for the processor. A loss that takes the processor
/// less than about 100 ms starts no adapter.
///
/// # Errors
/// Those of [`Comparison::run`] on the processor. An adapter that is missing or fails is slower.
pub fn fastest(comparison: &Comparison<'_, f32>, request: &Request) -> Result<Fastest, Error> {
    match on_all_texels(comparison, request)? {
        Some(scenes) => faster(comparison, &scenes),
        None => {
            Ok(on_processor("graphics adapters compare a fixed number of scenes on all texels".to_owned()))
        }
    }
}

fn on_processor(reason: String) -> Fastest {
    Fastest { adapter: None, reason }
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

/// The faster device for a comparison in all of `scenes`.
fn faster(comparison: &Comparison<'_, f32>, scenes: &[Scene]) -> Result<Fastest, Error> {
    let on_cpu = predict(scenes.len(), LONG, timed(over_first(comparison, scenes)))?;
    if on_cpu < SHORT {
        let reason = format!("about {}, less than starting an adapter takes", milliseconds(on_cpu));
        return Ok(on_processor(reason));
    }
    let adapter = match Adapter::start() {
        Ok(adapter) => adapter,
        Err(problem) => return Ok(on_processor(problem.to_string())),
    };
    // A measurement that takes longer than the whole loss on the CPU is the last.
    let long = LONG.min(on_cpu);
    let compared = comparison.clone().on(adapter.backend());
    match predict(scenes.len(), long, timed(over_first(&compared, scenes))) {
        Ok(on_adapter) => {
            let [cpu, gpu] = [on_cpu, on_adapter].map(milliseconds);
            let reason = format!("measured, about {cpu} on the CPU and {gpu} on {}", adapter.name());
            Ok(Fastest { adapter: (on_adapter < on_cpu).then_some(adapter), reason })
        }
        Err(problem) => Ok(on_processor(problem.to_string())),
    }
}

fn milliseconds(time: Duration) -> String {
    format!("{:.1} ms", 1e3 * time.as_secs_f64())
}

/// The time that `work` takes for a number of scenes.
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
#[derive(Debug)]
pub struct Adapter(svbrdf_gpu::GpuLosses);

#[cfg(feature = "gpu")]
impl Adapter {
    /// Starts the adapter that suits best.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] without one, [`Error::Gpu`] where it fails.
    pub fn start() -> Result<Self, Error> {
        Ok(Self(svbrdf_gpu::GpuLosses::new(&svbrdf_gpu::Gpu::headless()?)?))
    }

    /// Its name, as its driver gives it.
    pub fn name(&self) -> &str {
        self.0.adapter()
    }

    /// What a comparison computes on: see [`Comparison::on`].
    pub fn backend(&self) -> &dyn Backend<f32> {
        &self.0
    }
}

/// No adapter: this program was built without the GPU layer.
#[cfg(not(feature = "gpu"))]
#[derive(Debug)]
pub enum Adapter {}

#[cfg(not(feature = "gpu"))]
impl Adapter {
    /// Starts no adapter.
    ///
    /// # Errors
    /// [`Error::NoAdapter`].
    pub fn start() -> Result<Self, Error> {
        Err(Error::NoAdapter {
            problem: "this program was built without GPU support".to_owned(),
            remedy: "compute on the processor, or build with the feature `gpu`",
        })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        match *self {}
    }

    /// What a comparison computes on.
    pub fn backend(&self) -> &dyn Backend<f32> {
        match *self {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);

    /// The predicted time, and the largest number of scenes that was measured.
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
