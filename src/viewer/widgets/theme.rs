//! Theme: neutral grays, so that they do not tint the materials, and one accent.

use eframe::egui::{self, Color32, Stroke, Theme, Visuals};

use svbrdf_gpu::AdapterReport;

/// The accent colour: of the selection.
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

/// Number of colours of predictions; further ones have the same colours in dashes.
pub const SERIES: usize = COLOURS.len();
/// The colours of predictions: apart from each other for people with deuteranopia and protanopia, too, and neither the
/// ground truth's nor the accent's.
const COLOURS: [[u8; 3]; 6] =
    [[80, 190, 255], [240, 228, 66], [130, 90, 255], [40, 150, 110], [205, 255, 190], [110, 140, 0]];

/// The colour of the prediction or method in a slot, from 1 on, in histograms, bars and titles.
pub fn series(slot: usize, dark: bool) -> Color32 {
    let [r, g, b] = COLOURS[slot.saturating_sub(1) % SERIES];
    Color32::from_rgb(r, g, b).lerp_to_gamma(Color32::BLACK, if dark { 0.0 } else { 0.45 })
}

/// The line of the prediction in a slot in histograms: dashed from the seventh on.
pub fn series_line(points: &[egui::Pos2], slot: usize, stroke: Stroke) -> Vec<egui::Shape> {
    if slot <= SERIES {
        vec![egui::Shape::line(points.to_vec(), stroke)]
    } else {
        egui::Shape::dashed_line(points, stroke, 5.0, 3.0)
    }
}

/// The colour of the ground truth: neutral, and stronger than text.
pub fn ground_truth(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::WHITE } else { Color32::BLACK }
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
    egui_material_icons::initialize(ctx);
    // Ctrl+0 is one texel per pixel, as in other viewers of pictures.
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
    ctx.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(8.0, 5.0);
        style.spacing.button_padding = egui::vec2(7.0, 3.0);
        // Scroll bars beside the numbers, not over them.
        style.spacing.scroll.floating_allocated_width = style.spacing.scroll.bar_width;
        // What goes on beyond an edge is seen without the pointer, too.
        style.spacing.scroll.dormant_handle_opacity = 0.6;
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
    visuals.selection.bg_fill = ACCENT.gamma_multiply(0.5);
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

    /// CIE Lab (D65) of a colour as people with a colour-vision deficiency see it: `matrix` acts on linear sRGB.
    fn lab(colour: Color32, matrix: [[f64; 3]; 3]) -> [f64; 3] {
        let linear = [colour.r(), colour.g(), colour.b()].map(|byte| srgb::decode(f64::from(byte) / 255.0));
        let product = |matrix: [[f64; 3]; 3], v: [f64; 3]| {
            matrix.map(|row| row.iter().zip(v).map(|(m, c)| m * c).sum::<f64>())
        };
        let simulated = product(matrix, linear).map(|c| c.clamp(0.0, 1.0));
        let [x, y, z] = product(
            [
                [0.412_456, 0.357_576, 0.180_438],
                [0.212_673, 0.715_152, 0.072_175],
                [0.019_334, 0.119_192, 0.950_304],
            ],
            simulated,
        );
        let root = |t: f64| if t > 0.008_856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
        let [x, y, z] = [x / 0.950_47, y, z / 1.088_83].map(root);
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// Normal vision, and full protanopia and deuteranopia (Machado, Oliveira and Fernandes 2009, table 1).
    const VISIONS: [[[f64; 3]; 3]; 3] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [
            [0.152_286, 1.052_583, -0.204_868],
            [0.114_503, 0.786_281, 0.099_216],
            [-0.003_882, -0.048_116, 1.051_998],
        ],
        [
            [0.367_322, 0.860_646, -0.227_968],
            [0.280_085, 0.672_501, 0.047_413],
            [-0.011_820, 0.042_940, 0.968_881],
        ],
    ];

    /// The least distance of two of the colours in any vision (CIE 1976); 2.3 is just noticeable.
    fn nearest(colours: &[Color32]) -> f64 {
        let mut least = f64::INFINITY;
        for vision in VISIONS {
            for (i, a) in colours.iter().enumerate() {
                for b in &colours[..i] {
                    let apart =
                        lab(*a, vision).into_iter().zip(lab(*b, vision)).map(|(a, b)| (a - b).powi(2));
                    least = least.min(apart.sum::<f64>().sqrt());
                }
            }
        }
        least
    }

    #[test]
    fn predictions_are_told_apart_with_colour_vision_deficiencies_and_from_the_ground_truth() {
        for visuals in [dark(), light()] {
            let mut all: Vec<Color32> = (1..=SERIES).map(|slot| series(slot, visuals.dark_mode)).collect();
            all.push(ground_truth(&visuals));
            let found = nearest(&all);
            assert!(found > 20.0, "{found:.1} in the {} theme", theme(&visuals));
            for colour in all {
                let found = contrast(colour, visuals.panel_fill);
                assert!(found >= 3.0, "{colour:?} in the {} theme: {found:.2}", theme(&visuals));
            }
        }
        let confused = [Color32::from_rgb(230, 159, 0), Color32::from_rgb(160, 180, 40)];
        assert!(nearest(&confused) < 20.0, "a planted fault: {:.1}", nearest(&confused));
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
            // The colour of the selection is translucent.
            let selection = visuals.panel_fill.blend(visuals.selection.bg_fill);
            let selected = contrast(visuals.text_color(), selection);
            assert!(selected >= 4.5, "selected text in the {} theme: {selected:.2}", theme(&visuals));
            let outline = contrast(visuals.widgets.inactive.bg_stroke.color, visuals.panel_fill);
            assert!(outline >= 3.0, "outlines in the {} theme: {outline:.2}", theme(&visuals));
        }
    }

    fn theme(visuals: &Visuals) -> &'static str {
        if visuals.dark_mode { "dark" } else { "light" }
    }
}
