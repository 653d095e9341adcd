//! The panes: which there are, where they lie, what each shows.

use eframe::egui::{self, Align2, FontId, Rect, Sense, Vec2};

use super::cells::{TITLE, cells, pixel_aligned};
use super::command::Command;
use super::gestures::{self, Gesture, Target};
use super::gpu_view::GpuView;
use super::handles;
use super::legend;
use super::slots::Slot;
use super::state::{self, End, Layout, Projection, ViewState};
use super::theme;
use super::title::title_bar;
use crate::gpu::{DisplayMode, DisplayParams, ShadeParams};
use crate::material::Grid;
use crate::picture::camera::Camera;
use crate::picture::content::Shown;

/// What the panes need to know, for one frame.
#[derive(Debug)]
pub struct Scenery<'a> {
    pub slots: &'a [Slot],
    pub state: &'a ViewState,
    pub dark: bool,
    pub highlight_follows: bool,
    /// Whether every pane shows the ground truth for the moment.
    pub peek: bool,
    /// Whether the chosen prediction and the ground truth have changed places.
    pub swapped: bool,
    /// Whether materials are being read.
    pub reading: bool,
}

/// What outlives a frame.
#[derive(Debug, Default)]
pub struct Viewport {
    gesture: Option<Gesture>,
    /// The point of the plane under the pointer.
    pub hovered: Option<[f32; 2]>,
    /// Size of a pane in physical pixels.
    pane_pixels: Vec2,
}

/// One pane: the slot it shows, the slot it is compared with, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Content {
    pub shown: usize,
    pub reference: usize,
    pub mode: DisplayMode,
}

impl Scenery<'_> {
    /// The slot that the chosen prediction is in; the ground truth's where there is no prediction.
    pub fn chosen(&self) -> usize {
        (self.state.prediction + 1).min(self.slots.len().saturating_sub(1))
    }

    /// The slot that is seen where slot `index` would be.
    fn seen(&self, index: usize) -> usize {
        match index {
            _ if self.peek => 0,
            0 if self.swapped => self.chosen(),
            i if self.swapped && i == self.chosen() => 0,
            i => i,
        }
    }

    fn contents(&self) -> Vec<Content> {
        let alone = |shown, mode| Content { shown, reference: 0, mode };
        let chosen = self.seen(self.chosen());
        match self.state.layout {
            Layout::SideBySide => {
                (0..self.slots.len()).map(|i| alone(self.seen(i), DisplayMode::Shown)).collect()
            }
            Layout::Single => vec![alone(chosen, DisplayMode::Shown)],
            Layout::Difference => vec![alone(chosen, DisplayMode::Difference)],
            Layout::Wipe => vec![Content {
                shown: chosen,
                reference: self.seen(0),
                mode: DisplayMode::Wipe(self.state.wipe * 2.0 - 1.0),
            }],
        }
    }

    fn camera(&self, grid: Grid, aspect: f32) -> Camera {
        let fitted = match self.state.projection {
            Projection::Flat => Camera::flat(grid, aspect),
            Projection::Perspective => Camera::of_scene(&self.state.scene, grid, aspect),
        };
        fitted.zoomed(self.state.zoom, self.state.pan)
    }

    /// The name of slot `index` as titles give it.
    pub fn title(&self, index: usize) -> String {
        let name = self.slots[index].name();
        if index == 0 { format!("GROUND TRUTH  {name}") } else { format!("{index}  {name}") }
    }
}

impl Viewport {
    /// Shows the panes and returns what a person does in them.
    pub fn ui(
        &mut self,
        ui: &mut egui::Ui,
        scenery: &Scenery<'_>,
        gpu: Option<&mut GpuView>,
    ) -> Vec<Command> {
        let area = ui.available_rect_before_wrap();
        ui.painter().rect_filled(area, 0.0, theme::surround(scenery.dark));
        self.hovered = None;
        let Some(gpu) = gpu else {
            note(ui, area, "No graphics adapter: nothing can be drawn. The loss works.");
            return Vec::new();
        };
        if scenery.slots.is_empty() {
            let text = if scenery.reading {
                "Reading..."
            } else {
                "Open a material: Ctrl+O, or drop files or folders here."
            };
            note(ui, area, text);
            return Vec::new();
        }
        if let Err(problem) = shade(gpu, scenery) {
            note(ui, area, &problem);
            return Vec::new();
        }
        let contents = scenery.contents();
        let grid = scenery.slots[0].loaded.material.grid();
        let cells = cells(area, contents.len(), grid, ui.pixels_per_point());
        let mut commands = Vec::new();
        for (i, (content, cell)) in contents.into_iter().zip(cells).enumerate() {
            commands.extend(self.pane(ui, scenery, gpu, i, content, cell));
        }
        commands
    }

