//! Pass 1: Algorithm 3, or one of the maps, one fragment per texel.

use std::sync::OnceLock;

use wgpu::{
    BufferBindingType, Extent3d, LoadOp, Texture, TextureDescriptor, TextureFormat, TextureUsages,
    TextureView,
};

use svbrdf_core::error::Error;
use svbrdf_core::image::Image;
use svbrdf_core::material::Grid;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_shaders as shaders;

use super::fault::scoped;
use super::params::ShadeParams;
use super::pipeline::{CLEAR, Constants, Fullscreen, begin, bind, buffer_type, texture_type, uniform_buffer};
use super::textures::{descriptor, extent, write};
use super::uniforms::{GrammarShading, ShadingUniforms};
use super::{Gpu, MaterialTextures};

/// The largest 16-bit float.
const LARGEST_F16: f32 = 65504.0;

/// The pipelines of pass 1.
#[derive(Debug)]
pub struct Shading {
    pipelines: Fullscreen,
    /// Of the renderers of the grammar of conventions, compiled when one is drawn.
    grammar: OnceLock<Fullscreen>,
    reduction: Fullscreen,
}

/// What pass 1 writes: linear floats, a texel each, row 0 on top.
#[derive(Debug)]
pub struct Shaded {
    pub(super) texture: Texture,
    pub(super) view: TextureView,
    size: [usize; 2],
    stride: usize,
    repeated: bool,
}

impl Shaded {
    /// Numbers that were computed elsewhere, for pass 2.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the picture is too large for the adapter or for its memory.
    pub fn of_image(gpu: &Gpu, image: &Image<f32>) -> Result<Self, Error> {
        let size = [image.width, image.height];
        let extent = extent(gpu, size)?;
        scoped(&gpu.device, "uploading a picture", || {
            let texture = gpu.device.create_texture(&descriptor("picture", extent));
            write(gpu, &texture, size, |index| {
                let [r, g, b] = image.pixels[index];
                [r, g, b, 0.0]
            });
            let view = texture.create_view(&Default::default());
            Self { texture, view, size, stride: 1, repeated: false }
        })
    }

    /// (width, height) of the material in texels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// How many texels along an axis one stands for; 1 where all are shaded.
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// Whether it holds the cells of the repeated plane.
    pub fn is_repeated(&self) -> bool {
        self.repeated
    }
}

impl Shading {
    /// Compiles the shader.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the driver refuses.
    pub fn new(gpu: &Gpu) -> Result<Self, Error> {
        scoped(&gpu.device, "compiling the shading pass", || {
            let uniform = buffer_type(BufferBindingType::Uniform);
            let pipelines = pipelines(gpu, &shaders::SHADE);
            let (types, none) = ([uniform, texture_type()], Constants::new());
            let reduction =
                Fullscreen::new(&gpu.device, &shaders::REDUCE, &types, gpu.report.shading_format, none);
            Self { pipelines, grammar: OnceLock::new(), reduction }
        })
    }

    /// A target for materials of `size` = (width, height).
    ///
    /// # Errors
    /// [`Error::Gpu`] where it is too large for the adapter or for its memory.
    pub fn target(&self, gpu: &Gpu, size: [usize; 2]) -> Result<Shaded, Error> {
        self.reduced_target(gpu, size, 1)
    }

    /// A target for every `stride`-th texel along both axes of materials of `size` = (width, height): quick to shade, for
    /// screens that show several texels in a pixel.
    ///
    /// # Errors
    /// As [`Shading::target`].
    pub fn reduced_target(&self, gpu: &Gpu, size: [usize; 2], stride: usize) -> Result<Shaded, Error> {
        shaded(gpu, size, size, stride)
    }

    /// As [`Shading::reduced_target`], for every `stride`-th cell of the plane on which the material is repeated.
    ///
    /// # Errors
    /// As [`Shading::target`].
    pub fn repeated_target(&self, gpu: &Gpu, size: [usize; 2], stride: usize) -> Result<Shaded, Error> {
        let [width, height] = size;
        let target = shaded(gpu, size, Grid { width, height }.repeated_cells(), stride)?;
        Ok(Shaded { repeated: true, ..target })
    }

