//! Commands about training runs.

use crate::viewer::model::Model;
use crate::viewer::model::command::TrainingCommand;
use crate::viewer::model::command::effect::Effect;
use crate::viewer::model::material::request::{ReadRequest, Target};
use crate::viewer::model::material::source::Source;

pub(super) fn apply(model: &mut Model, command: TrainingCommand) -> Vec<Effect> {
    match command {
        TrainingCommand::Show { index, number } => vec![Effect::ShowStep { index, number }],
        TrainingCommand::Move(by) => vec![Effect::MoveStep(by)],
        TrainingCommand::Keep(index) => {
            let source = model.materials.all.get(index).map(|one| Source { run: None, ..one.read.source() });
            let request = source.map(|source| ReadRequest::new(vec![source], Target::Predictions));
            request.map(Effect::Read).into_iter().collect()
        }
    }
}
