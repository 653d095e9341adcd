//! From a point of a pane to the point of the material that is seen there, and back.
//!
//! Flat, orthographic and perspective views are one thing: a ray whose origin and direction are linear in the pane's
//! coordinates. `shaders/camera.wgsl` is the twin of [`Camera::plane_from_ndc`].

use glam::{DVec3, Mat3, Vec3};

use crate::material::Grid;
use crate::model::scene::{Kind, Scene};

/// Room left around the material when it is fitted into a pane.
const MARGIN: f32 = 1.03;
/// Widest view: tangent of half the vertical field of view.
const WIDEST: f32 = 4.0;
/// Where an orthographic view starts, in units of half the width of the material.
const FAR_AWAY: f32 = 100.0;

/// Rays through a pane: the one at (x, y), x right and y up in [-1, 1], starts at
/// `origin + x origin_right + y origin_up` and runs along `direction + x direction_right + y direction_up`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    pub origin: Vec3,
    pub origin_right: Vec3,
    pub origin_up: Vec3,
    pub direction: Vec3,
    pub direction_right: Vec3,
    pub direction_up: Vec3,
}

impl Camera {
    /// The material as a flat picture, fitted into a pane of `aspect` = width / height.
    pub fn flat(grid: Grid, aspect: f32) -> Self {
        let [half_width, half_height] = grid.half_extent();
        let reach = half_height.max(half_width / aspect) * MARGIN;
        Self {
            origin: Vec3::Z,
            origin_right: Vec3::X * (reach * aspect),
            origin_up: Vec3::Y * reach,
            direction: Vec3::NEG_Z,
            direction_right: Vec3::ZERO,
            direction_up: Vec3::ZERO,
        }
    }

    /// The material as the view of `scene` sees it: in perspective from a position, in parallel from a direction;
    /// always towards the middle of the material, fitted into a pane of `aspect` = width / height.
    pub fn of_scene(scene: &Scene, grid: Grid, aspect: f32) -> Self {
        let view = DVec3::from(scene.view).as_vec3();
        let forward = -view.normalize();
        let right = forward.cross(Vec3::Y).normalize();
        let up = right.cross(forward);
        match scene.kind {
            Kind::Near => Self::perspective(view, [right, up, forward], grid, aspect),
            Kind::Distant => Self::parallel([right, up, forward], grid, aspect),
        }
    }

    fn perspective(eye: Vec3, [right, up, forward]: [Vec3; 3], grid: Grid, aspect: f32) -> Self {
        let nearest = 0.05 * eye.length();
        let reach = corners(grid)
            .map(|corner| {
                let q = corner - eye;
                let depth = q.dot(forward).max(nearest);
                (q.dot(up) / depth).abs().max((q.dot(right) / depth).abs() / aspect)
            })
            .into_iter()
            .fold(0.0, f32::max);
        let reach = (reach * MARGIN).min(WIDEST);
        Self {
            origin: eye,
            origin_right: Vec3::ZERO,
            origin_up: Vec3::ZERO,
            direction: forward,
            direction_right: right * (reach * aspect),
            direction_up: up * reach,
        }
    }

    fn parallel([right, up, forward]: [Vec3; 3], grid: Grid, aspect: f32) -> Self {
        let reach = corners(grid)
            .map(|corner| corner.dot(up).abs().max(corner.dot(right).abs() / aspect))
            .into_iter()
            .fold(0.0, f32::max)
            * MARGIN;
        Self {
            origin: forward * -FAR_AWAY,
            origin_right: right * (reach * aspect),
            origin_up: up * reach,
            direction: forward,
            direction_right: Vec3::ZERO,
            direction_up: Vec3::ZERO,
        }
    }

    /// The same view magnified by `zoom` and moved by `pan`, in units of the pane (x right, y up in [-1, 1]).
    #[must_use]
    pub fn zoomed(self, zoom: f32, pan: [f32; 2]) -> Self {
        let [x, y] = [-pan[0] / zoom, -pan[1] / zoom];
        Self {
            origin: self.origin + self.origin_right * x + self.origin_up * y,
            origin_right: self.origin_right * zoom.recip(),
            origin_up: self.origin_up * zoom.recip(),
            direction: self.direction + self.direction_right * x + self.direction_up * y,
            direction_right: self.direction_right * zoom.recip(),
            direction_up: self.direction_up * zoom.recip(),
        }
    }

    /// Of a camera that looks at the middle of the material: half the height of the pane in units of the plane, measured at
    /// the middle of the material and at right angles to the view.
    pub fn half_height(&self) -> f32 {
        let distance = -self.origin.dot(self.direction) / self.direction.length_squared();
        (self.origin_up + self.direction_up * distance).length()
    }

