//! Commands about the photograph that renderings are compared with.

use crate::model::Model;
use crate::model::command::PhotographCommand;
use crate::model::command::effect::Effect;

pub(super) fn apply(model: &mut Model, command: PhotographCommand) -> Vec<Effect> {
    match command {
        PhotographCommand::Open(path) => return vec![Effect::OpenPhotograph(path)],
        PhotographCommand::Choose(index) => {
            model.view.scene = model.photograph.choose(index).unwrap_or(model.view.scene);
        }
        PhotographCommand::Close => model.photograph.set(None),
        PhotographCommand::SetTransfer(transfer) => {
            model.photograph.change(|source| source.transfer = transfer);
        }
        PhotographCommand::SetFalloff(on) => model.photograph.change(|source| source.falloff = on),
    }
    Vec::new()
}
