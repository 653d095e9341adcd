//! Scale of a pane in false colours: its colours, with the numbers and the unit of both ends.

use eframe::egui::{Align2, Color32, FontId, Painter, Rect, pos2, vec2};

use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;

use crate::pane::scenery::{PaneContent, Scenery};
use crate::widgets::numbers::digits;
use crate::widgets::paint::colour_bar;

/// Size of the colours, and the distance of the scale from the corner of the pane, in points.
const BAR: [f32; 2] = [9.0, 84.0];
const MARGIN: f32 = 8.0;
/// Least side of a pane that has a scale, in points.
const LEAST: f32 = 150.0;
const INK: Color32 = Color32::from_gray(0xf0);
const BEHIND: Color32 = Color32::from_black_alpha(170);

/// The scale of a pane.
#[derive(Clone, Debug, PartialEq)]
pub struct PaneScale {
    pub is_signed: bool,
    /// The amount that has the last colour.
    pub range: f64,
    pub unit: &'static str,
}

impl PaneScale {
    /// The scale of this content; `None` where it is not in false colours.
    pub fn of(scenery: &Scenery<'_>, content: PaneContent) -> Option<Self> {
        let (state, display) = (scenery.state, &scenery.state.display);
        if content.difference {
            let kind = state.difference_kind();
            return Some(Self { is_signed: kind.is_signed(), range: scenery.range, unit: unit(kind) });
        }
        let is_coloured = display.false_colour && display.quantity == Quantity::Roughness;
        is_coloured.then_some(Self { is_signed: false, range: 1.0, unit: "" })
    }

    /// Draws it into the lower left corner of a pane, unless the pane is too small.
    pub fn paint(&self, painter: &Painter, pane: Rect) {
        if pane.width().min(pane.height()) < LEAST {
            return;
        }
        let low = if self.is_signed { -self.range } else { 0.0 };
        let text = |value: f64| match value {
            0.0 => format!("0{}", self.unit),
            v => format!("{}{}", digits(v).replace('-', "\u{2212}"), self.unit),
        };
        let font = FontId::monospace(11.0);
        let layout = |value| painter.layout_no_wrap(text(value), font.clone(), INK);
        let (top, bottom) = (layout(self.range), layout(low));
        let widest = top.size().x.max(bottom.size().x);
        let size = vec2(BAR[0] + 4.0 + widest, BAR[1]);
        let area = Align2::LEFT_BOTTOM.anchor_size(pane.left_bottom() + vec2(MARGIN, -MARGIN), size);
        painter.rect_filled(area.expand(4.0), 3.0, BEHIND);
        let bar = area.with_max_x(area.left() + BAR[0]);
        painter.add(colour_bar(bar, [if self.is_signed { -1.0 } else { 0.0 }, 1.0], self.is_signed));
        let left = bar.right() + 4.0;
        painter.galley(pos2(left, area.top()), top, INK);
        let height = bottom.size().y;
        painter.galley(pos2(left, area.bottom() - height), bottom, INK);
    }
}

fn unit(kind: Difference) -> &'static str {
    if kind == Difference::Angle { "\u{b0}" } else { "" }
}
