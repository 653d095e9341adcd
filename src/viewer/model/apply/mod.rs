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
use super::command::effect::Effect;
use super::command::{Command, LossCommand, WhyCommand, WindowCommand};

impl Model {
    /// Carries out one command; what it does outside of the model is returned.
    pub fn apply(&mut self, command: Command) -> Vec<Effect> {
        match command {
            Command::Materials(command) => materials::apply(self, command),
            Command::Scene(command) => scene::apply(self, command),
            Command::Display(command) => display::apply(self, command),
            Command::Loss(command) => apply_to_loss(self, command),
            Command::Window(command) => apply_to_window(self, command),
            Command::Inspection(command) => {
                inspection::apply(self, command);
                Vec::new()
            }
            Command::Why(command) => apply_to_why(self, command),
            Command::Photograph(command) => photograph::apply(self, command),
            Command::Dataset(command) => dataset::apply(self, command),
        }
    }
}

fn apply_to_loss(model: &mut Model, command: LossCommand) -> Vec<Effect> {
    let settings = &mut model.settings;
    match command {
        LossCommand::AskOrder(on) => model.asks_order = on,
        LossCommand::SetAuto(on) => settings.auto_loss = on,
        LossCommand::SetSettings(loss) => settings.loss = loss,
        LossCommand::RemoveFileScenes => settings.loss = settings.loss.with_file(None),
        LossCommand::Compute | LossCommand::Cancel | LossCommand::Copy => return vec![Effect::Loss(command)],
    }
    Vec::new()
}

fn apply_to_window(model: &mut Model, command: WindowCommand) -> Vec<Effect> {
    match command {
        WindowCommand::SetDark(on) => model.settings.dark = on,
        WindowCommand::ToggleSidePanel if model.geometry.is_narrow => model.narrow_side_panel ^= true,
        WindowCommand::ToggleSidePanel => model.settings.side_panel ^= true,
        WindowCommand::ChooseTab(tab) => model.settings.tab = tab,
        WindowCommand::ShowHelp(on) => model.help = on,
        WindowCommand::DismissMessage(number) => model.messages.dismiss(number),
        WindowCommand::DismissMessages => model.messages.dismiss_all(),
        outside => return vec![Effect::Window(outside)],
    }
    Vec::new()
}

fn apply_to_why(model: &mut Model, command: WhyCommand) -> Vec<Effect> {
    match command {
        WhyCommand::ShowSection(section, on) => model.settings.sections.open(section, on),
        WhyCommand::ListScenes(count) => model.why.listed = count,
        WhyCommand::FindWorst | WhyCommand::CancelSearch => return vec![Effect::Why(command)],
    }
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::geometry::WindowGeometry;

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
