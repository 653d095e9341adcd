//! Bar at the top: open, save, layout, map or rendering, exposure, projection.

use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{self, PopupCloseBehavior};

use svbrdf_core::picture::quantity::Quantity;

use crate::viewer::jobs::displayed::Displayed;
use crate::viewer::model::command::{Command, DisplayCommand, LossCommand, PhotographCommand, WindowCommand};
use crate::viewer::model::view::state::{Layout, Projection, ViewState};
use crate::viewer::ui::panels::bar_item::{BarItem, Room};
use crate::viewer::ui::widgets::number;

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
    /// Whether renderings are compared with a photograph.
    pub has_photograph: bool,
}

impl<'a> TopBar<'a> {
    /// The bar for what is displayed.
    pub fn new(displayed: Displayed<'a>) -> Self {
        let model = displayed.model;
        Self {
            state: &model.view,
            dark: model.settings.dark,
            side_panel: model.side_panel(),
            swapped: model.swapped,
            histograms: model.settings.histograms,
            scale: model.settings.ui_scale,
            has_predictions: !model.materials.predictions().is_empty(),
            has_photograph: model.photograph.source().is_some(),
        }
    }

    pub fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        let room = Room::of(ui.available_width());
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            self.files(ui, room, &mut commands);
            ui.separator();
            self.choices(ui, &mut commands);
            let shown = [BarItem::Histogram, BarItem::Perspective, BarItem::Tile, BarItem::FalseColour];
            self.items(ui, room, &shown, &mut commands);
            self.items(ui, room, &[BarItem::Swap], &mut commands);
            if room > Room::Little {
                ui.separator();
                let exposure = [BarItem::Exposure, BarItem::AutoExposure, BarItem::Clip];
                self.items(ui, room, &exposure, &mut commands);
                ui.separator();
                let position =
                    [BarItem::Fit, BarItem::OneToOne, BarItem::Reset, BarItem::Undo, BarItem::Redo];
                self.items(ui, room, &position, &mut commands);
            }
            ui.separator();
            self.window(ui, room, &mut commands);
        });
        commands
    }

    fn files(&self, ui: &mut egui::Ui, room: Room, commands: &mut Vec<Command>) {
        button(ui, "Open", "Open materials (Ctrl+O)", commands, WindowCommand::ShowOpen(true).into());
        button(
            ui,
            "Save",
            "Save view, renderings, strip or session (Ctrl+S)",
            commands,
            WindowCommand::ShowSave(true).into(),
        );
        self.items(ui, room, &[BarItem::Copy], commands);
    }

    fn choices(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let mut layout = self.state.display.layout;
        choice(ui, "Layout", "Layout (C)", &mut layout, &Layout::ALL, Layout::name);
        if layout != self.state.display.layout {
            commands.push(DisplayCommand::SetLayout(layout).into());
        }
        let mut quantity = self.state.display.quantity;
        choice(ui, "Show", "Rendering or map (M, Shift+M)", &mut quantity, &Quantity::ALL, Quantity::name);
        if quantity != self.state.display.quantity {
            commands.push(DisplayCommand::SetQuantity(quantity).into());
        }
        for (difference, name) in [(false, "Value"), (true, "Difference")] {
            let label = ui.selectable_label(self.state.display.difference == difference, name);
            let hover = "Show the value, or the difference of predictions from the ground truth (D)";
            if label.on_hover_text(hover).clicked() && self.state.display.difference != difference {
                commands.push(DisplayCommand::ShowDifference(difference).into());
            }
        }
    }

    /// Those of `items` that have room.
    fn items(&self, ui: &mut egui::Ui, room: Room, items: &[BarItem], commands: &mut Vec<Command>) {
        for item in items.iter().filter(|item| item.needs() <= room) {
            self.item(ui, *item, commands);
        }
    }

    fn item(&self, ui: &mut egui::Ui, item: BarItem, commands: &mut Vec<Command>) {
        let (text, hover, command): (&str, &str, Command) = match item {
            BarItem::Copy => {
                ("Copy", "Copy the view as a picture (Ctrl+Shift+C)", WindowCommand::CopyPicture.into())
            }
            BarItem::Fit => ("Fit", "Fit the material into its pane (F)", DisplayCommand::Fit.into()),
            BarItem::OneToOne => ("1:1", "One texel per pixel (0)", DisplayCommand::OneToOne.into()),
            BarItem::Reset => {
                let hover = "Reset light, view, zoom, exposure and clipping marks (R)";
                ("Reset", hover, DisplayCommand::Reset.into())
            }
            BarItem::Undo => ("Undo", "Undo (Ctrl+Z)", DisplayCommand::Undo.into()),
            BarItem::Redo => ("Redo", "Redo (Ctrl+Shift+Z)", DisplayCommand::Redo.into()),
            BarItem::AutoExposure => {
                let hover = "The exposure at which the brightest 1% of the ground truth just clips (N)";
                ("Auto EV", hover, DisplayCommand::AutoExposure.into())
            }
            BarItem::Exposure => return self.exposure(ui, commands),
            _ => return self.toggle(ui, item, commands),
        };
        button(ui, text, hover, commands, command);
    }

    fn toggle(&self, ui: &mut egui::Ui, item: BarItem, commands: &mut Vec<Command>) {
        let state = self.state;
        let (on, text, hover, command): (bool, &str, &str, Command) = match item {
            BarItem::Histogram => {
                let hover = "Histograms of the values, per channel, of every material (J)";
                (self.histograms, "Histogram", hover, WindowCommand::ToggleHistograms.into())
            }
            BarItem::Perspective => {
                let on = state.display.projection == Projection::Perspective;
                let hover = "The plane seen from the view position, or the flat texture (P)";
                (on, "3D", hover, DisplayCommand::ToggleProjection.into())
            }
            BarItem::Tile => {
                let hover = "Repeat the material 2 x 2 times, shifted by half of itself: shows its seams; for display only (T)";
                (state.display.tiled, "Tile", hover, DisplayCommand::ToggleTiled.into())
            }
            BarItem::FalseColour => {
                let hover = "Roughness from 0 (black) to 1 (light yellow) (V)";
                (state.display.false_colour, "False colour", hover, DisplayCommand::ToggleFalseColour.into())
            }
            BarItem::Swap => {
                let hover =
                    "Swap prediction and ground truth (X); hold G to show the ground truth in every pane";
                (self.swapped, "Swap", hover, DisplayCommand::Swap.into())
            }
            BarItem::Clip => {
                let hover = "Mark clipped pixels: too bright (magenta) or black (blue) (L)";
                (state.display.show_clipping, "Clip", hover, DisplayCommand::ToggleClipping.into())
            }
            _ => return,
        };
        // Nothing comes and goes in the bar: what has no effect now is disabled.
        let applies = match item {
            BarItem::Histogram => !state.display.difference,
            BarItem::FalseColour => state.display.quantity == Quantity::Roughness,
            _ => true,
        };
        let button = ui.add_enabled(applies, egui::Button::selectable(on && applies, text));
        if button.on_hover_text(hover).on_disabled_hover_text(hover).clicked() {
            commands.push(command);
        }
    }

    fn exposure(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let mut ev = self.state.exposure_ev;
        number(ui, "Exposure", &mut ev, 0.0, |drag| {
            drag.speed(0.05).range(-20.0..=20.0).fixed_decimals(1).prefix("EV ")
        })
        .on_hover_text("Exposure in stops: E raises it by 0.5, Shift+E lowers it; double-click for 0");
        if ev != self.state.exposure_ev {
            commands.push(DisplayCommand::SetExposure(ev).into());
        }
    }

    fn window(&self, ui: &mut egui::Ui, room: Room, commands: &mut Vec<Command>) {
        // Several of its controls may be used in a row.
        let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
        let (menu, _) = MenuButton::new("Menu").config(config).ui(ui, |ui| self.menu(ui, room, commands));
        menu.on_hover_text(
            "Study, photograph, theme, size of the window's text, and what does not fit into this line",
        );
        let panel = ui.selectable_label(self.side_panel, "Panel").on_hover_text("Side panel (B)");
        if panel.clicked() {
            commands.push(WindowCommand::ToggleSidePanel.into());
        }
        button(ui, "?", "Keys and mouse (?)", commands, WindowCommand::ShowHelp(true).into());
    }

    fn menu(&self, ui: &mut egui::Ui, room: Room, commands: &mut Vec<Command>) {
        let hidden: Vec<BarItem> = BarItem::ALL.into_iter().filter(|item| item.needs() > room).collect();
        hidden.iter().for_each(|item| self.item(ui, *item, commands));
        if !hidden.is_empty() {
            ui.separator();
        }
        let study = ui.add_enabled(self.has_predictions, egui::Button::new("Study: time against error..."));
        let hover = "Measure the time and error of settings of the loss, for this pair on this machine";
        if study.on_hover_text(hover).clicked() {
            commands.push(LossCommand::ShowStudy(true).into());
            ui.close();
        }
        ui.separator();
        let (text, hover, command) = if self.has_photograph {
            ("Close photograph", "Compare with the ground truth again", PhotographCommand::Close)
        } else {
            let hover = "Compare renderings with a photograph, under its light and view";
            ("Open photograph...", hover, PhotographCommand::ShowOpen(true))
        };
        if ui.button(text).on_hover_text(hover).clicked() {
            commands.push(command.into());
            ui.close();
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
