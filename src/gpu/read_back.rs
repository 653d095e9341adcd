//! Numbers back from the device.

use std::sync::mpsc;

use bytemuck::Pod;
use wgpu::{BufferDescriptor, BufferUsages, Extent3d, PollType, TexelCopyBufferInfo, TextureFormat};

use svbrdf_core::error::Error;
use svbrdf_core::image::Image;

use super::fault::{failed, scoped};
use super::{Gpu, Shaded};

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
        let size = [self.texture.width(), self.texture.height()];
        let texels: Vec<[f32; 4]> = read(gpu, &self.texture, size)?;
        let [width, height] = size.map(|side| side as usize);
        match gpu.take_fault() {
            Some(fault) => Err(fault),
            None => Ok(Image {
                width,
                height,
                pixels: texels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect(),
            }),
        }
    }
}

/// The bytes of the pixels of a texture of four bytes a pixel, in the texture's own order of channels.
///
/// # Errors
/// [`Error::Gpu`] where the adapter failed.
pub fn read_rgba(gpu: &Gpu, texture: &wgpu::Texture, size: [u32; 2]) -> Result<Vec<[u8; 4]>, Error> {
    read(gpu, texture, size)
}

/// The texels of a texture, once the device has done all that was submitted.
fn read<T: Pod>(gpu: &Gpu, texture: &wgpu::Texture, [width, height]: [u32; 2]) -> Result<Vec<T>, Error> {
    let row = width * size_of::<T>() as u32;
    let stride = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = scoped(&gpu.device, "reading a picture back", || {
        let buffer = gpu.device.create_buffer(&BufferDescriptor {
            label: Some("read back"),
            size: u64::from(stride) * u64::from(height),
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(stride), rows_per_image: None };
        let target = TexelCopyBufferInfo { buffer: &buffer, layout };
        let size = Extent3d { width, height, depth_or_array_layers: 1 };
        encoder.copy_texture_to_buffer(texture.as_image_copy(), target, size);
        gpu.queue.submit([encoder.finish()]);
        buffer
    })?;
    let (sender, receiver) = mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        // Nobody listens any more where polling failed.
        let _ = sender.send(result);
    });
    gpu.device.poll(PollType::wait_indefinitely()).map_err(|e| failed(format!("waiting for it: {e}")))?;
    let mapped = receiver.recv().map_err(|_| failed("it never answered".to_owned()))?;
    mapped.map_err(|e| failed(format!("reading its memory: {e}")))?;
    let view = buffer.get_mapped_range(..).map_err(|e| failed(format!("reading its memory: {e}")))?;
    let rows = view.chunks_exact(stride as usize);
    Ok(rows.flat_map(|bytes| bytemuck::pod_collect_to_vec::<u8, T>(&bytes[..row as usize])).collect())
}
