//! Pairs of materials, and what many seeds show of their losses.

use rayon::prelude::*;
use statrs::distribution::{Binomial, DiscreteCDF};

use svbrdf_core::loss::{Comparison, Estimate, Loss, Outcome, Request, Sampling, Texels};
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;
use svbrdf_files::samples;

use super::pairs;

/// Coverage in percent that all seeds may have.
const ALLOWED: [f64; 2] = [93.5, 96.5];
/// The probability of a sound interval to fail in one cell of a test with few seeds, on either side.
const MISHAP: f64 = 1e-3;

/// The coverage in percent that `seeds` may show where that of all seeds is within `ALLOWED`: quantiles of the binomial
/// distribution.
pub fn allowed(seeds: u64) -> [f64; 2] {
    let count = |coverage: f64, p| Binomial::new(coverage / 100.0, seeds).unwrap().inverse_cdf(p);
    [count(ALLOWED[0], MISHAP), count(ALLOWED[1], 1.0 - MISHAP)].map(|n| 100.0 * n as f64 / seeds as f64)
}

pub struct Pair {
    pub ground_truth: Material<f32>,
    pub prediction: Material<f32>,
    /// The loss over all scenes, in the weights 2 : 1.
    pub reference: f64,
}

/// What many seeds have shown, in percent: of the seeds, and of the reference.
#[derive(Debug)]
pub struct Seen {
    pub coverage: f64,
    pub half_width: f64,
    pub rms: f64,
    pub bias: f64,
    /// Standard error of `bias`.
    pub bias_error: f64,
    #[expect(dead_code, reason = "printed")]
    pub scenes: f64,
}

/// Every `step`-th texel of every `step`-th row.
fn thinned(material: &Material<f32>, step: usize) -> Material<f32> {
    let [width, height] = material.size().map(|n| n / step);
    let from = |i: usize| (i / width * step + step / 2) * material.width() + i % width * step + step / 2;
    let plane = |p: &Vec<f32>| (0..width * height).map(|i| p[from(i)]).collect();
    let planes = material.planes();
    let planes = Planes {
        normal: planes.normal.each_ref().map(plane),
        diffuse: planes.diffuse.each_ref().map(plane),
        specular: planes.specular.each_ref().map(plane),
        roughness: plane(&planes.roughness),
    };
    Material::new(material.name(), width, height, planes).unwrap()
}

impl Pair {
    /// Every `step`-th texel of every `step`-th row of two materials. The reference takes 24 x 2^`log_points` scenes.
    pub fn new(
        ground_truth: &Material<f32>,
        prediction: &Material<f32>,
        step: usize,
        log_points: u32,
    ) -> Self {
        let [ground_truth, prediction] = [ground_truth, prediction].map(|m| thinned(m, step));
        let mut pair = Self { ground_truth, prediction, reference: 0.0 };
        let (near, distant) = (16 << log_points, 8 << log_points);
        let sampling =
            Sampling { near, distant, seed: 1 << 40, sampler: Sampler::Sobol, texels: Texels::All };
        pair.reference = pair.loss(sampling).estimate.mean;
        pair
    }

    pub fn name(&self) -> String {
        format!("{} - {}", self.ground_truth.name(), self.prediction.name())
    }

    pub fn comparison(&self) -> Comparison<'_, f32> {
        Comparison::new(&self.ground_truth, &[&self.prediction], PRINTED).unwrap()
    }

    fn loss(&self, sampling: Sampling) -> Loss {
        let request = Request::Scenes(sampling);
        self.comparison().run(&request, &Progress::default()).unwrap().losses.remove(0)
    }

    /// The estimate of `count` scenes, of which a third are distant, for a seed.
    pub fn fixed(&self, sampler: Sampler, texels: Texels, count: usize) -> impl Fn(u64) -> (Estimate, usize) {
        move |seed| {
            let (near, distant) = (count / 3 * 2, count / 3);
            (self.loss(Sampling { near, distant, seed, sampler, texels }).estimate, count)
        }
    }

    pub fn adaptive(&self, target: f64) -> impl Fn(u64) -> (Estimate, usize) {
        move |seed| {
            let mut scenes = 0;
            let count = |outcome: &Outcome| scenes += outcome.scenes.len();
            let request = Request::Accuracy { target, seed };
            let outcome = self.comparison().stream(&request, &Progress::default(), count);
            (outcome.unwrap().losses[0].estimate, scenes)
        }
    }

    pub fn seen(&self, seeds: u64, estimate: impl Fn(u64) -> (Estimate, usize) + Sync + Send) -> Seen {
        let estimates: Vec<_> = (0..seeds).into_par_iter().map(estimate).collect();
        let mean = |of: &dyn Fn(&Estimate) -> f64| {
            100.0 * estimates.iter().map(|(e, _)| of(e)).sum::<f64>() / seeds as f64
        };
        let error = |e: &Estimate| e.mean / self.reference - 1.0;
        let rms = 10.0 * mean(&|e| error(e).powi(2)).sqrt();
        Seen {
            coverage: mean(&|e| f64::from(holds(e, self.reference))),
            half_width: mean(&Estimate::relative_error95),
            rms,
            bias: mean(&error),
            bias_error: rms / (seeds as f64).sqrt(),
            scenes: estimates.iter().map(|(_, count)| *count as f64).sum::<f64>() / seeds as f64,
        }
    }
}

/// Whether the interval of an estimate holds the value.
pub fn holds(estimate: &Estimate, value: f64) -> bool {
    let [low, high] = estimate.interval95.unwrap();
    (low..=high).contains(&value)
}

/// The pairs made for this test, of `side` x `side` texels.
pub fn made(side: usize, log_points: u32) -> Vec<Pair> {
    pairs::made(side).iter().map(|[truth, other]| Pair::new(truth, other, 1, log_points)).collect()
}

/// The built-in ground truth with its predictions.
pub fn built_in(step: usize, log_points: u32) -> Vec<Pair> {
    let samples = samples::load::<f32>().unwrap();
    let gt = samples.ground_truth.material;
    samples.predictions.iter().map(|p| Pair::new(&gt, &p.material, step, log_points)).collect()
}
