//! The graphics adapter of the tests, and pictures of panes.

use std::sync::OnceLock;

use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::camera::Camera;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_gpu::{
    DisplayMode, DisplayParams, DisplayPass, Encoding, Gpu, MaterialTextures, Pane, PanePlace, ShadeParams,
    Shaded, Shading,
};

/// What to do where the tests and the build disagree on what is there.
pub const STALE_BUILD: &str =
    "this machine has changed since the build looked at it: touch tests/needs/adapter.rs";

/// The adapter, the same for every test, or why there is none.
pub fn find_gpu() -> Result<&'static Gpu, &'static str> {
    static GPU: OnceLock<Result<Gpu, String>> = OnceLock::new();
    GPU.get_or_init(|| Gpu::headless().map_err(|e| e.to_string())).as_ref().map_err(String::as_str)
}

/// The adapter. A test that calls this needs `adapter` (tests/needs), and is ignored where the build found no driver.
///
/// # Panics
/// If there is no adapter.
pub fn gpu() -> &'static Gpu {
    find_gpu().unwrap_or_else(|problem| {
        panic!("the build found a graphics driver, but {problem}\n(VK_DRIVER_FILES=none hides all drivers)")
    })
}

/// As [`gpu`], but it renders to 32-bit floats. A test that calls this needs `f32_adapter`.
///
/// # Panics
/// If there is no adapter, or it renders to fewer bits, as OpenGL does.
pub fn gpu_f32() -> &'static Gpu {
    let gpu = gpu();
    assert_eq!(gpu.report.shading_format, wgpu::TextureFormat::Rgba32Float, "{}", gpu.report);
    gpu
}

/// The passes of [`gpu`].
pub fn shading() -> &'static Shading {
    static SHADING: OnceLock<Shading> = OnceLock::new();
    SHADING.get_or_init(|| Shading::new(gpu()).expect("the shading pass compiles"))
}

/// A rendering by [`gpu`]; light and view may be below the plane.
pub fn shaded(gpu: &Gpu, material: &Material<f32>, scene: &Scene, convention: &Convention) -> Shaded {
    let params = ShadeParams { scene: *scene, convention: *convention, quantity: Quantity::Rendering };
    shaded_by(gpu, material, &params)
}

/// A material shaded by [`gpu`].
pub fn shaded_by(gpu: &Gpu, material: &Material<f32>, params: &ShadeParams) -> Shaded {
    let textures = MaterialTextures::upload(gpu, material).expect("uploaded");
    let target = shading().target(gpu, material.size()).expect("created");
    shading().draw(gpu, &textures, params, &target);
    target
}

/// A bumpy material in which no two texels, rows, columns or channels are alike.
pub fn bumpy(width: usize, height: usize) -> Material<f32> {
    let plane = |f: &dyn Fn(f32, f32) -> f32| -> Vec<f32> {
        let place = |i: usize| ((i % width) as f32 / width as f32, (i / width) as f32 / height as f32);
        (0..width * height).map(place).map(|(u, v)| f(u, v)).collect()
    };
    let planes = Planes {
        normal: [
            plane(&|u, v| 0.6 * (9.0 * u + 2.0 * v).sin()),
            plane(&|u, v| 0.6 * (7.0 * v - 3.0 * u).cos()),
            plane(&|_, _| 1.0),
        ],
        diffuse: [plane(&|u, _| u), plane(&|_, v| v), plane(&|u, v| 0.5 + 0.5 * (20.0 * u * v).sin())],
        specular: [plane(&|u, v| u * v), plane(&|u, v| 0.04 + 0.9 * u * (1.0 - v)), plane(&|_, v| 1.0 - v)],
        roughness: plane(&|u, v| (0.5 + 0.5 * (5.0 * u + 11.0 * v).sin()).powi(2)),
    };
    Material::new("bumpy", width, height, planes).expect("a valid material")
}

