//! The panes on the graphics adapter: shading and drawing of what has changed, and the copy of the rest.

use std::collections::HashMap;
use std::sync::Arc;

use eframe::{egui, egui_wgpu, wgpu};

use super::shaded::{ShadedMaterial, ShadedPart, ShadingDevice, ShadingRequest};
use super::slot::Slot;
use super::uploaded::Uploaded;
use crate::error::Error;
use crate::gpu::{Blit, Display, DisplayParams, Gpu, Pane, PanePlace, Shaded, Shading, Still};

/// What a pane shows where a draft of a material will not do, until all of it is there.
const SENDING: &str = "Sending the material to the graphics adapter...";

/// The texels of a pane, or those that they are compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PaneTexels {
    /// The shaded material of this id.
    Shaded(u64),
    /// The differences given for the material of this id.
    Differences(u64),
    /// The photograph given for the material of this id.
    Photograph(u64),
}

/// What the pixels of a pane depend on.
#[derive(PartialEq)]
struct PaneKey {
    texels: [PaneTexels; 2],
    versions: [u64; 2],
    params: DisplayParams,
    place: PanePlace,
}

/// What a pane showed last.
struct KeptPane {
    of: PaneKey,
    /// Its pixels, from the second frame on that shows them.
    still: Option<Arc<Still>>,
}

/// The passes, the shaded materials and the pixels of the panes. The materials' textures are part of the materials.
pub(super) struct GpuView {
    pub gpu: Gpu,
    /// The device of the window, for pictures of it.
    pub state: egui_wgpu::RenderState,
    shading: Shading,
    display: Display,
    blit: Arc<Blit>,
    shaded: HashMap<u64, ShadedMaterial>,
    /// Differences that were computed elsewhere, of materials by their ids, each with its version.
    given: HashMap<u64, (Arc<Shaded>, u64)>,
    /// The photograph at the exposure of materials by their ids, each with its version.
    photographs: HashMap<u64, (Arc<Shaded>, u64)>,
    versions: u64,
    panes: Vec<Option<KeptPane>>,
}

impl GpuView {
    /// # Errors
    /// Where the adapter cannot build the passes.
    pub(super) fn new(state: &egui_wgpu::RenderState) -> Result<Self, Error> {
        let gpu = Gpu::from_eframe_parts(&state.adapter, &state.device, &state.queue)?;
        let shading = Shading::new(&gpu)?;
        let display = Display::new(&gpu, state.target_format)?;
        let blit = Arc::new(Blit::new(&gpu, state.target_format)?);
        Ok(Self {
            gpu,
            state: state.clone(),
            shading,
            display,
            blit,
            shaded: HashMap::new(),
            given: HashMap::new(),
            photographs: HashMap::new(),
            versions: 0,
            panes: Vec::new(),
        })
    }

    /// Shades what is `asked` of the materials in these slots, and is not there yet. Returns whether another frame is needed to
    /// show all texels of all of them.
    ///
    /// # Errors
    /// A text for the pane, where the adapter cannot hold a material.
    pub(super) fn shade(&mut self, slots: &[&Slot], asked: ShadingRequest) -> Result<bool, String> {
        let uploads: Vec<&Uploaded> = slots
            .iter()
            .map(|slot| slot.loaded.textures.as_ref().ok_or("This material has no textures: reload it"))
            .collect::<Result<_, _>>()?;
        // A pane compares texels of one size: all materials are shown in full, or none.
        let draft = uploads.iter().filter(|one| one.whole().is_none()).find_map(|one| one.draft());
        let is_whole = |slot: &&Slot| self.shaded.get(&slot.id).is_some_and(|one| one.is_whole(asked.params));
        let is_left = draft.is_none() && asked.sharpens && !slots.iter().all(is_whole);
        let part = match draft {
            Some(_) if asked.exact => return Err(SENDING.to_owned()),
            Some(draft) => ShadedPart::EveryNth(draft.stride),
            None if asked.sharpens && !is_left => ShadedPart::Whole,
            None => asked.part,
        };
        let sharpens = is_left && !asked.waits;
        let asked = ShadingRequest { part, sharpens, ..asked };
        for (slot, uploaded) in slots.iter().zip(uploads) {
            let (textures, are_reduced) = match (uploaded.whole(), uploaded.draft()) {
                (Some(Ok(textures)), _) => (textures, false),
                (Some(Err(problem)), _) => return Err(problem.clone()),
                (None, Some(draft)) => (&draft.textures, true),
                (None, None) => return Err(SENDING.to_owned()),
            };
            let Self { gpu, shading, versions, .. } = self;
            let mut device = ShadingDevice { gpu, shading, textures, are_reduced, versions };
            let material = self.shaded.entry(slot.id).or_default();
            let shaded = material.shade(&mut device, slot.loaded.material.size(), asked);
            shaded.map_err(|error| error.to_string())?;
        }
        Ok(sharpens)
    }

