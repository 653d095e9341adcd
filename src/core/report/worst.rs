//! The scene with the largest loss of each prediction.

use serde::{Serialize, Serializer};

use super::Report;
use super::heading::{Compared, position};
use super::missed::missed;
use super::table::{Cell, Table, aligned};
use crate::error::Error;
use crate::loss::ALL_SCENES_TARGET;
use crate::model::scene::Scene;
use crate::why::Worst;

const TITLES: [&str; 8] =
    ["prediction", "worst", "mean", "times the mean", "kind", "view", "light", "evaluations"];

const COLUMNS: [&str; 12] = [
    "prediction",
    "worst",
    "mean",
    "kind",
    "view_x",
    "view_y",
    "view_z",
    "light_x",
    "light_y",
    "light_z",
    "evaluations",
    "target_reached",
];

/// The worst scene of each prediction.
#[derive(Clone, Debug)]
pub struct WorstReport {
    pub compared: Compared,
    /// The share of the nearest distances, and of the farthest ones, that the search leaves out.
    pub tail: f64,
    /// One per prediction.
    pub found: Vec<Worst>,
}

fn is_reached(worst: &Worst) -> bool {
    worst.mean.relative_error95() <= ALL_SCENES_TARGET
}

impl Report for WorstReport {
    fn text(&self) -> String {
        let mut rows = vec![TITLES.map(str::to_owned).to_vec()];
        rows.extend(self.found.iter().map(|worst| {
            let Scene { kind, view, light } = worst.scene;
            let mean = worst.mean.mean;
            vec![
                worst.prediction.clone(),
                format!("{:.6}", worst.loss),
                format!("{mean:.6}"),
                if mean > 0.0 { format!("{:.2}", worst.loss / mean) } else { "-".to_owned() },
                kind.to_string(),
                position(view),
                position(light),
                worst.evaluations.to_string(),
            ]
        }));
        let central = 100.0 - 200.0 * self.tail;
        let cut = format!("distances within the central {central}% of their distributions\n");
        format!("{}{cut}\n{}", self.compared.heading("worst scenes"), aligned(&rows))
    }

    fn table(&self) -> Table {
        let row = |worst: &Worst| {
            let Scene { kind, view, light } = worst.scene;
            let start = [worst.prediction.as_str().into(), worst.loss.into(), worst.mean.mean.into()];
            let place = view.into_iter().chain(light).map(Cell::from);
            let end = [worst.evaluations.into(), is_reached(worst).into()];
            start.into_iter().chain([kind.to_string().into()]).chain(place).chain(end).collect()
        };
        Table::new(COLUMNS, self.found.iter().map(row))
    }

    fn missed(&self) -> Vec<Error> {
        let of = |worst: &Worst| {
            let name = format!("the mean of {}", worst.prediction);
            missed(ALL_SCENES_TARGET, &name, &worst.mean, worst.mean_scenes)
        };
        self.found.iter().filter_map(of).collect()
    }
}

/// A scene file, too: scene k is the worst of prediction k.
#[derive(Serialize)]
struct WorstJson<'a> {
    #[serde(flatten)]
    compared: &'a Compared,
    /// The share of the distances that is left out at either end.
    distance_tail: f64,
    results: Vec<WorstEntry<'a>>,
    scenes: Vec<Scene>,
}

#[derive(Serialize)]
struct WorstEntry<'a> {
    prediction: &'a str,
    worst: f64,
    /// The loss over all scenes.
    mean: f64,
    interval95: Option<[f64; 2]>,
    /// Of the mean.
    target_error: f64,
    target_reached: bool,
    evaluations: usize,
}

impl Serialize for WorstReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let results = self.found.iter().map(|worst| WorstEntry {
            prediction: &worst.prediction,
            worst: worst.loss,
            mean: worst.mean.mean,
            interval95: worst.mean.interval95,
            target_error: ALL_SCENES_TARGET,
            target_reached: is_reached(worst),
            evaluations: worst.evaluations,
        });
        let scenes = self.found.iter().map(|worst| worst.scene);
        let (compared, distance_tail) = (&self.compared, self.tail);
        WorstJson { compared, distance_tail, results: results.collect(), scenes: scenes.collect() }
            .serialize(serializer)
    }
}