/// The material whose files have 8 bits.
pub fn of_8_bits(material: &Material<f32>) -> Material<f32> {
    let rounded = |plane: &Vec<f32>| plane.iter().map(|value| (value * 255.0).round() / 255.0).collect();
    let Planes { normal, diffuse, specular, roughness } = material.planes();
    let planes = Planes {
        normal: normal.clone(),
        diffuse: diffuse.each_ref().map(rounded),
        specular: specular.each_ref().map(rounded),
        roughness: rounded(roughness),
    };
    let [width, height] = material.size();
    Material::new("8 bits", width, height, planes).expect("a valid material")
}

/// The colour beside the material.
pub const BACKGROUND: [f32; 3] = [0.2, 0.4, 0.6];

/// What is displayed straight from above of a rectangle around the origin.
pub fn from_above([half_width, half_height]: [f32; 2], encoding: Encoding) -> DisplayParams {
    let camera = Camera {
        origin: [0.0, 0.0, 1.0].into(),
        origin_right: [half_width, 0.0, 0.0].into(),
        origin_up: [0.0, half_height, 0.0].into(),
        direction: [0.0, 0.0, -1.0].into(),
        direction_right: [0.0; 3].into(),
        direction_up: [0.0; 3].into(),
    };
    DisplayParams {
        camera,
        exposure_ev: 0.0,
        mode: DisplayMode::Value,
        difference: None,
        encoding,
        show_clipping: false,
        epsilon: 0.01,
        false_colour: false,
        nearest: false,
        background: BACKGROUND,
    }
}

/// An 8-bit picture, RGBA, row 0 on top.
pub struct Picture {
    pub width: usize,
    pub pixels: Vec<[u8; 4]>,
}

impl Picture {
    pub fn at(&self, column: usize, row: usize) -> [u8; 3] {
        let [r, g, b, _] = self.pixels[row * self.width + column];
        [r, g, b]
    }
}

/// What a window would show of a pane of `width` x `height` pixels.
pub fn picture(
    gpu: &Gpu,
    size: [u32; 2],
    shown: &Shaded,
    reference: &Shaded,
    params: &DisplayParams,
) -> Picture {
    let screen = Screen::new(gpu, size, shown, reference, params);
    screen.draw(gpu);
    let picture = screen.read(gpu);
    assert!(gpu.take_fault().is_none());
    picture
}

/// What stands for a window: a pane and the texture it is drawn into.
pub struct Screen {
    pane: Pane,
    texture: wgpu::Texture,
}

impl Screen {
    pub fn new(
        gpu: &Gpu,
        [width, height]: [u32; 2],
        shown: &Shaded,
        reference: &Shaded,
        params: &DisplayParams,
    ) -> Self {
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let display = DisplayPass::new(gpu, format).expect("the display pass compiles");
        let place = PanePlace { corner: [0; 2], size: [width, height] };
        let pane = display.pane(gpu, shown, reference, params, place);
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("window"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        Self { pane, texture }
    }

    pub fn draw(&self, gpu: &Gpu) {
        let view = self.texture.create_view(&Default::default());
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                resolve_target: None,
                depth_slice: None,
                ops: wgpu::Operations::default(),
            })],
            ..Default::default()
        });
        self.pane.draw(&mut pass);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
    }

    /// What was drawn last.
    pub fn read(&self, gpu: &Gpu) -> Picture {
        let texture = &self.texture;
        let stride = (4 * texture.width()).next_multiple_of(256);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("pixels"),
            size: u64::from(stride * texture.height()),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(stride), rows_per_image: None };
        let target = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(texture.as_image_copy(), target, texture.size());
        gpu.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("mapped"));
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("polled");
        let bytes = buffer.get_mapped_range(..).expect("mapped").to_vec();
        let row = |row: &[u8]| row[..4 * texture.width() as usize].to_vec();
        let pixels: Vec<u8> = bytes.chunks(stride as usize).flat_map(row).collect();
        Picture { width: texture.width() as usize, pixels: pixels.as_chunks::<4>().0.to_vec() }
    }
}
