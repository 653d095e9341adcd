//! Endpoints of a scene, its light and its view: their positions, and how they move in the window.

use glam::DVec3;

pub use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::model::scene::{Kind, Scene};

/// Least height of a light or a view in the window: from within the plane nothing is seen.
pub const LOWEST: f64 = 0.01;
/// Largest coordinate of a light or a view in the window.
pub const FARTHEST: f64 = 1000.0;
/// Least height of an endpoint that is orbited, as a share of its distance: the cosine of 85 degrees.
const ORBIT_LOWEST: f64 = 0.087_155_742_747_658_18;
/// Least height of a position that a direction becomes, as a share of its distance: about 6 degrees above the plane.
const LOWEST_SHARE: f64 = 0.1;

/// The position (or direction) of one endpoint of the scene.
pub fn endpoint(scene: &Scene, which: Endpoint) -> [f64; 3] {
    match which {
        Endpoint::Light => scene.light,
        Endpoint::View => scene.view,
    }
}

/// Puts one endpoint of the scene at `p`, clamped to above the plane and within reach.
pub fn set_endpoint(scene: &mut Scene, which: Endpoint, p: [f64; 3]) {
    if p.iter().any(|c| !c.is_finite()) {
        return;
    }
    let [x, y, z] = p;
    let p = [x.clamp(-FARTHEST, FARTHEST), y.clamp(-FARTHEST, FARTHEST), z.clamp(LOWEST, FARTHEST)];
    match which {
        Endpoint::Light => scene.light = p,
        Endpoint::View => scene.view = p,
    }
}

/// The projection of an endpoint onto the plane, where its handle is: of a direction, its (x, y) on the unit hemisphere.
pub fn over_plane(scene: &Scene, which: Endpoint) -> [f64; 2] {
    let p = DVec3::from(endpoint(scene, which));
    let p = if scene.kind == Kind::Distant { p.normalize() } else { p };
    [p.x, p.y]
}

/// Makes the scene near-field or distant, such that it looks the same from the middle of the material: light and view keep
/// their directions and distances. A direction within the plane becomes a position well above it.
pub fn set_kind(scene: &mut Scene, kind: Kind) {
    if scene.kind == kind {
        return;
    }
    scene.kind = kind;
    if kind == Kind::Near {
        for which in [Endpoint::Light, Endpoint::View] {
            let p = DVec3::from(endpoint(scene, which));
            let length = p.length();
            let z = p.z.max(LOWEST_SHARE * length);
            let shrink = ((length * length - z * z).max(0.0).sqrt() / p.x.hypot(p.y)).min(1.0);
            set_endpoint(scene, which, [p.x * shrink, p.y * shrink, z]);
        }
    }
}

/// Moves an endpoint so that its projection onto the plane is (x, y): a position keeps its height, a direction stays
/// on the hemisphere. The length of a direction stays: it is the distance of the position that it becomes.
pub fn move_over_plane(scene: &mut Scene, which: Endpoint, [x, y]: [f64; 2]) {
    let p = match scene.kind {
        Kind::Near => [x, y, endpoint(scene, which)[2]],
        Kind::Distant => {
            let rim = (1.0 - LOWEST * LOWEST).sqrt();
            let shrink = (rim / x.hypot(y)).min(1.0);
            let [x, y] = [x * shrink, y * shrink];
            let distance = DVec3::from(endpoint(scene, which)).length();
            [x, y, (1.0 - x * x - y * y).max(0.0).sqrt()].map(|c| c * distance)
        }
    };
    set_endpoint(scene, which, p);
}

/// Multiplies the height of an endpoint by `factor`.
pub fn scale_height(scene: &mut Scene, which: Endpoint, factor: f64) {
    let [x, y, z] = endpoint(scene, which);
    set_endpoint(scene, which, [x, y, z * factor]);
}

/// Multiplies the distance of an endpoint from the middle of the material by `factor`.
pub fn scale_distance(scene: &mut Scene, which: Endpoint, factor: f64) {
    let p = endpoint(scene, which);
    set_endpoint(scene, which, p.map(|c| c * factor));
}

/// Raises an endpoint whose height is less than `share` of its distance to that height. Distance and azimuth stay.
pub fn raise(scene: &mut Scene, which: Endpoint, share: f64) {
    let [x, y, z] = endpoint(scene, which);
    let length = DVec3::new(x, y, z).length();
    if z < share * length {
        let shrink = (1.0 - share * share).sqrt() * length / x.hypot(y);
        set_endpoint(scene, which, [x * shrink, y * shrink, share * length]);
    }
}

