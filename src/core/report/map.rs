//! Losses over texels, or over directions of the light or the view.

use schemars::JsonSchema;
use serde::Serialize;

use super::Report;
use super::heading::{Compared, position};
use super::table::{Cell, Column, Table, aligned_columns};
use crate::error::Error;
use crate::image::{Image, mean_of_channels};
use crate::loss::Comparison;
use crate::model::scene::Endpoint;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::why::{self, Hemisphere};

/// The loss over texels, or over the directions of the light or the view.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct MapReport {
    #[serde(flatten)]
    pub compared: Compared,
    /// The meaning of the numbers.
    pub shows: String,
    /// One per prediction.
    results: Vec<MapSummary>,
    /// The loss of each texel and channel, or of each direction in all channels: one image per prediction.
    #[serde(skip)]
    pub images: Vec<Image<f32>>,
    /// The map over directions and what moves; `None` for a map over texels.
    #[serde(skip)]
    pub directions: Option<(Endpoint, Hemisphere)>,
}

/// The map of a prediction in a few numbers.
#[derive(Clone, Debug, Serialize, JsonSchema)]
struct MapSummary {
    prediction: String,
    /// The loss.
    mean: f64,
    largest: f64,
    /// Where a map over texels is largest.
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    row: Option<usize>,
    /// The root mean square of the standard errors of a map over directions.
    #[serde(skip_serializing_if = "Option::is_none")]
    standard_error: Option<f64>,
    /// Where a map over directions is largest.
    #[serde(skip_serializing_if = "Option::is_none")]
    direction: Option<[f64; 3]>,
}

impl MapReport {
    /// The mean log difference of each texel over `scenes`.
    ///
    /// # Errors
    /// As [`why::error_maps`].
    pub fn over_texels(
        comparison: &Comparison<'_, f32>,
        scenes: &[Scene],
        progress: &Progress,
    ) -> Result<Self, Error> {
        let images = why::error_maps(comparison, scenes, progress)?;
        let entry = |(name, image): (String, &Image<f32>)| {
            let all = image.pixels.iter().map(mean_of_channels).enumerate();
            let (at, largest) = all.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
            let (column, row) = (Some(at % image.width), Some(at / image.width));
            let (mean, largest) = (why::mean(image), f64::from(largest));
            MapSummary { prediction: name, mean, largest, column, row, standard_error: None, direction: None }
        };
        Ok(Self {
            compared: Compared::new(comparison.ground_truth(), comparison.convention()),
            shows: format!("mean log difference of each texel over {} scenes", scenes.len()),
            results: names(comparison).zip(&images).map(entry).collect(),
            images,
            directions: None,
        })
    }

    /// The loss in distant scenes over the directions of what is `moved`, on a grid of `side` columns; `fixed` is the direction of
    /// the other.
    ///
    /// # Errors
    /// As [`why::hemisphere`].
    pub fn over_directions(
        comparison: &Comparison<'_, f32>,
        moved: Endpoint,
        fixed: [f64; 3],
        side: usize,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let map = why::hemisphere(comparison, moved, fixed, side, progress, |_| ())?;
        let entry = |(index, name): (usize, String)| {
            let (direction, largest) = map.worst(index)?;
            let (standard_error, direction) = (Some(map.standard_error(index)), Some(direction));
            let mean = map.mean(index);
            Some(MapSummary {
                prediction: name,
                mean,
                largest,
                column: None,
                row: None,
                standard_error,
                direction,
            })
        };
        let image = |losses: &Vec<f64>| Image {
            width: side,
            height: side,
            pixels: losses.iter().map(|&loss| [loss as f32; 3]).collect(),
        };
        let [what, other] = roles(moved);
        Ok(Self {
            compared: Compared::new(comparison.ground_truth(), comparison.convention()),
            shows: format!("loss over distant {what} directions, {other} {}", position(fixed)),
            results: names(comparison).enumerate().filter_map(entry).collect(),
            images: map.losses.iter().map(image).collect(),
            directions: Some((moved, map)),
        })
    }
}

fn names(comparison: &Comparison<'_, f32>) -> impl Iterator<Item = String> {
    comparison.predictions().iter().map(|prediction| prediction.name().to_owned())
}

/// What moves, and what is fixed.
fn roles(moved: Endpoint) -> [&'static str; 2] {
    match moved {
        Endpoint::Light => ["light", "view"],
        Endpoint::View => ["view", "light"],
    }
}

impl Report for MapReport {
    fn text(&self) -> String {
        let start: [Column<'_, &MapSummary, String>; 3] = [
            ("prediction", |summary| summary.prediction.clone()),
            ("mean", |summary| format!("{:.6}", summary.mean)),
            ("largest", |summary| format!("{:.6}", summary.largest)),
        ];
        let end: [Column<'_, &MapSummary, String>; 2] = match self.directions {
            Some((moved, _)) => [
                ("+- std. error", |summary| format!("{:.6}", summary.standard_error.unwrap_or_default())),
                (roles(moved)[0], |summary| position(summary.direction.unwrap_or_default())),
            ],
            None => [
                ("column", |summary| summary.column.unwrap_or_default().to_string()),
                ("row", |summary| summary.row.unwrap_or_default().to_string()),
            ],
        };
        let table = aligned_columns(&[&start[..], &end].concat(), &self.results);
        format!("{}\n{}", self.compared.heading(&self.shows), table)
    }

    /// A row for each texel or direction of each prediction.
    fn table(&self) -> Table {
        match &self.directions {
            Some((_, map)) => {
                let columns = ["prediction", "x", "y", "z", "loss", "standard_error"];
                Table::new(
                    columns,
                    self.results.iter().enumerate().flat_map(|(p, entry)| of_map(p, entry, map)),
                )
            }
            None => {
                let columns = ["prediction", "column", "row", "red", "green", "blue"];
                let all = self.results.iter().zip(&self.images);
                Table::new(columns, all.flat_map(|(entry, image)| of_image(entry, image)))
            }
        }
    }
}

/// The rows of the directions of the prediction with index `index`.
fn of_map(index: usize, entry: &MapSummary, map: &Hemisphere) -> impl Iterator<Item = Vec<Cell>> {
    let cells = map.directions.iter().zip(&map.losses[index]).zip(&map.standard_errors[index]);
    cells.filter_map(|((direction, &loss), &error)| {
        let numbers = (*direction)?.into_iter().chain([loss, error]).map(Cell::from);
        Some([entry.prediction.as_str().into()].into_iter().chain(numbers).collect())
    })
}

/// The rows of the texels of a prediction.
fn of_image(entry: &MapSummary, image: &Image<f32>) -> impl Iterator<Item = Vec<Cell>> {
    image.pixels.iter().enumerate().map(|(at, pixel)| {
        let start = [entry.prediction.as_str().into(), (at % image.width).into(), (at / image.width).into()];
        start.into_iter().chain(pixel.map(Cell::Single)).collect()
    })
}
