//! GPU view: shading and drawing of the panes that have changed, and the copy of the others.

use std::collections::HashMap;
use std::sync::Arc;

use eframe::{egui, egui_wgpu, wgpu};

use svbrdf_core::error::Error;
use svbrdf_gpu::{
    Blit, DisplayParams, DisplayPass, Gpu, Pane, PanePlace, Shaded, Shading, Still, texels_a_pixel,
};

use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::MaterialId;
use crate::model::material::textures::SentTextures;
use crate::pane::shaded::{ShadedMaterial, ShadedPart, ShadingDevice, ShadingRequest};

/// Texels of all materials that are sharpened in a frame: of new materials, whose light nobody drags yet, and of others.
const SHARPENED_FIRST: usize = 1 << 21;
const SHARPENED: usize = 1 << 20;

/// Greatest stride for lack of memory of the adapter.
const MOST_REDUCED: usize = 32;

/// From how many texels a pixel on the pixels of a pane are kept from its first frame on.
const MANY: f32 = 16.0;

/// Why materials are not shaded, as a text for the pane.
enum ShadingError {
    /// The adapter has no room for their pictures.
    NoRoom(String),
    /// Their maps are not on the adapter.
    NotThere(String),
}

/// The texels of a pane, or those that they are compared with.
#[derive(Clone, Debug)]
pub enum PaneTexels {
    Shaded(MaterialId),
    /// Those that were computed elsewhere.
    Given(Arc<Shaded>),
}

impl PartialEq for PaneTexels {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Shaded(one), Self::Shaded(other)) => one == other,
            (Self::Given(one), Self::Given(other)) => Arc::ptr_eq(one, other),
            _ => false,
        }
    }
}

/// What the pixels of a pane depend on.
#[derive(PartialEq)]
struct PaneKey {
    texels: [PaneTexels; 2],
    versions: [u64; 2],
    params: DisplayParams,
    place: PanePlace,
}

/// What a pane displayed last.
struct SavedPane {
    of: PaneKey,
    /// Its pixels, from the second frame on that shows them.
    still: Option<Arc<Still>>,
}

/// The passes, the shaded materials and the pixels of the panes. The materials' textures are part of the materials.
pub struct GpuView {
    pub gpu: Gpu,
    /// The device of the window, for pictures of it.
    pub state: egui_wgpu::RenderState,
    shading: Shading,
    display: DisplayPass,
    blit: Arc<Blit>,
    shaded: HashMap<MaterialId, ShadedMaterial>,
    /// The smallest stride of pictures for which the adapter has room, and the materials for which that was found.
    least_stride: usize,
    reduced_for: Vec<MaterialId>,
    reduction: usize,
    versions: u64,
    panes: Vec<Option<SavedPane>>,
}

impl GpuView {
    /// # Errors
    /// Where the adapter cannot build the passes.
    pub fn new(state: &egui_wgpu::RenderState) -> Result<Self, Error> {
        let gpu = Gpu::from_eframe_parts(&state.adapter, &state.device, &state.queue)?;
        let shading = Shading::new(&gpu)?;
        let display = DisplayPass::new(&gpu, state.target_format)?;
        let blit = Arc::new(Blit::new(&gpu, state.target_format)?);
        Ok(Self {
            gpu,
            state: state.clone(),
            shading,
            display,
            blit,
            shaded: HashMap::new(),
            least_stride: 1,
            reduced_for: Vec::new(),
            reduction: 1,
            versions: 0,
            panes: Vec::new(),
        })
    }

    /// Shades what is requested of these materials, and is not there yet. Returns whether another frame is needed to
    /// show all texels of all of them. Where the adapter has no room for all texels, every n-th is shown: [`Self::reduction`].
    ///
    /// # Errors
    /// A text for the pane, where the adapter cannot hold a material.
    pub fn shade(&mut self, materials: &[&LoadedMaterial], request: ShadingRequest) -> Result<bool, String> {
        loop {
            match self.shade_at_reduction(materials, request) {
                Err(ShadingError::NoRoom(_)) if !request.exact && self.least_stride < MOST_REDUCED => {
                    self.least_stride *= 2;
                    self.shaded.clear();
                }
                Err(ShadingError::NoRoom(text) | ShadingError::NotThere(text)) => return Err(text),
                Ok(is_left) => return Ok(is_left),
            }
        }
    }

    /// Every how many texels along an axis one is shown, for lack of memory of the adapter: 1 where all are.
    pub fn reduction(&self) -> usize {
        self.reduction
    }

