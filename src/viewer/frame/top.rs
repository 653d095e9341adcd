//! Bar at the top: open, save, layout, map or rendering, exposure, projection, in as many lines as the window needs.

use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{self, PopupCloseBehavior, RichText, Role, WidgetInfo};
use egui_material_icons::icons;

use svbrdf_core::picture::quantity::Quantity;
use svbrdf_files::session::window::SessionDisplay;

use crate::frame::{actions, menu};
use crate::jobs::Shown;
use crate::model::view::{AutoExposure, Layout, Projection};
use crate::model::{Model, display, undo};
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

fn view(ui: &mut egui::Ui, model: &Model, next: &mut Model) {
    let display = &model.view.display;
    type Edit = fn(&mut Model);
    let all: [(&str, &str, &str, Option<bool>, Edit); 9] = [
        (
            icons::ICON_VIEW_IN_AR.codepoint,
            "3D",
            "The plane seen from the view position, or the flat texture (P)",
            Some(display.projection == Projection::Perspective),
            |m| m.view.display.projection = m.view.display.projection.other(),
        ),
        (
            icons::ICON_PALETTE.codepoint,
            "False colour",
            "Roughness from 0 (black) to 1 (light yellow) (V)",
            Some(display.false_colour),
            |m| m.view.display.false_colour ^= true,
        ),
        (
            icons::ICON_SWAP_HORIZ.codepoint,
            "Swap",
            "Swap prediction and ground truth (X); hold G to show the ground truth in every pane",
            Some(model.swapped),
            |m| m.swapped ^= true,
        ),
        (
            icons::ICON_BRIGHTNESS_ALERT.codepoint,
            "Clipped pixels",
            "Mark clipped pixels: too bright (magenta) or black (blue) (L)",
            Some(display.show_clipping),
            |m| m.view.display.show_clipping ^= true,
        ),
        (icons::ICON_FIT_SCREEN.codepoint, "Fit", "Fit the material into its pane (F)", None, |m| {
            m.view.fit()
        }),
        ("1:1", "One texel per pixel", "One texel per pixel (0)", None, |m| display::magnify(m, 1.0)),
        (
            icons::ICON_RESTART_ALT.codepoint,
            "Reset",
            "Reset light, view, zoom, exposure and clipping marks (R)",
            None,
            display::reset,
        ),
        (icons::ICON_UNDO.codepoint, "Undo", "Undo (Ctrl+Z)", None, undo::undo),
        (icons::ICON_REDO.codepoint, "Redo", "Redo (Ctrl+Shift+Z)", None, undo::redo),
    ];
    for (icon, name, hover, on, edit) in all {
        // Nothing comes and goes in the bar: what has no effect now is disabled.
        let applies = name != "False colour" || display.quantity == Quantity::Roughness;
        let response = button(ui, icon, name, applies, on.map(|on| on && applies));
        if response.on_hover_text(hover).on_disabled_hover_text(hover).clicked() {
            edit(next);
        }
    }
}

fn layouts(ui: &mut egui::Ui, display: &mut SessionDisplay) {
    segments(ui, "layout", |ui| {
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
            let on = display.layout == layout;
            let name = format!("Layout {}", layout.name());
            let button = button(ui, icon.codepoint, &name, true, Some(on));
            if button.on_hover_text(hover).clicked() {
                display.layout = layout;
            }
        }
    });
}

fn quantities(ui: &mut egui::Ui, display: &mut SessionDisplay) {
    segments(ui, "quantity", |ui| {
        for quantity in Quantity::ALL {
            let (name, text) = (quantity.name(), letter(quantity));
            let on = display.quantity == quantity;
            let button = button(ui, &text, &format!("Show {name}"), true, Some(on));
            let hover = match quantity {
                Quantity::Rendering => "Rendering under the light and view (M, Shift+M)".to_owned(),
                _ => format!("Map of {name} (M, Shift+M)"),
            };
            if button.on_hover_text(hover).clicked() {
                display.quantity = quantity;
            }
        }
    });
}

fn differences(ui: &mut egui::Ui, display: &mut SessionDisplay) {
    segments(ui, "difference", |ui| {
        for (difference, name) in [(false, "Value"), (true, "Difference")] {
            let on = display.difference == difference;
            let button = button(ui, name, name, true, Some(on));
            let hover = "Show the value, or the difference of predictions from the ground truth (D)";
            if button.on_hover_text(hover).clicked() {
                display.difference = difference;
            }
        }
    });
}

fn exposure_controls(ui: &mut egui::Ui, model: &Model, next: &mut Model) {
    segments(ui, "exposure", |ui| {
        let darker = button(ui, "\u{2212}", "Darker", true, None);
        if darker.on_hover_text("Exposure lower by 0.5 stops (Shift+E)").clicked() {
            display::step_exposure(next, -0.5);
        }
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
        let brighter = button(ui, "+", "Brighter", true, None);
        if brighter.on_hover_text("Exposure higher by 0.5 stops (E)").clicked() {
            display::step_exposure(next, 0.5);
        }
        let now = model.view.display.auto_exposure;
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
                display::choose_exposure(next, auto);
            }
        }
    });
}

fn window(ui: &mut egui::Ui, shown: Shown<'_>, next: &mut Model) {
    // Several of its controls may be used in a row.
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let face = shaped(icons::ICON_MENU.codepoint, false);
    let (menu, _) = MenuButton::from_button(face).config(config).ui(ui, |ui| menu::ui(ui, shown, next));
    menu.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Menu"));
    menu.on_hover_text("Theme, size of text and controls, graphics adapter");
    let panel = button(ui, icons::ICON_DOCK_TO_LEFT.codepoint, "Panel", true, Some(shown.model.side_panel()));
    if panel.on_hover_text("Side panel (B)").clicked() {
        next.toggle_side_panel();
    }
    let help = button(ui, icons::ICON_HELP.codepoint, "Help", true, None);
    if help.on_hover_text("Keys and mouse (?)").clicked() {
        next.help = true;
    }
}

/// What opens and saves.
fn files(ui: &mut egui::Ui, next: &mut Model) {
    for (icon, name, hover, edit) in [
        (icons::ICON_FOLDER_OPEN, "Open", "Open materials (Ctrl+O)", actions::OPEN),
        (icons::ICON_SAVE, "Save", "Save view, renderings, strip or session (Ctrl+S)", actions::SAVE),
        (
            icons::ICON_CONTENT_COPY,
            "Copy",
            "Copy the view as a picture (Ctrl+Shift+C)",
            actions::COPY_PICTURE,
        ),
    ] {
        if button(ui, icon.codepoint, name, true, None).on_hover_text(hover).clicked() {
            edit(next);
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
