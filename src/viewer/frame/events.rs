//! Results of reading, saving, browsing and watching, taken over into the model and the dialogs.

use eframe::egui;

use crate::error::Error;
use crate::frame::dataset;
use crate::frame::layout::Parts;
use crate::jobs::browse::Browsed;
use crate::model::dialogs::Dialogs;
use crate::model::material::problem::MaterialProblem;
use crate::model::message::Message;

/// Takes over the results that have arrived since the last frame.
pub(super) fn take_results(parts: &mut Parts, ctx: &egui::Context) {
    if let Some(seconds) = parts.model.messages.expire(parts.model.time) {
        ctx.request_repaint_after_secs(seconds as f32);
    }
    take_materials(parts);
    dataset::take(parts);
    dataset::show(parts);
    let fault = parts.gpu.as_ref().and_then(|gpu| gpu.gpu.take_fault());
    parts.model.report(fault.map(|fault| Message::Failed(fault.into())));
    take_saved(parts);
    take_browsed(parts);
    take_scene_file(parts);
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

fn take_scene_file(parts: &mut Parts) {
    let Some(result) = parts.jobs.scene_file.as_ref().and_then(|job| job.poll()) else { return };
    parts.jobs.scene_file = None;
    match result {
        Ok(file) => {
            parts.model.dialogs.open = None;
            parts.model.use_scenes(file);
        }
        Err(error) => parts.model.not_opened(error),
    }
}

fn take_browsed(parts: &mut Parts) {
    let Some(result) = parts.jobs.browsing.as_ref().and_then(|job| job.poll()) else { return };
    parts.jobs.browsing = None;
    browsed(&mut parts.model.dialogs, result);
}

/// What to do without a file dialog.
const NO_DIALOG: &str = "This system has no file dialog: install zenity or a desktop portal. Type a path here, or drop files \
                         on the window.";

/// Takes over what was chosen in the dialog of the system: the save dialog where it is open, otherwise the open dialog.
fn browsed(dialogs: &mut Dialogs, result: Result<Browsed, Error>) {
    let chosen = match result {
        Ok(Browsed::Chosen(paths)) => Ok(paths),
        Ok(Browsed::Cancelled) => Ok(Vec::new()),
        Ok(Browsed::Unavailable) => Err(NO_DIALOG.to_owned()),
        Err(error) => Err(error.to_string()),
    };
    if let Some(dialog) = &mut dialogs.save {
        return match chosen {
            Ok(paths) => paths.first().into_iter().for_each(|path| dialog.fill(path)),
            Err(problem) => dialog.field.fail(problem),
        };
    }
    let dialog = dialogs.open.get_or_insert_default();
    match chosen {
        Ok(paths) => paths.iter().for_each(|path| dialog.add(path)),
        Err(problem) => dialog.fail(problem),
    }
}
