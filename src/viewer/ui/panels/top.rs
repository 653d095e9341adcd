//! Bar at the top: open, save, layout, map or rendering, exposure, projection, in as many lines as the window needs.

use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{self, PopupCloseBehavior, RichText, Role, WidgetInfo};
use egui_material_icons::icons;

use svbrdf_core::picture::quantity::Quantity;

use crate::jobs::displayed::Displayed;
use crate::model::command::{Command, DisplayCommand, WindowCommand};
use crate::model::dataset::DatasetState;
use crate::model::view::state::{AutoExposure, Layout, Projection, ViewState};
use crate::ui::widgets::number;

/// Height of every control, gap between two of them, and width of the exposure, in points.
const HEIGHT: f32 = 24.0;
const GAP: f32 = 3.0;
const EXPOSURE: f32 = 62.0;

/// What the bar shows.
#[derive(Debug)]
pub struct TopBar<'a> {
    pub state: &'a ViewState,
    pub dark: bool,
    pub side_panel: bool,
    pub swapped: bool,
    /// Size of text and controls.
    pub scale: f32,
    pub dataset: &'a DatasetState,
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
            scale: model.settings.ui_scale,
            dataset: &model.dataset,
        }
    }

    pub fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        ui.spacing_mut().item_spacing.x = GAP;
        // Text does not break within a button.
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        // In a window that is small for its scale the bar leaves most of the room to the panes.
        let highest = ui.ctx().content_rect().height() / 3.0;
        egui::ScrollArea::vertical().max_height(highest).auto_shrink([false, true]).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                files(ui, &mut commands);
                ui.separator();
                self.layouts(ui, &mut commands);
                ui.separator();
                self.quantities(ui, &mut commands);
                self.differences(ui, &mut commands);
                ui.separator();
                self.exposure(ui, &mut commands);
                ui.separator();
                self.view(ui, &mut commands);
                ui.separator();
                self.window(ui, &mut commands);
            });
        });
        commands
    }

    fn view(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let display = &self.state.display;
        for (icon, name, hover, on, command) in [
            (
                icons::ICON_VIEW_IN_AR.codepoint,
                "3D",
                "The plane seen from the view position, or the flat texture (P)",
                Some(display.projection == Projection::Perspective),
                DisplayCommand::ToggleProjection,
            ),
            (
                icons::ICON_PALETTE.codepoint,
                "False colour",
                "Roughness from 0 (black) to 1 (light yellow) (V)",
                Some(display.false_colour),
                DisplayCommand::ToggleFalseColour,
            ),
            (
                icons::ICON_SWAP_HORIZ.codepoint,
                "Swap",
                "Swap prediction and ground truth (X); hold G to show the ground truth in every pane",
                Some(self.swapped),
                DisplayCommand::Swap,
            ),
            (
                icons::ICON_BRIGHTNESS_ALERT.codepoint,
                "Clipped pixels",
                "Mark clipped pixels: too bright (magenta) or black (blue) (L)",
                Some(display.show_clipping),
                DisplayCommand::ToggleClipping,
            ),
            (
                icons::ICON_FIT_SCREEN.codepoint,
                "Fit",
                "Fit the material into its pane (F)",
                None,
                DisplayCommand::Fit,
            ),
            ("1:1", "One texel per pixel", "One texel per pixel (0)", None, DisplayCommand::OneToOne),
            (
                icons::ICON_RESTART_ALT.codepoint,
                "Reset",
                "Reset light, view, zoom, exposure and clipping marks (R)",
                None,
                DisplayCommand::Reset,
            ),
            (icons::ICON_UNDO.codepoint, "Undo", "Undo (Ctrl+Z)", None, DisplayCommand::Undo),
            (icons::ICON_REDO.codepoint, "Redo", "Redo (Ctrl+Shift+Z)", None, DisplayCommand::Redo),
        ] {
            // Nothing comes and goes in the bar: what has no effect now is disabled.
            let applies = name != "False colour" || display.quantity == Quantity::Roughness;
            let response = button(ui, icon, name, applies, on.map(|on| on && applies));
            if response.on_hover_text(hover).on_disabled_hover_text(hover).clicked() {
                commands.push(command.into());
            }
        }
    }

    fn layouts(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        segments(ui, |ui| {
            for (layout, icon, hover) in [
                (
                    Layout::SideBySide,
                    icons::ICON_VIEW_COLUMN_2,
                    "Ground truth and every prediction side by side (C)",
                ),
                (
                    Layout::Wipe,
                    icons::ICON_COMPARE,
                    "Ground truth left and chosen prediction right of a line (C)",
                ),
                (Layout::Single, icons::ICON_CROP_SQUARE, "The chosen prediction alone (C)"),
            ] {
                let on = self.state.display.layout == layout;
                let name = format!("Layout {}", layout.name());
                let button = button(ui, icon.codepoint, &name, true, Some(on));
                if button.on_hover_text(hover).clicked() && !on {
                    commands.push(DisplayCommand::SetLayout(layout).into());
                }
            }
        });
    }

    fn quantities(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        segments(ui, |ui| {
            for quantity in Quantity::ALL {
                let (name, text) = (quantity.name(), letter(quantity));
                let on = self.state.display.quantity == quantity;
                let button = button(ui, &text, &format!("Show {name}"), true, Some(on));
                let hover = match quantity {
                    Quantity::Rendering => "Rendering under the light and view (M, Shift+M)".to_owned(),
                    _ => format!("Map of {name} (M, Shift+M)"),
                };
                if button.on_hover_text(hover).clicked() && !on {
                    commands.push(DisplayCommand::SetQuantity(quantity).into());
                }
            }
        });
    }

    fn differences(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        segments(ui, |ui| {
            for (difference, name) in [(false, "Value"), (true, "Difference")] {
                let on = self.state.display.difference == difference;
                let button = button(ui, name, name, true, Some(on));
                let hover = "Show the value, or the difference of predictions from the ground truth (D)";
                if button.on_hover_text(hover).clicked() && !on {
                    commands.push(DisplayCommand::ShowDifference(difference).into());
                }
            }
        });
    }

    fn exposure(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        segments(ui, |ui| {
            let darker = button(ui, "\u{2212}", "Darker", true, None);
            if darker.on_hover_text("Exposure lower by 0.5 stops (Shift+E)").clicked() {
                commands.push(DisplayCommand::StepExposure(-0.5).into());
            }
            let mut ev = self.state.exposure_ev;
            number(ui, "Exposure", &mut ev, 0.0, |drag| {
                drag.speed(0.05)
                    .range(-20.0..=20.0)
                    .fixed_decimals(1)
                    .prefix("EV ")
                    .min_size(egui::vec2(EXPOSURE, HEIGHT))
            })
            .on_hover_text("Exposure in stops; double-click for 0");
            if ev != self.state.exposure_ev {
                commands.push(DisplayCommand::SetExposure(ev).into());
            }
            let brighter = button(ui, "+", "Brighter", true, None);
            if brighter.on_hover_text("Exposure higher by 0.5 stops (E)").clicked() {
                commands.push(DisplayCommand::StepExposure(0.5).into());
            }
            let now = self.state.display.auto_exposure;
            for (auto, text, name, hover) in [
                (
                    AutoExposure::Once,
                    "Auto",
                    "Auto EV",
                    "The brightest 1% of the ground truth just clip: now, and when materials are opened or a scene is \
                     chosen (N)",
                ),
                (
                    AutoExposure::Follow,
                    "Follow",
                    "Exposure follows",
                    "The brightest 1% of the ground truth just clip, under every light and view (Shift+N)",
                ),
            ] {
                let button = button(ui, text, name, true, Some(now == auto));
                if button.on_hover_text(hover).clicked() {
                    commands.push(DisplayCommand::AutoExposure(auto).into());
                }
            }
        });
    }

    fn window(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        // Several of its controls may be used in a row.
        let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
        let face = shaped(icons::ICON_MENU.codepoint, false);
        let (menu, _) = MenuButton::from_button(face).config(config).ui(ui, |ui| self.menu(ui, commands));
        menu.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Menu"));
        menu.on_hover_text("Photograph, theme, size of the window's text");
        let panel = button(ui, icons::ICON_DOCK_TO_LEFT.codepoint, "Panel", true, Some(self.side_panel));
        if panel.on_hover_text("Side panel (B)").clicked() {
            commands.push(WindowCommand::ToggleSidePanel.into());
        }
        let help = button(ui, icons::ICON_HELP.codepoint, "Help", true, None);
        if help.on_hover_text("Keys and mouse (?)").clicked() {
            commands.push(WindowCommand::ShowHelp(true).into());
        }
    }
}

