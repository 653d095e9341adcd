//! Style of all plots of the window.

use eframe::egui;
use egui_plot::Plot;

/// A plot that shows all of its data: nothing in it is zoomed, dragged or labelled at the pointer.
pub fn still_plot<'a>(ui: &egui::Ui, name: &str, height: f32) -> Plot<'a> {
    Plot::new(name)
        .height(height)
        .show_background(false)
        .grid_color(ui.visuals().text_color().gamma_multiply(0.25))
        .allow_zoom(false)
        .allow_drag(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .show_crosshair(false)
        .label_formatter(|_| None)
}
