//! The hemisphere of directions seen from above: x to the right, y up, straight above in the middle.

use eframe::egui::{Pos2, Rect, vec2};
use glam::DVec3;

use svbrdf_core::model::scene::{Endpoint, Scene};

/// The direction of light or view from the middle of the material.
pub fn unit(scene: &Scene, which: Endpoint) -> [f64; 3] {
    let endpoint = match which {
        Endpoint::Light => scene.light,
        Endpoint::View => scene.view,
    };
    DVec3::from(endpoint).normalize().to_array()
}

/// Where a unit direction is on the map.
pub fn pos_of(area: Rect, [x, y, _]: [f64; 3]) -> Pos2 {
    area.center() + vec2(x as f32, -y as f32) * (area.width() / 2.0)
}

/// The unit direction at a point of the map; beyond the rim, the nearest on it.
pub fn direction_at(area: Rect, pos: Pos2, rim: f64) -> [f64; 3] {
    let at = (pos - area.center()) / (area.width() / 2.0);
    let [x, y] = [f64::from(at.x), f64::from(-at.y)];
    let shrink = (rim / x.hypot(y)).min(1.0);
    let [x, y] = [x * shrink, y * shrink];
    [x, y, (1.0 - x * x - y * y).max(0.0).sqrt()]
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::*;

    #[test]
    fn a_point_of_the_map_is_where_its_direction_is_drawn() {
        let area = Rect::from_min_size(pos2(10.0, 20.0), vec2(200.0, 200.0));
        for pos in [pos2(110.0, 120.0), pos2(60.0, 90.0), pos2(150.0, 180.0)] {
            let direction = direction_at(area, pos, 0.97);
            assert!(pos_of(area, direction).distance(pos) < 1e-3, "{direction:?}");
            assert!((DVec3::from(direction).length() - 1.0).abs() < 1e-12);
        }
        // The upper left corner: x to the left, y up, on the rim.
        let [x, y, _] = direction_at(area, area.min, 0.97);
        assert!(x < 0.0 && y > 0.0 && (x.hypot(y) - 0.97).abs() < 1e-12);
    }
}
