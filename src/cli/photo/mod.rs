//! `svbrdf photo`: renderings against a photograph, or against all photographs of a capture.

mod args;
mod notes;
mod output;

use svbrdf_core::picture::difference::Difference;
use svbrdf_evaluate::photograph::{PhotoReport, PhotoSetting};
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::export::{Destination, PictureFormat};
use svbrdf_files::photograph::Capture;

use super::args::Given;
use super::job::{ComparisonJob, Job, NewJob, check_heights};
use super::output::exit::put;
use super::output::stop::stoppable;
use super::output::{CommandError, watched};
pub use args::PhotoArgs;
use args::PhotoCaptureArgs;

/// Photographs and materials to compare.
#[derive(Debug)]
struct PhotoJob {
    args: PhotoArgs,
    comparison: ComparisonJob,
}

impl PhotoArgs {
    pub fn job(mut self, given: &Given) -> NewJob {
        if self.capture.capture.is_some() {
            self.shift_materials()?;
        } else {
            let reason = "the exposure of a capture and held-out photographs belong to --capture";
            given.refuse::<PhotoCaptureArgs>(reason)?;
        }
        let comparison = ComparisonJob::new(&self.comparison, given)?;
        Ok(Box::new(PhotoJob { args: self, comparison }))
    }
}

impl Job for PhotoJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { args, comparison: job } = *self;
        let destination = args.output.as_deref().map(Destination::<PictureFormat>::new).transpose()?;
        let known = PhotoSetting::DIFFERENCES;
        if !known.contains(&args.difference) {
            let (known, found) = (known.map(Difference::key).join(", "), args.difference.key());
            let text = format!("expected one of the differences {known}, found {found}");
            return Err(CommandError::Usage(text));
        }
        let photograph = args.reading.photograph(args.photo);
        let capture = match &args.capture.capture {
            Some(path) => Capture::read(path)?.with_options(&photograph.read),
            None => Capture::of_one(photograph, args.scene.scene(job.session.as_ref().map(|one| one.scene))?),
        };
        let setting =
            PhotoSetting::new(capture, args.capture.exposure, &args.capture.hold_out, job.convention)?;
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
}
