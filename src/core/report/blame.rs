//! Report of the share of each map in each loss.

use serde::{Serialize, Serializer};

use super::Report;
use super::heading::{Compared, scenes_line};
use super::missed::missed;
use super::table::{Cell, Table, aligned};
use crate::error::Error;
use crate::loss::{Estimate, Request};
use crate::why::{Attribution, MapShare};

const TITLES: [&str; 7] =
    ["map", "share", "of the loss", "+- std. error", "95% interval", "only it wrong", "only it right"];

const COLUMNS: [&str; 11] = [
    "prediction",
    "map",
    "shapley",
    "standard_error",
    "interval95_low",
    "interval95_high",
    "only_wrong",
    "only_right",
    "loss",
    "target_error",
    "target_reached",
];

/// The attribution of the loss of each prediction to its maps.
#[derive(Clone, Debug)]
pub struct BlameReport {
    pub compared: Compared,
    /// The requested accuracy of each loss: half of its 95% interval, as a share of it.
    pub target_error: Option<f64>,
    /// One per prediction.
    pub attributions: Vec<Attribution>,
}

impl BlameReport {
    /// The report of the `attributions` that `request` gives.
    pub fn new(compared: Compared, request: &Request, attributions: Vec<Attribution>) -> Self {
        let target_error = match *request {
            Request::Accuracy { target, .. } => Some(target),
            _ => None,
        };
        Self { compared, target_error, attributions }
    }

    /// Whether the loss is known as well as requested; `None` where no accuracy was.
    fn target_reached(&self, attribution: &Attribution) -> Option<bool> {
        self.target_error.map(|target| attribution.loss.relative_error95() <= target)
    }

    fn entry<'a>(&self, attribution: &'a Attribution) -> AttributionEntry<'a> {
        AttributionEntry {
            prediction: &attribution.prediction,
            scenes: attribution.scenes.len(),
            seed: attribution.sampling.map(|sampling| sampling.seed),
            target_reached: self.target_reached(attribution),
            loss: attribution.loss,
            maps: &attribution.maps,
        }
    }

    fn text_of(&self, attribution: &Attribution) -> String {
        let Attribution { prediction, sampling, scenes, loss, maps } = attribution;
        let mut rows = vec![TITLES.map(str::to_owned).to_vec()];
        rows.extend(maps.iter().map(|share| {
            let [mean, error, interval] = share.shapley.texts();
            let share_of_loss = percent(share.shapley.mean, loss.mean);
            let [wrong, right] = [share.only_wrong, share.only_right].map(|e| format!("{:.6}", e.mean));
            vec![share.map.name().to_owned(), share_of_loss, mean, error, interval, wrong, right]
        }));
        let [mean, error, interval] = loss.texts();
        rows.push(vec!["all".to_owned(), percent(loss.mean, loss.mean), mean, error, interval]);
        let heading = self.compared.heading(&format!("blame of {prediction}"));
        let note = attribution.note().map_or(String::new(), |note| format!("\n{note}\n"));
        format!(
            "{heading}{}\n{}{note}",
            scenes_line(sampling.as_ref(), scenes, self.compared.size),
            aligned(&rows)
        )
    }
}

fn percent(part: f64, whole: f64) -> String {
    if whole > 0.0 { format!("{:.1}%", 100.0 * part / whole) } else { "-".to_owned() }
}

impl Report for BlameReport {
    fn text(&self) -> String {
        self.attributions.iter().map(|attribution| self.text_of(attribution)).collect::<Vec<_>>().join("\n")
    }

    fn table(&self) -> Table {
        let row = |a: &Attribution, share: &MapShare| {
            let [error, low, high] = Cell::errors(&share.shapley);
            let names = [a.prediction.as_str().into(), share.map.name().into()];
            let numbers = [share.only_wrong.mean, share.only_right.mean, a.loss.mean].map(Cell::from);
            let target = [self.target_error.into(), self.target_reached(a).into()];
            let shapley = [share.shapley.mean.into(), error, low, high];
            names.into_iter().chain(shapley).chain(numbers).chain(target).collect()
        };
        let all = self.attributions.iter();
        Table::new(COLUMNS, all.flat_map(|a| a.maps.iter().map(move |share| row(a, share))))
    }

    fn missed(&self) -> Vec<Error> {
        let Some(target) = self.target_error else { return Vec::new() };
        let of = |a: &Attribution| missed(target, &a.prediction, &a.loss, a.scenes.len());
        self.attributions.iter().filter_map(of).collect()
    }
}

#[derive(Serialize)]
struct BlameJson<'a> {
    #[serde(flatten)]
    compared: &'a Compared,
    target_error: Option<f64>,
    attributions: Vec<AttributionEntry<'a>>,
}

#[derive(Serialize)]
struct AttributionEntry<'a> {
    prediction: &'a str,
    scenes: usize,
    seed: Option<u64>,
    target_reached: Option<bool>,
    loss: Estimate,
    maps: &'a [MapShare],
}

impl Serialize for BlameReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let attributions = self.attributions.iter().map(|attribution| self.entry(attribution)).collect();
        BlameJson { compared: &self.compared, target_error: self.target_error, attributions }
            .serialize(serializer)
    }
}
