//! Snapshot: a part of the window as a picture, drawn offscreen by the code that draws the window.

use eframe::egui_wgpu::{RenderState, Renderer, RendererOptions, ScreenDescriptor};
use eframe::{egui, wgpu};

use svbrdf_core::error::Error;
use svbrdf_gpu::{Gpu, read_rgba};

use crate::widgets::theme;

/// Frames until the layout is settled.
const FRAMES: usize = 2;

/// Draws `content` in a window that nobody sees, of this size in pixels and pixels per point.
///
/// # Errors
/// [`Error::Gpu`] where the adapter cannot make a picture of this size, or fails.
pub fn snapshot(
    state: &RenderState,
    gpu: &Gpu,
    (size, scale): ([u32; 2], f32),
    dark: bool,
    mut content: impl FnMut(&mut egui::Ui),
) -> Result<egui::ColorImage, Error> {
    let limit = gpu.report.max_texture_side;
    if size.iter().any(|side| !(16..=limit).contains(side)) {
        return Err(Error::Gpu {
            problem: format!("expected a picture of 16 to {limit} pixels along a side, found {:?}", size),
            remedy: "choose another size",
        });
    }
    let ctx = egui::Context::default();
    theme::install(&ctx);
    theme::choose(&ctx, dark);
    ctx.set_pixels_per_point(scale);
    let points = egui::vec2(size[0] as f32, size[1] as f32) / scale;
    let input = egui::RawInput {
        screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, points)),
        ..Default::default()
    };
    let options = RendererOptions { dithering: false, ..Default::default() };
    let mut renderer = Renderer::new(&state.device, state.target_format, options);
    let mut shapes = Vec::new();
    for _ in 0..FRAMES {
        let mut output = ctx.run_ui(input.clone(), |ui| {
            // As the window is cleared before its panels.
            ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
            content(ui);
        });
        for (id, deltas) in output.textures_delta.set.drain() {
            for delta in &deltas {
                renderer.update_texture(&state.device, &state.queue, id, delta);
            }
        }
        shapes = output.shapes;
    }
    let primitives = ctx.tessellate(shapes, scale);
    let screen = ScreenDescriptor { size_in_pixels: size, pixels_per_point: scale };
    let texture = paint(state, &mut renderer, &primitives, &screen);
    let [width, height] = size.map(|side| side as usize);
    let mut rgba = read_rgba(gpu, &texture, size)?;
    if matches!(state.target_format, wgpu::TextureFormat::Bgra8Unorm | wgpu::TextureFormat::Bgra8UnormSrgb) {
        rgba.iter_mut().for_each(|pixel| pixel.swap(0, 2));
    }
    let pixels = rgba.into_iter().map(|[r, g, b, _]| egui::Color32::from_rgb(r, g, b)).collect();
    Ok(egui::ColorImage::new([width, height], pixels))
}

fn paint(
    state: &RenderState,
    renderer: &mut Renderer,
    primitives: &[egui::ClippedPrimitive],
    screen: &ScreenDescriptor,
) -> wgpu::Texture {
    let [width, height] = screen.size_in_pixels;
    let texture = state.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("snapshot"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: state.target_format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let view = texture.create_view(&Default::default());
    let mut encoder = state.device.create_command_encoder(&Default::default());
    let commands = renderer.update_buffers(&state.device, &state.queue, &mut encoder, primitives, screen);
    let attachment = wgpu::RenderPassColorAttachment {
        view: &view,
        resolve_target: None,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
        depth_slice: None,
    };
    let pass = wgpu::RenderPassDescriptor {
        label: Some("snapshot"),
        color_attachments: &[Some(attachment)],
        ..Default::default()
    };
    let mut pass = encoder.begin_render_pass(&pass).forget_lifetime();
    renderer.render(&mut pass, primitives, screen);
    drop(pass);
    state.queue.submit(commands.into_iter().chain([encoder.finish()]));
    texture
}
