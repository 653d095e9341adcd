//! User interface: input, panes, panels and dialogs.
//!
//! [`WindowUi::input`] reads keys and gestures before anything is drawn, and edits the model. [`WindowUi::draw`] draws the model as it is
//! shown; what is clicked and dragged in panels and dialogs edits the model of the next frame.

use eframe::egui;

use crate::dataset::{self, places::DatasetUi};
use crate::error::Error;
use crate::files;
use crate::frame::content::{self, CAPTION};
use crate::frame::{blind, inspection, keys, messages, side, status, top};
use crate::jobs::{Jobs, SAVING, Shown};
use crate::model::Model;
use crate::model::view::WindowGeometry;
use crate::pane::Displayed;
use crate::pane::gpu_view::GpuView;
use crate::pane::snapshot::snapshot;
use crate::pane::viewport::Viewport;
use crate::widgets::paint::PanelTextures;
use crate::widgets::{bare, fixed};

/// Least and greatest width of the side panel, in points.
const SIDE: std::ops::RangeInclusive<f32> = 260.0..=720.0;
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
        keys::act(ctx, model, &jobs.answers);
        if model.is_modal() {
            return;
        }
        if model.blind.is_none() {
            dataset::turn_pages(ctx, model, jobs);
        }
        if !model.dataset.table.has_pictures {
            self.viewport.gestures(ctx, model);
        }
    }

    /// Draws everything that is `shown`; what is clicked and dragged in panels and dialogs edits the `next` model.
    pub fn draw(
        &mut self,
        ui: &mut egui::Ui,
        shown: &Displayed<'_>,
        next: &mut Model,
        gpu: Option<&mut GpuView>,
    ) {
        let model = shown.model;
        if let Some(blind) = &model.blind {
            bare(egui::Panel::top("blind"), ui).show(ui, |ui| blind::ui(ui, blind, next));
            return self.viewport.ui(ui, shown, next, gpu);
        }
        bare(egui::Panel::top("top"), ui).show(ui, |ui| top::ui(ui, shown.shown(), next));
        bare(egui::Panel::bottom("status"), ui)
            .show(ui, |ui| status::ui(ui, shown, &self.viewport, self.dataset.told(shown.shown()), next));
        let was_open = model.side_panel();
        let mut is_open = was_open;
        let panel = bare(egui::Panel::right("side"), ui).resizable(true).size_range(SIDE);
        let panel = panel.default_size(model.settings.side_width).show_collapsible(
            ui,
            &mut is_open,
            // Contents that are too wide are cut off: the panel does not grow.
            |ui| fixed(ui, |ui| side::ui(ui, shown, next, &mut self.textures)),
        );
        if let Some(panel) = panel.filter(|_| was_open && is_open) {
            next.settings.side_width = panel.response.rect.width();
        }
        if is_open != was_open {
            next.toggle_side_panel();
        }
        let is_table = self.dataset.ui(ui, shown.shown(), next, &mut self.textures);
        let area = ui.available_rect_before_wrap();
        let height = area.height() - content::reserve(shown, area.height());
        self.picture_size = [area.width(), height].map(|side| (side * ui.pixels_per_point()) as u32);
        let panes = if is_table {
            area
        } else {
            content::ui(ui, shown, next, &mut self.viewport, gpu);
            let panes = self.viewport.area.unwrap_or(area);
            if !model.inspection.pins.is_empty() && model.materials.ground_truth().is_some() {
                inspection::drawer(ui, panes, shown, next);
            }
            panes
        };
        messages::ui(ui.ctx(), panes, &model.messages, next);
        if model.help {
            keys::help(ui.ctx(), &mut next.help);
        }
        files::open::ui(ui.ctx(), next);
        files::save::ui(ui.ctx(), shown.jobs.edits.get(SAVING), next);
    }
}

impl WindowUi {
    /// The panes and the legend in a picture.
    ///
    /// # Errors
    /// As [`snapshot`]; an internal one without an adapter.
    pub fn picture(
        &mut self,
        ctx: &egui::Context,
        displayed: Displayed<'_>,
        gpu: Option<&mut GpuView>,
    ) -> Result<egui::ColorImage, Error> {
        let Some(view) = gpu else {
            return Err(Error::internal("there is no graphics adapter to draw the view"));
        };
        let (state, gpu, dark) = (view.state.clone(), view.gpu.clone(), displayed.model.settings.dark);
        // Gestures and controls stay in the window.
        let picture = displayed.picture();
        let mut viewport = self.viewport.exact();
        let scale = ctx.pixels_per_point();
        let [width, height] = self.picture_size;
        let added = CAPTION + content::legend_height(&picture) - content::legend_height(&displayed);
        let size = [width, height + (added * scale) as u32];
        Ok(snapshot(&state, &gpu, (size, scale), dark, |ui| {
            content::ui(ui, &picture, &mut picture.model.clone(), &mut viewport, Some(view));
        })?)
    }
}

/// What effects and results change.
#[derive(Debug)]
pub struct Parts {
    pub model: Model,
    pub jobs: Jobs,
    pub ui: WindowUi,
    /// `None` where there is no adapter.
    pub gpu: Option<GpuView>,
}

impl Parts {
    /// Asks for all that is being read, so that this frame does not cancel it, and begins with the rest.
    pub fn begin_to_read(&self) {
        self.model.materials.openings.iter().for_each(|opening| drop(self.jobs.read(opening)));
    }

    /// What the panes display.
    pub fn displayed(&self) -> Displayed<'_> {
        Displayed::ask(Shown { model: &self.model, jobs: &self.jobs })
    }
}
