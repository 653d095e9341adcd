//! Scale of text and controls: chosen by the monitor at the first start, and changed within its range.

use eframe::egui;

use crate::model::Model;
use crate::model::ranges::UI_SCALE;

/// A step of the scale by a key.
const STEP: f32 = 0.1;

/// Changes the scale of text and controls by this many steps.
pub fn step(model: &mut Model, steps: f32) {
    let scale = (model.settings.ui_scale / STEP + steps).round() * STEP;
    model.settings.ui_scale = scale.clamp(*UI_SCALE.start(), *UI_SCALE.end());
}

/// Chooses the scale of text and controls at the first start: systems without one of their own draw text of 2 mm on a 4K screen.
pub fn suit(ctx: &egui::Context, is_to_be_chosen: &mut bool) {
    let (monitor, native) = ctx.input(|i| (i.viewport().monitor_size, i.viewport().native_pixels_per_point));
    let Some(monitor) = monitor.filter(|_| std::mem::take(is_to_be_chosen)) else { return };
    if native.is_none_or(|native| native <= 1.0) {
        ctx.set_zoom_factor(scale_of_monitor(monitor.y * ctx.pixels_per_point()));
    }
}

/// The scale of text and controls for a monitor of this height in pixels, in quarters: 1 up to 1080.
fn scale_of_monitor(height: f32) -> f32 {
    ((height / 1080.0 * 4.0).floor() / 4.0).clamp(1.0, 3.0)
}

/// The scale of text and controls that the context has.
pub fn scale_in_range(ctx: &egui::Context) -> f32 {
    let scale = ctx.zoom_factor().clamp(*UI_SCALE.start(), *UI_SCALE.end());
    ctx.set_zoom_factor(scale);
    scale
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_monitor_has_larger_text_at_the_first_start() {
        let scales = [600.0, 1080.0, 1200.0, 1440.0, 2160.0, 4320.0].map(scale_of_monitor);
        assert_eq!(scales, [1.0, 1.0, 1.0, 1.25, 2.0, 3.0]);
    }
}
