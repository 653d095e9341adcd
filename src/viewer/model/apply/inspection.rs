//! Commands about texels.

use crate::model::Model;
use crate::model::command::InspectionCommand;

pub(super) fn apply(model: &mut Model, command: InspectionCommand) {
    let inspection = &mut model.inspection;
    match command {
        InspectionCommand::TogglePin(texel) => inspection.toggle_pin(texel),
        InspectionCommand::TogglePinHere => {
            if let Some(texel) = model.geometry.texel {
                inspection.toggle_pin(texel);
            }
        }
        InspectionCommand::ClearPins => inspection.pins.clear(),
        InspectionCommand::Arm(on) => inspection.is_armed = on,
        InspectionCommand::SetRegion(region) => {
            inspection.region = region;
            inspection.is_armed = false;
        }
    }
}