/// Turns an endpoint about the middle of the material: by `sideways` about the upright axis y of the screen, and by
/// `upwards` towards it, both in radians. The distance stays. It stops 85 degrees off the normal; an endpoint that was put
/// lower by a number may stay there.
pub fn orbit(scene: &mut Scene, which: Endpoint, sideways: f64, upwards: f64) {
    const STEEPEST: f64 = std::f64::consts::FRAC_PI_2 - 1e-3;
    let p = DVec3::from(endpoint(scene, which));
    let length = p.length();
    let longitude = (p.x.atan2(p.z) + sideways).clamp(-STEEPEST, STEEPEST);
    let latitude = ((p.y / length).asin() + upwards).clamp(-STEEPEST, STEEPEST);
    let (x, y) = (latitude.cos() * longitude.sin(), latitude.sin());
    let lowest = ORBIT_LOWEST.min(p.z / length).max(LOWEST / length);
    let z = (latitude.cos() * longitude.cos()).max(lowest).min(1.0);
    let shrink = ((1.0 - z * z) / (x * x + y * y).max(f64::MIN_POSITIVE)).sqrt();
    set_endpoint(scene, which, [x * shrink, y * shrink, z].map(|c| c * length));
}

/// Puts the light where a flat surface mirrors it into the view at the point (x, y) of the plane; the light keeps its
/// height. A distant light mirrored into a distant view is so at every point.
pub fn put_highlight(scene: &mut Scene, [x, y]: [f64; 2]) {
    let [view_x, view_y, view_z] = scene.view;
    let light = match scene.kind {
        Kind::Distant => [-view_x, -view_y, view_z],
        Kind::Near => {
            let reach = scene.light[2] / view_z;
            [x + (x - view_x) * reach, y + (y - view_y) * reach, scene.light[2]]
        }
    };
    set_endpoint(scene, Endpoint::Light, light);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::ViewState;

    #[test]
    fn the_highlight_is_where_the_half_vector_is_the_normal() {
        let mut scene = ViewState::default().scene;
        scene.view = [0.3, -0.4, 1.7];
        let c = [0.25, 0.5];
        put_highlight(&mut scene, c);
        let at = DVec3::new(c[0], c[1], 0.0);
        let l = (DVec3::from(scene.light) - at).normalize();
        let v = (DVec3::from(scene.view) - at).normalize();
        let h = (l + v).normalize();
        assert!((h.z - 1.0).abs() < 1e-12, "{h:?}");
    }

    #[test]
    fn orbiting_keeps_the_distance_and_stays_above_the_plane() {
        let mut scene = ViewState::default().scene;
        let before = DVec3::from(scene.light).length();
        for _ in 0..100 {
            orbit(&mut scene, Endpoint::Light, 0.3, -0.2);
            assert!(scene.light[2] >= LOWEST && scene.light[0] > 0.0);
            assert!((DVec3::from(scene.light).length() - before).abs() < 1e-9);
        }
    }

    #[test]
    fn a_direction_that_is_moved_over_the_plane_stays_on_the_hemisphere() {
        let mut scene = Scene { kind: Kind::Distant, ..ViewState::default().scene };
        let distance = DVec3::from(scene.light).length();
        move_over_plane(&mut scene, Endpoint::Light, [3.0, 4.0]);
        assert!((DVec3::from(scene.light).length() - distance).abs() < 1e-4);
        move_over_plane(&mut scene, Endpoint::Light, [0.3, -0.2]);
        let [x, y] = over_plane(&scene, Endpoint::Light);
        assert!((x - 0.3).abs() < 1e-12 && (y + 0.2).abs() < 1e-12);
    }

    #[test]
    fn near_field_and_distant_keep_directions_and_distances_and_no_position_is_in_the_plane() {
        let start = ViewState::default().scene;
        let mut scene = start;
        set_kind(&mut scene, Kind::Distant);
        set_kind(&mut scene, Kind::Near);
        let off = |a: [f64; 3], b: [f64; 3]| (DVec3::from(a) - DVec3::from(b)).length();
        assert!(off(scene.light, start.light) < 1e-12 && off(scene.view, start.view) < 1e-12, "{scene:?}");
        // A direction dragged past the rim of the hemisphere.
        set_kind(&mut scene, Kind::Distant);
        move_over_plane(&mut scene, Endpoint::Light, [5.0, 0.0]);
        set_kind(&mut scene, Kind::Near);
        let (light, distance) = (DVec3::from(scene.light), DVec3::from(start.light).length());
        assert!((light.length() - distance).abs() < 1e-4, "{light:?} has another distance than {distance}");
        assert!(light.z > 0.09 * distance && light.x > 0.99 * distance, "{light:?}");
    }

    #[test]
    fn a_value_that_is_not_finite_moves_nothing() {
        let mut scene = ViewState::default().scene;
        set_endpoint(&mut scene, Endpoint::View, [f64::NAN, 0.0, 1.0]);
        assert_eq!(scene, ViewState::default().scene);
    }
}
