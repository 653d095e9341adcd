//! A material on the device: the core's f32 numbers, exactly.

use std::sync::atomic::{AtomicBool, Ordering};

use bytemuck::Pod;
use rayon::prelude::*;
use wgpu::util::StagingBelt;
use wgpu::{
    Buffer, BufferSize, COPY_BYTES_PER_ROW_ALIGNMENT, Extent3d, Origin3d, PollType, SubmissionIndex,
    TexelCopyBufferInfo, TexelCopyBufferLayout, TexelCopyTextureInfo, Texture, TextureDescriptor,
    TextureFormat, TextureUsages, TextureView,
};

use svbrdf_core::error::Error;
use svbrdf_core::material::{Material, Planes};

use super::Gpu;
use super::codes::{Codes, VALUES};
use super::fault::scoped;
use super::pipeline::uniform_buffer;

/// About how many bytes are sent at once: bounds the memory that an upload takes beside the textures.
const BAND_BYTES: usize = 4 << 20;
/// Bytes that are a multiple of those of every texel.
const ALIGNMENT: u64 = 16;
/// Texels that are looked at first, to find maps of many values soon.
const SAMPLE: usize = 4096;

/// The four maps: exactly the numbers of the core.
#[derive(Clone, Debug)]
pub struct MaterialTextures {
    pub(super) maps: Maps,
}

/// How the maps are held.
#[derive(Clone, Debug)]
pub(super) enum Maps {
    /// Normal with roughness, diffuse, specular: four f32 a texel each.
    Floats([TextureView; 3]),
    /// The f32 of the normal with the codes of roughness and diffuse, the codes of specular, and the values of the codes: where
    /// roughness, diffuse and specular have at most 256 values each, as those of 8-bit files.
    Coded([TextureView; 2], Buffer),
}

impl MaterialTextures {
    /// Copies `material` to the device.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the material is too large for the adapter or for its memory.
    pub fn upload(gpu: &Gpu, material: &Material<f32>) -> Result<Self, Error> {
        Self::send(gpu, material, material.size(), |index| index)
    }

    /// Copies the texels of `material` that a target of this `stride` shades: what
    /// [`Shading::reduced_textures`](super::Shading::reduced_textures) makes of the whole material.
    ///
    /// # Errors
    /// As [`MaterialTextures::upload`].
    pub fn upload_reduced(gpu: &Gpu, material: &Material<f32>, stride: usize) -> Result<Self, Error> {
        let [width, height] = material.size();
        let size = [width, height].map(|side| side.div_ceil(stride));
        let middle = |place: usize, side: usize| (place * stride + stride / 2).min(side - 1);
        let texel = |index| middle(index / size[0], height) * width + middle(index % size[0], width);
        Self::send(gpu, material, size, texel)
    }

    /// Copies texels into textures of `size`; `source` has the index in the material of each.
    fn send(
        gpu: &Gpu,
        material: &Material<f32>,
        size: [usize; 2],
        source: impl Fn(usize) -> usize + Sync,
    ) -> Result<Self, Error> {
        let extent = extent(gpu, size)?;
        let planes = material.planes();
        let maps = scoped(&gpu.device, "uploading a material", || {
            coded(gpu, planes, extent, &source).unwrap_or_else(|| floats(gpu, planes, extent, &source))
        })?;
        Ok(Self { maps })
    }

    /// Bytes of a texel on the device.
    pub fn texel_bytes(&self) -> usize {
        match self.maps {
            Maps::Floats(_) => 48,
            Maps::Coded(..) => 20,
        }
    }
}

/// The maps as floats.
fn floats(
    gpu: &Gpu,
    planes: &Planes<f32>,
    extent: Extent3d,
    source: &(impl Fn(usize) -> usize + Sync),
) -> Maps {
    let of = |label, texel: fn(&Planes<f32>, usize) -> [f32; 4]| {
        let texture = gpu.device.create_texture(&descriptor(label, extent));
        write(gpu, &texture, |index| texel(planes, source(index)));
        texture.create_view(&Default::default())
    };
    let [a, b] = [of("normal and roughness", normal_roughness), of("diffuse", diffuse)];
    Maps::Floats([a, b, of("specular", specular)])
}

/// The maps as codes; `None` where they have too many values.
fn coded(
    gpu: &Gpu,
    planes: &Planes<f32>,
    extent: Extent3d,
    source: &(impl Fn(usize) -> usize + Sync),
) -> Option<Maps> {
    let codes: [Codes; 3] = std::array::from_fn(|_| Codes::new());
    let [roughness, diffuse, specular] = &codes;
    let count = extent.width as usize * extent.height as usize;
    let colour = |codes: &Codes, planes: &[Vec<f32>; 3], index: usize| -> Option<u32> {
        let [r, g, b] = planes.each_ref().map(|plane| codes.code(plane[index]));
        Some(r? << 16 | g? << 8 | b?)
    };
    let normal_and_codes = |index: usize| -> Option<[u32; 4]> {
        let [x, y, z] = planes.normal.each_ref().map(|plane| plane[index].to_bits());
        let first = roughness.code(planes.roughness[index])?;
        Some([x, y, z, first << 24 | colour(diffuse, &planes.diffuse, index)?])
    };
    let specular_codes = |index: usize| colour(specular, &planes.specular, index);
    for index in (0..count).step_by((count / SAMPLE).max(1)).map(source) {
        normal_and_codes(index)?;
        specular_codes(index)?;
    }
    let has_failed = AtomicBool::new(false);
    let failed = || has_failed.store(true, Ordering::Relaxed);
    let create =
        |label, format| gpu.device.create_texture(&TextureDescriptor { format, ..descriptor(label, extent) });
    let textures = [
        create("normal and codes", TextureFormat::Rgba32Uint),
        create("codes of specular", TextureFormat::R32Uint),
    ];
    write(gpu, &textures[0], |index| {
        normal_and_codes(source(index)).unwrap_or_else(|| {
            failed();
            [0; 4]
        })
    });
    if !has_failed.load(Ordering::Relaxed) {
        write(gpu, &textures[1], |index| {
            specular_codes(source(index)).unwrap_or_else(|| {
                failed();
                0
            })
        });
    }
    if has_failed.load(Ordering::Relaxed) {
        return None;
    }
    let mut values = [[0.0_f32; 4]; VALUES];
    for (channel, codes) in codes.iter().enumerate() {
        values.iter_mut().zip(codes.values()).for_each(|(row, value)| row[channel] = value);
    }
    let values = uniform_buffer(&gpu.device, bytemuck::cast_slice(&values));
    Some(Maps::Coded(textures.map(|texture| texture.create_view(&Default::default())), values))
}

