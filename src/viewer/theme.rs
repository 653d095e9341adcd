//! Colours: neutral grays, so that they do not tint the materials, and one accent.

use eframe::egui::{self, Color32, Stroke, Theme, Visuals};

/// The accent colour: of the selection and of the ground truth.
const ACCENT: Color32 = Color32::from_rgb(0xe0, 0x93, 0x2f);
/// The accent colour as text on light gray.
const DARK_ACCENT: Color32 = Color32::from_rgb(0x9a, 0x52, 0x00);
/// The sun handle.
pub const SUN: Color32 = Color32::from_rgb(0xff, 0xd2, 0x4a);
/// The eye handle and the wipe line.
pub const EYE: Color32 = Color32::from_rgb(0xf5, 0xf5, 0xf5);
const PROBLEM: Color32 = Color32::from_rgb(0xef, 0x7f, 0x71);
const DARK_PROBLEM: Color32 = Color32::from_rgb(0xa3, 0x1d, 0x10);
/// The colours of warnings, as text on dark and on light gray.
const UNSURE: Color32 = Color32::from_rgb(0xff, 0x9f, 0x43);
const DARK_UNSURE: Color32 = Color32::from_rgb(0x8f, 0x40, 0x00);

/// The accent colour, readable on the theme's grays.
pub fn accent(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { ACCENT } else { DARK_ACCENT }
}

/// The colour of errors, readable on the theme's grays.
pub fn problem(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { PROBLEM } else { DARK_PROBLEM }
}

/// The neutral gray around the images.
pub fn surround(dark: bool) -> Color32 {
    Color32::from_gray(if dark { 0x4b } else { 0x8c })
}

/// Installs both themes; [`choose`] selects one.
pub fn install(ctx: &egui::Context) {
    ctx.set_visuals_of(Theme::Dark, visuals(Visuals::dark(), [0x23, 0x2e, 0x3c], 0xe6));
    ctx.set_visuals_of(Theme::Light, visuals(Visuals::light(), [0xea, 0xdd, 0xcc], 0x16));
    ctx.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(8.0, 5.0);
        style.spacing.button_padding = egui::vec2(7.0, 3.0);
        // Scroll bars beside the numbers, not over them.
        style.spacing.scroll.floating_allocated_width = style.spacing.scroll.bar_width;
        style.interaction.selectable_labels = true;
        style.text_styles.insert(egui::TextStyle::Small, egui::FontId::proportional(11.0));
    });
}

pub fn choose(ctx: &egui::Context, dark: bool) {
    ctx.set_theme(if dark { Theme::Dark } else { Theme::Light });
}

/// Grays for panel, widget and hovered widget, and for text.
fn visuals(mut visuals: Visuals, [panel, widget, hovered]: [u8; 3], text: u8) -> Visuals {
    let gray = Color32::from_gray;
    visuals.panel_fill = gray(panel);
    visuals.window_fill = gray(panel);
    visuals.override_text_color = Some(gray(text));
    visuals.widgets.inactive.weak_bg_fill = gray(widget);
    visuals.widgets.inactive.bg_fill = gray(widget);
    visuals.widgets.hovered.weak_bg_fill = gray(hovered);
    visuals.widgets.hovered.bg_fill = gray(hovered);
    visuals.selection.bg_fill = ACCENT.gamma_multiply(0.55);
    visuals.selection.stroke = Stroke::new(1.0, gray(text));
    visuals.hyperlink_color = accent(&visuals);
    visuals.warn_fg_color = if visuals.dark_mode { UNSURE } else { DARK_UNSURE };
    visuals
}
