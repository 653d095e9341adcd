//! Results of reading, saving, browsing and watching, taken over into the model and the dialogs.

use eframe::egui;

use crate::frame::dataset;
use crate::frame::layout::Parts;
use crate::model::material::problem::MaterialProblem;
use crate::model::message::Message;

/// Takes over the results that have arrived since the last frame.
pub(super) fn take_results(parts: &mut Parts, ctx: &egui::Context) {
    if let Some(seconds) = parts.model.messages.expire(parts.model.time) {
        ctx.request_repaint_after_secs(seconds as f32);
    }
    take_materials(parts);
    take_edits(parts);
    dataset::show(parts);
    let fault = parts.gpu.as_ref().and_then(|gpu| gpu.gpu.take_fault());
    parts.model.report(fault.map(|fault| Message::Failed(fault.into())));
    take_saved(parts);
    follow_files(parts);
}

fn take_materials(parts: &mut Parts) {
    let mut problems = Vec::new();
    let (jobs, materials) = (&mut parts.jobs, &mut parts.model.materials);
    let errors = jobs
        .openings
        .take(&mut jobs.uploads, |place, arrival| materials.place(place, arrival, &mut problems));
    for path in std::mem::take(&mut parts.model.materials.read) {
        parts.model.messages.settle(&path);
    }
    report_problems(parts, problems);
    parts.model.report(errors.into_iter().map(Message::Failed));
}

/// Reports problems with materials: those of the open dialog in the dialog, which stays open with its text.
fn report_problems(parts: &mut Parts, problems: Vec<MaterialProblem>) {
    let asked = parts.model.dialogs.open.as_ref().and_then(|dialog| dialog.opening);
    let mut is_told = false;
    for problem in problems {
        match (&problem, &mut parts.model.dialogs.open) {
            (MaterialProblem::NotRead { error, opening, .. }, Some(dialog))
                if asked == Some(*opening) && error.names_outside().is_none() =>
            {
                dialog.fail(error.to_string());
                is_told = true;
            }
            (MaterialProblem::NotOpened(_), _) if is_told => {}
            _ => parts.model.report([problem.into()]),
        }
    }
    if asked.is_some_and(|opening| !parts.jobs.openings.is_waiting(opening)) && !is_told {
        parts.model.dialogs.open = None;
    }
}

/// Reads files that have changed again where they are watched, and otherwise marks their materials.
fn follow_files(parts: &mut Parts) {
    for index in parts.jobs.watch.poll(&parts.jobs.waker, &parts.model.materials) {
        if !parts.model.settings.watch {
            parts.model.materials.all[index].is_newer = true;
            continue;
        }
        if let Some(case) = parts.model.dataset.shown {
            // With its losses, all of it in one frame.
            parts.model.dataset.is_stale = true;
            dataset::read_again(parts, case);
            continue;
        }
        for request in parts.model.materials.reload(Some(&[index])) {
            parts.jobs.read(&parts.model, request);
        }
    }
}

fn take_saved(parts: &mut Parts) {
    let Some(result) = parts.jobs.saving.as_ref().and_then(|job| job.poll()) else { return };
    parts.jobs.saving = None;
    match (result, &mut parts.model.dialogs.save) {
        (Ok(path), _) => {
            parts.model.dialogs.save = None;
            let path = std::path::absolute(&path).unwrap_or(path);
            parts.model.report([Message::Done(format!("Saved {}", path.display()))]);
        }
        (Err(error), _) if error.is_cancelled() => {}
        (Err(error), Some(dialog)) => dialog.field.fail(error.to_string()),
        (Err(error), None) => parts.model.report([Message::Failed(error)]),
    }
}

/// Takes over edits whose work has ended.
fn take_edits(parts: &mut Parts) {
    let Parts { model, jobs, .. } = parts;
    jobs.edits.retain(|_, job| {
        let Some(result) = job.poll() else { return true };
        match result {
            Ok(edit) => edit.0(model),
            Err(error) => model.not_opened(error),
        }
        false
    });
}
