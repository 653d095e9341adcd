//! The losses of all predictions of all materials.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use serde_json::json;

use crate::diagnose::{Storage, diagnose, floor};
use crate::error::Error;
use crate::metrics::of_maps;
use crate::rank::most_scenes;
use svbrdf_core::loss::{Comparison, check_same_size};
use svbrdf_core::material::{Grid, Material};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::parallel;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error as FilesError;

use super::record::{
    CandidateFile, Case, DatasetReading, DatasetSettings, KnownLoss, Mark, MaterialResult, PredictionResult,
};
use super::remark::{MASK, Remark};
use super::results::{Key, KnownNeighbours, PairResult, ResultsFolder};
use svbrdf_files::read::{self, Dependencies, MaterialPath, Neighbours, ReadOptions};

/// The results of a run over a data set.
#[derive(Clone, Debug, PartialEq)]
pub struct DatasetResults {
    /// Of every case, in order.
    pub results: Vec<MaterialResult>,
    /// The files of the results folder that cannot be used: lines.
    pub notes: Vec<String>,
    /// How many results could not be added to the folder, and why.
    pub unkept: Option<String>,
}

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
) -> Result<DatasetResults, Error> {
    let evaluation = Evaluation::new(settings, reading, results, progress)?;
    progress.begin(cases.len() as u64);
    let of_case = |index: usize| {
        let result = evaluation.material(&cases[index])?;
        progress.step()?;
        Ok::<_, Error>(result)
    };
    let found = parallel::try_map(cases.len(), of_case)?;
    let (notes, unkept) = evaluation.end()?;
    Ok(DatasetResults { results: found, notes, unkept })
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
        let of = |candidate| {
            let key = key(candidate);
            let known = load(&key);
            (key, known)
        };
        case.candidates.iter().map(of).collect()
    }

    /// The result of a material of which everything is known.
    fn whole(&self, case: &Case, found: &Found) -> Option<MaterialResult> {
        let of = |(candidate, (_, known)): (&CandidateFile, &(_, Option<PairResult>))| match known {
            Some(known) => Some(known.prediction.clone()),
            None => candidate.missing.clone().map(|problem| without_loss(candidate, problem)),
        };
        // Where a result is known, so is the ground truth.
        let PairResult { reading, floor, .. } = found.iter().find_map(|(_, known)| known.clone())?;
        let predictions = case.candidates.iter().zip(found).map(of).collect::<Option<_>>()?;
        let (index, material) = (case.index, case.material.clone());
        Some(MaterialResult { index, material, seed: self.seed(case), reading, floor, predictions })
    }

    /// The result of a material, of which what was found is not computed again.
    fn computed(&self, case: &Case, found: Found) -> Result<MaterialResult, Error> {
        let (index, material, seed) = (case.index, case.material.clone(), self.seed(case));
        let mut truth = open(&case.ground_truth, &self.reading.ground_truths, self.reading.strict);
        truth.remarks.retain(|remark| !self.reading.mask || remark.doubt.as_deref() != Some(MASK));
        let floor = self.floor(&truth, seed)?;
        let mut predictions = Vec::new();
        for (candidate, (key, known)) in case.candidates.iter().zip(found) {
            let prediction = match known {
                Some(known) => known.prediction,
                None => self.new_prediction(case, candidate, &truth, floor, (key, seed))?,
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
        let DatasetSettings { target_error, scenes, metrics, diagnose, .. } = self.settings;
        let Convention { name, .. } = self.convention;
        // That of a file by its content.
        let is_named = name.parse().is_ok_and(|named: Convention| named == self.convention);
        let convention = if is_named { json!(name) } else { json!(self.convention) };
        let mut of = json!({
            "format": 2,
            "convention": convention,
            "target_error": target_error,
            "seed": seed,
            "metrics": metrics,
            "diagnose": diagnose,
            "strict": self.reading.strict,
            "ground_truth": material(&case.ground_truth, &truth.sha256),
            "prediction": material(path, &prediction.sha256),
            "method": method,
            "sample": sample,
        });
        if self.reading.mask {
            of["mask"] = json!("alpha");
        }
        if let Some(registration) = self.reading.registrations.get(method) {
            of["registration"] = json!(registration);
        }
        if let Some(scenes) = scenes {
            of["scenes"] = scenes.key();
        }
        Some(Key::new(of, truth.files.iter().chain(&prediction.files).cloned().collect()))
    }

    /// The result of a prediction that is not known, which is kept if it has a loss.
    fn new_prediction(
        &self,
        case: &Case,
        candidate: &CandidateFile,
        truth: &Opened,
        floor: Option<f64>,
        (key, seed): (Option<Key>, u64),
    ) -> Result<PredictionResult, Error> {
        let opened = self.open(candidate, truth);
        // Not of files that were written while they were read.
        let found = self.dependencies(&case.ground_truth, &self.reading.ground_truths);
        let now = found.and_then(|found| self.key(case, candidate, &found, seed));
        let kept = key.filter(|key| now.as_ref() == Some(key)).and_then(|key| {
            let looked_at = truth.neighbours.iter().chain(&opened.neighbours);
            let neighbours: Option<Vec<_>> = looked_at.map(|one| KnownNeighbours::of(one, &key)).collect();
            Some((key, neighbours?))
        });
        let prediction = self.prediction(candidate, truth, opened, floor.unwrap_or(0.0), seed)?;
        if let (Some(folder), Some((key, neighbours)), Some(_)) = (&self.results, kept, prediction.known) {
            let (reading, prediction) = (truth.remarks.clone(), prediction.clone());
            let result = PairResult { reading, floor, prediction, neighbours };
            folder.add(&case.material, &key, &result, self.progress)?;
        }
        Ok(prediction)
    }

    /// A prediction of the size of the ground truth, or why there is none.
    pub(super) fn open(&self, candidate: &CandidateFile, truth: &Opened) -> Opened {
        let truth = match (&truth.found, &candidate.missing) {
            (Err(problem), _) => return Opened::failed(format!("ground truth: {problem}")),
            (_, Some(problem)) => return Opened::failed(problem.clone()),
            (Ok(truth), None) => truth,
        };
        let opened = open(&candidate.path, self.reading.of_method(&candidate.method), self.reading.strict);
        let registration = self.reading.registrations.get(&candidate.method);
        let (mut registered, mut kept) = (None, None);
        let found = opened.found.and_then(|found| {
            let pair = [&truth.material, &found.material];
            let other_size = registration.filter(|_| pair[0].size() != pair[1].size());
            let [part, material] = match other_size {
                Some(_) if self.reading.mask => {
                    return Err(
                        "a mask is not cut to predictions of another size; leave out --mask".to_owned()
                    );
                }
                Some(registration) => registration.applied(pair).map_err(|problem| problem.to_string())?,
                None => {
                    check_same_size(pair[0], pair[1]).map_err(|problem| problem.to_string())?;
                    if !self.reading.mask {
                        return Ok(found);
                    }
                    kept = Some(truth.kept()?);
                    let texels = kept.iter().flatten().copied().collect::<Vec<_>>();
                    pair.map(|material| material.gathered(&texels, [texels.len(), 1]))
                }
            };
            registered = Some(OpenedMaterial { material: part, mask: None, storage: truth.storage.clone() });
            Ok(OpenedMaterial { material, ..found })
        });
        let kept = kept.map(|kept| (truth.material.grid(), kept));
        Opened { found, truth: registered, kept, ..opened }
    }

    /// The result of a prediction; `floor` is that of the ground truth.
    fn prediction(
        &self,
        candidate: &CandidateFile,
        truth: &Opened,
        opened: Opened,
        floor: f64,
        seed: u64,
    ) -> Result<PredictionResult, Error> {
        let truth = opened.truth.as_ref().or(truth.found.as_ref().ok());
        let pair = truth.zip(opened.found.as_ref().ok());
        let metrics = pair.filter(|_| self.settings.metrics).map(metrics).unwrap_or_default();
        let marks = pair.filter(|_| self.settings.diagnose);
        let marks = marks.map(|pair| self.marks(pair, floor, seed)).transpose()?;
        let known = pair.map(|pair| self.loss(pair, opened.kept.as_ref(), seed)).transpose()?;
        // `open` gives the problem of the ground truth, too.
        let error = opened.found.err();
        let reading = opened.remarks;
        Ok(PredictionResult {
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
        kept: Option<&(Grid, Vec<usize>)>,
        seed: u64,
    ) -> Result<KnownLoss, Error> {
        let predictions = [&prediction.material];
        let mut comparison = Comparison::new(&truth.material, &predictions, self.convention)?;
        if let Some((grid, texels)) = kept {
            comparison = comparison.at(*grid, texels);
        }
        let request = self.settings.request(seed);
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
        let found = diagnose(pair, storages, &self.convention, floor, seed, &self.progress.part())?;
        Ok(found.marked().map(Mark::from).collect())
    }
}

/// The result of a prediction that was not read.
fn without_loss(candidate: &CandidateFile, problem: String) -> PredictionResult {
    let CandidateFile { method, sample, path, .. } = candidate.clone();
    let path = path.display().to_string();
    let (error, metrics) = (Some(problem), BTreeMap::new());
    PredictionResult { method, sample, path, known: None, error, reading: Vec::new(), metrics, marks: None }
}

/// A ground truth and a prediction of one size.
type OpenedPair<'a> = (&'a OpenedMaterial, &'a OpenedMaterial);

/// A material that was opened, or why it cannot be used.
pub(super) struct Opened {
    pub(super) found: Result<OpenedMaterial, String>,
    /// The part of the ground truth that a prediction of another size is compared with.
    pub(super) truth: Option<OpenedMaterial>,
    /// The texels that a mask keeps, and the grid that they are texels of.
    kept: Option<(Grid, Vec<usize>)>,
    remarks: Vec<Remark>,
    neighbours: Option<Neighbours>,
}

impl Opened {
    fn failed(problem: String) -> Self {
        Self { found: Err(problem), truth: None, kept: None, remarks: Vec::new(), neighbours: None }
    }
}

/// A material that was read, and how it is stored.
pub(super) struct OpenedMaterial {
    pub(super) material: Material<f32>,
    /// Which texels are opaque.
    mask: Option<Arc<[bool]>>,
    storage: Storage,
}

impl OpenedMaterial {
    /// The texels that its mask keeps, at least one.
    fn kept(&self) -> Result<Vec<usize>, String> {
        let [width, height] = self.material.size();
        let mask = self.mask.as_ref().filter(|mask| mask.len() == width * height);
        let mask =
            mask.ok_or("no alpha of the ground truth is a mask, 0 or 1 nearly everywhere; leave out --mask")?;
        let kept: Vec<usize> = (0..mask.len()).filter(|texel| mask[*texel]).collect();
        if kept.is_empty() { Err("the mask of the ground truth keeps no texel".to_owned()) } else { Ok(kept) }
    }
}

/// Reads a material.
pub(super) fn open(path: &Path, options: &ReadOptions, strict: bool) -> Opened {
    let read = match read::read::<f32>(path, options, &Progress::default()) {
        Ok(read) => read,
        Err(problem) => return Opened::failed(problem.to_string()),
    };
    let guesses = if strict { read.refuse_guesses(path) } else { Ok(()) };
    let (remarks, storage) = (Remark::of(&read), read.storage());
    let found = guesses.map(|()| OpenedMaterial { material: read.material, mask: read.mask, storage });
    let found = found.map_err(|problem| problem.to_string());
    Opened { found, truth: None, kept: None, remarks, neighbours: read.neighbours }
}

/// The metrics of the maps.
fn metrics((truth, prediction): OpenedPair<'_>) -> BTreeMap<String, f64> {
    let metrics = of_maps(&truth.material, &prediction.material).unwrap_or_default();
    metrics.into_iter().map(|metric| (metric.name.to_owned(), metric.value)).collect()
}
