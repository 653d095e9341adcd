//! The panes on the graphics adapter: shading of what has changed, and drawing.

use std::collections::HashMap;
use std::sync::Arc;

use eframe::{egui, egui_wgpu, wgpu};

use super::slots::Slot;
use crate::error::Error;
use crate::gpu::{Display, DisplayParams, Gpu, Pane, ShadeParams, Shaded, Shading};

/// The shaded texels of one material and what they were shaded with.
struct Entry {
    target: Shaded,
    drawn: Option<ShadeParams>,
}

/// The passes and the shaded materials. The materials' textures are part of the materials.
pub struct GpuView {
    pub gpu: Gpu,
    /// The device of the window, for pictures of it.
    pub state: egui_wgpu::RenderState,
    shading: Shading,
    display: Arc<Display>,
    shaded: HashMap<u64, Entry>,
}

impl GpuView {
    /// # Errors
    /// Where the adapter cannot build the passes.
    pub fn new(state: &egui_wgpu::RenderState) -> Result<Self, Error> {
        let gpu = Gpu::from_eframe_parts(&state.adapter, &state.device, &state.queue)?;
        let shading = Shading::new(&gpu)?;
        let display = Arc::new(Display::new(&gpu, state.target_format)?);
        Ok(Self { gpu, state: state.clone(), shading, display, shaded: HashMap::new() })
    }

    /// Shades the material of `slot`, unless it has been shaded with these parameters.
    ///
    /// # Errors
    /// A text for the pane, where the adapter cannot hold the material.
    pub fn shade(&mut self, slot: &Slot, params: ShadeParams) -> Result<(), String> {
        let textures = match &slot.loaded.textures {
            Some(Ok(textures)) => textures,
            Some(Err(problem)) => return Err(problem.clone()),
            None => return Err("This material has no textures: reload it".to_owned()),
        };
        let entry = match self.shaded.entry(slot.id) {
            std::collections::hash_map::Entry::Occupied(entry) => entry.into_mut(),
            std::collections::hash_map::Entry::Vacant(entry) => {
                let target =
                    self.shading.target(&self.gpu, slot.loaded.material.size()).map_err(|e| e.to_string())?;
                entry.insert(Entry { target, drawn: None })
            }
        };
        if entry.drawn != Some(params) {
            self.shading.draw(&self.gpu, textures, &params, &entry.target);
            entry.drawn = Some(params);
        }
        Ok(())
    }

    /// Frees the shaded pictures of closed materials.
    pub fn keep_only(&mut self, slots: &[Slot]) {
        self.shaded.retain(|id, _| slots.iter().any(|slot| slot.id == *id));
    }

    /// Draws `shown` into `rect`, with `reference` where the mode compares; both must have been shaded.
    pub fn paint(
        &self,
        painter: &egui::Painter,
        rect: egui::Rect,
        [shown, reference]: [u64; 2],
        params: DisplayParams,
    ) {
        let (Some(shown), Some(reference)) = (self.shaded.get(&shown), self.shaded.get(&reference)) else {
            return;
        };
        let pane = self.display.pane(&self.gpu, &shown.target, &reference.target);
        let draw = DrawPane { display: self.display.clone(), pane, params };
        painter.add(egui_wgpu::Callback::new_paint_callback(rect, draw));
    }
}

/// One pane of one frame, in egui's render pass.
struct DrawPane {
    display: Arc<Display>,
    pane: Pane,
    params: DisplayParams,
}

impl egui_wgpu::CallbackTrait for DrawPane {
    fn prepare(
        &self,
        _device: &wgpu::Device,
        queue: &wgpu::Queue,
        _screen: &egui_wgpu::ScreenDescriptor,
        _encoder: &mut wgpu::CommandEncoder,
        _resources: &mut egui_wgpu::CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        self.pane.write(queue, &self.params);
        Vec::new()
    }

    fn paint(
        &self,
        _info: egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        _resources: &egui_wgpu::CallbackResources,
    ) {
        self.display.draw(pass, &self.pane);
    }
}

impl std::fmt::Debug for GpuView {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("GpuView").field("gpu", &self.gpu).field("shaded", &self.shaded.len()).finish()
    }
}
