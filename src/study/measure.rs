//! Losses run against the clock.

use std::time::Instant;

use super::text::time;
use super::{Choice, Family, Pair, Point, Reference, Study};
use crate::error::Error;
use crate::loss::{Estimate, Loss, Weights, losses, losses_f32};
use crate::material::Material;
use crate::material::write::{self, Depth};
use crate::progress::Progress;
use crate::sampler::Sampler;
use crate::scene::Scene;

/// Texels times scenes of the reference at most, and its most scenes. 24 x 2^n scenes are best for the sequence.
const REFERENCE_WORK: usize = 1 << 31;
const REFERENCE_SCENES: usize = 24 << 11;
/// The reference is computed in this many pieces, so that its progress is seen.
const PIECES: usize = 32;
/// Texels times scenes that f64 is compared with f32 on at most, and the scenes that are enough.
const CORRECTION_WORK: usize = 1 << 21;
const CORRECTION_SCENES: usize = 24;
/// Names the scenes of the reference. Those of the choices have the seeds from 0 on.
const REFERENCE_SEED: u64 = 1 << 40;

/// Seeds of a choice.
const SEEDS: std::ops::RangeInclusive<usize> = 3..=32;
/// Texels times scenes of all seeds of a choice, unless these are too few.
const SEEDS_WORK: usize = 1 << 28;
/// A scene costs as much as this many texels even where the map has fewer.
const LEAST_TEXELS: usize = 1 << 13;
/// A choice whose loss would take longer, in seconds, is left out.
const LONGEST: f64 = 3.0;
/// The same for other precisions, backends and maps, whose errors need few runs.
const LONGEST_VARIANT: f64 = 0.7;
/// Most runs of those, and the seconds in which more than one has to fit.
const VARIANT_RUNS: usize = 3;
const VARIANT_TIME: f64 = 0.4;

/// One of the ways to compute the losses over scenes, on materials of its own.
type Kernel<'a> = Box<dyn Fn(&[Scene], &Progress) -> Result<Vec<Loss>, Error> + 'a>;

/// What a study has found out so far that further points need.
pub(super) struct Bench<'a> {
    pair: Pair<'a>,
    progress: &'a Progress,
    /// The losses of the seeds, for each choice that was run with many.
    bases: Vec<(Choice, Vec<f64>)>,
    /// Seconds a scene takes in f32 on the CPU, and in f64.
    rate_f32: f64,
    rate_f64: f64,
}

impl<'a> Bench<'a> {
    pub(super) fn new(pair: &Pair<'a>, progress: &'a Progress) -> Self {
        Self { pair: *pair, progress, bases: Vec::new(), rate_f32: 0.0, rate_f64: 0.0 }
    }

    fn texels(&self) -> usize {
        self.pair.ground_truth.width() * self.pair.ground_truth.height()
    }

    fn scenes(&self, choice: &Choice, seed: u64) -> Vec<Scene> {
        choice.sampler.scenes(seed, choice.near(), choice.distant(), &self.pair.convention)
    }

    /// The reference, whose runs also tell how long a scene takes.
    pub(super) fn reference(&mut self) -> Result<Reference, Error> {
        let affordable = |work: usize| work / self.texels();
        let mut count = 24;
        while 2 * count <= affordable(REFERENCE_WORK).min(REFERENCE_SCENES) {
            count *= 2;
        }
        let choices: u64 = Family::ALL.into_iter().flat_map(|family| self.plan(family)).sum();
        self.progress.begin(count as u64 + choices);

        let fast = kernel(&self.pair, Family::Sobol)?;
        let many = self.sobol(count);
        fast(&many[..1], &self.progress.part())?;
        let start = Instant::now();
        let mut values = Vec::with_capacity(count);
        for piece in many.chunks(count.div_ceil(PIECES)) {
            values.extend(per_scene(fast(piece, &self.progress.part())?));
            self.progress.advance(piece.len() as u64)?;
        }
        let rate_f32 = start.elapsed().as_secs_f64() / count as f64;
        let estimate = Estimate::of_sampled(Sampler::Sobol, &many, &values);

        let few = self.sobol(affordable(CORRECTION_WORK).clamp(3, CORRECTION_SCENES));
        let exact = kernel(&self.pair, Family::F64)?;
        let start = Instant::now();
        let exact = per_scene(exact(&few, &self.progress.part())?);
        let rate_f64 = start.elapsed().as_secs_f64() / few.len() as f64;
        let fast = per_scene(fast(&few, &self.progress.part())?);
        let correction = Estimate::of_difference(Weights::OfCounts, Sampler::Sobol, &few, &exact, &fast);

        (self.rate_f32, self.rate_f64) = (rate_f32, rate_f64);
        let loss = estimate.mean + correction.mean;
        if loss.is_nan() || loss <= 0.0 {
            let problem = "the two materials look the same in every scene, so that there is no error to study; \
                give a prediction that differs from the ground truth";
            return Err(Error::Usage(problem.to_owned()));
        }
        // Where f64 is compared in too few scenes for an error of its own, all of it counts as error.
        let of_correction = correction.standard_error.unwrap_or(correction.mean.abs());
        let standard_error = estimate.standard_error.unwrap_or(f64::INFINITY).hypot(of_correction);
        Ok(Reference { loss, error: standard_error / loss, scenes: count })
    }

