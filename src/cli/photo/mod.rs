//! `svbrdf photo`: renderings against a photograph.

mod args;
mod output;
mod results;

use svbrdf::error::Error;
use svbrdf::files::read::read_photograph;
use svbrdf::picture::difference::Difference;
use svbrdf::picture::export::{Destination, PictureFormat};

use super::bar::watched;
use super::exit::{put, tell};
use super::materials;
use super::render::check_heights;
use super::session::SessionSettings;
use super::stop::stoppable;
pub use args::{PhotoArgs, PhotoReadingArgs, PhotoSceneArgs};
use results::{PhotoResult, Setting, results};

/// Compares, prints the differences to stdout and writes the file.
///
/// # Errors
/// Where the photograph, a scene or a material cannot be read or used, or the file cannot be written.
pub fn run(args: &PhotoArgs) -> Result<(), Error> {
    let destination = args.output.as_deref().map(Destination::<PictureFormat>::new).transpose()?;
    if !output::KINDS.contains(&args.difference) {
        let (known, found) = (output::KINDS.map(Difference::key).join(", "), args.difference.key());
        return Err(Error::Usage(format!("expected one of the differences {known}, found {found}")));
    }
    let saved = SessionSettings::of(&args.comparison.materials)?;
    let scene = args.scene.scene(saved.map(|saved| saved.scene))?;
    let text = format!("reading {}", args.photo.display());
    let photograph = watched(&text, |_| read_photograph(&args.photo, &args.reading.options()))?;
    let corners = args.reading.corners(photograph.size());
    corners.check(photograph.size())?;
    let setting = Setting { args, photograph, corners, scene };
    for note in &setting.photograph.notes {
        tell(&format!("note: {note}"));
    }
    let materials = materials::open::<f32>(&args.comparison.materials)?.into_all();
    if destination.is_some() {
        check_heights(&materials)?;
    }
    let results = results(&setting, materials)?;
    if let Some(destination) = destination {
        write_differences(&destination, &setting, &results)?;
    }
    put(&output::report(&setting, &results, args.format)?)
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
