//! The losses of all predictions of all materials.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::json;

use crate::diagnose::{Explained, floor};
use crate::error::Error;
use crate::metrics::{Kept, RenderedScenes, of_masked_maps, of_renderings};
use crate::protocols::MaskSource;
use crate::rank::most_scenes;
use crate::results::{KeptAnswer, Key, ResultsFolder};
use svbrdf_core::loss::Comparison;
use svbrdf_core::material::Mask;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::parallel;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error as FilesError;

use super::opened::{Opened, OpenedMaterial, OpenedPair};
use super::reading::DatasetReading;
use super::record::{
    CandidateFile, Case, DatasetSettings, KnownLoss, Mark, MaterialResult, PairResult, PredictionResult,
};
use super::remark::MASK;
use svbrdf_files::read::{Dependencies, MaterialPath, ReadOptions};

/// The results of `cases` in order, computed in parallel.
///
/// Each prediction has as many of the scenes of its material as its target error needs, at most [`most_scenes`]: the scenes are the
/// first ones of one sequence. A material that cannot be read or compared has a result, too, with the reason. A material is one
/// step of `progress`. The results do not depend on the number of threads, nor on which other materials and predictions there
/// are.
///
/// A loss in the folder `results` is not computed again, and each new one is added to it as it comes. The folder is made where
/// there is none. What fails is not kept, and tried again. A result that cannot be written ends nothing.
///
/// # Errors
/// [`Cancelled`](Error::is_cancelled), [`UnknownName`](svbrdf_core::error::Error::UnknownName) for an unknown convention;
/// [`FilesError::Unwritable`] and [`FilesError::Unreadable`] of the folder.
pub fn run(
    cases: &[Case],
    settings: &DatasetSettings,
    reading: &DatasetReading,
    results: Option<&Path>,
    progress: &Progress,
) -> Result<KeptAnswer<Vec<MaterialResult>>, Error> {
    let evaluation = Evaluation::new(settings, reading, results, progress)?;
    progress.begin(cases.len() as u64);
    let of_case = |index: usize| {
        let result = evaluation.material(&cases[index])?;
        progress.step()?;
        Ok::<_, Error>(result)
    };
    let answer = parallel::try_map(cases.len(), of_case)?;
    let (notes, unkept) = evaluation.end()?;
    Ok(KeptAnswer { answer, notes, unkept })
}

/// The evaluation of a data set, material by material: what all results depend on.
#[derive(Debug)]
pub struct Evaluation<'a> {
    pub(super) settings: &'a DatasetSettings,
    convention: Convention,
    /// Of the scenes of each material.
    seeds: Vec<u64>,
    pub(super) reading: &'a DatasetReading,
    /// Those that are known.
    results: Option<ResultsFolder>,
    pub(super) progress: &'a Progress,
}

/// What the results folder has of the predictions of a material, and the keys of all.
type Found = Vec<(Option<Key>, Option<PairResult>)>;

impl<'a> Evaluation<'a> {
    /// With the losses of the folder `results`, where one is given, as [`run`].
    ///
    /// # Errors
    /// As [`run`], but for cancellation.
    pub fn new(
        settings: &'a DatasetSettings,
        reading: &'a DatasetReading,
        results: Option<&Path>,
        progress: &'a Progress,
    ) -> Result<Self, Error> {
        let convention = settings.convention.convention;
        let results = results.map(ResultsFolder::open).transpose()?;
        Ok(Self { settings, convention, seeds: settings.seeds(), reading, results, progress })
    }

    /// The result of a material, where the results folder has all of it.
    pub fn known(&self, case: &Case) -> Option<MaterialResult> {
        self.results.as_ref().and_then(|_| self.whole(case, &self.found(case)))
    }

    /// The result of a material: from the results folder, or computed and added to it.
    ///
    /// # Errors
    /// As [`run`].
    pub fn material(&self, case: &Case) -> Result<MaterialResult, Error> {
        let found = self.found(case);
        match self.whole(case, &found) {
            Some(result) => Ok(result),
            None => self.computed(case, found),
        }
    }

    /// What a user should know about the results folder: lines, and the results that are not kept.
    ///
    /// # Errors
    /// [`Cancelled`](Error::is_cancelled).
    pub fn end(self) -> Result<(Vec<String>, Option<String>), Error> {
        let progress = self.progress;
        Ok(self.results.map(|results| results.end(progress)).transpose()?.unwrap_or_default())
    }

    pub(super) fn seed(&self, case: &Case) -> u64 {
        self.seeds.get(case.index).copied().unwrap_or(self.settings.seed)
    }

