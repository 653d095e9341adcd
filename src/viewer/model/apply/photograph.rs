//! Commands about the photograph that renderings are compared with.

use crate::files::session::SessionPhotograph;
use crate::files::stamp::Stamp;
use crate::model::scene::Scene;
use crate::picture::difference::Difference;
use crate::picture::quantity::Quantity;
use crate::viewer::model::Model;
use crate::viewer::model::command::PhotographCommand;
use crate::viewer::model::command::effect::{DialogEffect, Effect};

pub(super) fn apply(model: &mut Model, command: PhotographCommand) -> Vec<Effect> {
    match command {
        PhotographCommand::ShowOpen(on) => return vec![Effect::Dialog(DialogEffect::ShowPhotograph(on))],
        PhotographCommand::Fill(path) => return vec![Effect::Dialog(DialogEffect::FillPhotograph(path))],
        PhotographCommand::Open { photograph, light } => {
            return vec![Effect::OpenPhotograph { photograph, light }];
        }
        PhotographCommand::Close => model.photograph.set(None, None),
        PhotographCommand::EditCorners(on) => {
            model.photograph.edit_corners(on);
            if on {
                model.compare_with_photograph();
            }
        }
        PhotographCommand::SetTransfer(transfer) => {
            model.change_photograph(|source| source.read.transfer = transfer);
        }
        PhotographCommand::SetFalloff(on) => model.change_photograph(|source| source.falloff = on),
        PhotographCommand::SetCorners(corners) => {
            model.change_photograph(|source| source.corners = corners.map(|corners| corners.0));
        }
    }
    Vec::new()
}

impl Model {
    /// Compares renderings with a photograph, whose file has this stamp; `None` for the scene keeps light and view.
    pub fn show_photograph(
        &mut self,
        photograph: SessionPhotograph,
        stamp: Option<Stamp>,
        scene: Option<Scene>,
    ) {
        self.photograph.set(Some(photograph), stamp);
        self.view.scene = scene.unwrap_or(self.view.scene);
        self.compare_with_photograph();
    }

    fn change_photograph(&mut self, change: impl FnOnce(&mut SessionPhotograph)) {
        if let Some(source) = self.photograph.source_mut() {
            change(source);
        }
    }

    /// Shows what is compared with a photograph: renderings in one scene.
    fn compare_with_photograph(&mut self) {
        self.view.display.quantity = Quantity::Rendering;
        if self.view.is_error_map() {
            // It averages over scenes of which there is no photograph.
            self.view.display.differences.choose(Quantity::Rendering, Difference::Log);
        }
    }
}
