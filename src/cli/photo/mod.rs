//! `svbrdf photo`: renderings against a photograph, or against all photographs of a capture.

mod args;
mod notes;
mod output;

use svbrdf_core::picture::difference::Difference;
use svbrdf_evaluate::photograph::{PhotoReport, PhotoSetting};
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::export::{Destination, PictureFormat};
use svbrdf_files::photograph::Capture;

use super::args::{Given, modes};
use super::job::{ComparisonJob, check_heights};
use super::output::exit::put;
use super::output::stop::stoppable;
use super::output::{CommandError, watched};
pub use args::PhotoArgs;

/// Compares, prints the differences to stdout and writes the file.
///
/// # Errors
/// Where the capture, a photograph, a scene or a material cannot be read or used, or the file cannot be written.
pub fn run(mut args: PhotoArgs, given: &Given) -> Result<(), CommandError> {
    match args.capture.capture {
        Some(_) => args.shift_materials(),
        None => given.check(&modes::PHOTO_ALONE)?,
    }
    let destination = args.output.as_deref().map(Destination::<PictureFormat>::new).transpose()?;
    let known = PhotoSetting::DIFFERENCES;
    if !known.contains(&args.difference) {
        let (known, found) = (known.map(Difference::key).join(", "), args.difference.key());
        return Err(CommandError::Usage(format!("expected one of the differences {known}, found {found}")));
    }
    let job = ComparisonJob::new(&args.comparison, given)?;
    let photograph = args.reading.photograph(args.photo);
    let capture = match &args.capture.capture {
        Some(path) => Capture::read(path)?.with_options(&photograph.read),
        None => Capture::of_one(photograph, args.scene.scene(job.session.as_ref().map(|one| one.scene))?),
    };
    let setting = PhotoSetting::new(capture, args.capture.exposure, &args.capture.hold_out, job.convention)?;
    let opened = job.materials.open::<f32>()?;
    args.output.as_deref().map_or(Ok(()), check_output)?;
    let materials = opened.into_all();
    if destination.is_some() {
        check_heights(&materials)?;
    }
    let named = materials.iter().map(|material| (material.name(), material));
    let report = watched("comparing", |progress| PhotoReport::new(setting, named, progress))?;
    notes::tell_notes(&report, &materials);
    if let Some(destination) = destination {
        let (panes, last) = output::panes(&report, args.difference);
        let entries = output::entries(&report, args.difference, last);
        stoppable(|progress| destination.write_maps(&panes, last as f32, &entries, progress))?;
    }
    Ok(put(&args.format.write(&report)?)?)
}
