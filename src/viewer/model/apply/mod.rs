//! Commands, carried out on the model.

pub mod dataset;
mod display;
pub mod exposure;
mod inspection;
mod materials;
mod photograph;
mod scene;
pub mod undo;

use super::Model;
use super::command::effect::{DialogEffect, Effect, LossEffect};
use super::command::{Command, LossCommand, WhyCommand, WindowCommand};
use super::settings::save_kind::SaveKind;

impl Model {
    /// Carries out one command; what it does outside of the model is returned.
    pub fn apply(&mut self, command: Command) -> Vec<Effect> {
        match command {
            Command::Materials(command) => materials::apply(self, command),
            Command::Scene(command) => scene::apply(self, command),
            Command::Display(command) => display::apply(self, command),
            Command::Loss(command) => apply_to_loss(self, command),
            Command::Window(command) => apply_to_window(self, command),
            Command::Inspection(command) => inspection::apply(self, command),
            Command::Why(command) => apply_to_why(self, command),
            Command::Photograph(command) => photograph::apply(self, command),
            Command::Dataset(command) => dataset::apply(self, command),
        }
    }
}

fn apply_to_loss(model: &mut Model, command: LossCommand) -> Vec<Effect> {
    let settings = &mut model.settings;
    let effect = match command {
        LossCommand::Compute => Effect::Loss(LossEffect::Compute),
        LossCommand::Cancel => Effect::Loss(LossEffect::Cancel),
        LossCommand::Copy => Effect::CopyLosses,
        LossCommand::AskOrder(on) => {
            model.asks_order = on;
            return Vec::new();
        }
        LossCommand::SetAuto(on) => {
            settings.auto_loss = on;
            return Vec::new();
        }
        LossCommand::SetSettings(loss) => {
            settings.loss = loss;
            return Vec::new();
        }
        LossCommand::SortByLoss(on) => {
            settings.sort_losses = on;
            return Vec::new();
        }
        LossCommand::RemoveFileScenes => {
            settings.loss = settings.loss.with_file(None);
            return Vec::new();
        }
    };
    vec![effect]
}

fn apply_to_window(model: &mut Model, command: WindowCommand) -> Vec<Effect> {
    let effect = match command {
        WindowCommand::ShowOpen(on) => Effect::Dialog(DialogEffect::ShowOpen(on)),
        WindowCommand::Browse(what) => Effect::Dialog(DialogEffect::Browse(what)),
        WindowCommand::ShowSave(on) => Effect::Dialog(DialogEffect::ShowSave(on.then(SaveKind::default))),
        WindowCommand::SaveScenes => Effect::Dialog(DialogEffect::ShowSave(Some(SaveKind::Scenes))),
        WindowCommand::Save(request) => Effect::Save(request),
        WindowCommand::CancelSaving => Effect::CancelSaving,
        WindowCommand::CopyPicture => Effect::CopyPicture,
        WindowCommand::SetScale(scale) => Effect::SetScale(scale),
        other => {
            change_window(model, other);
            return Vec::new();
        }
    };
    vec![effect]
}

/// The commands of the window that have no effect outside of the model.
fn change_window(model: &mut Model, command: WindowCommand) {
    match command {
        WindowCommand::SetDark(on) => model.settings.dark = on,
        WindowCommand::ToggleSidePanel if model.geometry.is_narrow => model.narrow_side_panel ^= true,
        WindowCommand::ToggleSidePanel => model.settings.side_panel ^= true,
        WindowCommand::ChooseTab(tab) => model.settings.tab = tab,
        WindowCommand::ShowHelp(on) => model.help = on,
        WindowCommand::DismissMessage(number) => model.messages.dismiss(number),
        WindowCommand::DismissMessages => model.messages.dismiss_all(),
        WindowCommand::ShowOpen(_)
        | WindowCommand::Browse(_)
        | WindowCommand::ShowSave(_)
        | WindowCommand::SaveScenes
        | WindowCommand::Save(_)
        | WindowCommand::CancelSaving
        | WindowCommand::CopyPicture
        | WindowCommand::SetScale(_) => {}
    }
}

fn apply_to_why(model: &mut Model, command: WhyCommand) -> Vec<Effect> {
    match command {
        WhyCommand::ShowSection(section, on) => model.settings.sections.open(section, on),
        WhyCommand::ListScenes(count) => model.why.listed = count,
        WhyCommand::FindWorst => return vec![Effect::Loss(LossEffect::FindWorst)],
        WhyCommand::CancelSearch => return vec![Effect::Loss(LossEffect::CancelSearch)],
    }
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::command::DisplayCommand;
    use crate::model::view::geometry::WindowGeometry;

    #[test]
    fn a_command_changes_the_model_and_returns_what_it_does_outside() {
        let mut model = Model::default();
        assert!(model.apply(DisplayCommand::StepExposure(0.5).into()).is_empty());
        assert_eq!(model.view.exposure_ev, 0.5);
        let effects = model.apply(LossCommand::Compute.into());
        assert!(matches!(effects[..], [Effect::Loss(LossEffect::Compute)]), "{effects:?}");
        let effects = model.apply(WindowCommand::ShowSave(true).into());
        assert!(
            matches!(effects[..], [Effect::Dialog(DialogEffect::ShowSave(Some(SaveKind::View)))]),
            "{effects:?}"
        );
    }

    #[test]
    fn narrow_windows_have_a_side_panel_of_their_own() {
        let mut model = Model::default();
        assert!(model.side_panel());
        model.geometry = WindowGeometry { is_narrow: true, ..WindowGeometry::default() };
        assert!(!model.side_panel());
        model.apply(WindowCommand::ToggleSidePanel.into());
        assert!(model.side_panel() && model.settings.side_panel);
        model.geometry.is_narrow = false;
        model.apply(WindowCommand::ToggleSidePanel.into());
        assert!(!model.side_panel() && model.narrow_side_panel);
    }
}
