//! The legend of a difference.

use eframe::egui::{Align2, Color32, FontId, Painter, Rect, Stroke, StrokeKind, pos2, vec2};

use super::state::ViewState;
use crate::picture::colour_map::{FULL_DIFFERENCE, heat};
use crate::picture::quantity::Quantity;

/// Colours in the bar.
const STEPS: usize = 64;

/// The difference that the last colour stands for: what is larger has that colour too.
///
/// Of renderings it is one of natural logarithms, and the exposure makes small ones visible; of maps it is plain.
pub fn largest(state: &ViewState) -> f32 {
    if state.quantity == Quantity::Rendering { FULL_DIFFERENCE * (-state.exposure_ev).exp2() } else { 1.0 }
}

/// Paints the bar into the lower left corner of a pane.
pub fn paint(painter: &Painter, rect: Rect, state: &ViewState) {
    let bar = Rect::from_min_size(rect.left_bottom() + vec2(14.0, -30.0), vec2(180.0, 10.0));
    let backdrop = bar.expand2(vec2(8.0, 8.0)).with_max_y(bar.bottom() + 22.0).translate(vec2(0.0, -8.0));
    painter.rect_filled(backdrop, 4.0, Color32::from_black_alpha(190));
    let bar = bar.translate(vec2(0.0, -8.0));
    for i in 0..STEPS {
        let [r, g, b] = heat((i as f32 + 0.5) / STEPS as f32).map(|c| (c * 255.0).round() as u8);
        let left = bar.left() + bar.width() * i as f32 / STEPS as f32;
        let step = Rect::from_min_max(
            pos2(left, bar.top()),
            pos2(left + bar.width() / STEPS as f32 + 0.5, bar.bottom()),
        );
        painter.rect_filled(step, 0.0, Color32::from_rgb(r, g, b));
    }
    painter.rect_stroke(bar, 0.0, Stroke::new(1.0, Color32::from_gray(150)), StrokeKind::Outside);
    let what = if state.quantity == Quantity::Rendering { "|ln|" } else { "difference" };
    let words = [
        (Align2::LEFT_TOP, bar.left_bottom(), "0".to_owned()),
        (Align2::CENTER_TOP, bar.center_bottom(), what.to_owned()),
        (Align2::RIGHT_TOP, bar.right_bottom(), format!("{:.3}+", largest(state))),
    ];
    for (anchor, at, text) in words {
        painter.text(at + vec2(0.0, 3.0), anchor, text, FontId::monospace(11.0), Color32::from_gray(230));
    }
}
