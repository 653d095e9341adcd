//! A material on the device: the core's f32 numbers, exactly.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

use wgpu::util::StagingBelt;
use wgpu::{
    Buffer, BufferSize, COPY_BYTES_PER_ROW_ALIGNMENT, Extent3d, Origin3d, PollType, SubmissionIndex,
    TexelCopyBufferInfo, TexelCopyBufferLayout, TexelCopyTextureInfo, Texture, TextureDescriptor,
    TextureFormat, TextureUsages, TextureView,
};

use svbrdf_core::error::Error;
use svbrdf_core::material::{Material, Planes};

use super::Gpu;
use super::fault::scoped;
use super::packing::Packing;
use super::pipeline::uniform_buffer;

/// About how many bytes are sent at once.
const BAND_BYTES: usize = 1 << 20;
/// Bytes of a texel of a texture.
const TEXEL_BYTES: usize = 16;
/// Texels that are filled at once, and stay in the nearest cache.
const FEW: usize = 512;
/// Most threads that fill bands: bounds the memory that an upload takes beside the textures.
const MOST_THREADS: usize = 8;
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
    /// Packed normals with the codes of diffuse, roughness and specular, and the values of the codes: where these have at
    /// most 256 values each, as those of 8-bit files.
    Coded(TextureView, Buffer),
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
            coded(gpu, planes, extent, &source)?.map_or_else(|| floats(gpu, planes, extent, &source), Ok)
        })??;
        Ok(Self { maps })
    }

    /// Bytes of a texel on the device.
    pub fn texel_bytes(&self) -> usize {
        match self.maps {
            Maps::Floats(_) => 48,
            Maps::Coded(..) => 16,
        }
    }
}

/// The maps as floats.
fn floats(
    gpu: &Gpu,
    planes: &Planes<f32>,
    extent: Extent3d,
    source: &(impl Fn(usize) -> usize + Sync),
) -> Result<Maps, Error> {
    let of = |label, texel: fn(&Planes<f32>, usize) -> [f32; 4]| {
        let texture = gpu.device.create_texture(&descriptor(label, extent));
        write(gpu, &texture, |first, texels| {
            (first..).zip(texels).for_each(|(index, bits)| {
                *bits = texel(planes, source(index)).map(f32::to_bits);
            });
            true
        })?;
        Ok(texture.create_view(&Default::default()))
    };
    let [a, b] = [of("normal and roughness", normal_roughness)?, of("diffuse", diffuse)?];
    Ok(Maps::Floats([a, b, of("specular", specular)?]))
}

