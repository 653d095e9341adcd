//! The bar on top: open, save, layout, what is shown, exposure, projection.

use eframe::egui;

use crate::picture::content::Shown;
use crate::viewer::command::Command;
use crate::viewer::state::{Layout, Projection, ViewState};

/// What the bar shows.
#[derive(Debug)]
pub struct TopBar<'a> {
    pub state: &'a ViewState,
    pub dark: bool,
    pub side_panel: bool,
    pub swapped: bool,
}

impl TopBar<'_> {
    pub fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        ui.horizontal_wrapped(|ui| {
            self.files(ui, &mut commands);
            ui.separator();
            self.choices(ui, &mut commands);
            ui.separator();
            self.exposure(ui, &mut commands);
            ui.separator();
            self.position(ui, &mut commands);
            ui.separator();
            self.window(ui, &mut commands);
        });
        commands
    }

    fn files(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        button(ui, "Open", "Open materials (Ctrl+O)", commands, Command::ShowOpen(true));
        button(ui, "Save", "Save this view as a picture (Ctrl+S)", commands, Command::ShowSave(true));
    }

    fn choices(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let mut layout = self.state.layout;
        choice(ui, "Layout", "Layout (C)", &mut layout, &Layout::ALL, Layout::name);
        if layout != self.state.layout {
            commands.push(Command::SetLayout(layout));
        }
        let mut shown = self.state.shown;
        choice(ui, "Show", "What is shown (M, Shift+M)", &mut shown, &Shown::ALL, Shown::name);
        if shown != self.state.shown {
            commands.push(Command::SetShown(shown));
        }
        let perspective = self.state.projection == Projection::Perspective;
        let toggle = ui
            .selectable_label(perspective, "Perspective")
            .on_hover_text("The plane as seen from the view's position, or the flat texture (P)");
        if toggle.clicked() {
            commands.push(Command::ToggleProjection);
        }
        let swap = ui.selectable_label(self.swapped, "Swap").on_hover_text(
            "Prediction and ground truth change places (X); hold G to peek at the ground truth",
        );
        if swap.clicked() {
            commands.push(Command::SwapSides);
        }
    }

    fn exposure(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        ui.label("EV");
        let mut ev = self.state.exposure_ev;
        super::number(ui, "Exposure", &mut ev, 0.0, |d| d.speed(0.05).range(-20.0..=20.0).fixed_decimals(1))
            .on_hover_text("Exposure in stops: E is up, Shift+E is down by 0.5; double-click for 0");
        if ev != self.state.exposure_ev {
            commands.push(Command::SetExposure(ev));
        }
        button(
            ui,
            "N",
            "Normalize: the ground truth's brightest 1% just clips (N)",
            commands,
            Command::Normalize,
        );
        let clipping = ui
            .selectable_label(self.state.show_clipping, "Clip")
            .on_hover_text("Mark pixels that are too bright or black (L)");
        if clipping.clicked() {
            commands.push(Command::ToggleClipping);
        }
    }

    fn position(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        button(ui, "Fit", "Fit the material into its pane (F)", commands, Command::Fit);
        button(ui, "1:1", "One texel per pixel (0)", commands, Command::OneToOne);
        button(
            ui,
            "Reset",
            "Light, view, zoom, exposure and clipping marks back to the start (R)",
            commands,
            Command::Reset,
        );
        button(ui, "Undo", "Undo (Ctrl+Z)", commands, Command::Undo);
        button(ui, "Redo", "Redo (Ctrl+Shift+Z)", commands, Command::Redo);
    }

    fn window(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let light = ui.selectable_label(!self.dark, "Light theme").on_hover_text("Light or dark window");
        if light.clicked() {
            commands.push(Command::SetDark(!self.dark));
        }
        let panel = ui.selectable_label(self.side_panel, "Panel").on_hover_text("Side panel (B)");
        if panel.clicked() {
            commands.push(Command::ToggleSidePanel);
        }
        button(ui, "?", "Keys and mouse (?)", commands, Command::SetHelp(true));
    }
}

fn button(ui: &mut egui::Ui, text: &str, hover: &str, commands: &mut Vec<Command>, command: Command) {
    if ui.button(text).on_hover_text(hover).clicked() {
        commands.push(command);
    }
}

/// A drop-down of named values.
fn choice<T: Copy + PartialEq>(
    ui: &mut egui::Ui,
    name: &str,
    hover: &str,
    value: &mut T,
    all: &[T],
    text: impl Fn(T) -> &'static str,
) {
    let response = egui::ComboBox::from_id_salt(name)
        .selected_text(text(*value))
        .show_ui(ui, |ui| {
            for one in all {
                ui.selectable_value(value, *one, text(*one));
            }
        })
        .response;
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, name));
    response.on_hover_text(hover);
}
