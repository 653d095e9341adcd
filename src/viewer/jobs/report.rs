//! Report: the page of the comparison with its findings, as `svbrdf report` writes it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use svbrdf_core::loss::Request;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_core::text::quoted;
use svbrdf_files::disk::atomic::write_text;
use svbrdf_files::session::Session;
use svbrdf_page::{Findings, MOST_BYTES, Repetition, Report, View, check_destination};

use super::displayed::Displayed;
use super::work::job::Job;
use crate::error::Error;
use crate::model::material::read::ReadMaterial;

/// Everything that the report of a window depends on.
struct ReportInputs {
    materials: Vec<(Arc<ReadMaterial>, String)>,
    convention: Convention,
    view: View,
    /// The scenes of the losses.
    request: Request,
    session: Session,
}

/// Starts to compute the findings of all predictions and to write the page to `path`.
pub fn start(displayed: Displayed<'_>, path: PathBuf) -> Job<PathBuf> {
    let inputs = ReportInputs::of(displayed);
    Job::start(&displayed.jobs.waker, move |progress| {
        check_destination(&path)?;
        let html = inputs.html(&path, progress)?;
        write_text(&path, &html, progress)?;
        Ok(path)
    })
}

impl ReportInputs {
    fn of(displayed: Displayed<'_>) -> Self {
        let model = displayed.model;
        let all = model.materials.all.iter();
        let (mut display, mut session) = (model.view.display.clone(), model.session());
        if display.difference && !model.view.is_error_map() && displayed.photograph().is_none() {
            // The range that the panes have, which may be automatic.
            display.differences.set_range(display.quantity, Some(displayed.range()));
        }
        session.window.display = Some(display.clone());
        let view = View { scene: model.view.scene, exposure_ev: model.view.exposure_ev, display };
        Self {
            materials: all.map(|one| (one.read.clone(), one.name().to_owned())).collect(),
            convention: model.view.convention(),
            view,
            request: model.settings.loss.request(),
            session,
        }
    }

    fn html(self, path: &Path, progress: &Progress) -> Result<String, Error> {
        let named =
            |(read, name): &(Arc<ReadMaterial>, String)| read.material().clone().renamed(name.clone());
        let materials: Vec<Material<f32>> = self.materials.iter().map(named).collect();
        let materials: Vec<&Material<f32>> = materials.iter().collect();
        let findings = match materials.as_slice() {
            [ground_truth, predictions @ ..] if !predictions.is_empty() => {
                Some(Findings::new(ground_truth, predictions, self.convention, &self.request, progress)?)
            }
            _ => None,
        };
        let report = Report {
            materials: &materials,
            convention: self.convention,
            view: self.view,
            findings,
            readings: self.materials.iter().map(|(read, _)| reading(read)).collect(),
            repetition: Some(repetition(path, &self.session)?),
            max_bytes: MOST_BYTES,
        };
        Ok(report.page(progress)?.html)
    }
}

/// The assumptions and notes of reading a material.
fn reading(ReadMaterial { record, .. }: &ReadMaterial) -> Vec<String> {
    let assumptions = record.assumptions.iter().map(ToString::to_string);
    assumptions.chain(record.notes.iter().map(ToString::to_string)).collect()
}

/// The command that makes the report at `path`, of a session beside it.
fn repetition(path: &Path, session: &Session) -> Result<Repetition, Error> {
    let name = format!("{}.svbrdf-session.json", path.file_stem().unwrap_or_default().to_string_lossy());
    let text = session.text(&path.with_file_name(&name))?;
    let command =
        format!("svbrdf report {} -o {}", quoted(&name), quoted(path.file_name().unwrap_or_default()));
    Ok(Repetition { command, session: Some([name, text]) })
}
