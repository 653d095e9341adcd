//! Robustness of the order of predictions to other conventions, epsilons, exposures, resolutions, scenes and measures.

use svbrdf_core::loss::{Comparison, Outcome, Request, Sampling, Texels};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::{Convention, Member};
use svbrdf_core::model::grammar::Description;
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::model::named_scenes::NamedScenes;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;

use crate::error::Error;
use crate::metrics::{Metric, RenderedScenes, of_maps, of_renderings};

/// Scenes of the questions about one kind of them, and texels of each.
const SCENES: usize = 2048;
const TEXELS: usize = 32;
/// Most scenes of a question: a squared error of sharp highlights would take hundreds of thousands, whose interval tells instead.
const MOST: usize = 24_576;

/// The answer to a question: how far each prediction is from the ground truth.
#[derive(Clone, Debug)]
pub struct Answered {
    pub question: String,
    /// Smaller is better.
    pub scores: Vec<f64>,
    /// For each pair of predictions, the 95% interval of the score of the first - that of the second; `None` where it is unknown.
    pub differences: Vec<Vec<Option<[f64; 2]>>>,
}

impl Answered {
    /// 1 where `a` is significantly farther from the ground truth than `b`, -1 where it is closer, 0 where that is not known.
    pub fn sign(&self, a: usize, b: usize) -> i8 {
        match self.differences[a][b] {
            Some([low, _]) if low > 0.0 => 1,
            Some([_, high]) if high < 0.0 => -1,
            _ => 0,
        }
    }

    /// The predictions, the best first.
    pub fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.scores.len()).collect();
        order.sort_by(|&a, &b| self.scores[a].total_cmp(&self.scores[b]));
        order
    }

    /// Kendall's tau to another order, where differences that are not significant in both are no changes.
    pub fn tau(&self, other: &Self) -> f64 {
        let count = self.scores.len();
        let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
        let (mut changed, mut all) = (0.0, 0.0);
        for (a, b) in pairs {
            all += 1.0;
            changed += f64::from(u8::from(self.sign(a, b) * other.sign(a, b) < 0));
        }
        if all > 0.0 { 1.0 - 2.0 * changed / all } else { 1.0 }
    }

    fn of_outcome(question: &str, outcome: &Outcome) -> Self {
        let count = outcome.losses.len();
        // Listed scenes are the question itself, and no sample.
        let interval = |a, b| {
            let difference = outcome.difference(a, b);
            if outcome.sampling.is_some() { difference.interval95 } else { Some([difference.mean; 2]) }
        };
        Self {
            question: question.to_owned(),
            scores: outcome.losses.iter().map(|loss| loss.estimate.mean).collect(),
            differences: (0..count).map(|a| (0..count).map(|b| interval(a, b)).collect()).collect(),
        }
    }

    /// Of scores without an error.
    fn exact(question: &str, scores: Vec<f64>) -> Self {
        let row = |a: &f64| scores.iter().map(|b| Some([a - b; 2])).collect();
        Self { question: question.to_owned(), differences: scores.iter().map(row).collect(), scores }
    }
}

/// The predictions of a ground truth, and the question that is asked by default.
#[derive(Clone, Debug)]
pub struct RobustInput<'a> {
    pub ground_truth: &'a Material<f32>,
    pub predictions: Vec<&'a Material<f32>>,
    pub convention: Convention,
    pub target_error: f64,
    pub seed: u64,
}

