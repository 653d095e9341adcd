//! Pass 1: Algorithm 3, or one of the maps, one fragment per texel.

use std::sync::OnceLock;

use wgpu::{
    BindGroup, BindingResource, BindingType, Buffer, BufferBindingType, Extent3d, LoadOp, Texture,
    TextureDescriptor, TextureFormat, TextureUsages, TextureView,
};

use svbrdf_core::error::Error;
use svbrdf_core::image::Image;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_shaders::{self as shaders, MapShaders, Shader};

use super::fault::scoped;
use super::params::ShadeParams;
use super::pipeline::{
    CLEAR, Constants, Fullscreen, begin, bind, buffer_type, codes_type, texture_type, uniform_buffer,
};
use super::textures::{Maps, descriptor, extent, write};
use super::uniforms::ShadingUniforms;
use super::{Gpu, MaterialTextures};

/// The largest 16-bit float.
const LARGEST_F16: f32 = 65504.0;

/// The pipelines of pass 1, for maps that are held in each of the ways.
#[derive(Debug)]
pub struct Shading {
    floats: Passes,
    /// Compiled when such maps are drawn.
    coded: OnceLock<Passes>,
}

/// The pipelines for maps that are held in one way.
#[derive(Debug)]
struct Passes {
    shading: Fullscreen,
    reduction: Fullscreen,
}

impl Passes {
    /// With these shaders, and these bindings of the maps.
    fn new(gpu: &Gpu, shaders: &'static MapShaders, maps: &[BindingType]) -> Self {
        let shading = pipelines(gpu, &shaders.shade, maps, constants(Quantity::Rendering));
        let reduction = pipelines(gpu, &shaders.reduce, maps, reduced(0));
        Self { shading, reduction }
    }
}

/// The bindings of maps as floats, and as codes.
const FLOATS: &[BindingType] = &[texture_type(); 3];
const CODED: &[BindingType] = &[codes_type(), buffer_type(BufferBindingType::Uniform)];

/// What pass 1 writes: linear floats, a texel each, row 0 on top.
#[derive(Debug)]
pub struct Shaded {
    pub(super) texture: Texture,
    pub(super) view: TextureView,
    size: [usize; 2],
    stride: usize,
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
            write(gpu, &texture, |first, texels| {
                texels.iter_mut().zip(&image.pixels[first..]).for_each(|(texel, &[r, g, b])| {
                    *texel = [r, g, b, 0.0].map(f32::to_bits);
                });
                true
            })?;
            let view = texture.create_view(&Default::default());
            Ok(Self { texture, view, size, stride: 1 })
        })?
    }

    /// (width, height) of the material in texels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// How many texels along an axis one stands for; 1 where all are shaded.
    pub fn stride(&self) -> usize {
        self.stride
    }
}

impl Shading {
    /// Compiles the shader.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the driver refuses.
    pub fn new(gpu: &Gpu) -> Result<Self, Error> {
        scoped(&gpu.device, "compiling the shading pass", || Self {
            floats: Passes::new(gpu, &shaders::FLOATS, FLOATS),
            coded: OnceLock::new(),
        })
    }

    /// The pipelines for these maps.
    fn passes(&self, gpu: &Gpu, textures: &MaterialTextures) -> &Passes {
        match textures.maps {
            Maps::Floats(_) => &self.floats,
            Maps::Coded(..) => self.coded.get_or_init(|| Passes::new(gpu, &shaders::CODED, CODED)),
        }
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
        let extent = extent(gpu, size.map(|side| side.div_ceil(stride)))?;
        scoped(&gpu.device, "creating a picture to shade into", || {
            let texture = floats(gpu, "shaded", extent);
            let view = texture.create_view(&Default::default());
            Shaded { texture, view, size, stride }
        })
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
            let reduction = &self.passes(gpu, textures).reduction;
            let group = bind_maps(gpu, reduction, &uniform, textures);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let views = std::array::from_fn(|map| {
                let view = floats(gpu, "reduced", extent).create_view(&Default::default());
                let mut pass = begin(&mut encoder, "reducing", &view, CLEAR);
                pass.set_pipeline(&reduction.with(&gpu.device, reduced(map as u32)));
                pass.set_bind_group(0, &group, &[]);
                pass.draw(0..3, 0..1);
                drop(pass);
                view
            });
            gpu.queue.submit([encoder.finish()]);
            MaterialTextures { maps: Maps::Floats(views) }
        })
    }

    /// Shades every texel of `target` and submits that. `textures` hold the material, or its [`Shading::reduced_textures`] of the
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
        let pipelines = &self.passes(gpu, textures).shading;
        let uniforms = ShadingUniforms::new(params, largest, stride, size);
        let buffer = uniform_buffer(&gpu.device, bytemuck::bytes_of(&uniforms));
        let group = bind_maps(gpu, pipelines, &buffer, textures);

        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = begin(&mut encoder, "shading", &target.view, part.map_or(CLEAR, |_| LoadOp::Load));
        if let Some([left, top, width, height]) = part {
            pass.set_scissor_rect(left, top, width, height);
        }
        pass.set_pipeline(&pipelines.with(&gpu.device, constants(params.quantity)));
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
    }
}

