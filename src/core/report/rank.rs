//! A ranking of predictions of one ground truth.

use serde::{Serialize, Serializer};

use super::Report;
use super::heading::{Compared, floor_line, scenes_line};
use super::latex::{bold, escaped, latex};
use super::missed::missed_by_any;
use super::table::{Cell, Table, aligned};
use crate::error::Error;
use crate::loss::{Estimate, Outcome};
use crate::rank::{Ranked, places};

const TITLES: [&str; 7] =
    ["prediction", "loss", "95% interval", "- best", "95% interval", "group", "not resolvable"];

const COLUMNS: [&str; 13] = [
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
    "resolvable",
    "to_best_resolvable",
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
    /// The number of captures that the floor is the mean loss between.
    pub captures: Option<usize>,
    /// How to repeat it; `None` for materials that no command names.
    pub repetition: Option<Repetition>,
}

/// What a ranking depends on beside its settings.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Repetition {
    /// The program and its version.
    pub software: &'static str,
    /// The command line.
    pub command: String,
    /// For each material, the ground truth first, what was noticed and assumed in reading it.
    pub readings: Vec<MaterialReading>,
}

/// How a material was read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct MaterialReading {
    pub material: String,
    pub remarks: Vec<String>,
}

impl RankReport {
    /// The ranking of the predictions of `outcome`.
    pub fn new(compared: Compared, target_error: f64, outcome: Outcome) -> Self {
        let places = places(&outcome);
        Self { compared, target_error, outcome, places, floor: None, captures: None, repetition: None }
    }

    /// The same report with the loss that the ground truth cannot resolve, and the number of captures that it is the mean loss between;
    /// `None`: it is that of rounding.
    #[must_use]
    pub fn with_floor(self, floor: Estimate, captures: Option<usize>) -> Self {
        Self { floor: Some(floor), captures, ..self }
    }

    /// The prediction that needed the most scenes, where there are others: all are compared in as many.
    fn scenes_of(&self) -> String {
        let error = |index: &usize| self.outcome.losses[*index].estimate.relative_error95();
        let most = (0..self.outcome.losses.len()).max_by(|a, b| error(a).total_cmp(&error(b)));
        match most.filter(|_| self.places.len() > 1) {
            Some(most) => {
                format!("as many scenes for all as {} needs\n", self.outcome.losses[most].prediction)
            }
            None => String::new(),
        }
    }

    /// Whether the loss, and its difference to the best, are above the floor; `None` without a floor or a difference.
    fn resolvable(&self, place: &Ranked) -> [Option<bool>; 2] {
        let is_above = |value: f64| self.floor.as_ref().map(|floor| value > floor.mean);
        let difference = place.to_best.and_then(|difference| is_above(difference.mean.abs()));
        [is_above(self.outcome.losses[place.index].estimate.mean), difference]
    }

    /// What of a place is not resolvable: "loss", "difference" or both; empty where both are.
    fn unresolvable(&self, place: &Ranked) -> String {
        let parts = self.resolvable(place).into_iter().zip(["loss", "difference"]);
        parts.filter(|(is, _)| *is == Some(false)).map(|(_, name)| name).collect::<Vec<_>>().join(", ")
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
            let group = place.group.to_string();
            let unresolvable = self.unresolvable(place);
            vec![loss.prediction.clone(), mean, interval, difference, of_difference, group, unresolvable]
        }));
        if rows[1..].iter().all(|row| row.last().is_some_and(String::is_empty)) {
            rows.iter_mut().for_each(|row| row.truncate(TITLES.len() - 1));
        }
        let floor = self.floor.as_ref().map(|floor| floor_line(floor, self.captures)).unwrap_or_default();
        let heading = self.compared.heading("rendering loss");
        let scenes = scenes_line(self.outcome.sampling.as_ref(), &self.outcome.scenes, self.compared.size);
        let needed = self.scenes_of();
        let repetition = self
            .repetition
            .as_ref()
            .map(|Repetition { software, command, .. }| format!("\nrepeat with {software}: {command}\n"));
        format!("{heading}{scenes}{needed}{floor}\n{}{}", aligned(&rows), repetition.unwrap_or_default())
    }

    fn table(&self) -> Table {
        let row = |(number, place): (usize, &Ranked)| {
            let loss = &self.outcome.losses[place.index];
            let [_, to_low, to_high] =
                place.to_best.as_ref().map_or_else(|| [const { Cell::Empty }; 3], Cell::errors);
            let start = [(number + 1).into(), loss.prediction.as_str().into(), loss.estimate.mean.into()];
            let to_best = [place.to_best.map(|estimate| estimate.mean).into(), to_low, to_high];
            let is_reached = loss.estimate.relative_error95() <= self.target_error;
            let [resolvable, to_best_resolvable] = self.resolvable(place).map(Cell::from);
            let end = [place.group.into(), is_reached.into(), resolvable, to_best_resolvable];
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
    /// The number of captures that the floor is the mean loss between.
    captures: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    repetition: Option<&'a Repetition>,
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
    /// Whether the loss is above the floor.
    resolvable: Option<bool>,
    /// Whether the difference to the best is.
    to_best_resolvable: Option<bool>,
}

impl Serialize for RankReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { compared, target_error, outcome, places, floor, captures, repetition } = self;
        let entry = |place: &Ranked| {
            let [resolvable, to_best_resolvable] = self.resolvable(place);
            RankEntry {
                prediction: &outcome.losses[place.index].prediction,
                loss: outcome.losses[place.index].estimate,
                to_best: place.to_best,
                group: place.group,
                resolvable,
                to_best_resolvable,
            }
        };
        let object = RankJson {
            compared,
            scenes: outcome.scenes.len(),
            seed: outcome.sampling.map(|sampling| sampling.seed),
            target_error: *target_error,
            target_reached: outcome.relative_error95() <= *target_error,
            floor: floor.map(|floor| floor.mean),
            captures: *captures,
            repetition: repetition.as_ref(),
            ranking: places.iter().map(entry).collect(),
        };
        object.serialize(serializer)
    }
}
