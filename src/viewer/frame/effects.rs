//! Effects of edits, carried out.

use std::path::Path;

use eframe::egui;

use svbrdf_files::scene_file;

use crate::frame::layout::Parts;
use crate::frame::{dataset, saving};
use crate::jobs::loss::ComputeLosses;
use crate::jobs::work::job::Job;
use crate::jobs::{Edit, browse};
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
        Effect::Read(request) => {
            let opening = jobs.read(model, request);
            if let Some(dialog) = model.dialogs.open.as_mut().filter(|dialog| dialog.submitted) {
                dialog.opening = Some(opening);
            }
        }
        Effect::CancelReading(number) => jobs.openings.cancel(number),
        Effect::ReadScenes(paths) => {
            let read = Job::start(&jobs.waker, move |_| {
                let file = scene_file::read_one(&paths)?;
                Ok(Edit::new(|model| {
                    model.dialogs.open = None;
                    file.into_iter().for_each(|file| model.use_scenes(file));
                }))
            });
            jobs.edits.insert("scenes", read);
        }
        Effect::OpenDataset(paths) => dataset::open(parts, paths),
        Effect::RestoreDataset(session, results) => dataset::restore(parts, *session, results),
        Effect::ReadCaseAgain(case) => dataset::read_again(parts, case),
        Effect::ComputeLoss => jobs.answers.resume::<ComputeLosses>(),
        Effect::CancelLoss => jobs.answers.stop::<ComputeLosses>(),
        Effect::Browse(what) => {
            // Where what is open came from.
            let from = model.files().next().and_then(Path::parent);
            jobs.edits.insert("dialog", browse::start(&jobs.waker, what, from));
        }
        Effect::Save(request) => saving::save_file(parts, ctx, request),
        Effect::CancelSaving => jobs.saving.iter().for_each(Job::cancel),
        Effect::CopyPicture => saving::copy_picture(parts, ctx),
    }
}
