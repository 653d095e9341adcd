//! Theme: neutral grays, so that they do not tint the materials, and one accent.

use eframe::egui::{self, Color32, Stroke, Theme, Visuals};

use svbrdf_gpu::AdapterReport;

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
const BETTER: Color32 = Color32::from_rgb(0x7f, 0xcf, 0x8f);
const DARK_BETTER: Color32 = Color32::from_rgb(0x0f, 0x5a, 0x26);
/// The colours of warnings, as text on dark and on light gray.
const UNSURE: Color32 = Color32::from_rgb(0xff, 0x9f, 0x43);
const DARK_UNSURE: Color32 = Color32::from_rgb(0x8f, 0x40, 0x00);

/// The accent colour, readable on the theme's grays.
pub fn accent(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { ACCENT } else { DARK_ACCENT }
}

/// The colour of what is better than another, readable on the theme's grays.
pub fn better(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { BETTER } else { DARK_BETTER }
}

/// The colour of prediction `index` in histograms and bars: the palette of Okabe and Ito, distinct with colour-vision deficiencies.
pub fn series(index: usize, dark: bool) -> Color32 {
    const COLOURS: [[u8; 3]; 6] =
        [[86, 180, 233], [230, 159, 0], [0, 158, 115], [204, 121, 167], [213, 94, 0], [0, 114, 178]];
    let [r, g, b] = COLOURS[index % COLOURS.len()];
    Color32::from_rgb(r, g, b).lerp_to_gamma(Color32::BLACK, if dark { 0.0 } else { 0.35 })
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
    ctx.set_visuals_of(Theme::Dark, dark());
    ctx.set_visuals_of(Theme::Light, light());
    ctx.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(8.0, 5.0);
        style.spacing.button_padding = egui::vec2(7.0, 3.0);
        // Scroll bars beside the numbers, not over them.
        style.spacing.scroll.floating_allocated_width = style.spacing.scroll.bar_width;
        style.interaction.selectable_labels = true;
        // A cursor that blinks draws the whole window twice a second.
        style.visuals.text_cursor.blink = false;
        style.text_styles.insert(egui::TextStyle::Small, egui::FontId::proportional(11.0));
    });
}

/// Right angles and hard edges on an adapter that computes on the CPU. It pays for every block of pixels that a triangle touches:
/// round corners and soft edges make five times as many triangles, and took a quarter of a frame.
pub fn suit(ctx: &egui::Context, adapter: &AdapterReport) {
    if !adapter.software {
        return;
    }
    ctx.options_mut(|options| options.tessellation_options.feathering = false);
    ctx.all_styles_mut(|style| {
        let widgets = &mut style.visuals.widgets;
        let all = [&mut widgets.noninteractive, &mut widgets.inactive, &mut widgets.hovered];
        let all = all.into_iter().chain([&mut widgets.active, &mut widgets.open]);
        all.for_each(|widget| widget.corner_radius = egui::CornerRadius::ZERO);
    });
}

pub fn choose(ctx: &egui::Context, dark: bool) {
    ctx.set_theme(if dark { Theme::Dark } else { Theme::Light });
}

fn dark() -> Visuals {
    visuals(Visuals::dark(), [0x23, 0x2e, 0x3c], 0x7c, [0xe6, 0xa8])
}

fn light() -> Visuals {
    visuals(Visuals::light(), [0xea, 0xdd, 0xcc], 0x78, [0x16, 0x50])
}

/// Grays for panel, widget and hovered widget, for the outline of widgets, and for text and weak text.
fn visuals(
    mut visuals: Visuals,
    [panel, widget, hovered]: [u8; 3],
    outline: u8,
    [text, weak_text]: [u8; 2],
) -> Visuals {
    let gray = Color32::from_gray;
    visuals.panel_fill = gray(panel);
    visuals.window_fill = gray(panel);
    visuals.override_text_color = Some(gray(text));
    visuals.weak_text_color = Some(gray(weak_text));
    // Unchecked boxes are seen by their outline.
    visuals.widgets.inactive.bg_stroke = Stroke::new(1.0, gray(outline));
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

#[cfg(test)]
mod tests {
    use svbrdf_core::math::srgb;

    use super::*;

    /// The contrast of two opaque colours, after WCAG 2.
    fn contrast(a: Color32, b: Color32) -> f64 {
        let linear = |byte: u8| srgb::decode(f64::from(byte) / 255.0);
        let luminance =
            |c: Color32| 0.2126 * linear(c.r()) + 0.7152 * linear(c.g()) + 0.0722 * linear(c.b()) + 0.05;
        let [a, b] = [luminance(a), luminance(b)];
        a.max(b) / a.min(b)
    }

    #[test]
    fn contrast_is_that_of_the_standard() {
        assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 1e-9);
        assert!((contrast(Color32::from_gray(0x77), Color32::WHITE) - 4.48).abs() < 0.01);
    }

    #[test]
    fn text_has_a_contrast_of_4_5_and_outlines_of_3() {
        for visuals in [dark(), light()] {
            let texts = [
                ("text", visuals.text_color()),
                ("weak text", visuals.weak_text_color()),
                ("warnings", visuals.warn_fg_color),
                ("problems", problem(&visuals)),
                ("accent", accent(&visuals)),
                ("better", better(&visuals)),
            ];
            for (what, colour) in texts {
                let found = contrast(colour, visuals.panel_fill);
                assert!(found >= 4.5, "{what} in the {} theme: {found:.2}", theme(&visuals));
            }
            let button = contrast(visuals.text_color(), visuals.widgets.inactive.weak_bg_fill);
            assert!(button >= 4.5, "text of buttons in the {} theme: {button:.2}", theme(&visuals));
            let outline = contrast(visuals.widgets.inactive.bg_stroke.color, visuals.panel_fill);
            assert!(outline >= 3.0, "outlines in the {} theme: {outline:.2}", theme(&visuals));
        }
    }

    fn theme(visuals: &Visuals) -> &'static str {
        if visuals.dark_mode { "dark" } else { "light" }
    }
}
