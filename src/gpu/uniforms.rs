//! Uniforms and storage of the shaders, laid out as in WGSL; a test compares every offset with naga's reflection.
//!
//! Members have their names in WGSL; members called `pad` are not in WGSL.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use svbrdf_core::model::brdf::Model;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::camera::Camera;

use super::params::{DisplayMode, DisplayParams, ShadeParams};

/// `Model` of brdf.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ModelUniforms {
    pub intensity: f32,
    pub roughness_floor: f32,
    pub light_z_floor: f32,
    pub clamp_n_dot_h: u32,
    pub d_floor: f32,
    pub g_floor: f32,
    pub pad: [u32; 2],
}

impl From<&Model<f32>> for ModelUniforms {
    fn from(m: &Model<f32>) -> Self {
        Self {
            intensity: m.intensity,
            roughness_floor: m.roughness_floor,
            light_z_floor: m.light_z_floor,
            clamp_n_dot_h: m.clamp_n_dot_h.into(),
            d_floor: m.d_floor,
            g_floor: m.g_floor,
            pad: [0; 2],
        }
    }
}

/// `Rays` of scene.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SceneUniforms {
    pub view: [f32; 3],
    pub near: u32,
    pub light: [f32; 3],
    pub pad: u32,
}

impl From<&Scene> for SceneUniforms {
    fn from(scene: &Scene) -> Self {
        // What a texel at the origin sees is what the core computes with, in its precision.
        let (light, view) = scene.rays::<f32>().from_texel(Vec3::ZERO);
        Self {
            view: view.to_array(),
            near: (scene.kind == Kind::Near).into(),
            light: light.to_array(),
            pad: 0,
        }
    }
}

/// `Shading` of shade.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ShadingUniforms {
    pub rays: SceneUniforms,
    pub model: ModelUniforms,
    pub largest: f32,
    pub stride: u32,
    pub size: [u32; 2],
}

impl ShadingUniforms {
    /// For a target whose largest number is `largest`, and every `stride`-th texel along both axes of a material of `size`.
    pub(super) fn new(params: &ShadeParams, largest: f32, stride: usize, size: [usize; 2]) -> Self {
        let (rays, model) = (SceneUniforms::from(&params.scene), Model::from(&params.convention.drawn()));
        let (stride, size) = (stride as u32, size.map(|side| side as u32));
        Self { rays, model: ModelUniforms::from(&model), largest, stride, size }
    }
}

/// A vec3f with the padding behind it.
pub type Padded = [f32; 4];

/// `Camera` of camera.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct CameraUniforms {
    pub origin: Padded,
    pub origin_right: Padded,
    pub origin_up: Padded,
    pub direction: Padded,
    pub direction_right: Padded,
    pub direction_up: Padded,
}

impl From<&Camera> for CameraUniforms {
    fn from(c: &Camera) -> Self {
        let padded = |v: Vec3| v.extend(0.0).to_array();
        Self {
            origin: padded(c.origin),
            origin_right: padded(c.origin_right),
            origin_up: padded(c.origin_up),
            direction: padded(c.direction),
            direction_right: padded(c.direction_right),
            direction_up: padded(c.direction_up),
        }
    }
}

/// `Display` of display.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct DisplayUniforms {
    pub camera: CameraUniforms,
    pub background: [f32; 3],
    pub exposure: f32,
    pub epsilon: f32,
    pub wipe: f32,
    pub range: f32,
    pub stride: u32,
    pub size: [u32; 2],
    pub corner: [u32; 2],
}

impl DisplayUniforms {
    /// For pictures of every `stride`-th texel of materials of `size` = (width, height), in a pane with this upper left pixel.
    pub(super) fn new(p: &DisplayParams, size: [usize; 2], stride: usize, corner: [u32; 2]) -> Self {
        let wipe = match p.mode {
            DisplayMode::Value => 0.0,
            DisplayMode::Wipe(x) => x,
        };
        Self {
            camera: CameraUniforms::from(&p.camera),
            background: p.background,
            exposure: p.exposure_ev.exp2(),
            epsilon: p.epsilon,
            wipe,
            range: p.difference.map_or(1.0, |difference| difference.range),
            stride: stride as u32,
            size: size.map(|side| side as u32),
            corner,
        }
    }
}