/// What opens and saves.
fn files(ui: &mut egui::Ui, commands: &mut Vec<Command>) {
    for (icon, name, hover, command) in [
        (icons::ICON_FOLDER_OPEN, "Open", "Open materials (Ctrl+O)", WindowCommand::ShowOpen(true)),
        (
            icons::ICON_SAVE,
            "Save",
            "Save view, renderings, strip or session (Ctrl+S)",
            WindowCommand::ShowSave(true),
        ),
        (
            icons::ICON_CONTENT_COPY,
            "Copy",
            "Copy the view as a picture (Ctrl+Shift+C)",
            WindowCommand::CopyPicture,
        ),
    ] {
        if button(ui, icon.codepoint, name, true, None).on_hover_text(hover).clicked() {
            commands.push(command.into());
        }
    }
}

/// The name of a quantity in the bar: maps by their first letters.
fn letter(quantity: Quantity) -> String {
    match quantity {
        Quantity::Rendering => "Rendering".to_owned(),
        map => map.name().chars().take(1).flat_map(char::to_uppercase).collect(),
    }
}

/// A button that is named `name` for assistive software, and is on or off where it can be: `None` is a button that does something.
fn button(ui: &mut egui::Ui, text: &str, name: &str, enabled: bool, on: Option<bool>) -> egui::Response {
    let response = ui.add_enabled(enabled, shaped(text, on.unwrap_or(false)));
    response.widget_info(|| match on {
        Some(on) => WidgetInfo::selected(Role::Button, enabled, on, name),
        None => WidgetInfo::labeled(Role::Button, enabled, name),
    });
    response
}

/// A text, or a letter of the icon font.
fn shaped(text: &str, on: bool) -> egui::Button<'static> {
    let (size, width) =
        if text.starts_with(char::is_alphanumeric) { (13.0, 0.0) } else { (17.0, HEIGHT + 4.0) };
    egui::Button::selectable(on, RichText::new(text).size(size)).min_size(egui::vec2(width, HEIGHT))
}

/// Buttons without gaps, of which usually one is on.
fn segments(ui: &mut egui::Ui, contents: impl FnOnce(&mut egui::Ui)) {
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        contents(ui);
    });
}
