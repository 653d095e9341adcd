//! A study as a CSV table.

use std::path::Path;

use crate::study::{Point, Study};
use svbrdf_core::loss::Precision;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;

use svbrdf_files::disk::atomic::Destination;

const CSV_HEADING: [&str; 14] = [
    "scenes",
    "near",
    "distant",
    "sampler",
    "texels",
    "precision",
    "maps",
    "seconds",
    "error",
    "shift",
    "seeds",
    "runs",
    "pareto",
    "options",
];

/// The destination of a table. Checks `path` before there is anything to write.
///
/// # Errors
/// [`UnknownName`](svbrdf_core::error::Error::UnknownName) for an extension other than csv, [`Error::Unwritable`] where its
/// folder is missing or it is itself a folder.
pub fn destination(path: &Path) -> Result<Destination<()>, Error> {
    let format = |extension: &str| (extension == "csv").then_some(());
    Destination::among(path, format, "extension of a table", ".csv")
}

/// Writes every point of a study, a row each (RFC 4180); the file appears when it is complete, or not at all.
///
/// # Errors
/// [`Error::Unwritable`], [`Cancelled`](Error::is_cancelled).
pub fn write(study: &Study, destination: &Destination<()>, progress: &Progress) -> Result<(), Error> {
    destination.replace(progress, |file| {
        let mut writer = csv::Writer::from_writer(file);
        writer.write_record(CSV_HEADING)?;
        for point in &study.points {
            writer.write_record(csv_row(point))?;
        }
        writer.flush()
    })
}

fn csv_row(p: &Point) -> [String; 14] {
    let c = &p.choice;
    let precision = if c.precision == Precision::F64 { "f64" } else { "f32" };
    let short = |number: f64| format!("{number:.4e}");
    [
        c.scenes.to_string(),
        c.near().to_string(),
        c.distant().to_string(),
        c.sampler.to_string(),
        c.texels.to_string(),
        precision.to_owned(),
        c.maps.name().to_owned(),
        short(p.seconds),
        short(p.error),
        short(p.shift),
        p.seeds.to_string(),
        p.runs.to_string(),
        p.pareto.to_string(),
        c.options(),
    ]
}
