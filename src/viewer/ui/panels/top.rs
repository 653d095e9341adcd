//! Bar at the top: open, save, layout, map or rendering, exposure, projection.

use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{self, PopupCloseBehavior, RichText, Role, WidgetInfo};
use egui_material_icons::icons;

use svbrdf_core::picture::quantity::Quantity;

use crate::jobs::displayed::Displayed;
use crate::model::command::{Command, DisplayCommand, WindowCommand};
use crate::model::dataset::DatasetState;
use crate::model::view::state::{AutoExposure, Layout, Projection, ViewState};
use crate::ui::panels::bar_item::{BarItem, Room};
use crate::ui::widgets::number;

/// Height of every control, gap between two of them, and width of the exposure, in points.
const HEIGHT: f32 = 24.0;
const GAP: f32 = 3.0;
const EXPOSURE: f32 = 62.0;
/// Gap between the buttons of a segment, and width of a separator, in points.
const SEGMENTS: f32 = 1.0;
const SEPARATOR: f32 = 6.0;

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
            histograms: model.settings.histograms,
            scale: model.settings.ui_scale,
            has_predictions: !model.materials.predictions().is_empty(),
            has_photograph: model.photograph.source().is_some(),
            dataset: &model.dataset,
        }
    }

    pub fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        ui.spacing_mut().item_spacing.x = GAP;
        let room = &room(ui);
        ui.horizontal(|ui| {
            self.files(ui, room, &mut commands);
            ui.separator();
            self.layouts(ui, &mut commands);
            ui.separator();
            self.quantities(ui, &mut commands);
            self.differences(ui, &mut commands);
            ui.separator();
            let toggles = [
                BarItem::Histogram,
                BarItem::Perspective,
                BarItem::Tile,
                BarItem::FalseColour,
                BarItem::Swap,
            ];
            self.items(ui, room, &toggles, &mut commands);
            if room.exposure {
                ui.separator();
                self.exposure(ui, &mut commands);
                self.items(ui, room, &[BarItem::Clip], &mut commands);
                ui.separator();
                let position =
                    [BarItem::Fit, BarItem::OneToOne, BarItem::Reset, BarItem::Undo, BarItem::Redo];
                self.items(ui, room, &position, &mut commands);
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                self.window(ui, room, &mut commands);
            });
        });
        commands
    }

    fn files(&self, ui: &mut egui::Ui, room: &Room, commands: &mut Vec<Command>) {
        let open = Face::Icon.button(ui, icons::ICON_FOLDER_OPEN.codepoint, "Open", true, None);
        if open.on_hover_text("Open materials (Ctrl+O)").clicked() {
            commands.push(WindowCommand::ShowOpen(true).into());
        }
        let save = Face::Icon.button(ui, icons::ICON_SAVE.codepoint, "Save", true, None);
        if save.on_hover_text("Save view, renderings, strip or session (Ctrl+S)").clicked() {
            commands.push(WindowCommand::ShowSave(true).into());
        }
        self.items(ui, room, &[BarItem::Copy], commands);
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
                let button = Face::Icon.button(ui, icon.codepoint, &name, true, Some(on));
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
                let button = Face::Text.button(ui, &text, &format!("Show {name}"), true, Some(on));
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
            for (difference, name) in [false, true].into_iter().zip(DIFFERENCES) {
                let on = self.state.display.difference == difference;
                let button = Face::Text.button(ui, name, name, true, Some(on));
                let hover = "Show the value, or the difference of predictions from the ground truth (D)";
                if button.on_hover_text(hover).clicked() && !on {
                    commands.push(DisplayCommand::ShowDifference(difference).into());
                }
            }
        });
    }

    /// Those of `items` that have room.
    fn items(&self, ui: &mut egui::Ui, room: &Room, items: &[BarItem], commands: &mut Vec<Command>) {
        for item in items.iter().filter(|item| room.has(**item)) {
            self.item(ui, *item, Face::Icon, commands);
        }
    }

    pub(super) fn item(&self, ui: &mut egui::Ui, item: BarItem, face: Face, commands: &mut Vec<Command>) {
        let display = &self.state.display;
        let on = match item {
            BarItem::Histogram => Some(self.histograms),
            BarItem::Perspective => Some(display.projection == Projection::Perspective),
            BarItem::Tile => Some(display.tiled),
            BarItem::FalseColour => Some(display.false_colour),
            BarItem::Swap => Some(self.swapped),
            BarItem::Clip => Some(display.show_clipping),
            _ => None,
        };
        // Nothing comes and goes in the bar: what has no effect now is disabled.
        let applies = match item {
            BarItem::Histogram => !display.difference,
            BarItem::FalseColour => display.quantity == Quantity::Roughness,
            _ => true,
        };
        let button = face.button(ui, item.icon(), item.name(), applies, on.map(|on| on && applies));
        if button.on_hover_text(item.hover()).on_disabled_hover_text(item.hover()).clicked() {
            commands.push(item.command());
        }
    }

    pub(super) fn exposure(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        segments(ui, |ui| {
            let darker = Face::Text.button(ui, "\u{2212}", "Darker", true, None);
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
            let brighter = Face::Text.button(ui, "+", "Brighter", true, None);
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
                let button = Face::Text.button(ui, text, name, true, Some(now == auto));
                if button.on_hover_text(hover).clicked() {
                    commands.push(DisplayCommand::AutoExposure(auto).into());
                }
            }
        });
    }

    /// From the right.
    fn window(&self, ui: &mut egui::Ui, room: &Room, commands: &mut Vec<Command>) {
        let help = Face::Icon.button(ui, icons::ICON_HELP.codepoint, "Help", true, None);
        if help.on_hover_text("Keys and mouse (?)").clicked() {
            commands.push(WindowCommand::ShowHelp(true).into());
        }
        let panel =
            Face::Icon.button(ui, icons::ICON_DOCK_TO_LEFT.codepoint, "Panel", true, Some(self.side_panel));
        if panel.on_hover_text("Side panel (B)").clicked() {
            commands.push(WindowCommand::ToggleSidePanel.into());
        }
        // Several of its controls may be used in a row.
        let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
        let face = Face::Icon.shaped(icons::ICON_MENU.codepoint, false);
        let (menu, _) =
            MenuButton::from_button(face).config(config).ui(ui, |ui| self.menu(ui, room, commands));
        menu.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Menu"));
        menu.on_hover_text(
            "Study, photograph, theme, size of the window's text, and what does not fit into this line",
        );
    }
}

