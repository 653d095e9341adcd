//! Input of the whole window: keys, and files that are dropped.

pub mod help;
pub mod keys;

use std::path::PathBuf;

use eframe::egui;

use svbrdf_files::read::ReadOptions;

use crate::jobs::Jobs;
use crate::model::effect::Effect;
use crate::model::{Model, opening};

/// Carries out keys, and opens files that were dropped on the window: in place of the built-in materials, otherwise as predictions.
pub fn act(ctx: &egui::Context, model: &mut Model, jobs: &Jobs) {
    keys::act(ctx, model, |model| escape(model, jobs));
    let paths: Vec<PathBuf> =
        ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_owned()).collect());
    if !paths.is_empty() {
        let replace = model.materials.only_built_in();
        opening::open(model, paths, replace, ReadOptions::AUTO);
    }
}

/// Closes or cancels the first of these that is there.
fn escape(model: &mut Model, jobs: &Jobs) {
    let Model { dialogs, dataset, inspection, view, effects, help, .. } = model;
    match () {
        () if *help => *help = false,
        () if dialogs.open.is_some() => dialogs.open = None,
        () if dialogs.save.is_some() => dialogs.save = None,
        () if dataset.sheet.is_open => dataset.show_sheet(false),
        () if inspection.is_armed => inspection.is_armed = false,
        () if inspection.region.is_some() => inspection.region = None,
        () if jobs.why.search.busy().is_some() => effects.push(Effect::CancelSearch),
        () if view.display.is_replaced() => view.isolate(None),
        () if dataset.sheet.is_behind => dataset.show_sheet(true),
        () => effects.push(Effect::CancelLoss),
    }
}
