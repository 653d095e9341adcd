//! A ranking of predictions of one ground truth.

use serde::{Serialize, Serializer};

use super::Report;
use super::heading::{Compared, scenes_line};
use super::latex::{bold, escaped, latex};
use super::missed::missed_by_any;
use super::table::{Cell, Table, aligned};
use crate::error::Error;
use crate::loss::{Estimate, Outcome};
use crate::rank::{Ranked, places};

const TITLES: [&str; 6] = ["prediction", "loss", "95% interval", "- best", "95% interval", "group"];

const COLUMNS: [&str; 11] = [
    "place",
    "prediction",
    "loss",
    "standard_error",
    "interval95_low",
    "interval95_high",
    "to_best",
    "to_best_low",
    "to_best_high",
    "group",
    "target_reached",
];

/// Predictions of one ground truth, best first, with what the data can separate.
#[derive(Clone, Debug)]
pub struct RankReport {
    pub compared: Compared,
    /// The requested accuracy of every loss: half of its 95% interval, as a share of it.
    pub target_error: f64,
    pub outcome: Outcome,
    /// Best first.
    pub places: Vec<Ranked>,
    /// The loss that the ground truth cannot resolve, where the depth of its files is known.
    pub floor: Option<Estimate>,
}

impl RankReport {
    /// The ranking of the predictions of `outcome`.
    pub fn new(compared: Compared, target_error: f64, outcome: Outcome) -> Self {
        let places = places(&outcome);
        Self { compared, target_error, outcome, places, floor: None }
    }

    /// The same report with the loss that the ground truth cannot resolve.
    #[must_use]
    pub fn with_floor(self, floor: Estimate) -> Self {
        Self { floor: Some(floor), ..self }
    }

    /// A line about the floor; empty without one.
    fn floor_line(&self) -> String {
        let Some(floor) = &self.floor else { return String::new() };
        format!(
            "floor {:.6}: smaller losses and differences are not resolvable with this ground truth\n",
            floor.mean
        )
    }

    /// A table for a paper: the first group in bold.
    pub fn latex(&self) -> String {
        let row = |place: &Ranked| {
            let loss = &self.outcome.losses[place.index];
            let [low, high] = loss.estimate.interval95.unwrap_or([f64::NAN; 2]);
            let mean = bold(&format!("{:.4}", loss.estimate.mean), place.group == 1);
            format!("{} & {mean} & [{low:.4}, {high:.4}] \\\\\n", escaped(&loss.prediction))
        };
        let rows: String = self.places.iter().map(row).collect();
        latex("lrl", "Prediction & Loss & 95\\% interval", &rows)
    }
}

impl Report for RankReport {
    fn text(&self) -> String {
        let mut rows = vec![TITLES.map(str::to_owned).to_vec()];
        rows.extend(self.places.iter().map(|place| {
            let loss = &self.outcome.losses[place.index];
            let [mean, _, interval] = loss.estimate.texts();
            let [difference, _, of_difference] =
                place.to_best.map_or_else(|| [const { String::new() }; 3], |estimate| estimate.texts());
            vec![loss.prediction.clone(), mean, interval, difference, of_difference, place.group.to_string()]
        }));
        let heading = self.compared.heading("rendering loss");
        let scenes = scenes_line(self.outcome.sampling.as_ref(), &self.outcome.scenes, self.compared.size);
        format!("{heading}{scenes}{}\n{}", self.floor_line(), aligned(&rows))
    }

    fn table(&self) -> Table {
        let row = |(number, place): (usize, &Ranked)| {
            let loss = &self.outcome.losses[place.index];
            let [_, to_low, to_high] =
                place.to_best.as_ref().map_or_else(|| [const { Cell::Empty }; 3], Cell::errors);
            let start = [(number + 1).into(), loss.prediction.as_str().into(), loss.estimate.mean.into()];
            let to_best = [place.to_best.map(|estimate| estimate.mean).into(), to_low, to_high];
            let is_reached = loss.estimate.relative_error95() <= self.target_error;
            let end = [place.group.into(), is_reached.into()];
            start.into_iter().chain(Cell::errors(&loss.estimate)).chain(to_best).chain(end).collect()
        };
        Table::new(COLUMNS, self.places.iter().enumerate().map(row))
    }

    fn missed(&self) -> Vec<Error> {
        missed_by_any(self.target_error, &self.outcome).into_iter().collect()
    }
}

#[derive(Serialize)]
struct RankJson<'a> {
    #[serde(flatten)]
    compared: &'a Compared,
    scenes: usize,
    seed: Option<u64>,
    target_error: f64,
    /// By every prediction.
    target_reached: bool,
    /// The mean of the loss that the ground truth cannot resolve.
    floor: Option<f64>,
    /// Best first.
    ranking: Vec<RankEntry<'a>>,
}

#[derive(Serialize)]
struct RankEntry<'a> {
    prediction: &'a str,
    loss: Estimate,
    /// The loss - the loss of the best prediction, over the same scenes.
    to_best: Option<Estimate>,
    group: usize,
}

impl Serialize for RankReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { compared, target_error, outcome, places, floor } = self;
        let entry = |place: &Ranked| RankEntry {
            prediction: &outcome.losses[place.index].prediction,
            loss: outcome.losses[place.index].estimate,
            to_best: place.to_best,
            group: place.group,
        };
        let object = RankJson {
            compared,
            scenes: outcome.scenes.len(),
            seed: outcome.sampling.map(|sampling| sampling.seed),
            target_error: *target_error,
            target_reached: outcome.relative_error95() <= *target_error,
            floor: floor.map(|floor| floor.mean),
            ranking: places.iter().map(entry).collect(),
        };
        object.serialize(serializer)
    }
}
