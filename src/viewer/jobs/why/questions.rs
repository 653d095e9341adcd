//! Questions of the tab *Why*: where and by what predictions are wrong.

use std::sync::Arc;

use serde_json::json;

use svbrdf_core::loss::{Comparison, Estimate, LossOptions, Request};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_evaluate::analyses::AnyAnalysis;
use svbrdf_evaluate::diagnose::{Diagnosis, diagnose, floor};
use svbrdf_evaluate::report::{AnalysisInput, Reader, Table};
use svbrdf_evaluate::why::{Attribution, RankedScene, TAIL, Worst, attribute, worst, worst_first};

use crate::model::material::loaded::LoadedMaterial;
use crate::model::view::ViewState;

use super::thumbnails::{self, Thumbnails};
use crate::error::Error;
use crate::jobs::answers::content::{ComparedPair, Content, read_all};
use crate::jobs::answers::{Answer, Answered, Answers, Question, Work};

/// Half of the 95% interval of a loss that is attributed, as a share of the loss.
pub const ATTRIBUTION_TARGET: f64 = 0.01;

/// The loss of each prediction under a light and view. The ground truth is the first of the materials.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneLosses {
    pub materials: Vec<Content>,
    pub scene: Scene,
    pub convention: Convention,
}

impl SceneLosses {
    /// What is drawn under this view, where there is a prediction.
    pub fn of(materials: &[LoadedMaterial], view: &ViewState) -> Option<Self> {
        let (scene, convention) = (view.scene, view.convention());
        (materials.len() > 1).then(|| Self { materials: Content::all(materials), scene, convention })
    }

    /// The latest losses of these materials, and whether they are of this scene.
    pub fn drawn(&self, answers: &Answers) -> Option<(Arc<Answered<Vec<f64>>>, bool)> {
        if let Answer::Ready(losses) = answers.get(self) {
            return Some((losses, true));
        }
        let latest = answers.latest(|one: &Self| one.materials == self.materials);
        latest.map(|(_, losses)| (losses, false))
    }
}

impl Question for SceneLosses {
    type Answer = Vec<f64>;
    const IS_SHORT: bool = true;
    const KEPT: usize = 1;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Vec<f64>, Error> {
        let read = read_all(&self.materials)?;
        let all: Vec<_> = read.iter().map(|one| one.material()).collect();
        let comparison = Comparison::new(all[0], &all[1..], self.convention)?;
        let outcome = comparison.run(&Request::Listed(vec![self.scene]), work.progress())?;
        Ok(outcome.losses.iter().map(|loss| loss.estimate.mean).collect())
    }
}

/// The loss that a ground truth cannot resolve.
#[derive(Clone, Debug, PartialEq)]
pub struct Floor {
    pub ground_truth: Content,
    pub convention: Convention,
    pub seed: u64,
}

impl Floor {
    fn of(pair: &ComparedPair, seed: u64) -> Self {
        Self { ground_truth: pair.ground_truth.clone(), convention: pair.convention, seed }
    }
}

impl Question for Floor {
    type Answer = Estimate;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Estimate, Error> {
        let read = self.ground_truth.read()?;
        Ok(floor(read.material(), &read.storage, &self.convention, self.seed, work.progress())?)
    }
}

/// Whether something trivial explains the loss of a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnose {
    pub pair: ComparedPair,
    /// The loss that its ground truth cannot resolve.
    pub floor: f64,
    pub seed: u64,
}

impl Diagnose {
    fn of(pair: &ComparedPair, seed: u64, floor: Option<&Answered<Estimate>>) -> Self {
        Self { pair: pair.clone(), floor: floor.map_or(0.0, |floor| floor.mean), seed }
    }
}

impl Question for Diagnose {
    type Answer = Diagnosis;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Diagnosis, Error> {
        let [truth, prediction] = self.pair.read()?;
        let materials = [truth.material(), prediction.material()];
        let storages = [&truth.storage, &prediction.storage];
        Ok(diagnose(materials, storages, &self.pair.convention, self.floor, self.seed, work.progress())?)
    }
}

/// How much of the loss of a pair comes from each map.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    pub pair: ComparedPair,
    pub seed: u64,
}

