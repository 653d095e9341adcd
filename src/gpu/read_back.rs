//! Numbers back from the device.

use std::sync::mpsc;

use wgpu::{Buffer, BufferDescriptor, BufferUsages, Extent3d, Origin3d, PollType, TextureFormat};

use svbrdf_core::error::Error;
use svbrdf_core::image::Image;

use super::fault::{failed, scoped};
use super::{Gpu, Shaded};

/// About how many bytes are read at once.
const BAND_BYTES: usize = 16 << 20;
/// Bytes of a texel: four f32.
const TEXEL_BYTES: usize = 16;

impl Shaded {
    /// Waits for what was drawn and reads it: the shaded texels.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the adapter cannot render to 32-bit floats or failed, now or while drawing.
    pub fn read_back(&self, gpu: &Gpu) -> Result<Image<f32>, Error> {
        if self.texture.format() != TextureFormat::Rgba32Float {
            return Err(Error::Gpu {
                problem: format!("{} cannot render to 32-bit floats", gpu.report.name),
                remedy: "use the CPU",
            });
        }
        let [width, height] = [self.texture.width(), self.texture.height()].map(|side| side as usize);
        let stride = (width * TEXEL_BYTES).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize);
        let rows_per_band = (BAND_BYTES / stride).clamp(1, height);
        let buffer =
            scoped(&gpu.device, "reading a picture back", || read_buffer(gpu, rows_per_band * stride))?;
        let mut pixels = Vec::with_capacity(width * height);
        for top in (0..height).step_by(rows_per_band) {
            let rows = rows_per_band.min(height - top);
            copy_rows(gpu, self, &buffer, top, rows, stride)?;
            let bytes = read(gpu, &buffer)?;
            for row in bytes.chunks_exact(stride).take(rows) {
                let texels: &[[f32; 4]] = bytemuck::cast_slice(&row[..width * TEXEL_BYTES]);
                pixels.extend(texels.iter().map(|&[r, g, b, _]| [r, g, b]));
            }
        }
        match gpu.take_fault() {
            Some(fault) => Err(fault),
            None => Ok(Image { width, height, pixels }),
        }
    }
}

/// The bytes of the pixels of a texture of four bytes a pixel, in the texture's own order of channels.
///
/// # Errors
/// [`Error::Gpu`] where the adapter failed.
pub fn read_rgba(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    [width, height]: [u32; 2],
) -> Result<Vec<[u8; 4]>, Error> {
    let stride = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = scoped(&gpu.device, "reading a picture back", || {
        let buffer = read_buffer(gpu, (stride * height) as usize);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(stride), rows_per_image: None };
        let size = Extent3d { width, height, depth_or_array_layers: 1 };
        let target = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
        encoder.copy_texture_to_buffer(texture.as_image_copy(), target, size);
        gpu.queue.submit([encoder.finish()]);
        buffer
    })?;
    let bytes = read(gpu, &buffer)?;
    let rows = bytes.chunks_exact(stride as usize);
    Ok(rows
        .flat_map(|row| bytemuck::cast_slice::<u8, [u8; 4]>(&row[..4 * width as usize]).to_vec())
        .collect())
}

fn copy_rows(
    gpu: &Gpu,
    source: &Shaded,
    buffer: &Buffer,
    top: usize,
    rows: usize,
    stride: usize,
) -> Result<(), Error> {
    scoped(&gpu.device, "reading a picture back", || {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                origin: Origin3d { x: 0, y: top as u32, z: 0 },
                ..source.texture.as_image_copy()
            },
            wgpu::TexelCopyBufferInfo {
                buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(stride as u32),
                    rows_per_image: None,
                },
            },
            Extent3d { width: source.texture.width(), height: rows as u32, depth_or_array_layers: 1 },
        );
        gpu.queue.submit([encoder.finish()]);
    })
}

/// A buffer of `size` bytes that the device writes and the program reads.
pub(super) fn read_buffer(gpu: &Gpu, size: usize) -> Buffer {
    gpu.device.create_buffer(&BufferDescriptor {
        label: Some("read back"),
        size: size as u64,
        usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
        mapped_at_creation: false,
    })
}

/// The bytes of `buffer`, once the device has done all that was submitted.
pub(super) fn read(gpu: &Gpu, buffer: &Buffer) -> Result<Vec<u8>, Error> {
    let (sender, receiver) = mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        // Nobody listens any more where polling failed.
        let _ = sender.send(result);
    });
    gpu.device.poll(PollType::wait_indefinitely()).map_err(|e| failed(format!("waiting for it: {e}")))?;
    let mapped = receiver.recv().map_err(|_| failed("it never answered".to_owned()))?;
    mapped.map_err(|e| failed(format!("reading its memory: {e}")))?;
    let view = buffer.get_mapped_range(..).map_err(|e| failed(format!("reading its memory: {e}")))?;
    let bytes = view.to_vec();
    drop(view);
    buffer.unmap();
    Ok(bytes)
}
