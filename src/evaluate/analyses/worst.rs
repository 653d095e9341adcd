//! The scene with the largest loss of each prediction.

use serde::{Deserialize, Serialize};

use super::scenes::SCENE;
use crate::error::Error;
use crate::report::{
    Analysis, AnalysisInput, AnalysisOption, Cell, Compared, Field, OptionValue, Reader, Report, Table,
    missed,
};
use crate::why;
use svbrdf_core::loss::{ALL_SCENES_TARGET, Estimate};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;

/// The scene with the largest loss of each prediction. Its JSON is a scene file, too.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WorstReport {
    #[serde(flatten)]
    compared: Compared,
    /// The share of the nearest distances, and of the farthest ones, that the search leaves out.
    distance_tail: f64,
    /// One per prediction.
    results: Vec<Worst>,
    /// The worst scene of each prediction.
    scenes: Vec<Scene>,
}

/// The worst scene of a prediction.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Worst {
    prediction: String,
    /// The loss in that scene.
    worst: f64,
    /// The loss over all scenes.
    mean: f64,
    /// The 95% confidence interval of the mean.
    interval95: Option<[f64; 2]>,
    /// The requested accuracy of the mean.
    target_error: f64,
    target_reached: bool,
    /// The number of scenes that the search rendered.
    evaluations: usize,
    /// The number of scenes that the mean is over.
    #[serde(skip)]
    mean_scenes: usize,
}

impl WorstReport {
    /// The report of what was `found` for each prediction without the share `tail` of either end of the distances.
    pub fn new(compared: Compared, tail: f64, found: Vec<why::Worst>) -> Self {
        let scenes = found.iter().map(|worst| worst.scene).collect();
        let results = found.into_iter().map(Worst::from).collect();
        Self { compared, distance_tail: tail, results, scenes }
    }
}

impl From<why::Worst> for Worst {
    fn from(found: why::Worst) -> Self {
        Self {
            prediction: found.prediction,
            worst: found.loss,
            mean: found.mean.mean,
            interval95: found.mean.interval95,
            target_error: ALL_SCENES_TARGET,
            target_reached: found.mean.relative_error95() <= ALL_SCENES_TARGET,
            evaluations: found.evaluations,
            mean_scenes: found.mean_scenes,
        }
    }
}

impl Report for WorstReport {
    fn heading(&self) -> String {
        let central = 100.0 - 200.0 * self.distance_tail;
        let cut = format!("distances within the central {central}% of their distributions\n");
        self.compared.heading("worst scenes") + &cut
    }

    fn table(&self, reader: Reader) -> Table {
        let losses: [Field<Worst>; 4] = [
            ("prediction", "prediction", |one| one.prediction.as_str().into()),
            ("worst", "worst", |one| one.worst.into()),
            ("mean", "mean", |one| one.mean.into()),
            ("", "times the mean", |one| match one.mean > 0.0 {
                true => format!("{:.2}", one.worst / one.mean).into(),
                false => Cell::Missing("-"),
            }),
        ];
        let search: [Field<Worst>; 2] = [
            ("evaluations", "evaluations", |one| one.evaluations.into()),
            ("target_reached", "", |one| one.target_reached.into()),
        ];
        let [losses, search] =
            [&losses[..], &search].map(|fields| Table::fields(fields, &self.results, reader));
        losses.beside(Table::fields(&SCENE, &self.scenes, reader)).beside(search)
    }

    fn missed(&self) -> Vec<String> {
        let of = |worst: &Worst| {
            let mean = Estimate { mean: worst.mean, standard_error: None, interval95: worst.interval95 };
            missed(worst.target_error, &format!("the mean of {}", worst.prediction), &mean, worst.mean_scenes)
        };
        self.results.iter().filter_map(of).collect()
    }
}

/// The options of the search.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(default)]
pub struct WorstOptions {
    distance_tail: f64,
}

impl Default for WorstOptions {
    fn default() -> Self {
        Self { distance_tail: why::TAIL }
    }
}

impl Analysis for WorstReport {
    const NAME: &'static str = "worst";
    const ANSWERS: &'static str = "under which light the loss is largest";
    const ABOUT: &'static str = "Searches for the scene with the largest loss of each prediction";
    const DETAILS: &'static str = "Evaluates 12,288 of the scenes that the loss is over, and distant ones with grazing light and view, \
        on 1,024 texels. Refines the worst of them, the best 4 on all texels. Distances have no largest value: the search is \
        within the central 99% of their distributions, which the distance tail changes. The mean is the loss over all scenes, to +-1% \
        where 49,152 scenes are enough. The JSON is a scene file, too.";
    const DOING: &'static str = "searching";
    const SCENES: &'static [&'static str] = &["seed"];
    type Options = WorstOptions;
    const OPTIONS: &'static [AnalysisOption] = &[AnalysisOption {
        name: "distance_tail",
        about: "Leaves out this share of the nearest distances, and the same share of the farthest",
        value: OptionValue::Share(why::TAIL),
    }];

    fn run(input: &AnalysisInput<'_>, options: &WorstOptions, progress: &Progress) -> Result<Self, Error> {
        let (truth, convention, tail) = (input.ground_truth, &input.convention, options.distance_tail);
        if !(0.0..0.5).contains(&tail) {
            return Err(Error::DistanceTail { found: tail });
        }
        let found = input
            .each(|prediction| why::worst(truth, prediction, convention, input.seed(), tail, progress))?;
        Ok(Self::new(input.compared(), tail, found))
    }
}
