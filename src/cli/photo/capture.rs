//! `svbrdf photo --capture`: renderings against all photographs of a capture.

use std::path::Path;

use svbrdf_core::material::Material;
use svbrdf_evaluate::capture::{Capture, CaptureReport, CaptureSetting};

use super::args::PhotoArgs;
use super::stretching::stretched;
use crate::cli::job::ComparisonJob;
use crate::cli::output::exit::{put, tell};
use crate::cli::output::{CommandError, watched};

/// Compares the materials of `args` with the capture at `path`, and prints the differences to stdout.
///
/// # Errors
/// Where the capture, a photograph or a material cannot be read or used.
pub fn run(args: &PhotoArgs, path: &Path, job: &ComparisonJob) -> Result<(), CommandError> {
    let mut capture = Capture::read(path)?;
    capture.set_options(&args.reading.options());
    let of = capture.file.display();
    for file in capture.outside() {
        tell(&format!("note: {} lies outside of the folder of {of}, which names it", file.display()));
    }
    let name = path.display().to_string();
    let setting =
        CaptureSetting::new(name, capture, args.capture.exposure, &args.capture.hold_out, job.convention)?;
    let materials = job.materials.open::<f32>()?.into_all();
    let named = materials.iter().map(|material| (material.name(), material));
    let report = watched("comparing", |progress| CaptureReport::new(setting, named, progress))?;
    tell_notes(&report, &materials);
    Ok(put(&args.format.write(&report)?)?)
}

/// What was noticed about the photographs, and where their shape is not that of a material; what several have in common once.
fn tell_notes(report: &CaptureReport, materials: &[Material<f32>]) {
    let mut told: Vec<String> = Vec::new();
    for read in &report.photographs {
        let noticed = read.notes.iter().map(|note| format!("note: {note}"));
        let sizes = materials.iter().map(Material::size).filter(|_| read.is_whole);
        let remedy = "the corners in capture.json tell where the material is in it";
        for note in noticed.chain(stretched(read.size, sizes, remedy)) {
            if !told.contains(&note) {
                tell(&note);
                told.push(note);
            }
        }
    }
}
