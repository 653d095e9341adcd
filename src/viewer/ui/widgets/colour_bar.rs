//! Bar of false colours, as legends and scales have it.

use eframe::egui::{Color32, Mesh, Rect, pos2};

use svbrdf_core::picture::colour_map::difference_to_display;

/// Colours from one end to the other.
const STEPS: u32 = 64;

/// The colours of the amounts from `low` to `high`, in units of the range: from left to right, or from below to above where
/// the bar is higher than wide.
pub fn colour_bar(bar: Rect, [low, high]: [f32; 2], is_signed: bool) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..=STEPS {
        let share = i as f32 / STEPS as f32;
        let [r, g, b] = difference_to_display(low + (high - low) * share, 1.0, is_signed);
        let ends = if bar.height() > bar.width() {
            let y = bar.bottom() - share * bar.height();
            [pos2(bar.left(), y), pos2(bar.right(), y)]
        } else {
            let x = bar.left() + share * bar.width();
            [pos2(x, bar.top()), pos2(x, bar.bottom())]
        };
        ends.into_iter().for_each(|end| mesh.colored_vertex(end, Color32::from_rgb(r, g, b)));
        if let Some(last) = (2 * i).checked_sub(2) {
            mesh.add_triangle(last, last + 1, last + 2);
            mesh.add_triangle(last + 1, last + 2, last + 3);
        }
    }
    mesh
}
