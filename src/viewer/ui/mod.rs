//! User interface: input, panes, panels and dialogs. They see the model and the jobs, and return commands.
//!
//! [`WindowUi::input`] reads keys and gestures before anything is drawn; [`WindowUi::draw`] draws, and returns what was clicked.

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

use content::CentralArea;
use dataset::DatasetUi;
use dialogs::Dialogs;
use pane::viewport::Viewport;
use panels::inspection::Drawer;
use panels::status::StatusBar;
use panels::top::TopBar;
use shading::gpu_view::GpuView;
use widgets::texture::PanelTextures;
use widgets::{bare, fixed};

use crate::jobs::displayed::Displayed;
use crate::model::command::{Command, WindowCommand};
use crate::model::view::geometry::WindowGeometry;

/// Width of the side panel, in points.
const SIDE: f32 = 320.0;
/// Width of a window, in points, below which the side panel is closed until it is asked for.
const NARROW: f32 = 900.0;

/// The state of the user interface between frames.
#[derive(Debug, Default)]
pub struct WindowUi {
    pub dialogs: Dialogs,
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

    /// The commands of keys, dropped files and gestures: all that is read before the window is drawn.
    pub fn input(&mut self, ctx: &egui::Context, displayed: Displayed<'_>) -> Vec<Command> {
        let mut commands = input::commands(ctx, displayed, &self.dialogs);
        if !self.dialogs.is_open() && !displayed.model.help {
            commands.extend(self.dataset.keys(ctx, displayed));
        }
        let has_panes = !displayed.model.dataset.sheet.is_open;
        if has_panes && !self.dialogs.is_open() && !displayed.model.help {
            let scenery = content::scenery(ctx, displayed);
            commands.extend(self.viewport.gestures(ctx, &scenery));
        }
        commands
    }

    /// Draws everything and returns the commands of what was clicked and dragged in panels and dialogs.
    pub fn draw(
        &mut self,
        ui: &mut egui::Ui,
        displayed: Displayed<'_>,
        gpu: Option<&mut GpuView>,
    ) -> Vec<Command> {
        let (model, mut commands) = (displayed.model, Vec::new());
        bare(egui::Panel::top("top"), ui).show(ui, |ui| commands.extend(TopBar::new(displayed).ui(ui)));
        bare(egui::Panel::bottom("status"), ui).show(ui, |ui| commands.extend(self.status(ui, displayed)));
        let was_open = model.side_panel();
        let mut is_open = was_open;
        bare(egui::Panel::right("side"), ui).exact_size(SIDE).resizable(false).show_collapsible(
            ui,
            &mut is_open,
            // Contents that are too wide are cut off: the panel does not grow.
            |ui| commands.extend(fixed(ui, |ui| side::ui(ui, displayed, &mut self.textures))),
        );
        if is_open != was_open {
            commands.push(WindowCommand::ToggleSidePanel.into());
        }
        commands.extend(self.dataset.drawer(ui, displayed));
        // Panes stay where they are in a drag.
        if !ui.input(|i| i.pointer.any_down()) {
            self.has_drawer = !model.inspection.pins.is_empty();
        }
        if self.has_drawer && !model.dataset.sheet.is_open && model.materials.ground_truth().is_some() {
            commands.extend(Drawer::new(displayed).ui(ui));
        }
        let area = ui.available_rect_before_wrap();
        self.picture_size = [area.width(), area.height()].map(|side| (side * ui.pixels_per_point()) as u32);
        let panes = match self.dataset.sheet(ui, displayed, &mut self.textures) {
            Some(of_sheet) => {
                commands.extend(of_sheet);
                area
            }
            None => {
                let mut content = CentralArea { displayed, viewport: &mut self.viewport };
                commands.extend(content.ui(ui, gpu));
                self.viewport.area
            }
        };
        commands.extend(panels::messages::ui(ui.ctx(), panes, &model.messages));
        if model.help {
            commands.extend(input::help::ui(ui.ctx()));
        }
        commands.extend(self.dialogs.ui(ui.ctx(), displayed));
        commands
    }

    fn status(&self, ui: &mut egui::Ui, displayed: Displayed<'_>) -> Vec<Command> {
        let view = &displayed.model.view;
        let has_panes = !displayed.model.dataset.sheet.is_open;
        let hovered = self.viewport.hovered.filter(|_| has_panes);
        let grid = displayed.model.materials.ground_truth().map(|ground_truth| ground_truth.grid());
        // The pointer was over a texel in the frame before: the materials of this one may be smaller.
        let size = displayed.materials().first().map_or([0, 0], |one| one.material().size());
        let texel = hovered.and_then(|hovered| hovered.texel);
        let bar = StatusBar {
            state: view,
            materials: displayed.materials(),
            computed_maps: displayed.computed_maps().map(AsRef::as_ref),
            photographs: displayed.photographs().map(AsRef::as_ref),
            texel: texel.filter(|texel| (0..2).all(|axis| texel[axis] < size[axis])),
            hovered: hovered.map(|hovered| hovered.index),
            magnification: grid.map_or(1.0, |grid| self.viewport.magnification(grid, view)),
            is_armed: displayed.model.inspection.is_armed,
        };
        bar.ui(ui)
    }
}
