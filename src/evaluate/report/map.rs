//! Losses over texels, or over directions of the light or the view.

use serde::Serialize;

use super::Report;
use super::heading::{Compared, position};
use super::table::{Cell, Field, Reader, Table};
use crate::why::{self, Hemisphere};
use svbrdf_core::error::Error;
use svbrdf_core::image::{Image, mean_of_channels};
use svbrdf_core::loss::Comparison;
use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;

/// The loss over texels, or over the directions of the light or the view.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
#[derive(Clone, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// The mean over `scenes` of the log difference of each texel, or what else the norm takes the mean of.
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
            MapSummary { prediction: name, mean, largest, column, row, ..MapSummary::default() }
        };
        Ok(Self {
            compared: Compared::new(comparison.ground_truth(), comparison.convention()),
            shows: format!(
                "mean {} of each texel over {} scenes",
                comparison.convention().norm().of_term(),
                scenes.len()
            ),
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
        let map = why::hemisphere(comparison, moved, fixed, side, progress)?;
        let entry = |(index, name): (usize, String)| {
            let (direction, largest) = map.worst(index)?;
            let (standard_error, direction) = (Some(map.standard_error(index)), Some(direction));
            let mean = map.mean(index);
            let found = MapSummary { prediction: name, mean, largest, ..MapSummary::default() };
            Some(MapSummary { standard_error, direction, ..found })
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

/// A prediction, a direction, and the loss there with its standard error.
type DirectionRow<'a> = (&'a str, [f64; 3], [f64; 2]);
/// A prediction, the column and row of a texel, and its loss in each channel.
type TexelRow<'a> = (&'a str, [usize; 2], [f32; 3]);

impl Report for MapReport {
    fn heading(&self) -> String {
        self.compared.heading(&self.shows)
    }

    /// For programs a row for each texel or direction of each prediction; for people a summary of each prediction.
    fn table(&self, reader: Reader) -> Table {
        match (reader, &self.directions) {
            (Reader::Person, directions) => self.summary(directions.as_ref().map(|(moved, _)| *moved)),
            (Reader::Program, Some((_, map))) => self.directions_table(map),
            (Reader::Program, None) => self.texels_table(),
        }
    }
}

impl MapReport {
    /// A row for each prediction; `moved` is what moves over the directions.
    fn summary(&self, moved: Option<Endpoint>) -> Table {
        let summary: [Field<MapSummary>; 3] = [
            ("", "prediction", |summary| summary.prediction.as_str().into()),
            ("", "mean", |summary| summary.mean.into()),
            ("", "largest", |summary| summary.largest.into()),
        ];
        let place: [Field<MapSummary>; 2] = match moved {
            Some(moved) => [
                ("", "+- std. error", |summary| summary.standard_error.into()),
                ("", roles(moved)[0], |summary| summary.direction.into()),
            ],
            None => {
                [("", "column", |summary| summary.column.into()), ("", "row", |summary| summary.row.into())]
            }
        };
        Table::fields(&[&summary[..], &place].concat(), &self.results, Reader::Person)
    }

    fn directions_table(&self, map: &Hemisphere) -> Table {
        let fields: [Field<DirectionRow<'_>>; 4] = [
            ("prediction", "", |(prediction, ..)| (*prediction).into()),
            ("x y z", "", |(_, direction, _)| (*direction).into()),
            ("loss", "", |(.., [loss, _])| (*loss).into()),
            ("standard_error", "", |(.., [_, error])| (*error).into()),
        ];
        let all = self.results.iter().zip(&map.losses).zip(&map.standard_errors);
        let rows = all.flat_map(|((summary, losses), errors)| {
            let cells = map.directions.iter().zip(losses).zip(errors);
            cells.filter_map(|((direction, &loss), &error)| {
                Some((summary.prediction.as_str(), (*direction)?, [loss, error]))
            })
        });
        Table::fields(&fields, rows, Reader::Program)
    }

    fn texels_table(&self) -> Table {
        let fields: [Field<TexelRow<'_>>; 6] = [
            ("prediction", "", |(prediction, ..)| (*prediction).into()),
            ("column", "", |(_, [column, _], _)| (*column).into()),
            ("row", "", |(_, [_, row], _)| (*row).into()),
            ("red", "", |(.., [red, _, _])| Cell::Single(*red)),
            ("green", "", |(.., [_, green, _])| Cell::Single(*green)),
            ("blue", "", |(.., [_, _, blue])| Cell::Single(*blue)),
        ];
        let rows = self.results.iter().zip(&self.images).flat_map(|(summary, image)| {
            let all = image.pixels.iter().enumerate();
            all.map(|(at, pixel)| (summary.prediction.as_str(), [at % image.width, at / image.width], *pixel))
        });
        Table::fields(&fields, rows, Reader::Program)
    }
}