    /// The point (x, y) of the plane z = 0 that is seen at (x, y) of the pane; `None` where the ray misses the plane.
    pub fn plane_from_ndc(&self, x: f32, y: f32) -> Option<[f32; 2]> {
        let origin = self.origin + self.origin_right * x + self.origin_up * y;
        let direction = self.direction + self.direction_right * x + self.direction_up * y;
        if direction.z >= 0.0 {
            return None;
        }
        let t = -origin.z / direction.z;
        Some([origin.x + direction.x * t, origin.y + direction.y * t])
    }

    /// Where in the pane the point `p` is seen, x right and y up; `None` where it is behind the view.
    pub fn ndc_from_point(&self, p: Vec3) -> Option<[f32; 2]> {
        let q = p - self.origin;
        if self.origin_right == Vec3::ZERO {
            let [s, x, y] = solve([self.direction, self.direction_right, self.direction_up], q)?;
            (s > 0.0).then(|| [x / s, y / s])
        } else {
            let [x, y, _] = solve([self.origin_right, self.origin_up, self.direction], q)?;
            Some([x, y])
        }
    }
}

/// The corners of the material, outer edges of its texels included.
fn corners(grid: Grid) -> [Vec3; 4] {
    let [x, y] = grid.half_extent();
    [[-x, -y], [x, -y], [-x, y], [x, y]].map(|[x, y]| Vec3::new(x, y, 0.0))
}

/// The coefficients of `q` in the basis of three vectors; `None` where they lie in a plane.
fn solve([a, b, c]: [Vec3; 3], q: Vec3) -> Option<[f32; 3]> {
    let coefficients = Mat3::from_cols(a, b, c).try_inverse()? * q;
    coefficients.is_finite().then(|| coefficients.to_array())
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: Grid = Grid { width: 64, height: 32 };

    fn scene(kind: Kind, view: [f64; 3]) -> Scene {
        Scene { kind, view, light: [0.0, 0.0, 1.0] }
    }

    fn cameras() -> Vec<Camera> {
        let scenes = [
            scene(Kind::Near, [0.3, -0.2, 1.5]),
            scene(Kind::Near, [0.0, 0.0, 2.5]),
            scene(Kind::Distant, [0.5, 0.4, 0.7]),
        ];
        let of_scenes = scenes.map(|s| Camera::of_scene(&s, GRID, 1.4));
        [Camera::flat(GRID, 0.7)].into_iter().chain(of_scenes).collect()
    }

    #[test]
    fn a_point_of_the_plane_is_seen_where_its_ray_starts() {
        for camera in cameras() {
            let camera = camera.zoomed(2.5, [0.3, -0.4]);
            for ndc in [[0.0, 0.0], [0.5, -0.25], [-0.9, 0.8]] {
                let Some([x, y]) = camera.plane_from_ndc(ndc[0], ndc[1]) else { continue };
                let back = camera.ndc_from_point(Vec3::new(x, y, 0.0)).unwrap();
                let off = (back[0] - ndc[0]).abs().max((back[1] - ndc[1]).abs());
                assert!(off < 1e-4, "{camera:?}: {ndc:?} became {back:?}");
            }
        }
    }

    #[test]
    fn a_fitted_material_lies_inside_the_pane_and_touches_its_margin() {
        for camera in cameras() {
            let projected = corners(GRID).map(|c| camera.ndc_from_point(c).unwrap());
            let farthest = projected.iter().flatten().fold(0.0f32, |m, x| m.max(x.abs()));
            assert!((farthest - MARGIN.recip()).abs() < 1e-4, "{camera:?}: {projected:?}");
        }
    }

    #[test]
    fn up_is_up_and_right_is_right_in_every_view() {
        for camera in cameras() {
            let at = |x, y| camera.ndc_from_point(Vec3::new(x, y, 0.0)).unwrap();
            assert!(at(0.5, 0.0)[0] > at(-0.5, 0.0)[0]);
            assert!(at(0.0, 0.3)[1] > at(0.0, -0.3)[1]);
        }
    }

    #[test]
    fn zooming_keeps_the_point_that_the_pan_names() {
        let camera = Camera::flat(GRID, 1.0);
        let (zoom, pan) = (3.0, [0.2, -0.1]);
        let before = camera.plane_from_ndc(0.0, 0.0).unwrap();
        let projected =
            camera.zoomed(zoom, pan).ndc_from_point(Vec3::new(before[0], before[1], 0.0)).unwrap();
        assert!(
            (projected[0] - pan[0]).abs() < 1e-5 && (projected[1] - pan[1]).abs() < 1e-5,
            "{projected:?}"
        );
    }
}
