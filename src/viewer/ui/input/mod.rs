//! Input of the whole window: keys, and files that are dropped.

pub mod help;
pub mod keys;

use std::path::PathBuf;

use eframe::egui;

use svbrdf_files::read::ReadOptions;

use super::dialogs::Dialogs;
use crate::jobs::displayed::Displayed;
use crate::model::command::{
    Command, DatasetCommand, DisplayCommand, InspectionCommand, LossCommand, MaterialsCommand, WhyCommand,
    WindowCommand,
};

/// The commands of the keys and of dropped files.
pub fn commands(ctx: &egui::Context, displayed: Displayed<'_>, dialogs: &Dialogs) -> Vec<Command> {
    let escape = escape(displayed, dialogs);
    let now = keys::Context {
        enter_is_free: ctx.memory(|m| m.focused()).is_none(),
        escape: &escape,
        difference: displayed.model.view.display.difference,
    };
    let mut commands = keys::commands(ctx, now);
    commands.extend(dropped(ctx, displayed));
    commands
}

/// What Escape does: it closes or cancels the first of these that is there.
fn escape(displayed: Displayed<'_>, dialogs: &Dialogs) -> Command {
    let (model, jobs) = (displayed.model, displayed.jobs);
    match () {
        () if model.help => WindowCommand::ShowHelp(false).into(),
        () if dialogs.open.is_some() => WindowCommand::ShowOpen(false).into(),
        () if dialogs.save.is_some() => WindowCommand::ShowSave(false).into(),
        () if model.dataset.sheet.is_open => DatasetCommand::ShowSheet(false).into(),
        () if model.inspection.is_armed => InspectionCommand::Arm(false).into(),
        () if model.inspection.region.is_some() => InspectionCommand::SetRegion(None).into(),
        () if jobs.why.search.busy().is_some() => WhyCommand::CancelSearch.into(),
        () if model.view.display.is_replaced() => DisplayCommand::Isolate(None).into(),
        () if model.dataset.sheet.is_behind => DatasetCommand::ShowSheet(true).into(),
        () => LossCommand::Cancel.into(),
    }
}

/// Opens files that were dropped on the window: in place of the built-in materials, otherwise as predictions.
fn dropped(ctx: &egui::Context, displayed: Displayed<'_>) -> Option<Command> {
    let paths: Vec<PathBuf> =
        ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_owned()).collect());
    let replace = displayed.model.materials.only_built_in();
    let is_empty = paths.is_empty();
    (!is_empty).then(|| MaterialsCommand::Open { paths, replace, read: ReadOptions::AUTO }.into())
}
