//! Effects of edits, carried out, and results of work on other threads, taken over; saving and copying of the view.

use std::path::Path;
use std::sync::Arc;

use eframe::egui;

use svbrdf_core::image::Image;
use svbrdf_files::disk::inputs::check_output_of;
use svbrdf_files::scene_file;

use crate::dataset::opening;
use crate::error::Error;
use crate::files::dialog;
use crate::frame::layout::Parts;
use crate::frame::written::{self, Writing};
use crate::jobs::watch::Watched;
use crate::jobs::work::Job;
use crate::jobs::{Edit, SAVING, Shown};
use crate::message::Message;
use crate::model::Effect;
use crate::model::Model;
use crate::model::dialogs::{SaveKind, SaveRequest};
use crate::model::material::opening::Arrival;
use crate::pane::Displayed;

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
        Effect::CheckFiles(session) => {
            let check = Job::<Edit>::start(&jobs.waker, move |_| {
                let warn = |path: &Path| {
                    let path = path.display();
                    Message::Warning(format!("{path} has changed since the picture was saved"))
                };
                let changed: Vec<_> = session.changed().into_iter().map(warn).collect();
                Ok(Box::new(|model| model.report(changed)))
            });
            jobs.edits.insert("files", check);
        }
        Effect::Browse(what) => {
            // Where what is open came from.
            let from = model.files().next().and_then(Path::parent);
            jobs.edits.insert("dialog", dialog::start(&jobs.waker, what, from));
        }
        Effect::Save(request) => save_file(parts, ctx, request),
        Effect::CopyPicture => copy_picture(parts, ctx),
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
    let (jobs, messages, materials) = (&parts.jobs, &mut parts.model.messages, &mut parts.model.materials);
    for mut opening in std::mem::take(&mut materials.openings) {
        let (arrivals, goes_on) = jobs.read(&opening);
        let are_wanted = arrivals.into_iter().all(|arrival| {
            if let Arrival::Read(read) = &arrival {
                messages.settle(read.path());
            }
            let is_wanted = materials.place(&opening, arrival, &mut problems);
            opening.arrived += 1;
            is_wanted
        });
        materials.openings.extend(Some(opening).filter(|_| goes_on && are_wanted));
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
    let Parts { model, jobs, ui, .. } = parts;
    let (all, rows) = (&model.materials.all, &ui.dataset.rows);
    let of_rows = rows.iter().map(|(case, row)| Watched::Row(*case, Arc::as_ptr(row).addr()));
    let watched = all.iter().map(|one| Watched::Material(one.id())).chain(of_rows).collect();
    let of_rows = rows.iter().map(|(_, row)| row.files.clone());
    let files = || all.iter().map(|one| one.read.files()).chain(of_rows).collect();
    for changed in jobs.watch.poll(&jobs.waker, watched, files) {
        let index = model.materials.all.iter().position(|one| changed == Watched::Material(one.id()));
        match (changed, model.dataset.shown) {
            // With its losses, all of it in one frame.
            (Watched::Row(case, _), _) | (_, Some(case)) if model.settings.watch => {
                model.dataset.read_again(case)
            }
            (Watched::Row(case, _), _) => model.dataset.newer.extend([case]),
            _ if !model.settings.watch => {
                index.into_iter().for_each(|index| model.materials.all[index].is_newer = true);
            }
            _ => {
                let index: Vec<usize> = index.into_iter().collect();
                model.materials.reload(Some(&index)).into_iter().for_each(|opening| model.read(opening));
            }
        }
    }
}

/// Starts to save.
pub(super) fn save_file(parts: &mut Parts, ctx: &egui::Context, SaveRequest { kind, path }: SaveRequest) {
    if let Err(error) = check_output_of(&path, parts.model.files()) {
        parts.model.report([Message::Failed(error.into())]);
        return;
    }
    let picture = (kind == SaveKind::View).then(|| picture(parts, ctx)).transpose();
    let writing = picture.map(|picture| writing(parts, kind, picture));
    let job = Job::<Edit>::start(&parts.jobs.waker, move |progress| {
        let result = writing.and_then(|write| write(&path, progress)).map(|()| path);
        Ok(Box::new(|model: &mut Model| model.saved(result)))
    });
    parts.jobs.edits.insert(SAVING, job);
}

/// What is written; `picture` is of the view.
fn writing(parts: &Parts, kind: SaveKind, picture: Option<egui::ColorImage>) -> Writing {
    let (displayed, view) = (&parts.displayed(), &parts.model.view);
    match (kind, picture) {
        (_, Some(picture)) => save_view(displayed, picture),
        (SaveKind::View | SaveKind::Renderings, _) if view.display.difference && view.is_error_map() => {
            written::error_maps(displayed)
        }
        (SaveKind::View | SaveKind::Renderings, _) if displayed.photograph().is_some() => {
            written::against_photograph(displayed)
        }
        (SaveKind::View | SaveKind::Renderings, _) => written::renderings(displayed),
        (SaveKind::Strip, _) => written::strip(displayed),
        (SaveKind::Session, _) => written::session(displayed),
        (SaveKind::Scenes, _) => written::scenes(displayed),
        (SaveKind::Materials, _) => written::materials_csv(displayed),
    }
}

fn save_view(displayed: &Displayed<'_>, picture: egui::ColorImage) -> Writing {
    let pixels = picture.pixels.iter().map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
    let [width, height] = picture.size;
    written::view(displayed, Image::<u8> { width, height, pixels })
}

/// Puts the view on the clipboard as a picture.
pub(super) fn copy_picture(parts: &mut Parts, ctx: &egui::Context) {
    match picture(parts, ctx) {
        Ok(picture) => {
            ctx.copy_image(picture);
            parts.model.report([Message::Done("Copied the view as a picture".to_owned())]);
        }
        Err(error) => parts.model.report([Message::Failed(error)]),
    }
}

fn picture(parts: &mut Parts, ctx: &egui::Context) -> Result<egui::ColorImage, Error> {
    let Parts { model, jobs, ui, gpu } = parts;
    ui.picture(ctx, Displayed::ask(Shown { model, jobs }), gpu.as_mut())
}
