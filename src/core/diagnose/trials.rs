//! The losses of a prediction before and after changes, in the same scenes on the same texels.

use rayon::prelude::*;

use super::change::Change;
use super::corrected::Corrected;
use super::exposure;
use super::radiances::{Pair, radiances};
use super::storage::Storage;
use crate::error::Error;
use crate::loss::{Comparison, Compute as _, Request, Sampling, Texels};
use crate::material::Material;
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::model::scene::{Kind, Scene};
use crate::progress::Progress;

/// Changed predictions are rendered together as far as their maps fit into this much memory.
const MOST_BYTES: usize = 1 << 30;
/// Texels of a scene whose radiances are compared one by one, for exposures.
const RADIANCES: usize = 1024;

/// A prediction, and the scenes that changes of it are tried in.
pub(super) struct Trials<'a> {
    pub(super) ground_truth: &'a Material<f32>,
    pub(super) prediction: &'a Material<f32>,
    pub(super) storage: &'a Storage,
    pub(super) convention: &'a Convention,
    pub(super) sampling: Sampling,
    /// Most texels of a scene.
    pub(super) texels: usize,
    pub(super) scenes: Vec<Scene>,
    pub(super) progress: &'a Progress,
}

/// The losses of each scene without and with changes, on the texels that both have.
#[derive(Clone, Debug)]
pub(super) struct Paired {
    pub(super) before: Vec<f64>,
    pub(super) after: Vec<f64>,
}

/// The mean; 0 of none.
pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

impl<'a> Trials<'a> {
    pub(super) fn new(
        [ground_truth, prediction]: [&'a Material<f32>; 2],
        storage: &'a Storage,
        convention: &'a Convention,
        [near, distant, texels]: [usize; 3],
        seed: u64,
        progress: &'a Progress,
    ) -> Result<Self, Error> {
        // Texels that are listed take far longer than whole maps.
        let is_whole = ground_truth.width() * ground_truth.height() <= texels;
        let texels = if is_whole { texels } else { texels / 8 };
        let sampling =
            Sampling { near, distant, seed, sampler: Sampler::Sobol, texels: Texels::Sampled(texels) };
        let scenes = sampling.scenes(convention)?;
        Ok(Self { ground_truth, prediction, storage, convention, sampling, texels, scenes, progress })
    }

    /// The losses under each of `trials`.
    pub(super) fn losses(&self, trials: &[Vec<Change>]) -> Result<Vec<Paired>, Error> {
        let bytes = 10 * size_of::<f32>() * self.ground_truth.width() * self.ground_truth.height();
        let mut losses = Vec::new();
        for trials in trials.chunks((MOST_BYTES / bytes.max(1)).max(1)) {
            let corrected = trials.iter().map(|changes| self.corrected(changes));
            losses.extend(self.of_corrected(&corrected.collect::<Result<Vec<_>, Error>>()?)?);
        }
        Ok(losses)
    }

    fn corrected(&self, changes: &[Change]) -> Result<Corrected, Error> {
        Corrected::new(self.prediction, changes, self.storage)
    }

    fn of_corrected(&self, corrected: &[Corrected]) -> Result<Vec<Paired>, Error> {
        let whole: Vec<&Material<f32>> =
            corrected.iter().filter(|one| one.texels.is_none()).map(|one| &one.material).collect();
        let materials: Vec<_> = std::iter::once(self.prediction).chain(whole).collect();
        let comparison = Comparison::new(self.ground_truth, &materials, *self.convention)?.without_pilot();
        let outcome = comparison.run(&Request::Scenes(self.sampling), &self.progress.part())?;
        let mut losses = outcome.losses.into_iter().map(|loss| loss.per_scene);
        let before = losses.next().unwrap_or_default();
        let one = |corrected: &Corrected| {
            let paired = match &corrected.texels {
                Some(texels) => self.on_texels(&corrected.material, texels)?,
                None => Paired { before: before.clone(), after: losses.next().unwrap_or_default() },
            };
            match corrected.stops {
                Some(stops) => self.exposed(paired, corrected, stops),
                None => Ok(paired),
            }
        };
        corrected.iter().map(one).collect()
    }

    /// On a part of the texels: in each scene on those of its subset that are among `texels`, which are in order. Trials of other parts
    /// are compared on the same subset. A scene without any has a loss of 0.
    fn on_texels(&self, material: &Material<f32>, texels: &[usize]) -> Result<Paired, Error> {
        let materials = [self.prediction, material];
        let comparison = Comparison::new(self.ground_truth, &materials, *self.convention)?;
        let progress = self.progress.part();
        let of_scenes = |scenes: &[Scene], some: &[usize]| match some {
            [] => Ok(vec![vec![0.0; scenes.len()]; materials.len()]),
            some => f32::cpu().scene_losses(&comparison, scenes, Some(some), &Progress::default()),
        };
        progress.begin(self.scenes.len() as u64);
        let of_scene = |(number, scene): (usize, &Scene)| {
            let subset = self.subset(number).into_iter().filter(|texel| texels.binary_search(texel).is_ok());
            let losses = of_scenes(std::slice::from_ref(scene), &subset.collect::<Vec<_>>())?;
            progress.step().map(|()| losses)
        };
        let losses = match self.sampling.texels.sampled(self.ground_truth.size()) {
            None => vec![of_scenes(&self.scenes, texels)?],
            Some(_) => self.scenes.par_iter().enumerate().map(of_scene).collect::<Result<Vec<_>, _>>()?,
        };
        let of = |place: usize| losses.iter().flat_map(|losses| losses[place].iter().copied()).collect();
        Ok(Paired { before: of(0), after: of(1) })
    }

    /// The independent random subset of the texels that a scene is compared on.
    fn subset(&self, number: usize) -> Vec<usize> {
        let Sampling { near, seed, sampler, .. } = self.sampling;
        let kind = self.scenes[number].kind;
        let index = if kind == Kind::Near { number } else { number - near };
        sampler.texels(seed, kind, index, self.texels, self.ground_truth.size())
    }

    /// Adds what an exposure changes on random texels of each scene.
    fn exposed(&self, paired: Paired, corrected: &Corrected, stops: [f64; 3]) -> Result<Paired, Error> {
        let epsilon = self.convention.epsilon;
        let change = |pairs: &Vec<Pair>| {
            exposure::loss(pairs, stops, epsilon) - exposure::loss(pairs, [0.0; 3], epsilon)
        };
        let changes = self.radiances(corrected)?;
        let after = paired.after.iter().zip(&changes).map(|(loss, pairs)| loss + change(pairs)).collect();
        Ok(Paired { after, ..paired })
    }

    fn radiances(&self, corrected: &Corrected) -> Result<Vec<Vec<Pair>>, Error> {
        let progress = self.progress.part();
        radiances(
            self.ground_truth,
            corrected,
            &self.sampling,
            &self.scenes,
            RADIANCES,
            self.convention,
            &progress,
        )
    }

    /// The stops of red, green and blue with the least loss, each or all together, after `changes` other than exposures.
    pub(super) fn best_exposure(&self, changes: &[Change], per_channel: bool) -> Result<[f64; 3], Error> {
        let pairs = self.radiances(&self.corrected(changes)?)?;
        Ok(exposure::best_exposure(&pairs, self.convention.epsilon, per_channel))
    }
}
