//! The scenes of a loss, worst first.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::report::{
    Analysis, AnalysisInput, AnalysisOption, Cell, Compared, Field, OptionValue, Reader, Report, Table,
    scenes_line,
};
use crate::why::{Distribution, worst_first};
use svbrdf_core::loss::{Comparison, Outcome};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;

/// The columns of a scene.
pub(super) const SCENE: [Field<Scene>; 3] = [
    ("kind", "kind", |scene| scene.kind.to_string().into()),
    ("view_x view_y view_z", "view", |scene| scene.view.into()),
    ("light_x light_y light_z", "light", |scene| scene.light.into()),
];

/// The scenes with the largest losses, sorted by the mean of the losses of all predictions in them, worst first. Its JSON is a
/// scene file, too.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ScenesReport {
    #[serde(flatten)]
    compared: Compared,
    /// `None` where the scenes were listed.
    seed: Option<u64>,
    /// The number of scenes that these are the worst of.
    of: usize,
    /// One per prediction.
    results: Vec<ScenesLoss>,
    scenes: Vec<Scene>,
    /// The number of each listed scene among all.
    #[serde(skip)]
    indices: Vec<usize>,
    /// The lines above the table.
    #[serde(skip)]
    heading: String,
}

/// The loss of a prediction in single scenes.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct ScenesLoss {
    prediction: String,
    /// Over all scenes.
    loss: f64,
    /// The loss of each listed scene.
    losses: Vec<f64>,
}

impl ScenesReport {
    /// The report of the `count` worst scenes of `outcome`.
    pub fn new(compared: Compared, outcome: &Outcome, count: usize) -> Self {
        let mut ranked = worst_first(outcome);
        ranked.truncate(count);
        let heading = compared.heading("losses of scenes")
            + &scenes_line(outcome.sampling.as_ref(), &outcome.scenes, compared.size);
        let distributions = outcome.losses.iter();
        let distributions = distributions
            .filter_map(|loss| Some(distribution(&loss.prediction, &Distribution::of(&loss.per_scene)?)));
        let results = outcome.losses.iter().enumerate().map(|(index, loss)| ScenesLoss {
            prediction: loss.prediction.clone(),
            loss: loss.estimate.mean,
            losses: ranked.iter().map(|ranked| ranked.losses[index]).collect(),
        });
        Self {
            heading: heading + &distributions.collect::<String>(),
            compared,
            seed: outcome.sampling.map(|sampling| sampling.seed),
            of: outcome.scenes.len(),
            results: results.collect(),
            scenes: ranked.iter().map(|ranked| ranked.scene).collect(),
            indices: ranked.iter().map(|ranked| ranked.index).collect(),
        }
    }
}

fn distribution(prediction: &str, d: &Distribution) -> String {
    let Distribution { least, median, percentile95, largest, scenes: [all, worst], of_worst } = d;
    format!(
        "{prediction}: from {least:.3} to {largest:.3}, median {median:.3}, 95th percentile {percentile95:.3}; \
         the worst {worst} of {all} scenes add {:.0}% of the loss\n",
        100.0 * of_worst
    )
}

impl Report for ScenesReport {
    fn heading(&self) -> String {
        self.heading.clone()
    }

    fn table(&self, reader: Reader) -> Table {
        let index: [Field<usize>; 1] = [("scene", "scene", |index| (*index).into())];
        let scenes = Table::fields(&SCENE, &self.scenes, reader);
        let mut table = Table::fields(&index, &self.indices, reader).beside(scenes);
        for result in &self.results {
            table.push(result.prediction.clone(), result.losses.iter().map(|&loss| Cell::from(loss)));
        }
        table
    }
}

/// The options of the list.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(default)]
pub struct ScenesOptions {
    top: usize,
}

impl Default for ScenesOptions {
    fn default() -> Self {
        Self { top: 10 }
    }
}

impl Analysis for ScenesReport {
    const NAME: &'static str = "scenes";
    const ANSWERS: &'static str = "in which scenes the loss is largest";
    const EXAMPLES: &'static [&'static str] =
        &["gt.png a.png", "gt.png a.png --top 5 --format json > worst.json"];
    const ABOUT: &'static str = "Prints the scenes with the largest losses, worst first";
    const DETAILS: &'static str = "Scenes are sorted by the mean of the losses of all predictions in them, over all texels. The JSON \
        is a scene file, too.";
    const DOING: &'static str = "rendering";
    const SCENES: &'static [&'static str] = &["near", "distant", "sampler", "seed", "scenes"];
    type Options = ScenesOptions;
    const OPTIONS: &'static [AnalysisOption] = &[AnalysisOption {
        name: "top",
        about: "Number of scenes that are listed",
        value: OptionValue::Count(10),
    }];

    fn run(input: &AnalysisInput<'_>, options: &ScenesOptions, progress: &Progress) -> Result<Self, Error> {
        let run =
            |comparison: Comparison<'_, f32>| Ok(comparison.without_pilot().run(&input.request, progress)?);
        Ok(Self::new(input.compared(), &input.comparing(run)?, options.top))
    }
}
