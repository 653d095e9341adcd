//! Losses over texels, or over directions of the light or the view.

use serde::Serialize;

use super::Report;
use super::heading::{Compared, position};
use super::table::{Cell, Table, aligned};
use crate::error::Error;
use crate::image::{Image, mean_of_channels};
use crate::loss::Comparison;
use crate::model::scene::Endpoint;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::why::{self, Hemisphere};

/// A map of the loss of each prediction.
#[derive(Clone, Debug, Serialize)]
pub struct MapReport {
    #[serde(flatten)]
    pub compared: Compared,
    /// The meaning of the numbers.
    pub shows: String,
    /// One per prediction.
    results: Vec<MapEntry>,
    /// The loss of each texel and channel, or of each direction in all channels: one image per prediction.
    #[serde(skip)]
    pub images: Vec<Image<f32>>,
    /// The map over directions and what moves; `None` for a map over texels.
    #[serde(skip)]
    pub directions: Option<(Endpoint, Hemisphere)>,
}

/// The summary of the map of a prediction.
#[derive(Clone, Debug, Serialize)]
struct MapEntry {
    prediction: String,
    mean: f64,
    largest: f64,
    #[serde(flatten)]
    place: MapPlace,
}

/// Where a map is largest.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(untagged)]
enum MapPlace {
    Texel {
        column: usize,
        row: usize,
    },
    Direction {
        /// The root mean square of the standard errors of all directions.
        standard_error: f64,
        direction: [f64; 3],
    },
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
            let place = MapPlace::Texel { column: at % image.width, row: at / image.width };
            MapEntry { prediction: name, mean: why::mean(image), largest: f64::from(largest), place }
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
            let place = MapPlace::Direction { standard_error: map.standard_error(index), direction };
            Some(MapEntry { prediction: name, mean: map.mean(index), largest, place })
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

    /// The same report with other names: the ground truth first, then each prediction.
    #[must_use]
    pub fn renamed(mut self, names: &[String]) -> Self {
        let Some((ground_truth, predictions)) = names.split_first() else { return self };
        self.compared.ground_truth.clone_from(ground_truth);
        for (entry, name) in self.results.iter_mut().zip(predictions) {
            entry.prediction.clone_from(name);
        }
        self
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
        let start = ["prediction", "mean", "largest"];
        let titles = match self.directions {
            Some((moved, _)) => start.into_iter().chain(["+- std. error", roles(moved)[0]]),
            None => start.into_iter().chain(["column", "row"]),
        };
        let mut rows = vec![titles.map(str::to_owned).collect::<Vec<_>>()];
        rows.extend(self.results.iter().map(|MapEntry { prediction, mean, largest, place }| {
            let end = match *place {
                MapPlace::Texel { column, row } => [column.to_string(), row.to_string()],
                MapPlace::Direction { standard_error, direction } => {
                    [format!("{standard_error:.6}"), position(direction)]
                }
            };
            let start = [prediction.clone(), format!("{mean:.6}"), format!("{largest:.6}")];
            start.into_iter().chain(end).collect()
        }));
        format!("{}\n{}", self.compared.heading(&self.shows), aligned(&rows))
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
fn of_map(index: usize, entry: &MapEntry, map: &Hemisphere) -> impl Iterator<Item = Vec<Cell>> {
    let cells = map.directions.iter().zip(&map.losses[index]).zip(&map.standard_errors[index]);
    cells.filter_map(|((direction, &loss), &error)| {
        let numbers = (*direction)?.into_iter().chain([loss, error]).map(Cell::from);
        Some([entry.prediction.as_str().into()].into_iter().chain(numbers).collect())
    })
}

/// The rows of the texels of a prediction.
fn of_image(entry: &MapEntry, image: &Image<f32>) -> impl Iterator<Item = Vec<Cell>> {
    image.pixels.iter().enumerate().map(|(at, pixel)| {
        let start = [entry.prediction.as_str().into(), (at % image.width).into(), (at / image.width).into()];
        start.into_iter().chain(pixel.map(Cell::Single)).collect()
    })
}
