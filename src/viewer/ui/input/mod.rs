//! Input of the whole window: keys, and files that are dropped.

pub mod help;
pub mod keys;

use std::path::PathBuf;

use eframe::egui;

use super::dialogs::Dialogs;
use crate::jobs::displayed::Displayed;
use crate::model::command::{
    Command, DatasetCommand, DisplayCommand, InspectionCommand, LossCommand, MaterialsCommand,
    PhotographCommand, SceneCommand, WhyCommand, WindowCommand,
};

/// The state of the keys between frames.
#[derive(Debug, Default)]
pub struct KeyInput {
    /// Whether something was dragged since Space was pressed: then Space pans and does not pause.
    space_dragged: bool,
}

impl KeyInput {
    /// The commands of the keys and of dropped files.
    pub fn commands(
        &mut self,
        ctx: &egui::Context,
        displayed: Displayed<'_>,
        dialogs: &Dialogs,
    ) -> Vec<Command> {
        let escape = escape(displayed, dialogs);
        let now = keys::Context {
            enter_is_free: ctx.memory(|m| m.focused()).is_none(),
            escape: &escape,
            difference: displayed.model.view.display.difference,
        };
        let mut commands = keys::commands(ctx, now);
        commands.extend(self.pause_key(ctx, displayed));
        commands.extend(dropped(ctx, displayed, dialogs));
        commands
    }

    /// Space, pressed and released without a drag, pauses what moves by itself.
    fn pause_key(&mut self, ctx: &egui::Context, displayed: Displayed<'_>) -> Option<Command> {
        let (pressed, released, down, dragging) = ctx.input(|i| {
            let space = egui::Key::Space;
            (i.key_pressed(space), i.key_released(space), i.key_down(space), i.pointer.any_down())
        });
        if pressed {
            self.space_dragged = false;
        }
        self.space_dragged |= down && dragging;
        let animation = &displayed.model.animation;
        let moves = animation.light || animation.turntable;
        let free = ctx.memory(|m| m.focused()).is_none();
        (released && !self.space_dragged && moves && free).then_some(SceneCommand::TogglePause.into())
    }
}

/// What Escape does: it closes or cancels the first of these that is there.
fn escape(displayed: Displayed<'_>, dialogs: &Dialogs) -> Command {
    let (model, jobs) = (displayed.model, displayed.jobs);
    match () {
        () if dialogs.photograph.is_some() => PhotographCommand::ShowOpen(false).into(),
        () if model.help => WindowCommand::ShowHelp(false).into(),
        () if dialogs.open.is_some() => WindowCommand::ShowOpen(false).into(),
        () if dialogs.save.is_some() => WindowCommand::ShowSave(false).into(),
        () if model.photograph.edits_corners() => PhotographCommand::EditCorners(false).into(),
        () if model.study => LossCommand::ShowStudy(false).into(),
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
fn dropped(ctx: &egui::Context, displayed: Displayed<'_>, dialogs: &Dialogs) -> Option<Command> {
    let paths: Vec<PathBuf> =
        ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_owned()).collect());
    if let (Some(path), Some(_)) = (paths.first(), &dialogs.photograph) {
        return Some(PhotographCommand::Fill(path.clone()).into());
    }
    let replace = displayed.model.materials.only_built_in();
    let is_empty = paths.is_empty();
    let read = displayed.model.materials.read_of_added();
    let open = match replace {
        true => MaterialsCommand::Open { paths, replace, read },
        false => MaterialsCommand::AddDropped { paths, read },
    };
    (!is_empty).then(|| open.into())
}
