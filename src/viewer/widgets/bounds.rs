//! Places within areas of any size: a window can be smaller than the margins of what it shows.

use eframe::egui::{Pos2, Rect, Vec2, pos2};

/// `value` between `low` and `high`; halfway between them where they are the wrong way round.
pub fn between(value: f32, low: f32, high: f32) -> f32 {
    if low <= high { value.max(low).min(high) } else { 0.5 * (low + high) }
}

/// The point of `rect` nearest to `pos`.
pub fn nearest(rect: Rect, pos: Pos2) -> Pos2 {
    pos2(between(pos.x, rect.left(), rect.right()), between(pos.y, rect.top(), rect.bottom()))
}

/// `rect` without a margin at each side; its middle along an axis that is shorter than both margins.
pub fn inset(rect: Rect, margin: Vec2) -> Rect {
    let rest = (rect.size() - 2.0 * margin).max(Vec2::ZERO);
    Rect::from_center_size(rect.center(), rest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::vec2;

    #[test]
    fn what_remains_of_an_area_lies_in_it_and_has_no_negative_side() {
        let margin = vec2(6.0, 60.0);
        for width in [0.0, 2.5, 8.0, 12.0, 640.0] {
            for height in [0.0, 2.5, 119.0, 121.0, 640.0] {
                let rect = Rect::from_min_size(pos2(30.0, 40.0), vec2(width, height));
                let rest = inset(rect, margin);
                assert!(rest.width() >= 0.0 && rest.height() >= 0.0, "{rest:?}");
                assert!(rect.expand(1e-3).contains_rect(rest), "{rest:?} in {rect:?}");
                assert!(rest.contains(nearest(rest, pos2(1e6, -1e6))), "{rest:?}");
            }
        }
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(100.0, 200.0));
        assert_eq!(inset(rect, margin), rect.shrink2(margin));
    }
}
