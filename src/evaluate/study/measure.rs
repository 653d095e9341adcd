//! Measures the time and the error of each choice.

use std::time::Instant;

use super::choice::{Choice, Family};
use super::pair::Pair;
use super::result::{Point, Reference, Study};
use crate::error::Error;
use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::{Comparison, Compute, Estimate, Outcome, Request, Sampling, Texels};
use svbrdf_core::material::{Depth, Material};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_core::text::time;

/// Scenes of the reference, 24 x 2^n for the Sobol sequence, and the most texels of each: more texels add little.
const REFERENCE_SCENES: usize = 24 << 13;
const REFERENCE_TEXELS: usize = 1024;
/// Scenes that f64 is compared with f32 on, and the most texels of each.
const CORRECTION_SCENES: usize = 24;
const CORRECTION_TEXELS: usize = (1 << 21) / CORRECTION_SCENES;
/// Seed of the reference. The choices use the seeds from 0 on.
const REFERENCE_SEED: u64 = 1 << 40;

/// Scenes of the runs that predict the time of a choice.
const WARMING_SCENES: usize = 6;
/// Least and most seeds of a choice.
const SEEDS: std::ops::RangeInclusive<usize> = 3..=32;
/// Texels times scenes of all seeds of a choice, within [`SEEDS`].
const SEEDS_WORK: usize = 1 << 28;
/// A scene costs as much as this many texels even where fewer are compared.
const LEAST_TEXELS: usize = 1 << 11;
/// Longest loss of a choice, in seconds; choices above it are not measured.
const LONGEST: f64 = 3.0;
/// The same for other precisions and maps, whose errors need few runs.
const LONGEST_VARIANT: f64 = 0.7;
/// The time of a loss in f64, in times of one in f32, and that of a texel of a random subset, in times of one of a whole map: roughly,
/// for what is told beforehand.
const F64_COST: f64 = 40.0;
const WHOLE: f64 = 14.0;
/// Most runs of those, and the seconds in which more than one has to fit.
const VARIANT_RUNS: usize = 3;
const VARIANT_TIME: f64 = 0.4;

/// Computes the loss of a sampling in the precision and with the maps of a family.
type Kernel<'a> = Box<dyn Fn(&Sampling, &Progress) -> Result<Outcome, CoreError> + 'a>;

/// The loss of one prediction over sampled scenes.
fn outcome<T: Compute>(
    [ground_truth, prediction]: [&Material<T>; 2],
    convention: Convention,
    sampling: &Sampling,
    progress: &Progress,
) -> Result<Outcome, CoreError> {
    let comparison = Comparison::new(ground_truth, &[prediction], convention)?.without_pilot();
    comparison.run(&Request::Scenes(*sampling), progress)
}

/// A study in progress: its pair, and the losses that further points are compared with.
pub(super) struct Bench<'a> {
    pair: Pair<'a>,
    progress: &'a Progress,
    /// The losses of the seeds, for each choice that was run with many.
    bases: Vec<(Choice, Vec<f64>)>,
}

impl<'a> Bench<'a> {
    pub(super) fn new(pair: &Pair<'a>, progress: &'a Progress) -> Self {
        Self { pair: *pair, progress, bases: Vec::new() }
    }

    /// The reference.
    pub(super) fn reference(&self) -> Result<Reference, Error> {
        let (pair, start) = (&self.pair, Instant::now());
        let fast = kernel(pair, Family::Sobol)?;
        let sobol = |scenes, texels| {
            let choice = Choice { scenes, texels: Texels::Sampled(texels), ..Choice::default() };
            choice.sampling(REFERENCE_SEED)
        };
        let many = sobol(REFERENCE_SCENES, REFERENCE_TEXELS);
        let few = sobol(CORRECTION_SCENES, CORRECTION_TEXELS);
        let loss = fast(&many, self.progress)?;
        let seconds = start.elapsed().as_secs_f64();
        let exact = kernel(pair, Family::F64)?(&few, &self.progress.part())?;
        let rounded = fast(&few, &self.progress.part())?;
        let [of, from] = [&exact, &rounded].map(|outcome| outcome.losses[0].per_scene.as_slice());
        let correction = Estimate::of_difference(few.sampler, &rounded.scenes, of, from);

        let estimate = loss.losses[0].estimate;
        let mean = estimate.mean + correction.mean;
        if mean.is_nan() || mean <= 0.0 {
            return Err(Error::NothingToStudy);
        }
        let errors = [estimate, correction].map(|e| e.standard_error.unwrap_or(f64::INFINITY));
        let error = errors[0].hypot(errors[1]) / mean;
        Ok(Reference { loss: mean, error, scenes: REFERENCE_SCENES, seconds })
    }

