//! Commands about the photograph that renderings are compared with.

use svbrdf_files::photograph::SessionPhotograph;

use crate::model::Model;
use crate::model::command::PhotographCommand;
use crate::model::command::effect::{DialogEffect, Effect};

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
            change(model, |source| source.read.transfer = transfer);
        }
        PhotographCommand::SetFalloff(on) => change(model, |source| source.falloff = on),
        PhotographCommand::SetCorners(corners) => change(model, |source| source.corners = corners),
    }
    Vec::new()
}

fn change(model: &mut Model, change: impl FnOnce(&mut SessionPhotograph)) {
    if let Some(source) = model.photograph.source_mut() {
        change(source);
    }
}
