//! Scale of a pane in false colours: its colours, with the numbers of both ends. Those of differences are in the legend.

use eframe::egui::{Align2, Color32, FontId, Painter, Rect, pos2, vec2};

use svbrdf_core::picture::quantity::Quantity;

use crate::pane::displayed::Displayed;
use crate::pane::scenery::PaneContent;
use crate::widgets::paint::colour_bar;

/// Size of the colours, and the distance of the scale from the corner of the pane, in points.
const BAR: [f32; 2] = [9.0, 84.0];
const MARGIN: f32 = 8.0;
/// Least side of a pane that has a scale, in points.
const LEAST: f32 = 150.0;
const INK: Color32 = Color32::from_gray(0xf0);
const BEHIND: Color32 = Color32::from_black_alpha(170);

/// Whether a pane shows roughness in false colours, from 0 to 1.
pub fn has_scale(shown: &Displayed<'_>, content: PaneContent) -> bool {
    let display = &shown.view().display;
    display.false_colour && display.quantity == Quantity::Roughness && !content.difference
}

/// Draws the scale into the lower left corner of a pane, unless the pane is too small.
pub fn paint(painter: &Painter, pane: Rect) {
    if pane.width().min(pane.height()) < LEAST {
        return;
    }
    let layout = |text: &str| painter.layout_no_wrap(text.to_owned(), FontId::monospace(11.0), INK);
    let [top, bottom] = ["1.000", "0"].map(layout);
    let size = vec2(BAR[0] + 4.0 + top.size().x, BAR[1]);
    let area = Align2::LEFT_BOTTOM.anchor_size(pane.left_bottom() + vec2(MARGIN, -MARGIN), size);
    painter.rect_filled(area.expand(4.0), 3.0, BEHIND);
    let bar = area.with_max_x(area.left() + BAR[0]);
    painter.add(colour_bar(bar, [0.0, 1.0], false));
    let left = bar.right() + 4.0;
    painter.galley(pos2(left, area.top()), top, INK);
    let height = bottom.size().y;
    painter.galley(pos2(left, area.bottom() - height), bottom, INK);
}
