//! Measures the time and the error of each setting.

use std::time::Instant;

use svbrdf_core::loss::{Comparison, Estimate, Request, Sampling, Texels};
use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_core::text::time;

use super::{Family, Reference, Study, StudyPoint};
use crate::error::Error;

/// Scenes of the reference, 24 x 2^n for the Sobol sequence. It samples 1024 texels of each: more add little.
const REFERENCE_SCENES: usize = 24 << 13;
/// Scenes that f64 is compared with f32 on, and the most texels of each.
const CORRECTION_SCENES: usize = 24;
const CORRECTION_TEXELS: usize = (1 << 21) / CORRECTION_SCENES;
/// Seed of the reference. The settings use the seeds from 0 on.
const REFERENCE_SEED: u64 = 1 << 40;

/// Scenes of the runs that predict the time of a setting.
const WARMING_SCENES: usize = 6;
const WARMING_RUNS: usize = 4;
/// Least and most seeds of a setting.
const SEEDS: [usize; 2] = [3, 32];
/// Texels times scenes of all seeds of a setting, within [`SEEDS`].
const SEEDS_WORK: usize = 1 << 28;
/// A scene costs as much as this many texels even where fewer are compared.
const LEAST_TEXELS: usize = 1 << 11;
/// Longest loss of a setting, in seconds; settings above it are not measured.
const LONGEST: f64 = 3.0;

/// Measures every setting for the first prediction of `comparison`, except those whose loss would take too long.
///
/// # Errors
/// Those of the loss; [`Error::NoPrediction`]; [`Error::NothingToStudy`] where the two materials look the same, so that no error is
/// relative to anything; [`Cancelled`](Error::is_cancelled).
pub fn run(comparison: &Comparison<'_, f32>, progress: &Progress) -> Result<Study, Error> {
    let (truth, convention) = (comparison.ground_truth(), *comparison.convention());
    let prediction = *comparison.predictions().first().ok_or(Error::NoPrediction)?;
    let pair = &Comparison::new(truth, &[prediction], convention)?.without_pilot();
    let reference = reference(pair, prediction, progress)?;
    let size = truth.size();
    progress.begin(Family::ALL.into_iter().flat_map(Family::settings).map(|one| work(size, &one)).sum());
    let mut study = Study {
        names: [truth, prediction].map(|material| material.name().to_owned()),
        size,
        convention,
        threads: rayon::current_num_threads(),
        reference,
        points: Vec::new(),
        left_out: Vec::new(),
    };
    for family in Family::ALL {
        measure(pair, family, &mut study, progress)?;
    }
    study.mark();
    Ok(study)
}

fn reference(
    pair: &Comparison<'_, f32>,
    prediction: &Material<f32>,
    progress: &Progress,
) -> Result<Reference, Error> {
    let fast = |sampling, progress: &_| pair.run(&Request::Scenes(sampling), progress);
    let many = Sampling { seed: REFERENCE_SEED, ..Family::MoreTexels.setting(REFERENCE_SCENES) };
    let texels = Texels::Sampled(CORRECTION_TEXELS);
    let few = Sampling { seed: REFERENCE_SEED, texels, ..Family::Sobol.setting(CORRECTION_SCENES) };
    let estimate = fast(many, progress)?.losses[0].estimate;
    let [truth, prediction] = [pair.ground_truth().cast::<f64>(), prediction.cast()];
    let exact = Comparison::new(&truth, &[&prediction], *pair.convention())?.without_pilot();
    let exact = exact.run(&Request::Scenes(few), &progress.part())?;
    let rounded = fast(few, &progress.part())?;
    let [of, from] = [&exact, &rounded].map(|outcome| outcome.losses[0].per_scene.as_slice());
    let correction = Estimate::of_difference(few.sampler, &rounded.scenes, of, from);

    let mean = estimate.mean + correction.mean;
    if mean.is_nan() || mean <= 0.0 {
        return Err(Error::NothingToStudy);
    }
    let errors = [estimate, correction].map(|e| e.standard_error.unwrap_or(f64::INFINITY));
    Ok(Reference { loss: mean, error: errors[0].hypot(errors[1]) / mean, scenes: REFERENCE_SCENES })
}

/// Measures the settings of a family until one would take too long. A family that samples no fewer texels than the maps have
/// equals that on all of them.
fn measure(
    pair: &Comparison<'_, f32>,
    family: Family,
    study: &mut Study,
    progress: &Progress,
) -> Result<(), Error> {
    let size = study.size;
    if family.texels() != Texels::All && family.texels().sampled(size).is_none() {
        return Ok(progress.advance(family.settings().map(|setting| work(size, &setting)).sum())?);
    }
    // The loss, and the seconds that sampling and rendering its scenes took.
    let timed = |sampling| -> Result<(f64, f64), Error> {
        let start = Instant::now();
        let outcome = pair.run(&Request::Scenes(sampling), &progress.part())?;
        Ok((outcome.losses[0].estimate.mean, start.elapsed().as_secs_f64()))
    };
    let rate = least(|| Ok(timed(family.setting(WARMING_SCENES))?.1))? / WARMING_SCENES as f64;
    let mut is_left_out = false;
    for sampling in family.settings() {
        let scenes = sampling.near + sampling.distant;
        let seconds = rate * scenes as f64;
        if seconds <= LONGEST {
            let seeds = seeds(size, &sampling);
            let runs = (0..seeds as u64).map(|seed| timed(Sampling { seed, ..sampling }));
            let (losses, mut times): (Vec<f64>, Vec<f64>) =
                runs.collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
            times.sort_by(f64::total_cmp);
            let (seconds, error) = (times[times.len() / 2], relative_rms(&losses, study.reference.loss));
            study.points.push(StudyPoint { family, sampling, seconds, error, seeds, pareto: false });
        } else if !std::mem::replace(&mut is_left_out, true) {
            let (name, least) = (family.name(), time(seconds));
            study.left_out.push(format!("{name} from {scenes} scenes on, {least} or more each"));
        }
        progress.advance(work(size, &sampling))?;
    }
    Ok(())
}

/// The least time of several runs: the first does everything that happens once, and another may wait for the machine.
fn least(mut seconds: impl FnMut() -> Result<f64, Error>) -> Result<f64, Error> {
    (0..WARMING_RUNS).try_fold(f64::INFINITY, |least, _| Ok(least.min(seconds()?)))
}

/// Texels of all scenes of a setting, of each at least [`LEAST_TEXELS`].
fn texels([width, height]: [usize; 2], sampling: &Sampling) -> usize {
    let compared = sampling.texels.sampled([width, height]).unwrap_or(width * height);
    (sampling.near + sampling.distant) * compared.max(LEAST_TEXELS)
}

fn seeds(size: [usize; 2], sampling: &Sampling) -> usize {
    let [least, most] = SEEDS;
    (SEEDS_WORK / texels(size, sampling)).clamp(least, most)
}

/// Progress of a setting.
fn work(size: [usize; 2], sampling: &Sampling) -> u64 {
    (seeds(size, sampling) * texels(size, sampling) / LEAST_TEXELS) as u64
}

/// The root mean square of the relative distances of `losses` from `reference`.
fn relative_rms(losses: &[f64], reference: f64) -> f64 {
    let squares = losses.iter().map(|loss| ((loss - reference) / reference).powi(2));
    (squares.sum::<f64>() / losses.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_stall_is_no_rate() {
        let mut times = [0.4, 0.02, 7.0, 0.021].into_iter();
        assert_eq!(least(|| Ok(times.next().unwrap_or(f64::NAN))).unwrap(), 0.02);
    }
}
