//! Effects of edits, carried out.

use std::path::Path;

use eframe::egui;

use crate::frame::layout::Parts;
use crate::frame::{dataset, saving};
use crate::jobs::browse;
use crate::jobs::loss::ComputeLosses;
use crate::jobs::work::job::Job;
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
        Effect::Read(request) => drop(jobs.read(model, request)),
        Effect::ReadForDialog(request) => {
            let opening = jobs.read(model, request);
            if let Some(dialog) = &mut model.dialogs.open {
                dialog.opening = dialog.submitted.then_some(opening);
            }
        }
        Effect::CancelReading(number) => jobs.openings.cancel(number),
        Effect::ReadScenes(paths) => jobs.read_scenes(paths),
        Effect::OpenDataset(paths) => dataset::open(parts, paths),
        Effect::RestoreDataset(session, results) => dataset::restore(parts, *session, results),
        Effect::ReadCaseAgain(case) => dataset::read_again(parts, case),
        Effect::ComputeLoss => jobs.answers.resume::<ComputeLosses>(),
        Effect::CancelLoss => jobs.answers.stop::<ComputeLosses>(),
        Effect::Browse(what) => {
            // Where what is open came from.
            let from = model.files().next().and_then(Path::parent);
            jobs.browsing = Some(browse::start(&jobs.waker, what, from));
        }
        Effect::Save(request) => saving::save_file(parts, ctx, request),
        Effect::CancelSaving => jobs.saving.iter().for_each(Job::cancel),
        Effect::CopyPicture => saving::copy_picture(parts, ctx),
    }
}