impl RobustInput<'_> {
    /// The answers to all questions, the default one first. A question is one step of `progress`.
    ///
    /// # Errors
    /// Where the materials cannot be compared; [`Error`] of a cancelled computation.
    pub fn answers(&self, progress: &Progress) -> Result<Vec<Answered>, Error> {
        let usual = Request::Accuracy { target: self.target_error, seed: self.seed };
        let losses = self.losses(&usual)?;
        progress.begin(losses.len() as u64 + 3);
        let mut all = Vec::new();
        for (name, convention, request) in losses {
            all.push(self.loss(&name, convention, &request, progress)?);
            progress.step()?;
        }
        all.push(self.halved(&usual, progress)?);
        progress.step()?;
        all.extend(self.maps()?);
        progress.step()?;
        all.push(self.flip(progress)?);
        progress.step()?;
        Ok(all)
    }

    /// The questions that are losses of the materials as they are.
    fn losses(&self, usual: &Request) -> Result<Vec<(String, Convention, Request)>, Error> {
        let mut all = vec![(self.convention.name.to_owned(), self.convention, usual.clone())];
        for described in named::all().iter().filter(|described| described.name != self.convention.name) {
            all.push((described.name.clone(), Convention::try_from(described)?, usual.clone()));
        }
        for epsilon in [0.01, 0.1].into_iter().filter(|epsilon| *epsilon != self.convention.epsilon) {
            all.push((
                format!("epsilon {epsilon}"),
                Convention { epsilon, ..self.convention },
                usual.clone(),
            ));
        }
        for (name, factor) in [("exposure -1 EV", 0.5), ("exposure +1 EV", 2.0)] {
            all.push((name.to_owned(), exposed(&self.convention, factor)?, usual.clone()));
        }
        for (name, near, distant) in [("near-field scenes", SCENES, 0), ("distant scenes", 0, SCENES)] {
            let texels = Texels::Sampled(TEXELS);
            let sampling = Sampling { near, distant, seed: self.seed, sampler: Sampler::Sobol, texels };
            all.push((name.to_owned(), self.convention, Request::Scenes(sampling)));
        }
        for lights in NamedScenes::ALL {
            all.push((
                format!("lights {}", lights.name()),
                self.convention,
                Request::Listed(lights.scenes()?),
            ));
        }
        Ok(all)
    }

    fn loss(
        &self,
        name: &str,
        convention: Convention,
        request: &Request,
        progress: &Progress,
    ) -> Result<Answered, Error> {
        let comparison = Comparison::new(self.ground_truth, &self.predictions, convention)?;
        let outcome = comparison.at_most(MOST).run(request, &progress.part())?;
        Ok(Answered::of_outcome(name, &outcome))
    }

    /// The measures of maps, each a mean over the four of them; those that maps of this size have.
    fn maps(&self) -> Result<Vec<Answered>, Error> {
        const RMSE: [&str; 4] =
            ["rmse_normal_stored", "rmse_diffuse_srgb", "rmse_specular_srgb", "rmse_roughness"];
        const SSIM: [&str; 4] = [
            "ssim11_gaussian_normal_stored",
            "ssim11_gaussian_diffuse_srgb",
            "ssim11_gaussian_specular_srgb",
            "ssim11_gaussian_roughness",
        ];
        let of_prediction = |prediction: &&Material<f32>| Ok(of_maps(self.ground_truth, prediction)?);
        let all = self.predictions.iter().map(of_prediction).collect::<Result<Vec<_>, Error>>()?;
        // Larger is better in SSIM.
        let asked = [("RMSE of maps", RMSE, 0.25), ("SSIM of maps", SSIM, -0.25)];
        let answer = |(question, names, factor): (&str, [&str; 4], f64)| {
            let value =
                |name: &str, of: &[Metric]| of.iter().find(|one| one.name == name).map(|one| one.value);
            let score = |of: &Vec<Metric>| names.iter().map(|name| value(name, of)).sum::<Option<f64>>();
            let scores: Option<Vec<f64>> = all.iter().map(score).collect();
            scores
                .map(|scores| Answered::exact(question, scores.iter().map(|score| factor * score).collect()))
        };
        Ok(asked.into_iter().filter_map(answer).collect())
    }

    /// FLIP of renderings under nine flashes.
    fn flip(&self, progress: &Progress) -> Result<Answered, Error> {
        let scenes = NamedScenes::Flash9.scenes()?;
        let convention = &self.convention;
        let rendered =
            RenderedScenes { scenes: &scenes, sampler: Sampler::Random, convention, exposure_ev: 0.0 };
        let mut scores = Vec::new();
        for prediction in &self.predictions {
            let metrics = of_renderings(self.ground_truth, prediction, &rendered, &progress.part())?;
            let flip = metrics.iter().find(|metric| metric.name == "flip_rendering_clipped");
            scores.push(flip.map_or(f64::NAN, |metric| metric.value));
        }
        Ok(Answered::exact("FLIP of renderings", scores))
    }

    /// The loss of all materials at half the resolution.
    fn halved(&self, request: &Request, progress: &Progress) -> Result<Answered, Error> {
        let half = |material: &Material<f32>| {
            let [width, height] = material.size();
            material.clone().resized([(width / 2).max(1), (height / 2).max(1)])
        };
        let ground_truth = half(self.ground_truth)?;
        let predictions: Vec<_> =
            self.predictions.iter().map(|prediction| half(prediction)).collect::<Result<_, _>>()?;
        let halved =
            RobustInput { ground_truth: &ground_truth, predictions: predictions.iter().collect(), ..*self };
        halved.loss("half resolution", self.convention, request, progress)
    }
}

/// The convention with a brighter light.
fn exposed(convention: &Convention, factor: f64) -> Result<Convention, Error> {
    let Some(Member { terms, norm, .. }) = convention.member else {
        return Ok(Convention { intensity: convention.intensity * factor, ..*convention });
    };
    let mut described =
        named::all().iter().find(|known| known.name == convention.name).cloned().unwrap_or_default();
    (described.terms, described.loss.norm) = (*terms, *norm);
    described.loss.epsilon = Some(convention.epsilon);
    described.terms.light.factor *= factor;
    let Description { name, .. } = &described;
    described.name = format!("{name}, exposed");
    Ok(Convention::try_from(&described)?)
}
