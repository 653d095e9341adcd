//! Dialog that opens a photograph with its light and view.

use std::path::Path;

use eframe::egui;

use svbrdf_files::photograph::SessionPhotograph;
use svbrdf_files::scene_file::PhotographLight;

use super::path_field::{PathField, dialog};
use crate::model::command::{BrowseFor, Command, PhotographCommand, WindowCommand};
use crate::ui::widgets::number;

/// The choices so far.
#[derive(Debug)]
pub struct PhotographDialog {
    pub path: String,
    light: LightChoice,
    /// Of a flash, in degrees.
    fov: f64,
    scenes: String,
    number: usize,
    falloff: bool,
    field: PathField,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LightChoice {
    AsNow,
    Flash,
    File,
}

impl Default for PhotographDialog {
    fn default() -> Self {
        Self {
            path: String::new(),
            light: LightChoice::AsNow,
            fov: 45.0,
            scenes: String::new(),
            number: 0,
            falloff: false,
            field: PathField::default(),
        }
    }
}

impl PhotographDialog {
    pub fn ui(&mut self, ctx: &egui::Context) -> Vec<Command> {
        let mut commands = Vec::new();
        let open = dialog(ctx, "Open photograph", 440.0, |ui| self.contents(ui, &mut commands));
        if !open {
            commands.push(PhotographCommand::ShowOpen(false).into());
        }
        commands
    }

    /// Puts a path into the field.
    pub fn fill(&mut self, path: &Path) {
        self.path = path.display().to_string();
    }

    /// Shows what went wrong, and puts the cursor into the path field.
    pub fn fail(&mut self, problem: String) {
        self.field.fail(problem);
    }

    fn contents(&mut self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let field = egui::TextEdit::singleline(&mut self.path).hint_text("photo.jpg, or drop a file here");
        self.field.ui(
            ui,
            "Photograph: PNG, JPEG, EXR or another picture format; or the folder of a capture, which has its own lights",
            field,
        );
        if ui
            .button("Browse...")
            .on_hover_text("Chooses a photograph with the file dialog of the system")
            .clicked()
        {
            commands.push(WindowCommand::Browse(BrowseFor::Files).into());
        }
        ui.separator();
        ui.label("Light and view of the photograph");
        self.light(ui);
        ui.checkbox(&mut self.falloff, "Divide out falloff").on_hover_text(
            "For photographs with a flash or lamp near the material: the renderings have no falloff of light with distance",
        );
        ui.separator();
        let path = self.path.trim();
        let button = ui
            .add_enabled(!path.is_empty(), egui::Button::new("Open photograph"))
            .on_disabled_hover_text("Needs a path above");
        let entered = ui.input(|i| i.key_pressed(egui::Key::Enter)) && !path.is_empty();
        if button.on_hover_text("Return").clicked() || entered {
            let photograph =
                SessionPhotograph { path: path.into(), falloff: self.falloff, ..Default::default() };
            self.field.clear();
            commands.push(PhotographCommand::Open { photograph, light: self.chosen() }.into());
        }
        self.field.problem(ui);
    }

    fn light(&mut self, ui: &mut egui::Ui) {
        ui.radio_value(&mut self.light, LightChoice::AsNow, "As they are in the window").on_hover_text(
            "For a photograph that is compared with the renderings of the present light and view",
        );
        ui.horizontal(|ui| {
            ui.radio_value(&mut self.light, LightChoice::Flash, "Flash at the camera, field of view")
                .on_hover_text("Light and view at one place, straight above the middle of the material");
            let fov = number(ui, "Field of view", &mut self.fov, 45.0, |drag| {
                drag.range(0.1..=179.0).speed(0.2).max_decimals(2).suffix(" degrees")
            });
            let hover =
                "The angle that the width of the material spans at the camera, straight above its middle";
            if fov.on_hover_text(hover).changed() {
                self.light = LightChoice::Flash;
            }
        });
        ui.horizontal(|ui| {
            ui.radio_value(&mut self.light, LightChoice::File, "Scene file")
                .on_hover_text("Light and view from a JSON file of scenes, or of a MaterialGAN capture");
            let number = number(ui, "Scene number", &mut self.number, 0, |drag| {
                drag.range(0..=9999).speed(0.05).prefix("scene ")
            });
            let number = number.on_hover_text("Number of the scene in a file of several, from 0");
            let field = egui::TextEdit::singleline(&mut self.scenes).hint_text("scene.json or render.json");
            let field = ui.add(field);
            field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Scene file"));
            if field.changed() || number.changed() {
                self.light = LightChoice::File;
            }
        });
    }

    /// `None`: those of the window.
    fn chosen(&self) -> Option<PhotographLight> {
        Some(match self.light {
            LightChoice::AsNow => return None,
            LightChoice::Flash => PhotographLight::Flash { fov_degrees: self.fov },
            LightChoice::File => {
                PhotographLight::File { path: self.scenes.trim().into(), number: Some(self.number) }
            }
        })
    }
}
