//! The bar at the top: open, save, layout, map or rendering, exposure, projection.

use eframe::egui;

use crate::picture::quantity::Quantity;
use crate::viewer::command::{Command, DisplayCommand, LossCommand, WindowCommand};
use crate::viewer::state::{Layout, Projection, ViewState};

/// What the bar shows.
#[derive(Debug)]
pub struct TopBar<'a> {
    pub state: &'a ViewState,
    pub dark: bool,
    pub side_panel: bool,
    pub swapped: bool,
    /// Whether histograms of the values are shown.
    pub histograms: bool,
    /// Size of text and controls.
    pub scale: f32,
    pub has_predictions: bool,
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
        button(ui, "Open", "Open materials (Ctrl+O)", commands, WindowCommand::ShowOpen(true).into());
        button(
            ui,
            "Save",
            "Save view, renderings, strip or session (Ctrl+S)",
            commands,
            WindowCommand::ShowSave(true).into(),
        );
        let hover = "Copy the view as a picture (Ctrl+Shift+C)";
        button(ui, "Copy", hover, commands, WindowCommand::CopyPicture.into());
    }

    fn choices(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let mut layout = self.state.layout;
        choice(ui, "Layout", "Layout (C)", &mut layout, &Layout::ALL, Layout::name);
        if layout != self.state.layout {
            commands.push(DisplayCommand::SetLayout(layout).into());
        }
        let mut quantity = self.state.quantity;
        choice(ui, "Show", "Rendering or map (M, Shift+M)", &mut quantity, &Quantity::ALL, Quantity::name);
        if quantity != self.state.quantity {
            commands.push(DisplayCommand::SetQuantity(quantity).into());
        }
        for (difference, name) in [(false, "Value"), (true, "Difference")] {
            let label = ui.selectable_label(self.state.difference == difference, name);
            let hover = "Show the value, or the difference of predictions from the ground truth (D)";
            if label.on_hover_text(hover).clicked() && self.state.difference != difference {
                commands.push(DisplayCommand::ShowDifference(difference).into());
            }
        }
        if !self.state.difference {
            let histograms = ui
                .selectable_label(self.histograms, "Histogram")
                .on_hover_text("Histograms of the values, per channel, of every material (J)");
            if histograms.clicked() {
                commands.push(WindowCommand::ToggleHistograms.into());
            }
        }
        let perspective = self.state.projection == Projection::Perspective;
        let toggle = ui
            .selectable_label(perspective, "Perspective")
            .on_hover_text("The plane seen from the view position, or the flat texture (P)");
        if toggle.clicked() {
            commands.push(DisplayCommand::ToggleProjection.into());
        }
        let tiled = ui.selectable_label(self.state.tiled, "Tile").on_hover_text(
            "Repeat the material 2 x 2 times, shifted by half of itself: shows its seams; for display only (T)",
        );
        if tiled.clicked() {
            commands.push(DisplayCommand::ToggleTiled.into());
        }
        if self.state.quantity == Quantity::Roughness {
            let colours = ui
                .selectable_label(self.state.false_colour, "False colour")
                .on_hover_text("Roughness from 0 (black) to 1 (light yellow) (V)");
            if colours.clicked() {
                commands.push(DisplayCommand::ToggleFalseColour.into());
            }
        }
        let swap = ui.selectable_label(self.swapped, "Swap").on_hover_text(
            "Swap prediction and ground truth (X); hold G to show the ground truth in every pane",
        );
        if swap.clicked() {
            commands.push(DisplayCommand::Swap.into());
        }
    }

    fn exposure(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        ui.label("EV");
        let mut ev = self.state.exposure_ev;
        super::number(ui, "Exposure", &mut ev, 0.0, |d| d.speed(0.05).range(-20.0..=20.0).fixed_decimals(1))
            .on_hover_text("Exposure in stops: E raises it by 0.5, Shift+E lowers it; double-click for 0");
        if ev != self.state.exposure_ev {
            commands.push(DisplayCommand::SetExposure(ev).into());
        }
        button(
            ui,
            "Auto EV",
            "The exposure at which the brightest 1% of the ground truth just clips (N)",
            commands,
            DisplayCommand::AutoExposure.into(),
        );
        let clipping = ui
            .selectable_label(self.state.show_clipping, "Clip")
            .on_hover_text("Mark clipped pixels: too bright (magenta) or black (blue) (L)");
        if clipping.clicked() {
            commands.push(DisplayCommand::ToggleClipping.into());
        }
    }

    fn position(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        button(ui, "Fit", "Fit the material into its pane (F)", commands, DisplayCommand::Fit.into());
        button(ui, "1:1", "One texel per pixel (0)", commands, DisplayCommand::OneToOne.into());
        button(
            ui,
            "Reset",
            "Reset light, view, zoom, exposure and clipping marks (R)",
            commands,
            DisplayCommand::Reset.into(),
        );
        button(ui, "Undo", "Undo (Ctrl+Z)", commands, DisplayCommand::Undo.into());
        button(ui, "Redo", "Redo (Ctrl+Shift+Z)", commands, DisplayCommand::Redo.into());
    }

    fn window(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let menu = ui.menu_button("Menu", |ui| self.menu(ui, commands));
        menu.response.on_hover_text("Study, theme and size of the window's text");
        let panel = ui.selectable_label(self.side_panel, "Panel").on_hover_text("Side panel (B)");
        if panel.clicked() {
            commands.push(WindowCommand::ToggleSidePanel.into());
        }
        button(ui, "?", "Keys and mouse (?)", commands, WindowCommand::ShowHelp(true).into());
    }

    fn menu(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let study = ui.add_enabled(self.has_predictions, egui::Button::new("Study: time against error..."));
        let hover = "Measure the time and error of settings of the loss, for this pair on this machine";
        if study.on_hover_text(hover).clicked() {
            commands.push(LossCommand::ShowStudy(true).into());
        }
        ui.separator();
        let theme = if self.dark { "Light theme" } else { "Dark theme" };
        button(ui, theme, "Colours of the window", commands, WindowCommand::SetDark(!self.dark).into());
        ui.menu_button("UI scale", |ui| {
            for percent in [75, 100, 125, 150, 175, 200, 250, 300] {
                let scale = percent as f32 / 100.0;
                let is_current = (self.scale - scale).abs() < 1e-3;
                if ui.selectable_label(is_current, format!("{percent}%")).clicked() {
                    commands.push(WindowCommand::SetScale(scale).into());
                }
            }
        })
        .response
        .on_hover_text("Size of text and controls (Ctrl with plus, minus; Ctrl+0 for 100%)");
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