    fn found(&self, case: &Case) -> Found {
        let truth = self.dependencies(&case.ground_truth, &self.reading.ground_truths);
        let key = |candidate| self.key(case, candidate, truth.as_ref()?, self.seed(case));
        let load = |key: &Option<Key>| self.results.as_ref()?.load(&case.material, key.as_ref()?);
        let is_diagnosed = self.settings.diagnose;
        let of = |candidate| {
            let key = key(candidate);
            // A loss does not depend on whether it is diagnosed.
            let other = || load(&Some(key.as_ref()?.with("diagnose", json!(!is_diagnosed))));
            let mut known: Option<PairResult> = load(&key).or_else(other);
            if let Some(known) = known.as_mut().filter(|_| !is_diagnosed) {
                (known.floor, known.prediction.marks) = (None, None);
            }
            (key, known)
        };
        case.candidates.iter().map(of).collect()
    }

    /// The result of a material of which everything is known.
    fn whole(&self, case: &Case, found: &Found) -> Option<MaterialResult> {
        let of = |(candidate, (_, known)): (&CandidateFile, &(_, Option<PairResult>))| match known {
            Some(known) => self.has_all(known).then(|| known.prediction.clone()),
            None => candidate.missing.clone().map(|problem| without_loss(candidate, problem)),
        };
        // Where a result is known, so is the ground truth.
        let PairResult { reading, floor, .. } = found.iter().find_map(|(_, known)| known.clone())?;
        let predictions = case.candidates.iter().zip(found).map(of).collect::<Option<_>>()?;
        let (index, material) = (case.index, case.material.clone());
        Some(MaterialResult { index, material, seed: self.seed(case), reading, floor, predictions })
    }

    /// Whether the diagnosis is known, too, where it is asked for.
    fn has_all(&self, known: &PairResult) -> bool {
        known.prediction.marks.is_some() == self.settings.diagnose
    }

    /// The result of a material, of which what was found is not computed again.
    fn computed(&self, case: &Case, found: Found) -> Result<MaterialResult, Error> {
        let (index, material, seed) = (case.index, case.material.clone(), self.seed(case));
        let mut truth = Opened::ground_truth(case, self.reading);
        let is_masked = self.reading.mask.is_some();
        truth.remarks.retain(|remark| !is_masked || remark.doubt.as_deref() != Some(MASK));
        let floor = self.floor(&truth, seed)?;
        let mut predictions = Vec::new();
        for (candidate, (key, known)) in case.candidates.iter().zip(found) {
            let prediction = match known {
                Some(known) if self.has_all(&known) => known.prediction,
                known => self.new_prediction(case, candidate, &truth, floor, (key, known, seed))?,
            };
            predictions.push(prediction);
        }
        Ok(MaterialResult { index, material, seed, reading: truth.remarks, floor, predictions })
    }

    /// Those of a material, where there is a results folder and the material can be located.
    fn dependencies(&self, path: &Path, options: &ReadOptions) -> Option<Dependencies> {
        self.results.as_ref().and_then(|_| MaterialPath::new(path, options).dependencies().ok())
    }

    /// What the result of a prediction depends on; `None` where it cannot be known before it is computed.
    fn key(&self, case: &Case, candidate: &CandidateFile, truth: &Dependencies, seed: u64) -> Option<Key> {
        let CandidateFile { method, sample, path, .. } = candidate;
        let prediction = self.dependencies(path, self.reading.of_method(method))?;
        // How it is read is a part of the digest.
        let material =
            |path: &Path, sha256: &str| json!({"path": path.display().to_string(), "sha256": sha256});
        let DatasetSettings { scenes, diagnose, .. } = self.settings;
        let Convention { name, .. } = self.convention;
        // That of a file by its content.
        let is_named = name.parse().is_ok_and(|named: Convention| named == self.convention);
        let convention = if is_named { json!(name) } else { json!(self.convention) };
        let mut of = json!({
            "format": 3,
            "convention": convention,
            "target_error": scenes.target(),
            "seed": seed,
            "metrics": self.settings.computes()[0],
            "diagnose": diagnose,
            "strict": self.reading.strict,
            "ground_truth": material(&case.ground_truth, &truth.sha256),
            "prediction": material(path, &prediction.sha256),
            "method": method,
            "sample": sample,
        });
        if let Some(mask) = &self.reading.mask {
            of["mask"] = json!(mask);
            if let Some(digest) = mask.digest(&case.material) {
                of["mask_sha256"] = json!(digest);
            }
        }
        if self.reading.roughness != [None; 2] {
            of["roughness"] = json!(self.reading.roughness);
        }
        if self.settings.computes()[1] {
            of["metrics of renderings"] = json!(true);
        }
        if let Some(registration) = self.reading.registrations.get(method) {
            of["registration"] = json!(registration);
        }
        if let Some(scenes) = scenes.key() {
            of["scenes"] = scenes;
        }
        Some(Key::new(of))
    }

