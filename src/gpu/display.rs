//! Pass 2: what the camera sees of shaded texels, encoded for the screen, one fragment per pixel.

use glam::{Vec2, Vec3};
use wgpu::{BindGroup, BindingResource, BufferBindingType, RenderPass, RenderPipeline, TextureFormat};

use svbrdf_core::error::Error;
use svbrdf_core::material::Grid;
use svbrdf_core::picture::camera::Camera;
use svbrdf_core::picture::difference::Difference;
use svbrdf_shaders as shaders;

use super::fault::scoped;
use super::params::{DisplayMode, DisplayParams, DisplayedDifference, Encoding};
use super::pipeline::{Constants, Fullscreen, bind, buffer_type, texture_type, uniform_buffer};
use super::uniforms::DisplayUniforms;
use super::{Gpu, Shaded};

/// The pipelines of pass 2.
#[derive(Debug)]
pub struct DisplayPass {
    pipelines: Fullscreen,
}

/// Where a pane is drawn, in pixels of the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PanePlace {
    /// The upper left pixel.
    pub corner: [u32; 2],
    /// (width, height).
    pub size: [u32; 2],
}

/// Two pictures and how they are displayed.
#[derive(Debug)]
pub struct Pane {
    pipeline: RenderPipeline,
    group: BindGroup,
}

impl DisplayPass {
    /// Compiles the shader for a target that does not encode by itself, as egui's.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the target encodes sRGB itself, or the driver refuses.
    pub fn new(gpu: &Gpu, target_format: TextureFormat) -> Result<Self, Error> {
        if target_format.is_srgb() {
            return Err(Error::Gpu {
                problem: format!(
                    "the window's format is {target_format:?}, which encodes sRGB a second time"
                ),
                remedy: "choose another backend with WGPU_BACKEND",
            });
        }
        scoped(&gpu.device, "compiling the display pass", || {
            let types = [buffer_type(BufferBindingType::Uniform), texture_type(), texture_type()];
            let device = &gpu.device;
            Self {
                pipelines: Fullscreen::new(
                    device,
                    &shaders::DISPLAY,
                    &types,
                    target_format,
                    Constants::new(),
                ),
            }
        })
    }

    /// A pane of two pictures of one size and stride; the same one twice where there is no reference. It is drawn into the
    /// rectangle `place` of the target. A failure waits in [`Gpu::take_fault`].
    pub fn pane(
        &self,
        gpu: &Gpu,
        shaded: &Shaded,
        reference: &Shaded,
        params: &DisplayParams,
        place: PanePlace,
    ) -> Pane {
        let uniforms = DisplayUniforms::new(params, shaded.size(), shaded.stride(), place.corner);
        let uniforms = uniform_buffer(&gpu.device, bytemuck::bytes_of(&uniforms));
        let resources = [
            uniforms.as_entire_binding(),
            BindingResource::TextureView(&shaded.view),
            BindingResource::TextureView(&reference.view),
        ];
        let group = bind(&gpu.device, &self.pipelines.layout, &resources);
        // Where every pixel covers one texel at most along either axis, it shows the nearest one.
        let is_magnified =
            || footprint(params, shaded, place.size).is_some_and(|texels| texels.cmple(Vec2::ONE).all());
        let nearest = params.nearest || is_magnified();
        Pane { pipeline: self.pipelines.with(&gpu.device, constants(params, nearest)), group }
    }
}

impl Pane {
    /// Draws it over the viewport of `pass`, which is its rectangle.
    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// How many of the shaded texels a pixel of a pane of `size` covers. Known of parallel rays only, whose pixels cover as much
/// everywhere.
pub fn texels_a_pixel(params: &DisplayParams, shaded: &Shaded, size: [u32; 2]) -> Option<f32> {
    footprint(params, shaded, size).map(Vec2::element_product)
}

/// How many texels a pixel covers along both axes, as [`texels_a_pixel`].
fn footprint(params: &DisplayParams, shaded: &Shaded, [across, down]: [u32; 2]) -> Option<Vec2> {
    let Camera { origin_right, origin_up, direction, direction_right, direction_up, .. } = params.camera;
    if direction_right != Vec3::ZERO || direction_up != Vec3::ZERO {
        return None;
    }
    let on_plane = |step: Vec3| (step - direction * (step.z / direction.z)).truncate().abs();
    let extent = on_plane(origin_right * (2.0 / across as f32)) + on_plane(origin_up * (2.0 / down as f32));
    let [width, height] = shaded.size();
    let [half_width, half_height] = Grid { width, height }.half_extent();
    let texel = 2.0 * Vec2::new(half_width / width as f32, half_height / height as f32);
    Some(extent / shaded.stride() as f32 / texel)
}

/// The constants of the pipeline that shows pictures in this way.
fn constants(params: &DisplayParams, nearest: bool) -> Constants {
    let mode = match params.mode {
        DisplayMode::Value => 0,
        DisplayMode::Wipe(_) => 1,
    };
    let difference = match params.difference {
        None => 0,
        Some(DisplayedDifference { is_computed: true, .. }) => 7,
        Some(DisplayedDifference { kind, .. }) => match kind {
            Difference::Log => 1,
            Difference::SignedLog => 2,
            Difference::Absolute => 3,
            Difference::Signed => 4,
            Difference::Relative => 5,
            Difference::Angle => 6,
            // Not of single texels: always computed.
            Difference::Flip => 7,
        },
    };
    let encoding = match params.encoding {
        Encoding::Radiance => 0,
        Encoding::Albedo => 1,
        Encoding::Data => 2,
    };
    vec![
        ("MODE", mode),
        ("DIFFERENCE", difference),
        ("ENCODING", encoding),
        ("SHOW_CLIPPING", params.show_clipping.into()),
        ("FALSE_COLOUR", params.false_colour.into()),
        ("NEAREST", nearest.into()),
    ]
}
