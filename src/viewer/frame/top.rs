//! Bar at the top: open, save, layout, map or rendering, exposure, projection, in as many lines as the window needs.

use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{self, Key, Modifiers, PopupCloseBehavior, RichText, Role, WidgetInfo};
use egui_material_icons::icons;

use svbrdf_core::picture::quantity::Quantity;
use svbrdf_files::session::window::SessionDisplay;

use crate::frame::actions::{BOTH, COMMAND, NONE, SHIFT};
use crate::frame::{actions, menu};
use crate::jobs::Shown;
use crate::model::Model;
use crate::model::view::{AutoExposure, Layout, Projection};
use crate::widgets::number;

/// Height of every control, gap between two of them, and width of the exposure, in points.
const HEIGHT: f32 = 24.0;
const GAP: f32 = 3.0;
const EXPOSURE: f32 = 62.0;

/// Draws the bar for the model.
pub fn ui(ui: &mut egui::Ui, shown @ Shown { model, .. }: Shown<'_>, next: &mut Model) {
    ui.spacing_mut().item_spacing.x = GAP;
    // Text does not break within a button.
    ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
    // In a window that is small for its scale the bar leaves most of the room to the panes.
    let highest = ui.ctx().content_rect().height() / 3.0;
    let area = egui::ScrollArea::vertical().max_height(highest).min_scrolled_height(highest);
    area.auto_shrink([false, true]).show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            files(ui, next);
            ui.separator();
            layouts(ui, &mut next.view.display);
            ui.separator();
            quantities(ui, &mut next.view.display);
            differences(ui, &mut next.view.display);
            ui.separator();
            exposure_controls(ui, model, next);
            ui.separator();
            view(ui, model, next);
            ui.separator();
            window(ui, shown, next);
        });
    });
}

/// Buttons that do what keys do.
fn view(ui: &mut egui::Ui, model: &Model, next: &mut Model) {
    let display = &model.view.display;
    for (icon, name, key, on) in [
        (
            icons::ICON_VIEW_IN_AR.codepoint,
            "3D",
            (NONE, Key::P),
            Some(display.projection == Projection::Perspective),
        ),
        (icons::ICON_PALETTE.codepoint, "False colour", (NONE, Key::V), Some(display.false_colour)),
        (icons::ICON_SWAP_HORIZ.codepoint, "Swap", (NONE, Key::X), Some(model.swapped)),
        (
            icons::ICON_BRIGHTNESS_ALERT.codepoint,
            "Clipped pixels",
            (NONE, Key::L),
            Some(display.show_clipping),
        ),
        (icons::ICON_FIT_SCREEN.codepoint, "Fit", (NONE, Key::F), None),
        ("1:1", "One texel per pixel", (NONE, Key::Num0), None),
        (icons::ICON_RESTART_ALT.codepoint, "Reset", (NONE, Key::R), None),
        (icons::ICON_UNDO.codepoint, "Undo", (COMMAND, Key::Z), None),
        (icons::ICON_REDO.codepoint, "Redo", (BOTH, Key::Z), None),
    ] {
        act(ui, next, (icon, name), key, on);
    }
}

/// A button that does what a key does, which its hover text names; `on` as that of a [`button`].
fn act(
    ui: &mut egui::Ui,
    next: &mut Model,
    (icon, name): (&str, &str),
    key: (Modifiers, Key),
    on: Option<bool>,
) {
    let Some((line, edit)) = actions::of(key) else { return };
    let hover = format!("{name}: {} ({})", line.effect, line.keys);
    // Nothing comes and goes in the bar: what has no effect now is disabled.
    let applies = name != "False colour" || next.view.display.quantity == Quantity::Roughness;
    let response = button(ui, icon, name, applies, on.map(|on| on && applies));
    if response.on_hover_text(&hover).on_disabled_hover_text(hover).clicked() {
        edit(next);
    }
}

/// Buttons of which one is on: each with its text, its name and its value. `hover` tells of one.
fn choices<T: Copy + PartialEq>(
    ui: &mut egui::Ui,
    id: &str,
    all: impl IntoIterator<Item = (String, String, T)>,
    chosen: &mut T,
    hover: impl Fn(&str) -> String,
) {
    segments(ui, id, |ui| {
        for (text, name, value) in all {
            let button = button(ui, &text, &name, true, Some(*chosen == value));
            if button.on_hover_text(hover(&name)).clicked() {
                *chosen = value;
            }
        }
    });
}