    /// Announces the work on all families to the progress.
    pub(super) fn begin(&self) {
        self.progress.begin(Family::ALL.into_iter().flat_map(|family| self.plan(family)).sum());
    }

    /// About how long the families take, in seconds, by the time of the reference.
    pub(super) fn expected_seconds(&self, reference: &Reference) -> f64 {
        let all = self.pair.ground_truth.width() * self.pair.ground_truth.height();
        let cost = |texels| match texels {
            Texels::Sampled(count) if count < all => count as f64,
            _ => all as f64 / WHOLE,
        };
        let rate = reference.seconds / REFERENCE_SCENES as f64 / cost(Texels::Sampled(REFERENCE_TEXELS));
        let of_choice = |choice: Choice| {
            let factor = if choice.family() == Family::F64 { F64_COST } else { 1.0 };
            let seconds = factor * rate * choice.scenes as f64 * cost(choice.texels);
            if seconds > longest(&choice) { 0.0 } else { seconds * self.runs(&choice, seconds) as f64 }
        };
        let families = Family::ALL.into_iter().filter(|family| !self.is_on_all(*family));
        families.flat_map(Family::choices).map(of_choice).sum()
    }

    /// Measures the choices of a family until one would take too long.
    pub(super) fn family(
        &mut self,
        family: Family,
        study: &mut Study,
        update: &mut impl FnMut(&Study),
    ) -> Result<(), Error> {
        let plan = self.plan(family);
        if self.is_on_all(family) {
            return Ok(self.progress.advance(plan.iter().sum())?);
        }
        let kernel = kernel(&self.pair, family)?;
        let rate = self.warm(&kernel, family)?;
        let seconds = |choice: &Choice| rate * choice.scenes as f64;
        let too_long = |choice: &Choice| seconds(choice) > longest(choice);
        if let Some(first) = family.choices().find(too_long) {
            let (name, scenes, least) = (family.name(), first.scenes, time(seconds(&first)));
            study.left_out.push(format!("{name} from {scenes} scenes on, {least} or more each"));
        }
        for (choice, steps) in family.choices().zip(plan) {
            if !too_long(&choice)
                && let Some(point) = self.point(&kernel, choice, seconds(&choice), study)?
            {
                study.add(point);
                update(study);
            }
            self.progress.advance(steps)?;
        }
        Ok(())
    }

    /// Whether the maps have no more texels than this family samples: then it equals the family on all texels.
    fn is_on_all(&self, family: Family) -> bool {
        let all = self.pair.ground_truth.width() * self.pair.ground_truth.height();
        family.choices().any(|choice| matches!(choice.texels, Texels::Sampled(count) if count >= all))
    }

    /// Seconds per scene in this family, after a run that does everything that happens once.
    fn warm(&self, kernel: &Kernel<'_>, family: Family) -> Result<f64, Error> {
        let Some(first) = family.choices().next() else { return Ok(0.0) };
        let few = Choice { scenes: WARMING_SCENES, ..first };
        self.timed(kernel, &few, 0)?;
        let (_, seconds) = self.timed(kernel, &few, 0)?;
        Ok(seconds / WARMING_SCENES as f64)
    }

    /// Progress of each choice of a family: approximate work, in scenes in f32.
    fn plan(&self, family: Family) -> Vec<u64> {
        let runs = |choice: &Choice| if *choice == choice.base() { self.seeds(choice) } else { 1 };
        let cost = |choice: Choice| choice.scenes * self.texels(&choice) * runs(&choice) / LEAST_TEXELS;
        family.choices().map(|choice| cost(choice) as u64).collect()
    }

    /// Texels per scene, at least [`LEAST_TEXELS`].
    fn texels(&self, choice: &Choice) -> usize {
        let all = self.pair.ground_truth.width() * self.pair.ground_truth.height();
        let compared = match choice.texels {
            Texels::Sampled(count) => all.min(count),
            Texels::All => all,
        };
        compared.max(LEAST_TEXELS)
    }

