//! Report of the share of each map in each loss.

use schemars::JsonSchema;
use serde::Serialize;

use super::Report;
use super::heading::{Compared, scenes_line};
use super::missed::missed;
use super::table::{Cell, Column, Shown, Table, aligned_columns};
use crate::why::{self, MapShare};
use svbrdf_core::error::Error;
use svbrdf_core::loss::{Estimate, Request};

/// A map, or all of them: its name, its part of the loss, the loss, and the losses where only it is wrong and where only it is right.
pub type Part = (&'static str, Estimate, f64, Option<[f64; 2]>);

/// The columns of parts for people.
pub const PARTS: [Column<'static, Part, Shown>; 7] = [
    ("map", |(name, ..)| Shown::Text((*name).to_owned())),
    ("share", |(_, part, loss, _)| match *loss > 0.0 {
        true => Shown::Share(part.mean / loss),
        false => Shown::Missing("-"),
    }),
    ("of the loss", |(_, part, ..)| Shown::Number(part.mean)),
    ("+- std. error", |(_, part, ..)| Shown::number(part.standard_error, "unknown")),
    ("95% interval", |(_, part, ..)| Shown::interval(part.interval95, "unknown")),
    ("only it wrong", |(.., only)| Shown::number(only.map(|[wrong, _]| wrong), "")),
    ("only it right", |(.., only)| Shown::number(only.map(|[_, right]| right), "")),
];

/// The parts of the maps of a `loss`.
pub fn parts<'a>(maps: &'a [MapShare], loss: &Estimate) -> impl Iterator<Item = Part> + use<'a> {
    let loss = loss.mean;
    maps.iter().map(move |share| {
        (share.map.name(), share.shapley, loss, Some([share.only_wrong.mean, share.only_right.mean]))
    })
}

/// The attribution of the loss of each prediction to its maps.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct BlameReport {
    #[serde(flatten)]
    compared: Compared,
    /// The requested accuracy of each loss: half of its 95% interval, as a share of it.
    target_error: Option<f64>,
    /// One per prediction.
    attributions: Vec<Attribution>,
}

/// The loss of a prediction and the part of each map.
#[derive(Clone, Debug, Serialize, JsonSchema)]
struct Attribution {
    prediction: String,
    /// The number of scenes.
    scenes: usize,
    /// `None` where the scenes were listed.
    seed: Option<u64>,
    /// Whether the loss is known as well as requested; `None` where no accuracy was.
    target_reached: Option<bool>,
    /// The sum of the Shapley values.
    loss: Estimate,
    maps: [MapShare; 4],
    /// The lines about the scenes, and what shares below 0% mean.
    #[serde(skip)]
    lines: [String; 2],
}

impl BlameReport {
    /// The report of the `attributions` that `request` gives.
    pub fn new(compared: Compared, request: &Request, attributions: Vec<why::Attribution>) -> Self {
        let target_error = match *request {
            Request::Accuracy { target, .. } => Some(target),
            _ => None,
        };
        let attribution = |found: why::Attribution| Attribution {
            scenes: found.scenes.len(),
            seed: found.sampling.map(|sampling| sampling.seed),
            target_reached: target_error.map(|target| found.loss.relative_error95() <= target),
            loss: found.loss,
            maps: found.maps,
            lines: [
                scenes_line(found.sampling.as_ref(), &found.scenes, compared.size),
                found.note().map_or(String::new(), |note| format!("\n{note}\n")),
            ],
            prediction: found.prediction,
        };
        let attributions = attributions.into_iter().map(attribution).collect();
        Self { compared, target_error, attributions }
    }

    fn text_of(&self, attribution: &Attribution) -> String {
        let Attribution { prediction, loss, maps, lines: [scenes, note], .. } = attribution;
        let rows = parts(maps, loss).chain([("all", *loss, loss.mean, None)]);
        let heading = self.compared.heading(&format!("blame of {prediction}"));
        format!("{heading}{scenes}\n{}{note}", aligned_columns(&PARTS, rows))
    }
}

impl Report for BlameReport {
    fn text(&self) -> String {
        self.attributions.iter().map(|attribution| self.text_of(attribution)).collect::<Vec<_>>().join("\n")
    }

    fn table(&self) -> Table {
        let columns: [Column<'_, (&Self, &Attribution, &MapShare)>; 11] = [
            ("prediction", |(_, a, _)| a.prediction.as_str().into()),
            ("map", |(.., share)| share.map.name().into()),
            ("shapley", |(.., share)| share.shapley.mean.into()),
            ("standard_error", |(.., share)| share.shapley.standard_error.into()),
            ("interval95_low", |(.., share)| Cell::low(share.shapley.interval95)),
            ("interval95_high", |(.., share)| Cell::high(share.shapley.interval95)),
            ("only_wrong", |(.., share)| share.only_wrong.mean.into()),
            ("only_right", |(.., share)| share.only_right.mean.into()),
            ("loss", |(_, a, _)| a.loss.mean.into()),
            ("target_error", |(report, ..)| report.target_error.into()),
            ("target_reached", |(_, a, _)| a.target_reached.into()),
        ];
        let rows = self.attributions.iter().flat_map(|a| a.maps.iter().map(move |share| (self, a, share)));
        Table::of(&columns, rows)
    }

    fn missed(&self) -> Vec<Error> {
        let Some(target) = self.target_error else { return Vec::new() };
        let of = |a: &Attribution| missed(target, &a.prediction, &a.loss, a.scenes);
        self.attributions.iter().filter_map(of).collect()
    }
}