    /// The texels of `textures`, which hold a material of `size` = (width, height), that a target of this `stride` shades. To
    /// shade them again and again, this is quicker to read.
    ///
    /// # Errors
    /// As [`Shading::target`].
    pub fn reduced_textures(
        &self,
        gpu: &Gpu,
        textures: &MaterialTextures,
        size: [usize; 2],
        stride: usize,
    ) -> Result<MaterialTextures, Error> {
        let extent = extent(gpu, size.map(|side| side.div_ceil(stride)))?;
        scoped(&gpu.device, "reducing a material", || {
            let uniform = uniform_buffer(&gpu.device, bytemuck::bytes_of(&(stride as u32)));
            let pipeline = self.reduction.with(&gpu.device, Constants::new());
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let views = textures.views.each_ref().map(|whole| {
                let view = floats(gpu, "reduced", extent).create_view(&Default::default());
                let resources = [uniform.as_entire_binding(), wgpu::BindingResource::TextureView(whole)];
                let group = bind(&gpu.device, &self.reduction.layout, &resources);
                let mut pass = begin(&mut encoder, "reducing", &view, CLEAR);
                pass.set_pipeline(&pipeline);
                pass.set_bind_group(0, &group, &[]);
                pass.draw(0..3, 0..1);
                drop(pass);
                view
            });
            gpu.queue.submit([encoder.finish()]);
            MaterialTextures { views }
        })
    }

    /// Shades every texel of `target`, which is a repeated one where the parameters are, and submits that. `textures` hold the material, or its [`Shading::reduced_textures`] of the
    /// target's stride.
    ///
    /// A failure waits in [`Gpu::take_fault`].
    pub fn draw(&self, gpu: &Gpu, textures: &MaterialTextures, params: &ShadeParams, target: &Shaded) {
        self.draw_part(gpu, textures, params, target, None);
    }

    /// As [`Shading::draw`], but only the texels of `part` = (left, top, width, height), which lies within the target; the
    /// others stay as they are.
    pub fn draw_part(
        &self,
        gpu: &Gpu,
        textures: &MaterialTextures,
        params: &ShadeParams,
        target: &Shaded,
        part: Option<[u32; 4]>,
    ) {
        let largest = match gpu.report.shading_format {
            TextureFormat::Rgba16Float => LARGEST_F16,
            _ => f32::MAX,
        };
        let (stride, size) = (target.stride, target.size);
        let (pipelines, buffer) = match params.convention.member {
            Some(member) if params.quantity == Quantity::Rendering => {
                let uniforms = GrammarShading::new(&member.terms, &params.scene, largest, stride, size);
                let pipelines = self.grammar.get_or_init(|| pipelines(gpu, &shaders::GRAMMAR));
                (pipelines, uniform_buffer(&gpu.device, bytemuck::bytes_of(&uniforms)))
            }
            _ => {
                let uniforms = ShadingUniforms::new(params, largest, stride, size);
                (&self.pipelines, uniform_buffer(&gpu.device, bytemuck::bytes_of(&uniforms)))
            }
        };
        let [normal_roughness, diffuse, specular] = &textures.views;
        let maps = [normal_roughness, diffuse, specular].map(wgpu::BindingResource::TextureView);
        let [a, b, c] = maps;
        let group = bind(&gpu.device, &pipelines.layout, &[buffer.as_entire_binding(), a, b, c]);

        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = begin(&mut encoder, "shading", &target.view, part.map_or(CLEAR, |_| LoadOp::Load));
        if let Some([left, top, width, height]) = part {
            pass.set_scissor_rect(left, top, width, height);
        }
        pass.set_pipeline(&pipelines.with(&gpu.device, constants(params.quantity, params.repeated)));
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
    }
}

/// The pipelines of a shader of pass 1.
fn pipelines(gpu: &Gpu, shader: &'static shaders::Shader) -> Fullscreen {
    let maps = [buffer_type(BufferBindingType::Uniform), texture_type(), texture_type(), texture_type()];
    let first = constants(Quantity::Rendering, false);
    Fullscreen::new(&gpu.device, shader, &maps, gpu.report.shading_format, first)
}

/// A target for every `stride`-th of `count` = [columns, rows] texels or cells of a material of `size`.
fn shaded(gpu: &Gpu, size: [usize; 2], count: [usize; 2], stride: usize) -> Result<Shaded, Error> {
    let extent = extent(gpu, count.map(|side| side.div_ceil(stride)))?;
    scoped(&gpu.device, "creating a picture to shade into", || {
        let texture = floats(gpu, "shaded", extent);
        let view = texture.create_view(&Default::default());
        Shaded { texture, view, size, stride, repeated: false }
    })
}

/// A texture of floats to draw into.
fn floats(gpu: &Gpu, label: &str, size: Extent3d) -> Texture {
    gpu.device.create_texture(&TextureDescriptor {
        label: Some(label),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: gpu.report.shading_format,
        usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// The constants of the pipeline that shades this quantity of texels, or of the cells of the repeated plane.
fn constants(quantity: Quantity, repeated: bool) -> Constants {
    let number = match quantity {
        Quantity::Rendering => 0,
        Quantity::Normal => 1,
        Quantity::Diffuse => 2,
        Quantity::Specular => 3,
        Quantity::Roughness => 4,
    };
    vec![("QUANTITY", number), ("REPEATED", repeated.into())]
}
