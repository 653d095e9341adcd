//! Commands of the tab *Why*.

use eframe::egui;

use crate::viewer::app::App;
use crate::viewer::command::WhyCommand;
use crate::viewer::why::ComparedPair;

impl App {
    pub(super) fn apply_to_why(&mut self, ctx: &egui::Context, command: WhyCommand) {
        match command {
            WhyCommand::ShowSection(section, on) => self.settings.why.open(section, on),
            WhyCommand::ListScenes(count) => self.why.listed = count,
            WhyCommand::SetMoved(moved) => self.why.moved = moved,
            WhyCommand::FindWorst => {
                if let Some(pair) = ComparedPair::of(&self.slots.slots, &self.state) {
                    self.why.search.start(ctx, &pair, self.settings.loss.seed);
                }
            }
            WhyCommand::CancelSearch => self.why.search.cancel(),
        }
    }
}
