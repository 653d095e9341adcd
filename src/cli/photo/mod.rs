//! `svbrdf photo`: renderings against a photograph.

mod args;
mod capture;
mod output;
mod stretching;

use svbrdf_core::error::Error;
use svbrdf_core::material::Material;
use svbrdf_core::picture::difference::Difference;
use svbrdf_evaluate::photograph::{PhotoReport, PhotoSetting};
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::export::{Destination, PictureFormat};
use svbrdf_files::read::read_photograph;

use super::args::Given;
use super::job::{ComparisonJob, Job, NewJob, check_heights};
use super::output::exit::{put, tell};
use super::output::stop::stoppable;
use super::output::{CommandError, watched};
pub use args::PhotoArgs;
use args::PhotoCaptureArgs;
use stretching::stretched;

/// Photographs and materials to compare.
#[derive(Debug)]
struct PhotoJob {
    args: PhotoArgs,
    comparison: ComparisonJob,
}

impl PhotoArgs {
    pub fn job(mut self, given: &Given) -> NewJob {
        if self.capture.capture.is_some() {
            self.shift_materials();
        } else {
            let reason = "the exposure of a capture and held-out photographs belong to --capture";
            given.refuse::<PhotoCaptureArgs>(reason)?;
        }
        let comparison = ComparisonJob::new(&self.comparison, given)?;
        Ok(Box::new(PhotoJob { args: self, comparison }))
    }
}

/// Compares, prints the differences to stdout and writes the file.
impl Job for PhotoJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        match &self.args.capture.capture {
            Some(capture) => capture::run(&self.args, capture, &self.comparison),
            None => of_photograph(&self.args, &self.comparison),
        }
    }
}

fn of_photograph(args: &PhotoArgs, job: &ComparisonJob) -> Result<(), CommandError> {
    let destination = args.output.as_deref().map(Destination::<PictureFormat>::new).transpose()?;
    let known = PhotoReport::DIFFERENCES;
    if !known.contains(&args.difference) {
        let (known, found) = (known.map(Difference::key).join(", "), args.difference.key());
        return Err(CommandError::Usage(format!("expected one of the differences {known}, found {found}")));
    }
    let scene = args.scene.scene(job.session.as_ref().map(|session| session.scene))?;
    let text = format!("reading {}", args.photo.display());
    let photograph = watched(&text, |_| read_photograph(&args.photo, &args.reading.options()))?;
    let corners = args.reading.corners(photograph.size());
    corners.check(photograph.size())?;
    for note in &photograph.notes {
        tell(&format!("note: {note}"));
    }
    let opened = job.materials.open::<f32>()?;
    args.output.as_deref().map_or(Ok(()), check_output)?;
    let materials = opened.into_all();
    if destination.is_some() {
        check_heights(&materials)?;
    }
    note_stretching(args, photograph.size(), &materials);
    let setting = PhotoSetting {
        name: args.photo.display().to_string(),
        photograph,
        corners,
        falloff: args.reading.falloff,
        scene,
        convention: job.convention,
    };
    let named = materials.iter().map(|material| (material.name(), material));
    let report = watched("rendering", |progress| PhotoReport::new(setting, named, progress))?;
    if let Some(destination) = destination {
        write_differences(&destination, &report, args.difference)?;
    }
    Ok(put(&args.format.write(&report)?)?)
}

/// Notes for each size of `materials` where the whole photograph has another shape.
fn note_stretching(args: &PhotoArgs, size: [usize; 2], materials: &[Material<f32>]) {
    if args.reading.is_whole() {
        let remedy = "--corners gives the corners of the material in it";
        stretched(size, materials.iter().map(Material::size), remedy).iter().for_each(|note| tell(note));
    }
}

fn write_differences(
    destination: &Destination<PictureFormat>,
    report: &PhotoReport,
    kind: Difference,
) -> Result<(), Error> {
    let panes: Vec<_> = report.results.iter().map(|result| result.compared.difference(kind)).collect();
    let last = output::last_colour(report, kind);
    let entries = output::entries(report, kind, last);
    stoppable(|progress| destination.write_maps(&panes, last as f32, &entries, progress))
}