    /// Takes the differences of the material `id`, for panes whose difference is computed elsewhere.
    pub(super) fn give(&mut self, id: u64, differences: &Arc<Shaded>) {
        put(&mut self.given, &mut self.versions, id, differences);
    }

    /// Takes the photograph at the exposure of the material `id`.
    pub(super) fn give_photograph(&mut self, id: u64, photograph: &Arc<Shaded>) {
        put(&mut self.photographs, &mut self.versions, id, photograph);
    }

    /// These texels and their version, where they are there.
    fn texels(&self, texels: PaneTexels) -> Option<(&Shaded, u64)> {
        let (given, id) = match texels {
            PaneTexels::Shaded(id) => {
                let shown = self.shaded.get(&id).and_then(ShadedMaterial::shown)?;
                return Some((&shown.shaded, shown.version));
            }
            PaneTexels::Differences(id) => (&self.given, id),
            PaneTexels::Photograph(id) => (&self.photographs, id),
        };
        given.get(&id).map(|(given, version)| (given.as_ref(), *version))
    }

    /// Frees the shaded pictures of closed materials, and the pixels of all but the first `panes` panes.
    pub(super) fn keep_only(&mut self, slots: &[Slot], panes: usize) {
        self.shaded.retain(|id, _| slots.iter().any(|slot| slot.id == *id));
        self.given.retain(|id, _| slots.iter().any(|slot| slot.id == *id));
        self.photographs.retain(|id, _| slots.iter().any(|slot| slot.id == *id));
        self.panes.truncate(panes);
    }

    /// Draws `shown` into `rect`, with `reference` where the mode compares; both must have been shaded or given.
    ///
    /// Where pane `number` shows what it showed in the frame before, its pixels are kept and copied from then on. A pane that
    /// changes is drawn into the window at once: its pixels would be copied only once.
    pub(super) fn paint(
        &mut self,
        painter: &egui::Painter,
        rect: egui::Rect,
        number: usize,
        texels: [PaneTexels; 2],
        params: DisplayParams,
    ) {
        if self.panes.len() <= number {
            self.panes.resize_with(number + 1, || None);
        }
        let kept = self.panes[number].take();
        let [Some(shown), Some(reference)] = texels.map(|texels| self.texels(texels)) else { return };
        let place = place(rect, painter.ctx().pixels_per_point());
        let key = PaneKey { texels, versions: [shown.1, reference.1], params, place };
        let pane = |place| Arc::new(self.display.pane(&self.gpu, shown.0, reference.0, &params, place));
        let (still, drawn) = match kept {
            Some(KeptPane { of, still: Some(still) }) if of == key => {
                (Some(still.clone()), PaneDrawing::Copied(self.blit.clone(), still))
            }
            Some(KeptPane { of, still: None }) if of == key => {
                let still = Arc::new(self.blit.still(&self.gpu, place.size));
                still.draw(&self.gpu, &pane(PanePlace { corner: [0; 2], ..place }));
                (Some(still.clone()), PaneDrawing::Copied(self.blit.clone(), still))
            }
            _ => (None, PaneDrawing::Direct(pane(place))),
        };
        self.panes[number] = Some(KeptPane { of: key, still });
        painter.add(egui_wgpu::Callback::new_paint_callback(rect, drawn));
    }
}

/// The pixels that a rectangle of the window covers.
fn place(rect: egui::Rect, pixels_per_point: f32) -> PanePlace {
    let [first, end] =
        [rect.min, rect.max].map(|p| [p.x, p.y].map(|c| (c * pixels_per_point).round().max(0.0) as u32));
    PanePlace { corner: first, size: [0, 1].map(|axis| end[axis].saturating_sub(first[axis]).max(1)) }
}

/// Puts texels that were computed elsewhere in the place of `id`, with a new version where they are others.
fn put(all: &mut HashMap<u64, (Arc<Shaded>, u64)>, versions: &mut u64, id: u64, texels: &Arc<Shaded>) {
    if all.get(&id).is_some_and(|(given, _)| Arc::ptr_eq(given, texels)) {
        return;
    }
    *versions += 1;
    all.insert(id, (texels.clone(), *versions));
}

/// How a pane comes into egui's render pass.
enum PaneDrawing {
    /// Its pixels are computed.
    Direct(Arc<Pane>),
    /// Its kept pixels are copied.
    Copied(Arc<Blit>, Arc<Still>),
}

impl egui_wgpu::CallbackTrait for PaneDrawing {
    fn paint(
        &self,
        _info: egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        _resources: &egui_wgpu::CallbackResources,
    ) {
        match self {
            Self::Direct(pane) => pane.draw(pass),
            Self::Copied(blit, still) => blit.draw(pass, still),
        }
    }
}

impl std::fmt::Debug for GpuView {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("GpuView").field("gpu", &self.gpu).field("shaded", &self.shaded.len()).finish()
    }
}
