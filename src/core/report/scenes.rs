//! The scenes of a loss, worst first.

use serde::{Serialize, Serializer};

use super::Report;
use super::heading::{Compared, position, scenes_line};
use super::table::{Cell, Table, aligned};
use crate::loss::Outcome;
use crate::model::scene::Scene;
use crate::why::{Distribution, RankedScene, worst_first};

/// The losses of single scenes, sorted by the mean of the losses of all predictions in them.
#[derive(Clone, Debug)]
pub struct ScenesReport {
    pub compared: Compared,
    pub outcome: Outcome,
    /// The scenes that are listed.
    pub ranked: Vec<RankedScene>,
}

impl ScenesReport {
    /// The report of all scenes of `outcome`.
    pub fn new(compared: Compared, outcome: Outcome) -> Self {
        let ranked = worst_first(&outcome);
        Self { compared, outcome, ranked }
    }

    /// The same report with the `count` worst scenes only.
    #[must_use]
    pub fn top(mut self, count: usize) -> Self {
        self.ranked.truncate(count);
        self
    }

    fn names(&self) -> impl Iterator<Item = String> {
        self.outcome.losses.iter().map(|loss| loss.prediction.clone())
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
        let distributions = self.outcome.losses.iter();
        let distributions: String = distributions
            .filter_map(|loss| Some(distribution(&loss.prediction, &Distribution::of(&loss.per_scene)?)))
            .collect();
        let titles = ["scene", "kind", "view", "light"].map(str::to_owned);
        let mut rows = vec![titles.into_iter().chain(self.names()).collect::<Vec<_>>()];
        rows.extend(self.ranked.iter().map(|ranked| {
            let Scene { kind, view, light } = ranked.scene;
            let start = [ranked.index.to_string(), kind.to_string(), position(view), position(light)];
            start.into_iter().chain(ranked.losses.iter().map(|loss| format!("{loss:.6}"))).collect()
        }));
        let heading = self.compared.heading("losses of scenes");
        let scenes = scenes_line(self.outcome.sampling.as_ref(), &self.outcome.scenes, self.compared.size);
        format!("{heading}{scenes}\n{distributions}\n{}", aligned(&rows))
    }

    fn table(&self) -> Table {
        let fixed = ["scene", "kind", "view_x", "view_y", "view_z", "light_x", "light_y", "light_z"];
        let row = |ranked: &RankedScene| {
            let Scene { kind, view, light } = ranked.scene;
            let numbers = view.iter().chain(&light).chain(&ranked.losses).map(|&number| Cell::from(number));
            [ranked.index.into(), kind.to_string().into()].into_iter().chain(numbers).collect()
        };
        Table::new(fixed.map(str::to_owned).into_iter().chain(self.names()), self.ranked.iter().map(row))
    }
}

/// A scene file, too.
#[derive(Serialize)]
struct ScenesJson<'a> {
    #[serde(flatten)]
    compared: &'a Compared,
    seed: Option<u64>,
    /// The number of scenes that these are the worst of.
    of: usize,
    results: Vec<ScenesEntry<'a>>,
    scenes: Vec<Scene>,
}

#[derive(Serialize)]
struct ScenesEntry<'a> {
    prediction: &'a str,
    /// Over all scenes.
    loss: f64,
    /// The loss of each listed scene.
    losses: Vec<f64>,
}

impl Serialize for ScenesReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let results = self.outcome.losses.iter().enumerate().map(|(index, loss)| ScenesEntry {
            prediction: &loss.prediction,
            loss: loss.estimate.mean,
            losses: self.ranked.iter().map(|ranked| ranked.losses[index]).collect(),
        });
        let object = ScenesJson {
            compared: &self.compared,
            seed: self.outcome.sampling.map(|sampling| sampling.seed),
            of: self.outcome.scenes.len(),
            results: results.collect(),
            scenes: self.ranked.iter().map(|ranked| ranked.scene).collect(),
        };
        object.serialize(serializer)
    }
}
