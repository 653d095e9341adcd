//! Scale of text and controls at the first start, chosen by the monitor.

use eframe::egui;

/// Chooses the scale, once the monitor is known: systems without one of their own draw text of 2 mm on a 4K screen.
pub fn suit(ctx: &egui::Context, is_to_be_chosen: &mut bool) {
    let (monitor, native) = ctx.input(|i| (i.viewport().monitor_size, i.viewport().native_pixels_per_point));
    let Some(monitor) = monitor.filter(|_| std::mem::take(is_to_be_chosen)) else { return };
    if native.is_none_or(|native| native <= 1.0) {
        ctx.set_zoom_factor(scale_of_monitor(monitor.y * ctx.pixels_per_point()));
    }
}

/// In quarters, for a monitor of this height in pixels: 1 up to 1080.
fn scale_of_monitor(height: f32) -> f32 {
    ((height / 1080.0 * 4.0).floor() / 4.0).clamp(1.0, 3.0)
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