/// The names of what panes of predictions show.
const DIFFERENCES: [&str; 2] = ["Value", "Difference"];

/// The name of a quantity in the bar: maps by their first letters.
fn letter(quantity: Quantity) -> String {
    match quantity {
        Quantity::Rendering => "Rendering".to_owned(),
        map => map.name().chars().take(1).flat_map(char::to_uppercase).collect(),
    }
}

/// What of the bar fits into its line, by the widths that its parts have.
fn room(ui: &egui::Ui) -> Room {
    // Between it and the controls from the right.
    const AIR: f32 = 10.0;
    let icon = |text: &str| Face::Icon.width(ui, text) + GAP;
    let texts = |texts: &[&str]| {
        let widths: f32 = texts.iter().map(|text| Face::Text.width(ui, text) + SEGMENTS).sum();
        widths - SEGMENTS + GAP
    };
    let separator = SEPARATOR + GAP;
    let letters = Quantity::ALL.map(letter);
    let letters: Vec<&str> = letters.iter().map(String::as_str).collect();
    // Open, Save, three layouts; help, panel and menu.
    let always =
        8.0 * icon(icons::ICON_SAVE.codepoint) + 3.0 * separator + texts(&letters) + texts(&DIFFERENCES);
    Room::new(ui.available_width() - always - AIR, |part| match part {
        Some(item) => icon(item.icon()),
        None => {
            let number = Face::Text.width(ui, "EV \u{2212}20.0").max(EXPOSURE) + SEGMENTS;
            2.0 * separator + number + texts(&["\u{2212}", "+", "Auto", "Follow"])
        }
    })
}

/// What a button shows.
#[derive(Clone, Copy, Debug)]
pub(super) enum Face {
    Icon,
    Text,
    /// Its name, in the menu.
    Name,
}

impl Face {
    /// A button that is named `name` for assistive software, and is on or off where it can be: `None` is a button that does something.
    pub(super) fn button(
        self,
        ui: &mut egui::Ui,
        text: &str,
        name: &str,
        enabled: bool,
        on: Option<bool>,
    ) -> egui::Response {
        let label = if matches!(self, Self::Name) { name } else { text };
        let response = ui.add_enabled(enabled, self.shaped(label, on.unwrap_or(false)));
        response.widget_info(|| match on {
            Some(on) => WidgetInfo::selected(Role::Button, enabled, on, name),
            None => WidgetInfo::labeled(Role::Button, enabled, name),
        });
        response
    }

    /// The size of its text, and its least width.
    fn size(self, text: &str) -> [f32; 2] {
        match self {
            Self::Icon if text.is_ascii() => [13.0, HEIGHT + 4.0],
            Self::Icon => [17.0, HEIGHT + 4.0],
            Self::Text | Self::Name => [13.0, 0.0],
        }
    }

    /// The width of the button with this text, in points.
    fn width(self, ui: &egui::Ui, text: &str) -> f32 {
        let [size, least] = self.size(text);
        let font = egui::FontId::proportional(size);
        let galley = ui.painter().layout_no_wrap(text.to_owned(), font, egui::Color32::PLACEHOLDER);
        (galley.size().x + 2.0 * ui.spacing().button_padding.x).max(least)
    }

    fn shaped(self, text: &str, on: bool) -> egui::Button<'static> {
        let [size, width] = self.size(text);
        egui::Button::selectable(on, RichText::new(text).size(size)).min_size(egui::vec2(width, HEIGHT))
    }
}

/// Buttons without gaps, of which usually one is on.
fn segments(ui: &mut egui::Ui, contents: impl FnOnce(&mut egui::Ui)) {
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.x = SEGMENTS;
        contents(ui);
    });
}
