//! The ranking of a data set as a page.

use std::path::Path;

use svbrdf_files::atomic::write_text;
use svbrdf_files::dataset::DatasetReport;
use svbrdf_files::inputs::check_output;
use svbrdf_files::page::{check_destination, material_views, ranking};

use super::args::{RankArgs, RankFormat};
use crate::cli::args::{Given, modes};
use crate::cli::output::stop::stoppable;
use crate::cli::output::{CommandError, watched_on};

/// Checks the options of a page, before anything is computed: its file, or none for another format.
///
/// # Errors
/// [`CommandError::Usage`]; where the file cannot be written.
pub fn check(args: &RankArgs, given: &Given) -> Result<(), CommandError> {
    if args.format != RankFormat::Html {
        return given.check(&modes::RANK_PRINTED);
    }
    Ok(check_destination(output(args)?)?)
}

/// Writes the page, with thumbnails and figures of the materials where their files are known: journals do not name ground truths.
///
/// # Errors
/// Where a file cannot be written, or is one of the materials.
pub fn write(args: &RankArgs, report: &DatasetReport) -> Result<(), CommandError> {
    let path = output(args)?;
    let cases = if args.merge { Vec::new() } else { report.settings.source.cases()? };
    let predictions = cases.iter().flat_map(|case| case.candidates.iter().map(|one| one.path.as_path()));
    let inputs = cases.iter().map(|case| case.ground_truth.as_path()).chain(predictions);
    check_output(path, inputs.chain(args.journal.as_deref()))?;
    Ok(stoppable(|progress| {
        let views = watched_on(progress, "rendering materials", |progress| {
            material_views(report, &cases, args.figures, path, progress)
        })?;
        write_text(path, &ranking(report, &views), progress)
    })?)
}

fn output(args: &RankArgs) -> Result<&Path, CommandError> {
    args.output
        .as_deref()
        .ok_or_else(|| CommandError::usage("--format html writes a file; give --output NAME.html"))
}
