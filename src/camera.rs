//! From a point of a pane to the point of the material that is seen there, and back.
//!
//! Flat, orthographic and perspective views are one thing: a ray whose origin and direction are linear in the pane's
//! coordinates. `shaders/camera.wgsl` is the twin of [`Camera::plane_from_ndc`].

use crate::vec3::Vec3;

/// Rays through a pane: the one at (x, y), x right and y up in [-1, 1], starts at
/// `origin + x origin_right + y origin_up` and runs along `direction + x direction_right + y direction_up`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    pub origin: Vec3<f32>,
    pub origin_right: Vec3<f32>,
    pub origin_up: Vec3<f32>,
    pub direction: Vec3<f32>,
    pub direction_right: Vec3<f32>,
    pub direction_up: Vec3<f32>,
}

impl Camera {
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
}
