//! Properties of a graphics adapter.

use std::fmt;

use wgpu::{Adapter, Backend, DeviceType, TextureFormat, TextureUsages};

use svbrdf_core::error::Error;

/// What to do where there is no adapter.
pub(super) const NO_ADAPTER_REMEDY: &str = "install a Vulkan driver (on Debian and Ubuntu \
    `apt-get install mesa-vulkan-drivers`, which has a software one), unset WGPU_BACKEND, or use the CPU";

/// What is used, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct AdapterReport {
    /// As the driver calls the adapter.
    pub name: String,
    /// Vulkan, Metal, DX12 or GL.
    pub backend: String,
    /// The driver and its version.
    pub driver: String,
    /// Whether it computes on the CPU.
    pub software: bool,
    /// Why this adapter, in a few words; empty for one that is not taken.
    pub reason: String,
    /// What pass 1 writes: 32-bit floats where the adapter can.
    pub shading_format: TextureFormat,
    /// What the adapter cannot do, and what that means.
    pub limits_note: Option<String>,
    /// Largest width and height of a material, in texels.
    pub max_texture_side: u32,
}

impl fmt::Display for AdapterReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, backend, driver, reason, .. } = self;
        let kind = if self.software { "software" } else { "hardware" };
        write!(f, "{name} ({kind}, {backend}, driver {driver})")?;
        if !reason.is_empty() {
            write!(f, ": {reason}")?;
        }
        match &self.limits_note {
            Some(note) => write!(f, "; {note}"),
            None => Ok(()),
        }
    }
}

impl AdapterReport {
    pub(super) fn new(adapter: &Adapter, reason: String, max_texture_side: u32) -> Result<Self, Error> {
        let info = adapter.get_info();
        let (shading_format, limits_note) = shading_format(adapter)?;
        Ok(Self {
            name: info.name,
            backend: backend_name(info.backend).to_owned(),
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            software: info.device_type == DeviceType::Cpu,
            reason,
            shading_format,
            limits_note,
            max_texture_side,
        })
    }
}

/// What pass 1 writes on this adapter, and what is lost if that is not 32-bit floats.
fn shading_format(adapter: &Adapter) -> Result<(TextureFormat, Option<String>), Error> {
    let renderable = |format: TextureFormat| {
        adapter.get_texture_format_features(format).allowed_usages.contains(TextureUsages::RENDER_ATTACHMENT)
    };
    if renderable(TextureFormat::Rgba32Float) {
        return Ok((TextureFormat::Rgba32Float, None));
    }
    if renderable(TextureFormat::Rgba16Float) {
        let note = "it cannot render to 32-bit floats: pictures are shown in 16-bit floats (3 digits, at most \
            65504), and offscreen renderings need the CPU";
        return Ok((TextureFormat::Rgba16Float, Some(note.to_owned())));
    }
    Err(Error::NoAdapter {
        problem: format!("{} cannot render to floats", adapter.get_info().name),
        remedy: NO_ADAPTER_REMEDY,
    })
}

pub(super) fn backend_name(backend: Backend) -> &'static str {
    match backend {
        Backend::Vulkan => "Vulkan",
        Backend::Metal => "Metal",
        Backend::Dx12 => "DX12",
        Backend::Gl => "GL",
        Backend::BrowserWebGpu => "WebGPU",
        Backend::Noop => "none",
    }
}