/// The maps as codes; `None` where they have too many values.
fn coded(
    gpu: &Gpu,
    planes: &Planes<f32>,
    extent: Extent3d,
    source: &(impl Fn(usize) -> usize + Sync),
) -> Result<Option<Maps>, Error> {
    let packing = Packing::new(planes);
    let count = extent.width as usize * extent.height as usize;
    let is_packed = |index: usize| packing.pack(&mut [[0; 4]], |_| source(index));
    if !(0..count).step_by((count / SAMPLE).max(1)).all(is_packed) {
        return Ok(None);
    }
    let format = TextureFormat::Rgba32Uint;
    let texture = gpu.device.create_texture(&TextureDescriptor { format, ..descriptor("codes", extent) });
    if !write(gpu, &texture, |first, texels| packing.pack(texels, |number| source(first + number)))? {
        return Ok(None);
    }
    let values = packing.values();
    let values = uniform_buffer(&gpu.device, bytemuck::cast_slice(&values));
    Ok(Some(Maps::Coded(texture.create_view(&Default::default()), values)))
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

/// Sends texels band by band, on several threads. Each fills buffers that are used again: clearing fresh memory takes longer than the
/// copy. `fill` puts the bits of the texels of a part of a row in their place, from the given index on; where it returns false, the rest
/// is not sent, and the result is false.
pub(super) fn write(
    gpu: &Gpu,
    texture: &Texture,
    fill: impl Fn(usize, &mut [[u32; 4]]) -> bool + Sync,
) -> Result<bool, Error> {
    let [width, height] = [texture.width() as usize, texture.height() as usize];
    let rows = (BAND_BYTES / (pitch(width) * TEXEL_BYTES)).clamp(1, height);
    let (next, is_refused) = (AtomicUsize::new(0), AtomicBool::new(false));
    let work = || {
        let mut belt = StagingBelt::new(gpu.device.clone(), (rows * pitch(width) * TEXEL_BYTES) as u64);
        let mut last = None;
        loop {
            let top = next.fetch_add(rows, Ordering::Relaxed);
            if top >= height || is_refused.load(Ordering::Relaxed) {
                return;
            }
            let fill = |first: usize, texels: &mut [[u32; 4]]| {
                if !fill(first, texels) {
                    is_refused.store(true, Ordering::Relaxed);
                }
            };
            // Where the adapter has no buffer for it, it has reported a fault.
            let band = [top, rows.min(height - top)];
            let Some(submission) = send_band(gpu, &mut belt, texture, band, fill) else { return };
            // The buffer of the band before is free again when its copy has ended. A lost device is reported where it draws.
            let copied = |submission_index| PollType::Wait { submission_index, timeout: None };
            last.replace(submission).map(|last| gpu.device.poll(copied(Some(last))));
        }
    };
    let threads = rayon::current_num_threads().min(MOST_THREADS).min(height.div_ceil(rows));
    thread::scope(|scope| {
        // Where the system has no more threads, this one does it all.
        let send = || scoped(&gpu.device, "sending texels", work);
        let others: Vec<_> =
            (1..threads).map_while(|_| thread::Builder::new().spawn_scoped(scope, send).ok()).collect();
        work();
        others.into_iter().try_for_each(|other| other.join().unwrap_or_else(|panic| resume_unwind(panic)))
    })?;
    Ok(!is_refused.into_inner())
}

/// Texels of a row in a buffer.
fn pitch(width: usize) -> usize {
    width.next_multiple_of(COPY_BYTES_PER_ROW_ALIGNMENT as usize / TEXEL_BYTES)
}

/// Sends `rows` of texels from row `top` on.
fn send_band(
    gpu: &Gpu,
    belt: &mut StagingBelt,
    texture: &Texture,
    [top, rows]: [usize; 2],
    fill: impl Fn(usize, &mut [[u32; 4]]),
) -> Option<SubmissionIndex> {
    let (width, row_bytes) = (texture.width() as usize, pitch(texture.width() as usize) * TEXEL_BYTES);
    let slice =
        belt.allocate(BufferSize::new((rows * row_bytes) as u64)?, BufferSize::new(TEXEL_BYTES as u64)?);
    let mut bytes = slice.get_mapped_range_mut().ok()?;
    let mut few = [[0_u32; 4]; FEW];
    for (row, column) in (0..rows).flat_map(|row| (0..width).step_by(FEW).map(move |column| (row, column))) {
        let texels = &mut few[..FEW.min(width - column)];
        fill((top + row) * width + column, texels);
        let start = row * row_bytes + column * TEXEL_BYTES;
        bytes.slice(start..start + size_of_val(texels)).copy_from_slice(bytemuck::cast_slice(texels));
    }
    drop(bytes);
    let layout = TexelCopyBufferLayout {
        offset: slice.offset(),
        bytes_per_row: Some(row_bytes as u32),
        rows_per_image: None,
    };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.copy_buffer_to_texture(
        TexelCopyBufferInfo { buffer: slice.buffer(), layout },
        TexelCopyTextureInfo { origin: Origin3d { x: 0, y: top as u32, z: 0 }, ..texture.as_image_copy() },
        Extent3d { width: width as u32, height: rows as u32, depth_or_array_layers: 1 },
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
