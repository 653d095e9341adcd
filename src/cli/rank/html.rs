//! The ranking of a data set as a page.

use std::path::Path;

use svbrdf_files::atomic::write_text;
use svbrdf_files::dataset::{Case, DatasetReport};
use svbrdf_files::inputs::check_output_of;
use svbrdf_files::page::{check_destination, material_views, ranking};

use super::args::{RankArgs, RankFormat};
use super::cases::source;
use crate::cli::args::{Given, modes};
use crate::cli::output::stop::stoppable;
use crate::cli::output::{CommandError, watched_on};

/// Checks the options of a page, before anything is computed: its file, which replaces no material, list or journal, or none for
/// another format.
///
/// # Errors
/// [`CommandError::Usage`]; where the file cannot be written.
pub fn check(args: &RankArgs, given: &Given) -> Result<(), CommandError> {
    if args.format != RankFormat::Html {
        return given.check(&modes::RANK_PRINTED);
    }
    let path = output(args)?;
    check_destination(path)?;
    let cases = materials(args)?;
    let predictions = cases.iter().flat_map(|case| case.candidates.iter().map(|one| &one.path));
    let materials = cases.iter().map(|case| &case.ground_truth).chain(predictions);
    Ok(check_output_of(path, materials.chain(args.comparison.materials.paths()).chain(&args.journal))?)
}

/// The materials of the figures; none of journals, which do not name ground truths.
fn materials(args: &RankArgs) -> Result<Vec<Case>, CommandError> {
    if args.merge { Ok(Vec::new()) } else { Ok(source(args)?.cases()?) }
}

/// Writes the page, with thumbnails and figures of the materials where their files are known.
///
/// # Errors
/// Where a file cannot be written, or is one of the materials.
pub fn write(args: &RankArgs, report: &DatasetReport) -> Result<(), CommandError> {
    let path = output(args)?;
    let cases = materials(args)?;
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
