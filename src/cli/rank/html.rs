//! The ranking of a data set as a page.

use std::path::Path;

use svbrdf_core::progress::Progress;
use svbrdf_evaluate::dataset::{Case, DatasetReport};
use svbrdf_files::disk::atomic::write_text;
use svbrdf_files::disk::inputs::check_output_of;
use svbrdf_page::{check_destination, material_views, ranking};

use super::args::{RankArgs, RankFormat};
use crate::cli::args::{Given, modes};
use crate::cli::output::{CommandError, watched_on};

/// Checks the options of a page, before anything is computed: its file, which replaces no material and no list, or none for
/// another format.
///
/// # Errors
/// [`CommandError::Usage`]; where the file cannot be written.
pub fn check(args: &RankArgs, given: &Given, cases: &[Case]) -> Result<(), CommandError> {
    if args.format != RankFormat::Html {
        return given.check(&modes::RANK_PRINTED);
    }
    let path = output(args)?;
    check_destination(path)?;
    let predictions = cases.iter().flat_map(|case| case.candidates.iter().map(|one| &one.path));
    let materials = cases.iter().map(|case| &case.ground_truth).chain(predictions);
    Ok(check_output_of(path, materials.chain(args.comparison.materials.paths()))?)
}

/// Writes the page, with thumbnails and figures of the materials `cases`.
///
/// # Errors
/// Where a file cannot be written, or is one of the materials.
pub fn write(
    args: &RankArgs,
    report: &DatasetReport,
    cases: &[Case],
    progress: &Progress,
) -> Result<(), CommandError> {
    let path = output(args)?;
    let views = watched_on(progress, "rendering materials", |progress| {
        material_views(report, cases, args.figures, path, progress)
    })?;
    Ok(write_text(path, &ranking(report, &views), progress)?)
}

fn output(args: &RankArgs) -> Result<&Path, CommandError> {
    args.output
        .as_deref()
        .ok_or_else(|| CommandError::usage("--format html writes a file; give --output NAME.html"))
}
