//! User interface: input, panes, panels and dialogs.
//!
//! [`WindowUi::input`] reads keys and gestures before anything is drawn, and edits the model. [`WindowUi::draw`] draws the model as it is
//! shown; what is clicked and dragged in panels and dialogs edits the model of the next frame.

pub mod content;
pub mod dataset;
pub mod dialogs;
pub mod input;
pub mod legend;
pub mod loss;
pub mod materials;
pub mod pane;
pub mod panels;
pub mod photograph;
pub mod shading;
pub mod side;
pub mod snapshot;
pub mod why;
pub mod widgets;

use eframe::egui;

use dataset::DatasetUi;
use pane::viewport::Viewport;
use panels::status::StatusBar;
use shading::gpu_view::GpuView;
use widgets::texture::PanelTextures;
use widgets::{bare, fixed};

use crate::jobs::Jobs;
use crate::jobs::displayed::Displayed;
use crate::model::Model;
use crate::model::view::geometry::WindowGeometry;

/// Width of the side panel, in points.
const SIDE: f32 = 320.0;
/// Width of a window, in points, below which the side panel is closed until it is asked for.
const NARROW: f32 = 900.0;

/// The state of the user interface between frames.
#[derive(Debug, Default)]
pub struct WindowUi {
    viewport: Viewport,
    textures: PanelTextures,
    pub dataset: DatasetUi,
    /// Size of the panes and the legend, in pixels.
    picture_size: [u32; 2],
    /// Whether the drawer is there.
    has_drawer: bool,
}

impl WindowUi {
    /// What the last frame measured.
    pub fn geometry(&self, ctx: &egui::Context) -> WindowGeometry {
        WindowGeometry {
            pane: self.viewport.pane_pixels(),
            picture: self.picture_size,
            window: (ctx.content_rect().size() * ctx.zoom_factor()).into(),
            is_narrow: ctx.content_rect().width() < NARROW,
            texel: self.viewport.last_texel,
        }
    }

    /// Carries out keys, dropped files and gestures: all that is read before the window is drawn.
    pub fn input(&mut self, ctx: &egui::Context, model: &mut Model, jobs: &Jobs) {
        input::act(ctx, model, jobs);
        if model.is_modal() {
            return;
        }
        self.dataset.turn_pages(ctx, model, jobs);
        if !model.dataset.sheet.is_open {
            self.viewport.gestures(ctx, model);
        }
    }

    /// Draws everything that is `shown`; what is clicked and dragged in panels and dialogs edits the `next` model.
    pub fn draw(
        &mut self,
        ui: &mut egui::Ui,
        shown: Displayed<'_>,
        next: &mut Model,
        gpu: Option<&mut GpuView>,
    ) {
        let model = shown.model;
        bare(egui::Panel::top("top"), ui).show(ui, |ui| panels::top::ui(ui, model, next));
        bare(egui::Panel::bottom("status"), ui).show(ui, |ui| self.status(ui, shown, next));
        let was_open = model.side_panel();
        let mut is_open = was_open;
        bare(egui::Panel::right("side"), ui).exact_size(SIDE).resizable(false).show_collapsible(
            ui,
            &mut is_open,
            // Contents that are too wide are cut off: the panel does not grow.
            |ui| fixed(ui, |ui| side::ui(ui, shown, next, &mut self.textures)),
        );
        if is_open != was_open {
            next.toggle_side_panel();
        }
        self.dataset.drawer(ui, shown, next);
        // Panes stay where they are in a drag.
        if !ui.input(|i| i.pointer.any_down()) {
            self.has_drawer = !model.inspection.pins.is_empty();
        }
        if self.has_drawer && !model.dataset.sheet.is_open && model.materials.ground_truth().is_some() {
            panels::inspection::drawer(ui, shown, next);
        }
        let area = ui.available_rect_before_wrap();
        self.picture_size = [area.width(), area.height()].map(|side| (side * ui.pixels_per_point()) as u32);
        let panes = if self.dataset.sheet(ui, shown, next, &mut self.textures) {
            area
        } else {
            content::ui(ui, shown, next, &mut self.viewport, gpu);
            self.viewport.area
        };
        panels::messages::ui(ui.ctx(), panes, &model.messages, next);
        if model.help {
            input::help::ui(ui.ctx(), &mut next.help);
        }
        dialogs::ui(ui.ctx(), shown, next);
    }

    fn status(&self, ui: &mut egui::Ui, shown: Displayed<'_>, next: &mut Model) {
        let view = &shown.model.view;
        let has_panes = !shown.model.dataset.sheet.is_open;
        let hovered = self.viewport.hovered.filter(|_| has_panes);
        let grid = shown.model.materials.ground_truth().map(|ground_truth| ground_truth.grid());
        // The pointer was over a texel in the frame before: the materials of this one may be smaller.
        let size = shown.materials().first().map_or([0, 0], |one| one.material().size());
        let texel = hovered.and_then(|hovered| hovered.texel);
        let bar = StatusBar {
            state: view,
            materials: shown.materials(),
            computed_maps: shown.computed_maps().map(AsRef::as_ref),
            photographs: shown.photographs().map(AsRef::as_ref),
            texel: texel.filter(|texel| (0..2).all(|axis| texel[axis] < size[axis])),
            hovered: hovered.map(|hovered| hovered.index),
            magnification: grid.map_or(1.0, |grid| self.viewport.magnification(grid, view)),
        };
        bar.ui(ui, next);
    }
}