/// The pipelines of a shader that reads these maps; those with the `first` constants are compiled at once.
fn pipelines(gpu: &Gpu, shader: &'static Shader, maps: &[BindingType], first: Constants) -> Fullscreen {
    let types = [&[buffer_type(BufferBindingType::Uniform)], maps].concat();
    Fullscreen::new(&gpu.device, shader, &types, gpu.report.shading_format, first)
}

/// The group of uniforms and maps.
fn bind_maps(gpu: &Gpu, pipelines: &Fullscreen, uniforms: &Buffer, textures: &MaterialTextures) -> BindGroup {
    let mut resources = vec![uniforms.as_entire_binding()];
    match &textures.maps {
        Maps::Floats(views) => resources.extend(views.iter().map(BindingResource::TextureView)),
        Maps::Coded(codes, values) => {
            resources.extend([BindingResource::TextureView(codes), values.as_entire_binding()]);
        }
    }
    bind(&gpu.device, &pipelines.layout, &resources)
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

/// The constants of the pipeline that reduces one texture of floats: normal and roughness, diffuse, or specular.
fn reduced(map: u32) -> Constants {
    vec![("MAP", map)]
}

/// The constants of the pipeline that shades this quantity.
fn constants(quantity: Quantity) -> Constants {
    let number = match quantity {
        Quantity::Rendering => 0,
        Quantity::Normal => 1,
        Quantity::Diffuse => 2,
        Quantity::Specular => 3,
        Quantity::Roughness => 4,
    };
    vec![("QUANTITY", number)]
}

#[cfg(test)]
mod tests {
    use svbrdf_core::material::{Material, Planes};

    use super::*;

    /// Unit vectors in all directions, some of them with components that are 0 or alike, and those of 8-bit files.
    fn unit_vectors(count: usize) -> [Vec<f32>; 3] {
        let vector = |index: usize| {
            let at = |step: f64| (index as f64 * step).fract();
            let [u, v, w] = [at(0.754_877_666), at(0.569_840_291), at(0.381_966_011)];
            match index % 4 {
                0 => [u - 0.5, v - 0.5, w - 0.5],
                1 => [u, v, w].map(|one| (one * 5.0).floor() - 2.0 + 1e-9),
                2 => [0.01 * (u - 0.5), -0.0, if v < 0.5 { 1.0 } else { -1.0 }],
                _ => [u, v, 0.5 + 0.5 * w].map(|one| 2.0 * (one * 255.0).round() / 255.0 - 1.0),
            }
        };
        let mut planes = [0; 3].map(|_| Vec::with_capacity(count));
        (0..count).for_each(|index| {
            planes.iter_mut().zip(vector(index)).for_each(|(plane, one)| plane.push(one as f32));
        });
        planes
    }

    /// The normals as the shader reads them: of this material, uploaded.
    fn normals_of(gpu: &Gpu, material: &Material<f32>) -> Vec<[f32; 3]> {
        let size = material.size();
        let uploaded = MaterialTextures::upload(gpu, material).unwrap();
        assert_eq!(uploaded.texel_bytes(), 16);
        let textures = Shading::new(gpu).unwrap().reduced_textures(gpu, &uploaded, size, 1).unwrap();
        let Maps::Floats([view, ..]) = textures.maps else { panic!("floats") };
        let texture = view.texture().clone();
        Shaded { texture, view, size, stride: 1 }.read_back(gpu).unwrap().pixels
    }

    #[test]
    fn packed_normals_are_those_of_the_core_bit_for_bit() {
        let gpu = match Gpu::headless() {
            Ok(gpu) if gpu.report.shading_format == TextureFormat::Rgba32Float => gpu,
            other => return eprintln!("NOT TESTED: {other:?}"),
        };
        let size = [640, 512];
        let count = size[0] * size[1];
        let [diffuse, specular] = [0.25, 0.04].map(|value| [0; 3].map(|_| vec![value; count]));
        let planes = Planes { normal: unit_vectors(count), diffuse, specular, roughness: vec![0.5; count] };
        let material = Material::new("unit vectors", size[0], size[1], planes).unwrap();
        let [x, y, z] = &material.planes().normal;
        let found = normals_of(&gpu, &material);
        let bits = |one: [f32; 3]| one.map(f32::to_bits);
        let differ = |index: &usize| bits(found[*index]) != bits([x[*index], y[*index], z[*index]]);
        assert_eq!((0..count).find(differ), None);
        // The largest component is each of the three, of both signs.
        for component in [x, y, z] {
            assert!(component.iter().any(|one| *one > 0.9) && component.iter().any(|one| *one < -0.9));
        }
    }
}