    fn seeds(&self, choice: &Choice) -> usize {
        (SEEDS_WORK / (choice.scenes * self.texels(choice))).clamp(*SEEDS.start(), *SEEDS.end())
    }

    /// The number of runs of a choice that takes about `seconds`.
    fn runs(&self, choice: &Choice, seconds: f64) -> usize {
        match *choice == choice.base() {
            true => self.seeds(choice),
            false => ((VARIANT_TIME / seconds) as usize).clamp(1, VARIANT_RUNS),
        }
    }

    /// Measures a choice that takes about `seconds`; `None` where its base was not measured.
    fn point(
        &mut self,
        kernel: &Kernel<'_>,
        choice: Choice,
        seconds: f64,
        study: &Study,
    ) -> Result<Option<Point>, Error> {
        let is_base = choice == choice.base();
        let runs = self.runs(&choice, seconds);
        let base = self.bases.iter().find(|(base, _)| *base == choice.base()).map(|(_, losses)| losses);
        if !is_base && base.is_none() {
            return Ok(None);
        }
        let timed: Result<Vec<_>, Error> =
            (0..runs as u64).map(|seed| self.timed(kernel, &choice, seed)).collect();
        let (run, mut times): (Vec<f64>, Vec<f64>) = timed?.into_iter().unzip();
        let shift = base.map_or(0.0, |base| mean_difference(&run, base));
        let losses = base.map_or(run, |base| base.iter().map(|loss| loss + shift).collect());
        times.sort_by(f64::total_cmp);
        let floats = Choice { maps: Depth::Float, ..choice };
        let of_floats = study.points.iter().find(|p| p.choice == floats).map(|p| p.seconds);
        let point = Point {
            choice,
            seconds: of_floats.unwrap_or(times[times.len() / 2]),
            error: relative_rms(&losses, study.reference.loss),
            shift: shift / study.reference.loss,
            seeds: losses.len(),
            runs,
            pareto: false,
        };
        if is_base {
            self.bases.push((choice, losses));
        }
        Ok(Some(point))
    }

    /// The loss of a choice over the scenes of a seed, and the seconds that sampling and rendering them took.
    fn timed(&self, kernel: &Kernel<'_>, choice: &Choice, seed: u64) -> Result<(f64, f64), Error> {
        let start = Instant::now();
        let outcome = kernel(&choice.sampling(seed), &self.progress.part())?;
        Ok((outcome.losses[0].estimate.mean, start.elapsed().as_secs_f64()))
    }
}

/// The longest loss of a choice that is measured, in seconds.
fn longest(choice: &Choice) -> f64 {
    if *choice == choice.base() { LONGEST } else { LONGEST_VARIANT }
}

/// The kernel of a family, on materials converted to its precision and depth.
fn kernel<'a>(pair: &Pair<'a>, family: Family) -> Result<Kernel<'a>, Error> {
    let Pair { ground_truth, prediction, convention } = *pair;
    let of_files = |depth| -> Result<Kernel<'a>, Error> {
        let [truth, prediction] =
            [ground_truth.after_round_trip(depth)?, prediction.after_round_trip(depth)?];
        Ok(Box::new(move |s, p| outcome([&truth, &prediction], convention, s, p)))
    };
    Ok(match family {
        Family::F64 => {
            let [truth, prediction] = [ground_truth.cast::<f64>(), prediction.cast()];
            Box::new(move |s, p| outcome([&truth, &prediction], convention, s, p))
        }
        Family::HalfMaps => of_files(Depth::Half)?,
        Family::EightBitMaps => of_files(Depth::Eight)?,
        _ => Box::new(move |s, p| outcome([ground_truth, prediction], convention, s, p)),
    })
}

/// The mean of `run` less the same seeds of `base`.
fn mean_difference(run: &[f64], base: &[f64]) -> f64 {
    run.iter().zip(base).map(|(a, b)| a - b).sum::<f64>() / run.len() as f64
}

/// The root mean square of the relative distances of `losses` from `reference`.
fn relative_rms(losses: &[f64], reference: f64) -> f64 {
    let squares = losses.iter().map(|loss| ((loss - reference) / reference).powi(2));
    (squares.sum::<f64>() / losses.len() as f64).sqrt()
}
