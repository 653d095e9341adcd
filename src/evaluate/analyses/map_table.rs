//! A map as a report: its rows, a summary for people, and its arrays.

use super::map::{MapReport, MapSummary, roles};
use crate::report::{ArrayValues, Cell, Field, Reader, Report, ReportArray, Table};
use crate::why::Hemisphere;
use svbrdf_core::image::Image;
use svbrdf_core::model::scene::Endpoint;

/// A prediction, a direction, and the loss there with its standard error.
type DirectionRow<'a> = (&'a str, [f64; 3], [f64; 2]);
/// A prediction, the column and row of a texel, and its loss in each channel.
type TexelRow<'a> = (&'a str, [usize; 2], [f32; 3]);

impl Report for MapReport {
    fn heading(&self) -> String {
        self.compared.heading(&self.shows)
    }

    fn pictures(&self) -> Option<(&[Image<f32>], &str)> {
        Some((&self.images, &self.shows))
    }

    fn into_arrays(self: Box<Self>) -> Vec<(&'static str, Vec<ReportArray>)> {
        let of_image = |Image { width, height, pixels }: Image<f32>| ReportArray {
            size: [width, height],
            channels: 3,
            values: ArrayValues::F32(pixels.into_flattened()),
        };
        let Some((_, map)) = self.directions else {
            return vec![("maps", self.images.into_iter().map(of_image).collect())];
        };
        let array = |channels, values| ReportArray {
            size: [map.side; 2],
            channels,
            values: ArrayValues::F64(values),
        };
        let planes = |planes: Vec<Vec<f64>>| planes.into_iter().map(|plane| array(1, plane)).collect();
        let directions = map.directions.iter().flat_map(|one| one.unwrap_or([f64::NAN; 3])).collect();
        vec![
            ("maps", planes(map.losses)),
            ("standard_errors", planes(map.standard_errors)),
            ("directions", vec![array(3, directions)]),
        ]
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