    fn shade_at_reduction(
        &mut self,
        materials: &[&LoadedMaterial],
        request: ShadingRequest,
    ) -> Result<bool, ShadingError> {
        // A pane compares texels of one size: all materials are shown in full, or none.
        let uploads = materials.iter().filter_map(|one| one.read.uploaded.as_ref());
        let strides = uploads.filter_map(|one| one.sent.as_ref()).map(|sent| sent.stride);
        let stride = strides.fold(self.least_stride, usize::max);
        self.reduction = stride;
        let is_whole = |one: &&LoadedMaterial| {
            self.shaded.get(&one.id()).is_some_and(|one| one.is_whole(request.params))
        };
        let is_left = stride == 1 && request.sharpens && !materials.iter().all(is_whole);
        let part = match stride {
            1 if request.sharpens && !is_left => ShadedPart::Whole,
            1 => request.part,
            stride => ShadedPart::EveryNth(stride),
        };
        let sharpens = is_left && !request.waits;
        let part_request = ShadingRequest { part, sharpens, ..request };
        for material in materials {
            let is_usable = |one: &&SentTextures| one.stride == 1 || one.stride == stride && !request.exact;
            let uploaded = material.read.uploaded.as_ref();
            let Some(sent) = uploaded.and_then(|one| one.sent.as_ref()).filter(is_usable) else {
                let problem = uploaded.and_then(|one| one.problem.clone());
                return Err(ShadingError::NotThere(problem.unwrap_or_default()));
            };
            let (textures, are_reduced) = (&sent.textures, sent.stride > 1);
            let Self { gpu, shading, versions, .. } = self;
            let shaded = self.shaded.entry(material.id()).or_default();
            let band = if shaded.is_new() { SHARPENED_FIRST } else { SHARPENED } / materials.len();
            let mut device = ShadingDevice { gpu, shading, textures, are_reduced, band, versions };
            let size = material.material().size();
            let shaded = shaded.shade(&mut device, size, part_request);
            shaded.map_err(|error| ShadingError::NoRoom(error.to_string()))?;
        }
        Ok(sharpens)
    }

    /// These texels and their version, where they are there.
    fn texels<'a>(&'a self, texels: &'a PaneTexels) -> Option<(&'a Shaded, u64)> {
        match texels {
            PaneTexels::Shaded(id) => {
                let texels = self.shaded.get(id).and_then(ShadedMaterial::displayed)?;
                Some((&texels.shaded, texels.version))
            }
            PaneTexels::Given(texels) => Some((texels, 0)),
        }
    }

    /// Frees the shaded pictures of closed materials, and the pixels of all but the first `panes` panes.
    pub fn keep_only(&mut self, materials: &[LoadedMaterial], panes: usize) {
        if !materials.iter().map(LoadedMaterial::id).eq(self.reduced_for.iter().copied()) {
            (self.least_stride, self.reduced_for) = (1, materials.iter().map(LoadedMaterial::id).collect());
        }
        let is_here = |id: &MaterialId| materials.iter().any(|one| one.id() == *id);
        self.shaded.retain(|id, _| is_here(id));
        self.panes.truncate(panes);
    }

    /// Draws the first of `texels` into `rect`, with the second where the mode compares; both must be there.
    ///
    /// Where pane `number` shows what it showed in the frame before, its pixels are kept and copied from then on. A pane that
    /// changes is drawn into the window at once, since its pixels would be copied only once; one of many texels a pixel, each of
    /// which is averaged, is kept from its first frame on.
    pub fn paint(
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
        let last = self.panes[number].take();
        let [Some(displayed), Some(reference)] = texels.each_ref().map(|one| self.texels(one)) else {
            return;
        };
        let place = place(rect, painter.ctx().pixels_per_point());
        let key = PaneKey { texels: texels.clone(), versions: [displayed.1, reference.1], params, place };
        let pane = |place| Arc::new(self.display.pane(&self.gpu, displayed.0, reference.0, &params, place));
        let (still, drawn) = match last {
            Some(SavedPane { of, still: Some(still) }) if of == key => {
                (Some(still.clone()), PaneDrawing::Copied(self.blit.clone(), still))
            }
            last if last.as_ref().is_some_and(|last| last.of == key)
                || texels_a_pixel(&params, displayed.0, place.size).is_some_and(|texels| texels > MANY) =>
            {
                let still = Arc::new(self.blit.still(&self.gpu, place.size));
                still.draw(&self.gpu, &pane(PanePlace { corner: [0; 2], ..place }));
                (Some(still.clone()), PaneDrawing::Copied(self.blit.clone(), still))
            }
            _ => (None, PaneDrawing::Direct(pane(place))),
        };
        self.panes[number] = Some(SavedPane { of: key, still });
        painter.add(egui_wgpu::Callback::new_paint_callback(rect, drawn));
    }
}

/// The pixels that a rectangle of the window covers.
fn place(rect: egui::Rect, pixels_per_point: f32) -> PanePlace {
    let [first, end] =
        [rect.min, rect.max].map(|p| [p.x, p.y].map(|c| (c * pixels_per_point).round().max(0.0) as u32));
    PanePlace { corner: first, size: [0, 1].map(|axis| end[axis].saturating_sub(first[axis]).max(1)) }
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
