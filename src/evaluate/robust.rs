//! Robustness of the order of predictions to other conventions, epsilons and scenes: a ranking, asked several times.

use svbrdf_core::loss::{Comparison, Outcome, Request, Sampling, Texels};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::model::named_scenes::NamedScenes;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;
use svbrdf_core::statistics::order;

use crate::error::Error;

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
    /// An answer with the interval of each pair of predictions.
    pub fn new(
        question: String,
        scores: Vec<f64>,
        interval: impl Fn(usize, usize) -> Option<[f64; 2]>,
    ) -> Self {
        let all = 0..scores.len();
        let differences = all.clone().map(|a| all.clone().map(|b| interval(a, b)).collect()).collect();
        Self { question, scores, differences }
    }

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
        order(&self.scores)
    }

    /// Kendall's tau to another order, where differences that are not significant in both are no changes.
    pub fn tau(&self, other: &Self) -> f64 {
        let count = self.pairs().count().max(1) as f64;
        1.0 - 2.0 * self.changes(other).count() as f64 / count
    }

    /// The pairs of predictions that change sides in another order, where both differences are significant.
    pub fn changes(&self, other: &Self) -> impl Iterator<Item = (usize, usize)> {
        self.pairs().filter(|&(a, b)| self.sign(a, b) * other.sign(a, b) < 0)
    }

    fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let count = self.scores.len();
        (0..count).flat_map(move |a| (a + 1..count).map(move |b| (a, b)))
    }

    fn of_outcome(question: String, outcome: &Outcome) -> Self {
        // Listed scenes are the question itself, and no sample.
        let interval = |a, b| {
            let difference = outcome.difference(a, b);
            if outcome.sampling.is_some() { difference.interval95 } else { Some([difference.mean; 2]) }
        };
        let scores = outcome.losses.iter().map(|loss| loss.estimate.mean).collect();
        Self::new(question, scores, interval)
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
        let questions = self.questions()?;
        progress.begin(questions.len() as u64);
        let answer = |(name, convention, request): (String, Convention, Request)| {
            let comparison = Comparison::new(self.ground_truth, &self.predictions, convention)?;
            let outcome = comparison.at_most(MOST).run(&request, &progress.part())?;
            progress.step()?;
            Ok(Answered::of_outcome(name, &outcome))
        };
        questions.into_iter().map(answer).collect()
    }

    /// Each with its name, its convention and its scenes.
    fn questions(&self) -> Result<Vec<(String, Convention, Request)>, Error> {
        let own = self.convention;
        let usual = Request::Accuracy { target: self.target_error, seed: self.seed };
        let mut all = vec![(own.name.to_owned(), own, usual.clone())];
        for described in named::all().iter().filter(|described| described.name != own.name) {
            all.push((described.name.clone(), Convention::try_from(described)?, usual.clone()));
        }
        for epsilon in [0.01, 0.1].into_iter().filter(|epsilon| *epsilon != own.epsilon) {
            all.push((format!("epsilon {epsilon}"), Convention { epsilon, ..own }, usual.clone()));
        }
        for (name, near, distant) in [("near-field scenes", SCENES, 0), ("distant scenes", 0, SCENES)] {
            let texels = Texels::Sampled(TEXELS);
            let sampling = Sampling { near, distant, seed: self.seed, sampler: Sampler::Sobol, texels };
            all.push((name.to_owned(), own, Request::Scenes(sampling)));
        }
        for lights in NamedScenes::ALL {
            all.push((format!("lights {}", lights.name()), own, Request::Listed(lights.scenes()?)));
        }
        Ok(all)
    }
}