fn layouts(ui: &mut egui::Ui, display: &mut SessionDisplay) {
    let icons = [icons::ICON_VIEW_COLUMN_2, icons::ICON_COMPARE, icons::ICON_CROP_SQUARE];
    let all = Layout::ALL.into_iter().zip(icons);
    let all = all.map(|(one, icon)| (icon.codepoint.to_owned(), format!("Layout {}", one.name()), one));
    choices(ui, "layout", all, &mut display.layout, |name| format!("{name} (C)"));
}

fn quantities(ui: &mut egui::Ui, display: &mut SessionDisplay) {
    let all = Quantity::ALL.map(|one| (letter(one), format!("Show {}", one.name()), one));
    choices(ui, "quantity", all, &mut display.quantity, |name| format!("{name} (M, Shift+M)"));
}

fn differences(ui: &mut egui::Ui, display: &mut SessionDisplay) {
    let all =
        [(false, "Value"), (true, "Difference")].map(|(on, name)| (name.to_owned(), name.to_owned(), on));
    let hover = "Show the value, or the difference of predictions from the ground truth (D)";
    choices(ui, "difference", all, &mut display.difference, |_| hover.to_owned());
}

fn exposure_controls(ui: &mut egui::Ui, model: &Model, next: &mut Model) {
    segments(ui, "exposure", |ui| {
        act(ui, next, ("\u{2212}", "Darker"), (SHIFT, Key::E), None);
        let mut ev = model.view.exposure_ev;
        number(ui, "Exposure", &mut ev, 0.0, |drag| {
            drag.speed(0.05)
                .range(-20.0..=20.0)
                .fixed_decimals(1)
                .prefix("EV ")
                .min_size(egui::vec2(EXPOSURE, HEIGHT))
        })
        .on_hover_text("Exposure in stops; double-click for 0");
        if ev != model.view.exposure_ev {
            next.view.set_exposure(ev);
        }
        act(ui, next, ("+", "Brighter"), (NONE, Key::E), None);
        let now = model.view.display.auto_exposure;
        let follows = AutoExposure::Follow;
        act(ui, next, ("Auto", "Auto EV"), (NONE, Key::N), Some(now == AutoExposure::Once));
        act(ui, next, ("Follow", "Exposure follows"), (SHIFT, Key::N), Some(now == follows));
    });
}

fn window(ui: &mut egui::Ui, shown: Shown<'_>, next: &mut Model) {
    // Several of its controls may be used in a row.
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let face = shaped(icons::ICON_MENU.codepoint, false);
    let (menu, _) = MenuButton::from_button(face).config(config).ui(ui, |ui| menu::ui(ui, shown, next));
    menu.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Menu"));
    menu.on_hover_text("Theme, size of text and controls, graphics adapter");
    let is_open = Some(shown.model.side_panel());
    act(ui, next, (icons::ICON_DOCK_TO_LEFT.codepoint, "Panel"), (NONE, Key::B), is_open);
    act(ui, next, (icons::ICON_HELP.codepoint, "Help"), (NONE, Key::F1), None);
}

/// What opens and saves.
fn files(ui: &mut egui::Ui, next: &mut Model) {
    act(ui, next, (icons::ICON_FOLDER_OPEN.codepoint, "Open"), (COMMAND, Key::O), None);
    act(ui, next, (icons::ICON_SAVE.codepoint, "Save"), (COMMAND, Key::S), None);
    act(ui, next, (icons::ICON_CONTENT_COPY.codepoint, "Copy"), (BOTH, Key::C), None);
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

/// Buttons without gaps, of which usually one is on, in one line.
fn segments(ui: &mut egui::Ui, name: &str, contents: impl FnOnce(&mut egui::Ui)) {
    let id = ui.scope_id().with(name);
    let width = ui.data(|data| data.get_temp(id)).unwrap_or(0.0);
    let line = egui::Layout::left_to_right(egui::Align::Center);
    // Where it does not fit behind what is before it, it begins the next line.
    let drawn = ui.allocate_ui_with_layout(egui::vec2(width, HEIGHT), line, |ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        contents(ui);
    });
    ui.data_mut(|data| data.insert_temp(id, drawn.response.rect.width()));
}