    /// The result of a prediction that is not known, or not its diagnosis, which is kept if it has a loss.
    fn new_prediction(
        &self,
        case: &Case,
        candidate: &CandidateFile,
        truth: &Opened,
        floor: Option<f64>,
        (key, known, seed): (Option<Key>, Option<PairResult>, u64),
    ) -> Result<PredictionResult, Error> {
        let opened = Opened::beside(candidate, truth, self.reading);
        // Not of files that were written while they were read.
        let found = self.dependencies(&case.ground_truth, &self.reading.ground_truths);
        let now = found.and_then(|found| self.key(case, candidate, &found, seed));
        let kept = key.filter(|key| now.as_ref() == Some(key));
        let prediction = self.prediction(candidate, truth, opened, floor.unwrap_or(0.0), (known, seed))?;
        if let (Some(folder), Some(key), Some(_)) = (&self.results, kept, prediction.known) {
            let (reading, prediction) = (truth.remarks.clone(), prediction.clone());
            let result = PairResult { reading, floor, prediction };
            folder.add(&case.material, &key, &result, self.progress)?;
        }
        Ok(prediction)
    }

    /// The result of a prediction, of which a loss that is `known` is not computed again; `floor` is that of the ground truth.
    fn prediction(
        &self,
        candidate: &CandidateFile,
        truth: &Opened,
        opened: Opened,
        floor: f64,
        (known, seed): (Option<PairResult>, u64),
    ) -> Result<PredictionResult, Error> {
        let truth = opened.truth.as_ref().or(truth.found.as_ref().ok());
        let pair = truth.zip(opened.found.as_ref().ok());
        let kept = opened.kept.as_ref();
        let known = known.map(|known| (known.prediction.metrics, known.prediction.known));
        let new =
            |pair| Ok::<_, Error>((self.metrics(pair, kept, seed)?, Some(self.loss(pair, kept, seed)?)));
        let (metrics, known) = match known {
            Some(known) => known,
            None => pair.map(new).transpose()?.unwrap_or_default(),
        };
        let marks = pair.filter(|_| self.settings.diagnose);
        let marks = marks.map(|pair| self.marks(pair, floor, seed)).transpose()?;
        let size = pair.map(|(truth, _)| truth.material.size());
        // `open` gives the problem of the ground truth, too.
        let error = opened.found.err();
        let reading = opened.remarks;
        Ok(PredictionResult {
            size,
            known,
            error,
            reading,
            metrics,
            marks,
            ..without_loss(candidate, String::new())
        })
    }

    /// The loss of a pair; of texels that a mask keeps, with their places.
    fn loss(
        &self,
        (truth, prediction): OpenedPair<'_>,
        kept: Option<&Mask>,
        seed: u64,
    ) -> Result<KnownLoss, Error> {
        let texels = kept.map(Mask::texels);
        let pair = [&truth.material, &prediction.material].map(|material| match &texels {
            Some(texels) => material.gathered(texels, [texels.len(), 1]),
            None => material.clone(),
        });
        let predictions = [&pair[1]];
        let mut comparison = Comparison::new(&pair[0], &predictions, self.convention)?;
        if let Some(texels) = &texels {
            comparison = comparison.at(truth.material.grid(), texels);
        }
        let request = self.settings.scenes.of_seed(seed);
        let outcome = comparison.at_most(most_scenes(1)).run(&request, &self.progress.part())?;
        let estimate = outcome.losses.first().map(|loss| loss.estimate);
        let estimate =
            estimate.ok_or_else(|| FilesError::Internal("a comparison without a loss".to_owned()))?;
        // Listed scenes are the question itself, and no sample.
        let sampled = outcome.sampling;
        Ok(KnownLoss {
            loss: estimate.mean,
            standard_error: sampled.and(estimate.standard_error).unwrap_or(0.0),
            interval95: sampled.and(estimate.interval95).unwrap_or([estimate.mean; 2]),
            scenes: outcome.scenes.len(),
        })
    }

