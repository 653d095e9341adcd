//! Commands about texels.

use eframe::egui;

use crate::viewer::app::App;
use crate::viewer::command::InspectCommand;
use crate::viewer::inspect;

impl App {
    pub(super) fn apply_to_inspect(&mut self, ctx: &egui::Context, command: InspectCommand) {
        match command {
            InspectCommand::TogglePin(texel) => self.inspect.toggle_pin(texel),
            InspectCommand::TogglePinHere => {
                if let Some(texel) = self.viewport.last_texel {
                    self.inspect.toggle_pin(texel);
                }
            }
            InspectCommand::ClearPins => self.inspect.pins.clear(),
            InspectCommand::Arm(on) => self.inspect.armed = on,
            InspectCommand::SetRegion(region) => {
                self.inspect.region = region;
                self.inspect.armed = false;
            }
            InspectCommand::CopyPins => self.copy_text(ctx, self.pins_csv(), "the pinned texels as CSV"),
        }
    }

    /// The numbers of every pin in every material, as CSV.
    pub(in crate::viewer) fn pins_csv(&self) -> String {
        let names: Vec<&str> = self.seen.iter().map(|slot| slot.name()).collect();
        let convention = self.state.convention();
        inspect::csv(self.inspect.pins.iter().map(|pin| {
            let materials = self.seen.iter().map(|slot| &slot.loaded.material);
            let rows = inspect::rows(materials, *pin, &self.state.scene, &convention);
            (*pin, names.iter().copied().zip(rows).collect())
        }))
    }
}
