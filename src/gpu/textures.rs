//! A material on the device: the core's f32 numbers, exactly.

use rayon::prelude::*;
use wgpu::util::StagingBelt;
use wgpu::{
    BufferSize, COPY_BYTES_PER_ROW_ALIGNMENT, Extent3d, Origin3d, PollType, SubmissionIndex,
    TexelCopyBufferInfo, TexelCopyBufferLayout, TexelCopyTextureInfo, Texture, TextureDescriptor,
    TextureFormat, TextureUsages, TextureView,
};

use svbrdf_core::error::Error;
use svbrdf_core::material::{Material, Planes};

use super::Gpu;
use super::fault::scoped;

/// About how many bytes are sent at once: bounds the memory that an upload takes beside the textures.
const BAND_BYTES: usize = 4 << 20;
/// Bytes of a texel of one texture: four f32.
const TEXEL_BYTES: usize = 16;

/// The four maps as three float textures: normal with roughness, diffuse, specular.
#[derive(Clone, Debug)]
pub struct MaterialTextures {
    pub(super) views: [TextureView; 3],
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
        let textures = scoped(&gpu.device, "uploading a material", || {
            let create = |label| gpu.device.create_texture(&descriptor(label, extent));
            let textures = [create("normal and roughness"), create("diffuse"), create("specular")];
            for (texture, texel) in textures.iter().zip([normal_roughness, diffuse, specular]) {
                write(gpu, texture, size, |index| texel(material.planes(), source(index)));
            }
            textures
        })?;
        Ok(Self { views: textures.map(|t| t.create_view(&Default::default())) })
    }
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
pub(super) fn write(
    gpu: &Gpu,
    texture: &Texture,
    [width, height]: [usize; 2],
    texel: impl Fn(usize) -> [f32; 4] + Sync,
) {
    let pitch = width.next_multiple_of(COPY_BYTES_PER_ROW_ALIGNMENT as usize / TEXEL_BYTES);
    let rows_per_band = (BAND_BYTES / (pitch * TEXEL_BYTES)).clamp(1, height);
    let mut texels = vec![[0.0; 4]; rows_per_band * pitch];
    let mut belt = StagingBelt::new(gpu.device.clone(), size_of_val(texels.as_slice()) as u64);
    let mut last = None;
    for top in (0..height).step_by(rows_per_band) {
        let band = &mut texels[..rows_per_band.min(height - top) * pitch];
        band.par_chunks_mut(pitch).enumerate().for_each(|(row, values)| {
            let first = (top + row) * width;
            values[..width].iter_mut().zip(first..).for_each(|(value, index)| *value = texel(index));
        });
        // Where the adapter has no buffer for it, it has reported a fault.
        let Some(submission) = send_band(gpu, &mut belt, texture, top, bytemuck::cast_slice(band)) else {
            return;
        };
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
    rows: &[u8],
) -> Option<SubmissionIndex> {
    let width = texture.width();
    let bytes_per_row = (width * TEXEL_BYTES as u32).next_multiple_of(COPY_BYTES_PER_ROW_ALIGNMENT);
    let slice = belt.allocate(BufferSize::new(rows.len() as u64)?, BufferSize::new(TEXEL_BYTES as u64)?);
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