/// `size` as wgpu wants it, if the device can hold it.
pub(super) fn extent(gpu: &Gpu, size: [usize; 2]) -> Result<Extent3d, Error> {
    let limit = gpu.report.max_texture_side;
    let side = |side: usize| u32::try_from(side).ok().filter(|side| (1..=limit).contains(side));
    match size.map(side) {
        [Some(width), Some(height)] => Ok(Extent3d { width, height, depth_or_array_layers: 1 }),
        _ => Err(Error::Gpu {
            problem: format!(
                "{} x {} texels; {} takes at most {limit} along a side",
                size[0], size[1], gpu.report.name
            ),
            remedy: "use a smaller material, or use the CPU",
        }),
    }
}

pub(super) fn descriptor(label: &'static str, size: Extent3d) -> TextureDescriptor<'static> {
    TextureDescriptor {
        label: Some(label),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: TextureFormat::Rgba32Float,
        usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
        view_formats: &[],
    }
}

/// Sends the texels band by band, through buffers that are used again: clearing fresh memory takes longer than the copy.
pub(super) fn write<T: Pod + Send>(gpu: &Gpu, texture: &Texture, texel: impl Fn(usize) -> T + Sync) {
    let [width, height] = [texture.width() as usize, texture.height() as usize];
    let bytes = size_of::<T>();
    let pitch = width.next_multiple_of(COPY_BYTES_PER_ROW_ALIGNMENT as usize / bytes);
    let rows_per_band = (BAND_BYTES / (pitch * bytes)).clamp(1, height);
    let mut texels = vec![T::zeroed(); rows_per_band * pitch];
    let mut belt = StagingBelt::new(gpu.device.clone(), size_of_val(texels.as_slice()) as u64);
    let mut last = None;
    for top in (0..height).step_by(rows_per_band) {
        let band = &mut texels[..rows_per_band.min(height - top) * pitch];
        band.par_chunks_mut(pitch).enumerate().for_each(|(row, values)| {
            let first = (top + row) * width;
            values[..width].iter_mut().zip(first..).for_each(|(value, index)| *value = texel(index));
        });
        // Where the adapter has no buffer for it, it has reported a fault.
        let rows = bytemuck::cast_slice(band);
        let bytes_per_row = (pitch * bytes) as u32;
        let Some(submission) = send_band(gpu, &mut belt, texture, top, (rows, bytes_per_row)) else { return };
        // The buffer of the band before is free again when its copy has ended. A lost device is reported where it draws.
        let copied = |submission_index| PollType::Wait { submission_index, timeout: None };
        last.replace(submission).map(|last| gpu.device.poll(copied(Some(last))));
    }
}

/// Sends rows of texels, whose bytes are `rows`, from row `top` on.
fn send_band(
    gpu: &Gpu,
    belt: &mut StagingBelt,
    texture: &Texture,
    top: usize,
    (rows, bytes_per_row): (&[u8], u32),
) -> Option<SubmissionIndex> {
    let width = texture.width();
    let slice = belt.allocate(BufferSize::new(rows.len() as u64)?, BufferSize::new(ALIGNMENT)?);
    slice.get_mapped_range_mut().ok()?.copy_from_slice(rows);
    let layout = TexelCopyBufferLayout {
        offset: slice.offset(),
        bytes_per_row: Some(bytes_per_row),
        rows_per_image: None,
    };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.copy_buffer_to_texture(
        TexelCopyBufferInfo { buffer: slice.buffer(), layout },
        TexelCopyTextureInfo { origin: Origin3d { x: 0, y: top as u32, z: 0 }, ..texture.as_image_copy() },
        Extent3d { width, height: rows.len() as u32 / bytes_per_row, depth_or_array_layers: 1 },
    );
    belt.finish();
    let submission = gpu.queue.submit([encoder.finish()]);
    belt.recall();
    Some(submission)
}

fn normal_roughness(planes: &Planes<f32>, index: usize) -> [f32; 4] {
    let [x, y, z] = &planes.normal;
    [x[index], y[index], z[index], planes.roughness[index]]
}

fn diffuse(planes: &Planes<f32>, index: usize) -> [f32; 4] {
    colour(&planes.diffuse, index)
}

fn specular(planes: &Planes<f32>, index: usize) -> [f32; 4] {
    colour(&planes.specular, index)
}

fn colour([r, g, b]: &[Vec<f32>; 3], index: usize) -> [f32; 4] {
    [r[index], g[index], b[index], 0.0]
}
