//! Commands about training runs.

use eframe::egui;

use crate::viewer::app::App;
use crate::viewer::command::TrainingCommand;
use crate::viewer::slots::Target;
use crate::viewer::source::Source;

impl App {
    pub(super) fn apply_to_training(&mut self, ctx: &egui::Context, command: TrainingCommand) {
        match command {
            TrainingCommand::Show { slot, number } => self.go_to_step(ctx, slot, number),
            TrainingCommand::Move(by) => self.move_step(ctx, by),
            TrainingCommand::Keep(slot) => {
                if let Some(slot) = self.slots.slots.get(slot) {
                    let source = Source { run: None, ..slot.loaded.source() };
                    let gpu = self.gpu.as_ref().map(|g| &g.gpu);
                    self.slots.open(ctx, gpu, vec![source], Target::Predictions);
                }
            }
        }
    }
}
