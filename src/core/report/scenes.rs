//! The scenes of a loss, worst first.

use schemars::JsonSchema;
use serde::Serialize;

use super::Report;
use super::heading::{Compared, position, scenes_line};
use super::table::{Cell, Table, aligned};
use crate::loss::Outcome;
use crate::model::scene::Scene;
use crate::why::{Distribution, worst_first};

/// The scenes with the largest losses, sorted by the mean of the losses of all predictions in them, worst first. Its JSON is a
/// scene file, too.
#[derive(Clone, Debug, Serialize, JsonSchema)]
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
#[derive(Clone, Debug, Serialize, JsonSchema)]
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

    /// The titles `start`, then the predictions.
    fn columns(&self, start: &[&str]) -> Vec<String> {
        let names = self.results.iter().map(|result| result.prediction.as_str());
        start.iter().copied().chain(names).map(str::to_owned).collect()
    }

    /// A row for each scene: what `start` gives for its number, then what `loss` gives for each loss.
    fn rows<C, const N: usize>(
        &self,
        start: impl Fn(usize, &Scene) -> [C; N],
        loss: impl Fn(f64) -> C,
    ) -> Vec<Vec<C>> {
        let row = |(k, (&index, scene)): (usize, (&usize, &Scene))| {
            let losses = self.results.iter().map(|result| loss(result.losses[k]));
            start(index, scene).into_iter().chain(losses).collect()
        };
        self.indices.iter().zip(&self.scenes).enumerate().map(row).collect()
    }
}

fn distribution(prediction: &str, d: &Distribution) -> String {
    let Distribution { least, median, percentile95, largest, worst_tenth } = d;
    format!(
        "{prediction}: from {least:.3} to {largest:.3}, median {median:.3}, 95th percentile {percentile95:.3}; \
         the worst tenth of the scenes adds {:.0}% of the loss\n",
        100.0 * worst_tenth
    )
}

impl Report for ScenesReport {
    fn text(&self) -> String {
        let start = |index: usize, scene: &Scene| {
            [index.to_string(), scene.kind.to_string(), position(scene.view), position(scene.light)]
        };
        let mut rows = vec![self.columns(&["scene", "kind", "view", "light"])];
        rows.extend(self.rows(start, |loss| format!("{loss:.6}")));
        format!("{}\n{}", self.heading, aligned(&rows))
    }

    fn table(&self) -> Table {
        let start = ["scene", "kind", "view_x", "view_y", "view_z", "light_x", "light_y", "light_z"];
        let cells = |index: usize, &Scene { kind, view: [x, y, z], light: [a, b, c] }: &Scene| {
            let [x, y, z, a, b, c] = [x, y, z, a, b, c].map(Cell::from);
            [index.into(), kind.to_string().into(), x, y, z, a, b, c]
        };
        Table::new(self.columns(&start), self.rows(cells, Cell::from))
    }
}
