//! Commands about files and materials.

use eframe::egui;

use crate::viewer::app::App;
use crate::viewer::command::MaterialsCommand;
use crate::viewer::message::Message;
use crate::viewer::slots::Target;
use crate::viewer::source::Source;

impl App {
    pub(super) fn apply_to_materials(&mut self, ctx: &egui::Context, command: MaterialsCommand) {
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        match command {
            MaterialsCommand::Open { paths, replace, read } => {
                self.read = read;
                let target = if replace { Target::Everything } else { Target::Predictions };
                let sources = paths.into_iter().map(|path| Source::file(path, read)).collect();
                let opening = self.slots.open(ctx, gpu, sources, target);
                if let Some(window) = &mut self.open_window {
                    window.opening = window.submitted.then_some(opening);
                }
            }
            MaterialsCommand::OpenAgain(source) => {
                self.slots.open(ctx, gpu, vec![*source], Target::Predictions);
            }
            MaterialsCommand::OpenBuiltIn => self.slots.open_built_in(ctx, gpu),
            MaterialsCommand::Reload => self.slots.reload(ctx, gpu, None),
            MaterialsCommand::ReadAs { slot, read } => self.slots.read_as(ctx, gpu, slot, read),
            MaterialsCommand::SaveAssumptions { slot } => {
                let saved = self.slots.save_assumptions(ctx, gpu, slot);
                self.report(saved.err().map(Message::Failed));
            }
            MaterialsCommand::Close(slot) => self.close_prediction(slot),
            MaterialsCommand::MakeGroundTruth(slot) => self.slots.make_ground_truth(slot),
            MaterialsCommand::SetWatch(on) => self.settings.watch = on,
            MaterialsCommand::SetFit(on) => self.slots.rules.fit = on,
        }
    }

    /// Closes the material in slot `slot`; the chosen prediction stays the same one where it can.
    fn close_prediction(&mut self, slot: usize) {
        self.slots.close(slot);
        let state = &mut self.state;
        if slot <= state.prediction {
            state.prediction = state.prediction.saturating_sub(1);
        }
        state.prediction = state.prediction.min(self.slots.predictions().len().saturating_sub(1));
    }
}
