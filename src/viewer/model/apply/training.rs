//! Commands about training runs.

use crate::model::Model;
use crate::model::command::TrainingCommand;
use crate::model::command::effect::Effect;
use crate::model::material::request::{ReadRequest, Target};
use svbrdf_files::source::MaterialSource;

pub(super) fn apply(model: &mut Model, command: TrainingCommand) -> Vec<Effect> {
    match command {
        TrainingCommand::Show { index, number } => vec![Effect::ShowStep { index, number }],
        TrainingCommand::Move(by) => vec![Effect::MoveStep(by)],
        TrainingCommand::Keep(index) => {
            let source =
                model.materials.all.get(index).map(|one| MaterialSource { run: None, ..one.read.reopened() });
            let request = source.map(|source| ReadRequest::new(vec![source], Target::Predictions));
            request.map(Effect::Read).into_iter().collect()
        }
    }
}