    /// Sobol scenes of the reference, 2 : 1.
    fn sobol(&self, count: usize) -> Vec<Scene> {
        Sampler::Sobol.scenes(REFERENCE_SEED, count - count / 3, count / 3, &self.pair.convention)
    }

    /// Measures the choices of a family until one would take too long. An adapter that fails costs its own points only.
    pub(super) fn family(
        &mut self,
        family: Family,
        study: &mut Study,
        update: &mut impl FnMut(&Study),
    ) -> Result<(), Error> {
        match self.measure(family, study, update) {
            Err(problem @ (Error::Gpu { .. } | Error::NoAdapter { .. })) => {
                study.left_out.push(format!("{}: {problem}", family.name()));
                update(study);
                Ok(())
            }
            result => result,
        }
    }

    fn measure(
        &mut self,
        family: Family,
        study: &mut Study,
        update: &mut impl FnMut(&Study),
    ) -> Result<(), Error> {
        let plan = self.plan(family);
        if family == Family::Gpu && self.pair.gpu.is_none() {
            return self.progress.advance(plan.iter().sum());
        }
        let kernel = kernel(&self.pair, family)?;
        let rate = match family {
            Family::Gpu => self.warm(&kernel)?,
            Family::F64 => self.rate_f64,
            _ => self.rate_f32,
        };
        let seconds = |choice: &Choice| rate * choice.scenes as f64;
        let longest = |choice: &Choice| if *choice == choice.base() { LONGEST } else { LONGEST_VARIANT };
        let too_long = |choice: &Choice| seconds(choice) > longest(choice);
        if let Some(first) = family.choices().find(too_long) {
            let (name, scenes, least) = (family.name(), first.scenes, time(seconds(&first)));
            study.left_out.push(format!("{name} from {scenes} on, which take {least} or more"));
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

    /// Seconds a scene takes after everything that is done once.
    fn warm(&self, kernel: &Kernel<'_>) -> Result<f64, Error> {
        let Some(smallest) = Family::Sobol.choices().next() else { return Ok(0.0) };
        self.timed(kernel, &smallest, 0)?;
        let (_, seconds) = self.timed(kernel, &smallest, 0)?;
        Ok(seconds / smallest.scenes as f64)
    }

    /// What each choice of a family adds to the progress: about the work, in scenes in f32 on the CPU.
    fn plan(&self, family: Family) -> Vec<u64> {
        let cost = |choice: Choice| match family {
            Family::Random | Family::Sobol => choice.scenes * self.seeds(&choice),
            _ => choice.scenes,
        };
        family.choices().map(|choice| cost(choice) as u64).collect()
    }

    fn seeds(&self, choice: &Choice) -> usize {
        let work = choice.scenes * self.texels().max(LEAST_TEXELS);
        (SEEDS_WORK / work).clamp(*SEEDS.start(), *SEEDS.end())
    }

    /// Runs a choice that takes about `seconds`; `None` where the choice that it is compared with was left out.
    fn point(
        &mut self,
        kernel: &Kernel<'_>,
        choice: Choice,
        seconds: f64,
        study: &Study,
    ) -> Result<Option<Point>, Error> {
        let is_base = choice == choice.base();
        let runs = match is_base {
            true => self.seeds(&choice),
            false => ((VARIANT_TIME / seconds) as usize).clamp(1, VARIANT_RUNS),
        };
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

    /// The loss of a choice over the scenes of a seed, and the seconds that drawing and rendering them took.
    fn timed(&self, kernel: &Kernel<'_>, choice: &Choice, seed: u64) -> Result<(f64, f64), Error> {
        let start = Instant::now();
        let losses = kernel(&self.scenes(choice, seed), &self.progress.part())?;
        let mean = losses.first().map_or(f64::NAN, |loss| loss.estimate.mean);
        Ok((mean, start.elapsed().as_secs_f64()))
    }
}

/// The way a family computes its losses, on the materials as it has them.
fn kernel<'a>(pair: &Pair<'a>, family: Family) -> Result<Kernel<'a>, Error> {
    let Pair { ground_truth, prediction, convention, gpu } = *pair;
    let of_files = |depth| -> Result<Kernel<'a>, Error> {
        let (ground_truth, prediction) = (write::held(ground_truth, depth)?, write::held(prediction, depth)?);
        Ok(Box::new(move |scenes, p| losses_f32(&ground_truth, &[&prediction], scenes, &convention, p)))
    };
    Ok(match (family, gpu) {
        (Family::Gpu, Some(gpu)) => {
            Box::new(move |scenes, p| gpu(ground_truth, prediction, scenes, &convention, p))
        }
        (Family::F64, _) => {
            let (ground_truth, prediction): (Material<f64>, Material<f64>) =
                (ground_truth.cast(), prediction.cast());
            Box::new(move |scenes, p| losses(&ground_truth, &[&prediction], scenes, &convention, p))
        }
        (Family::HalfMaps, _) => of_files(Depth::Half)?,
        (Family::EightBitMaps, _) => of_files(Depth::Eight)?,
        (Family::Random | Family::Sobol | Family::Gpu, _) => {
            Box::new(move |scenes, p| losses_f32(ground_truth, &[prediction], scenes, &convention, p))
        }
    })
}

fn per_scene(losses: Vec<Loss>) -> Vec<f64> {
    losses.into_iter().next().map(|loss| loss.per_scene).unwrap_or_default()
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