impl Question for Attribute {
    type Answer = Attribution;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Attribution, Error> {
        let [truth, prediction] = self.pair.read()?;
        let request = Request::Accuracy { target: ATTRIBUTION_TARGET, seed: self.seed };
        Ok(attribute(
            truth.material(),
            prediction.material(),
            &self.pair.convention,
            &request,
            work.progress(),
        )?)
    }
}

/// The scenes of the loss of a pair, worst first.
#[derive(Clone, Debug, PartialEq)]
pub struct RankScenes {
    pub pair: ComparedPair,
    pub scenes: Request,
}

impl Question for RankScenes {
    type Answer = Vec<RankedScene>;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Vec<RankedScene>, Error> {
        let [truth, prediction] = self.pair.read()?;
        let predictions = [prediction.material()];
        let comparison =
            Comparison::new(truth.material(), &predictions, self.pair.convention)?.without_pilot();
        Ok(worst_first(&comparison.run(&self.scenes, work.progress())?))
    }
}

/// Pictures of the differences of a pair in these scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawScenes {
    pub pair: ComparedPair,
    pub scenes: Vec<Scene>,
}

impl Question for DrawScenes {
    type Answer = Thumbnails;
    const KEPT: usize = 4;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Thumbnails, Error> {
        let [truth, prediction] = self.pair.read()?;
        let materials = [truth.material(), prediction.material()];
        thumbnails::make(materials, &self.pair.convention, &self.scenes, work.progress())
    }
}

/// The scene with the largest loss of a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct FindWorst {
    pub pair: ComparedPair,
    /// Names the scenes that the search starts from.
    pub seed: u64,
}

impl Question for FindWorst {
    type Answer = Worst;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Worst, Error> {
        let [truth, prediction] = self.pair.read()?;
        let materials = [truth.material(), prediction.material()];
        Ok(worst(materials[0], materials[1], &self.pair.convention, self.seed, TAIL, work.progress())?)
    }
}

/// The report of an analysis of a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Analyse {
    /// The name of the analysis.
    pub analysis: &'static str,
    pub pair: ComparedPair,
    pub scenes: Request,
}

/// The report of an analysis of one prediction.
#[derive(Clone, Debug)]
pub struct AnalysisTable {
    /// The lines about its settings.
    pub heading: String,
    pub table: Table,
}

impl Question for Analyse {
    type Answer = AnalysisTable;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<AnalysisTable, Error> {
        let analysis = AnyAnalysis::named(self.analysis)
            .ok_or_else(|| Error::internal(format!("there is no analysis {}", self.analysis)))?;
        let [truth, prediction] = self.pair.read()?;
        let seed = LossOptions { seed: self.scenes.seed(), ..LossOptions::default() };
        let request = match analysis.lists_scenes() {
            true => self.scenes.clone(),
            false => analysis.request(&seed, None)?,
        };
        let input = AnalysisInput {
            ground_truth: truth.material(),
            predictions: vec![prediction.material()],
            storages: vec![&truth.storage, &prediction.storage],
            paths: Vec::new(),
            convention: self.pair.convention,
            request,
            few_scenes: false,
            mask: None,
        };
        let report = analysis.run(&input, json!({}), work.progress())?;
        Ok(AnalysisTable { heading: report.heading(), table: report.table(Reader::Person) })
    }
}

/// The floor and the diagnosis of a pair.
pub fn diagnosis(
    answers: &Answers,
    pair: &ComparedPair,
    seed: u64,
) -> (Option<Arc<Answered<Estimate>>>, Answer<Diagnosis>) {
    let floor = match answers.get(&Floor::of(pair, seed)) {
        Answer::Running(fraction, elapsed) => return (None, Answer::Running(fraction, elapsed)),
        floor => floor.ready(),
    };
    let found = answers.get(&Diagnose::of(pair, seed, floor.as_deref()));
    (floor, found)
}

/// The diagnosis of a pair, where it is known.
pub fn known_diagnosis(
    answers: &Answers,
    pair: &ComparedPair,
    seed: u64,
) -> Option<Arc<Answered<Diagnosis>>> {
    let floor = answers.known(&Floor::of(pair, seed));
    answers.known(&Diagnose::of(pair, seed, floor.as_deref()))
}
