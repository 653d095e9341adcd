//! Effects of edits, carried out, and results of work on other threads, taken over.

use std::path::Path;

use eframe::egui;

use svbrdf_files::scene_file;

use crate::dataset::opening;
use crate::files::browse;
use crate::frame::layout::Parts;
use crate::frame::saving;
use crate::jobs::Edit;
use crate::jobs::work::job::Job;
use crate::message::Message;
use crate::model::effect::Effect;

/// Carries out what edits of the model need outside of it: the only place that does.
pub(super) fn carry_out(parts: &mut Parts, ctx: &egui::Context) {
    for effect in std::mem::take(&mut parts.model.effects) {
        one(parts, ctx, effect);
        ctx.request_repaint();
    }
}

fn one(parts: &mut Parts, ctx: &egui::Context, effect: Effect) {
    let Parts { model, jobs, .. } = parts;
    match effect {
        Effect::ReadScenes(paths) => {
            let read = Job::<Edit>::start(&jobs.waker, move |_| {
                let file = scene_file::read_one(&paths)?;
                Ok(Box::new(|model| {
                    model.dialogs.open = None;
                    file.into_iter().for_each(|file| model.use_scenes(file));
                }))
            });
            jobs.edits.insert("scenes", read);
        }
        Effect::OpenDataset(paths) => opening::open(jobs, paths),
        Effect::RestoreDataset(session, results) => {
            opening::restore(jobs, *session, results, model.materials.rules.strict);
        }
        Effect::Browse(what) => {
            // Where what is open came from.
            let from = model.files().next().and_then(Path::parent);
            jobs.edits.insert("dialog", browse::start(&jobs.waker, what, from));
        }
        Effect::Save(request) => saving::save_file(parts, ctx, request),
        Effect::CopyPicture => saving::copy_picture(parts, ctx),
    }
}

/// Takes over the results that have arrived since the last frame.
pub(super) fn take_results(parts: &mut Parts, ctx: &egui::Context) {
    if let Some(seconds) = parts.model.messages.expire(parts.model.time) {
        ctx.request_repaint_after_secs(seconds as f32);
    }
    take_materials(parts);
    parts.jobs.take_edits(&mut parts.model);
    let fault = parts.gpu.as_ref().and_then(|gpu| gpu.gpu.take_fault());
    parts.model.report(fault.map(|fault| Message::Failed(fault.into())));
    follow_files(parts);
}

/// Asks for the materials that are being read, and takes over those that have been.
fn take_materials(parts: &mut Parts) {
    let mut problems = Vec::new();
    let (jobs, materials) = (&parts.jobs, &mut parts.model.materials);
    for mut opening in std::mem::take(&mut materials.openings) {
        let (arrivals, goes_on) = jobs.read(&opening);
        let are_wanted = arrivals.into_iter().all(|arrival| {
            let is_wanted = materials.place(&opening, arrival, &mut problems);
            opening.arrived += 1;
            is_wanted
        });
        materials.openings.extend(Some(opening).filter(|_| goes_on && are_wanted));
    }
    for path in std::mem::take(&mut parts.model.materials.read) {
        parts.model.messages.settle(&path);
    }
    report_problems(parts, problems);
}

/// Reports problems with materials: those of the open dialog in the dialog, which stays open with its text.
fn report_problems(parts: &mut Parts, problems: Vec<Message>) {
    let asked = parts.model.dialogs.open.as_ref().and_then(|dialog| dialog.opening);
    let mut is_told = false;
    for problem in problems {
        match (&problem, &mut parts.model.dialogs.open) {
            (Message::NotRead { error, opening, .. }, Some(dialog))
                if asked == Some(*opening) && error.names_outside().is_none() =>
            {
                dialog.fail(error.to_string());
                is_told = true;
            }
            (Message::NotOpened(_), _) if is_told => {}
            _ => parts.model.report([problem]),
        }
    }
    if asked.is_some_and(|opening| !parts.model.materials.is_waiting(opening)) && !is_told {
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
            parts.model.dataset.read_again(case);
            continue;
        }
        for opening in parts.model.materials.reload(Some(&[index])) {
            parts.model.read(opening);
        }
    }
}