    /// The metrics that are asked for, by name.
    fn metrics(
        &self,
        (truth, prediction): OpenedPair<'_>,
        kept: Option<&Mask>,
        seed: u64,
    ) -> Result<BTreeMap<String, f64>, Error> {
        let [maps, renderings] = self.settings.computes();
        let (truth, prediction) = (&truth.material, &prediction.material);
        let mut metrics = Vec::new();
        if maps {
            let count_all = self.reading.mask == Some(MaskSource::AlphaElseBlack);
            let mask = kept.map(|mask| Kept { texels: mask.kept(), count_all });
            metrics = of_masked_maps(truth, prediction, mask)?;
        }
        let scenes = self.settings.scenes.of_seed(seed).scenes(&self.convention)?;
        if let Some(scenes) = scenes.filter(|_| renderings && kept.is_none()) {
            let convention = &self.convention;
            let (sampler, exposure_ev) = (Sampler::Random, 0.0);
            let rendered = RenderedScenes { scenes: &scenes, sampler, convention, exposure_ev };
            metrics.extend(of_renderings(truth, prediction, &rendered, &self.progress.part())?);
        }
        Ok(metrics.into_iter().map(|metric| (metric.name.to_owned(), metric.value)).collect())
    }

    /// The floor of a ground truth that was read, where diagnoses are asked for.
    fn floor(&self, truth: &Opened, seed: u64) -> Result<Option<f64>, Error> {
        let truth = truth.found.as_ref().ok().filter(|_| self.settings.diagnose);
        let of = |truth: &OpenedMaterial| {
            floor(&truth.material, &truth.storage, &self.convention, seed, &self.progress.part())
        };
        Ok(truth.map(of).transpose()?.map(|floor| floor.mean))
    }

    /// The marks of the diagnosis of a prediction; none where its loss is below `floor`.
    fn marks(&self, (truth, prediction): OpenedPair<'_>, floor: f64, seed: u64) -> Result<Vec<Mark>, Error> {
        let pair = [&truth.material, &prediction.material];
        let storages = [&truth.storage, &prediction.storage];
        let progress = self.progress.part();
        let found = Explained::of(pair, storages, &self.convention, floor, seed, &progress)?;
        Ok(found.marked().marked().map(Mark::from).collect())
    }
}

/// The result of a prediction that was not read.
fn without_loss(candidate: &CandidateFile, problem: String) -> PredictionResult {
    let CandidateFile { method, sample, path, .. } = candidate.clone();
    let path = path.display().to_string();
    PredictionResult { method, sample, path, error: Some(problem), ..PredictionResult::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::Source;
    use svbrdf_core::loss::Request;
    use svbrdf_files::convention::ChosenConvention;

    #[test]
    fn a_loss_that_is_known_stays_as_it_is_diagnosed_and_one_that_is_diagnosed_is_known_without() {
        let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/samples");
        let predictions = vec![(None, samples.join("blurred_normals.png"))];
        let source = Source::predictions(samples.join("worn_tiles.png"), predictions);
        let (cases, reading, progress) =
            (source.cases().unwrap(), DatasetReading::default(), Progress::default());
        let request = Request::Accuracy { target: 0.2, seed: 0 };
        let plain = DatasetSettings::new(source, ChosenConvention::default(), request, &cases);
        let with = DatasetSettings { diagnose: true, ..plain.clone() };
        let [first, second] = [(); 2].map(|()| tempfile::tempdir().unwrap());
        let of = |settings, folder| Evaluation::new(settings, &reading, Some(folder), &progress).unwrap();
        let put = |evaluation: &Evaluation<'_>, prediction: PredictionResult| {
            let key = evaluation.found(&cases[0])[0].0.clone().unwrap();
            let result = PairResult { reading: Vec::new(), floor: Some(0.5), prediction };
            evaluation.results.as_ref().unwrap().add(&cases[0].material, &key, &result, &progress).unwrap();
        };
        let evaluation = of(&plain, first.path());
        let mut prediction = evaluation.material(&cases[0]).unwrap().predictions.remove(0);
        // As if it were another one.
        prediction.known.as_mut().unwrap().loss = 42.0;
        put(&evaluation, prediction);
        let evaluation = of(&with, first.path());
        assert!(evaluation.known(&cases[0]).is_none());
        let prediction = evaluation.material(&cases[0]).unwrap().predictions.remove(0);
        assert_eq!(prediction.known.unwrap().loss, 42.0);
        assert!(evaluation.known(&cases[0]).is_some() && prediction.marks.is_some());
        put(&of(&with, second.path()), prediction);
        let known = of(&plain, second.path()).known(&cases[0]).unwrap();
        let prediction = &known.predictions[0];
        assert_eq!((prediction.known.unwrap().loss, &prediction.marks, known.floor), (42.0, &None, None));
    }
}