    fn pane(
        &mut self,
        ui: &mut egui::Ui,
        scenery: &Scenery<'_>,
        gpu: &GpuView,
        number: usize,
        content: Content,
        cell: Rect,
    ) -> Vec<Command> {
        let mut commands = Vec::new();
        let (title, rect) = cell.split_top_bottom_at_y(cell.top() + TITLE);
        commands.extend(title_bar(ui, scenery, number, content, title));
        let rect = pixel_aligned(ui, rect);
        self.pane_pixels = rect.size() * ui.pixels_per_point();

        let response = ui.interact(rect, ui.scope_id().with(("pane", number)), Sense::drag());
        let label = format!("Pane {}", scenery.title(content.shown));
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &label));
        let camera = scenery.camera(scenery.slots[0].loaded.material.grid(), rect.width() / rect.height());
        self.paint(ui, scenery, gpu, content, rect, camera);

        let target = Target {
            rect,
            camera: &camera,
            state: scenery.state,
            highlight_follows: scenery.highlight_follows,
        };
        commands.extend(gestures::commands(ui, &response, &target, &mut self.gesture));
        let pointer = response.hover_pos().or_else(|| response.interact_pointer_pos());
        if let Some(pos) = pointer {
            let [x, y] = handles::ndc_from_pos(rect, pos);
            self.hovered = camera.plane_from_ndc(x, y);
        }
        commands
    }

    fn paint(
        &self,
        ui: &egui::Ui,
        scenery: &Scenery<'_>,
        gpu: &GpuView,
        content: Content,
        rect: Rect,
        camera: Camera,
    ) {
        let state = scenery.state;
        let painter = ui.painter_at(rect);
        let background = theme::surround(scenery.dark).to_normalized_gamma_f32();
        let params = DisplayParams {
            camera,
            exposure_ev: state.exposure_ev,
            mode: content.mode,
            encoding: state.shown.into(),
            show_clipping: state.show_clipping,
            epsilon: state.convention().epsilon as f32,
            background: [background[0], background[1], background[2]],
        };
        let ids = [content.shown, content.reference].map(|i| scenery.slots[i].id);
        gpu.paint(&painter, rect, ids, params);
        if content.mode == DisplayMode::Wipe(state.wipe * 2.0 - 1.0) {
            handles::paint_wipe(&painter, rect, state.wipe);
        }
        if content.mode == DisplayMode::Difference {
            legend::paint(&painter, rect, state);
        }
        if state.shown == Shown::Rendering {
            paint_handles(&painter, rect, &camera, state);
        }
    }

    /// The magnification at which a texel of `grid` covers one physical pixel.
    pub fn one_to_one_zoom(&self, grid: Grid) -> f32 {
        let [half_width, _] = grid.half_extent();
        let aspect = self.pane_pixels.x / self.pane_pixels.y;
        let fitted = Camera::flat(grid, aspect).origin_right.x;
        let pixels_per_texel = self.pane_pixels.x * half_width / fitted / grid.width as f32;
        if pixels_per_texel.is_finite() && pixels_per_texel > 0.0 { pixels_per_texel.recip() } else { 1.0 }
    }
}

/// Shades every material that a pane shows.
fn shade(gpu: &mut GpuView, scenery: &Scenery<'_>) -> Result<(), String> {
    let state = scenery.state;
    let params = ShadeParams { scene: state.scene, convention: state.convention(), shown: state.shown };
    gpu.keep_only(scenery.slots);
    for content in scenery.contents() {
        for index in [content.shown, content.reference] {
            gpu.shade(&scenery.slots[index], params)?;
        }
    }
    Ok(())
}

fn paint_handles(painter: &egui::Painter, rect: Rect, camera: &Camera, state: &ViewState) {
    if state.projection == Projection::Flat
        && let Some((at, outside)) =
            handles::pos_from_plane(camera, rect, state::foot(&state.scene, End::View))
    {
        handles::paint_eye(painter, at, outside);
    }
    if let Some((at, outside)) = handles::pos_from_plane(camera, rect, state::foot(&state.scene, End::Light))
    {
        handles::paint_sun(painter, at, outside);
    }
}

/// A sentence in the middle of an empty area.
fn note(ui: &egui::Ui, area: Rect, text: &str) {
    let galley = ui.painter().layout(
        text.to_owned(),
        FontId::proportional(15.0),
        egui::Color32::from_gray(235),
        area.width() * 0.8,
    );
    let rect = Align2::CENTER_CENTER.anchor_size(area.center(), galley.size());
    ui.painter().galley(rect.min, galley, egui::Color32::from_gray(235));
}
