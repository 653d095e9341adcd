//! `svbrdf photo`: renderings against a photograph.

mod args;
mod output;
mod results;

use svbrdf::error::Error;
use svbrdf::files::read::read_photograph;
use svbrdf::picture::difference::Difference;
use svbrdf::picture::export::{Destination, PictureFormat};

use super::args::Given;
use super::job::{ComparisonJob, check_heights};
use super::output::exit::{put, tell};
use super::output::stop::stoppable;
use super::output::{CommandError, watched};
pub use args::PhotoArgs;
use results::{PhotoResult, Setting, results};

/// Compares, prints the differences to stdout and writes the file.
///
/// # Errors
/// Where the photograph, a scene or a material cannot be read or used, or the file cannot be written.
pub fn run(args: &PhotoArgs, given: &Given) -> Result<(), CommandError> {
    let destination = args.output.as_deref().map(Destination::<PictureFormat>::new).transpose()?;
    if !output::KINDS.contains(&args.difference) {
        let (known, found) = (output::KINDS.map(Difference::key).join(", "), args.difference.key());
        return Err(CommandError::Usage(format!("expected one of the differences {known}, found {found}")));
    }
    let job = ComparisonJob::new(&args.comparison, given)?;
    let scene = args.scene.scene(job.session.as_ref().map(|session| session.scene))?;
    let text = format!("reading {}", args.photo.display());
    let photograph = watched(&text, |_| read_photograph(&args.photo, &args.reading.options()))?;
    let corners = args.reading.corners(photograph.size());
    corners.check(photograph.size())?;
    let setting = Setting { args, photograph, corners, scene, convention: job.convention };
    for note in &setting.photograph.notes {
        tell(&format!("note: {note}"));
    }
    let materials = job.materials.open::<f32>()?.into_all();
    if destination.is_some() {
        check_heights(&materials)?;
    }
    let results = results(&setting, materials)?;
    if let Some(destination) = destination {
        write_differences(&destination, &setting, &results)?;
    }
    Ok(put(&output::report(&setting, &results, args.format)?)?)
}

fn write_differences(
    destination: &Destination<PictureFormat>,
    setting: &Setting<'_>,
    results: &[PhotoResult],
) -> Result<(), Error> {
    let kind = setting.args.difference;
    let panes: Vec<_> = results.iter().map(|result| result.compared.difference(kind)).collect();
    let last = output::last_colour(results, kind);
    let entries = output::entries(setting, results, last);
    stoppable(|progress| destination.write_maps(&panes, last as f32, &entries, progress))
}
