//! The panes, drawn, and what the mouse does in them.

use eframe::egui::{self, Align2, FontId, Rect, Sense, Vec2};

use super::cells::{TITLE, cells, pixel_aligned};
use super::command::Command;
use super::gestures::{self, Gesture, Target};
use super::gpu_view::GpuView;
use super::handles;
use super::panes::{Content, Hovered, Scenery};
use super::state::{self, Endpoint, Projection, ViewState};
use super::theme;
use super::title::title_bar;
use crate::gpu::{DisplayMode, DisplayParams, DisplayedDifference, ShadeParams};
use crate::material::Grid;
use crate::picture::camera::Camera;
use crate::picture::quantity::Quantity;

/// The state of the panes between frames.
#[derive(Debug, Default)]
pub struct Viewport {
    gesture: Option<Gesture>,
    /// What is under the pointer.
    pub hovered: Option<Hovered>,
    /// Size of a pane in physical pixels.
    pane_pixels: Vec2,
}

impl Viewport {
    /// Draws the panes and returns the commands of the mouse in them.
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
            note(ui, area, "No graphics adapter: materials cannot be drawn. The loss can be computed.");
            return Vec::new();
        };
        if scenery.slots.is_empty() {
            let text = if scenery.reading {
                "Reading..."
            } else {
                "Open a material with Ctrl+O, or drop files or folders here."
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
        let label = format!("Pane {}", scenery.title(content.slot));
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
            self.hovered =
                camera.plane_from_ndc(x, y).map(|point| Hovered { slot: slot_at(content, x), point });
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
            difference: content
                .difference
                .then(|| DisplayedDifference { kind: state.difference_kind(), range: scenery.range as f32 }),
            encoding: state.quantity.into(),
            show_clipping: state.show_clipping,
            epsilon: state.convention().epsilon as f32,
            background: [background[0], background[1], background[2]],
        };
        let ids = [content.slot, content.reference].map(|i| scenery.slots[i].id);
        gpu.paint(&painter, rect, ids, params);
        if content.mode == DisplayMode::Wipe(state.wipe * 2.0 - 1.0) {
            handles::paint_wipe(&painter, rect, state.wipe);
        }
        if state.quantity == Quantity::Rendering {
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

/// The slot whose value is shown at this x of a pane, from -1 to 1.
fn slot_at(content: Content, x: f32) -> usize {
    match content.mode {
        DisplayMode::Wipe(line) if x < line => content.reference,
        DisplayMode::Wipe(_) | DisplayMode::Value => content.slot,
    }
}

/// Shades every material in a pane.
fn shade(gpu: &mut GpuView, scenery: &Scenery<'_>) -> Result<(), String> {
    let state = scenery.state;
    let params = ShadeParams { scene: state.scene, convention: state.convention(), quantity: state.quantity };
    gpu.keep_only(scenery.slots);
    for content in scenery.contents() {
        for index in [content.slot, content.reference] {
            gpu.shade(&scenery.slots[index], params)?;
        }
    }
    Ok(())
}

fn paint_handles(painter: &egui::Painter, rect: Rect, camera: &Camera, state: &ViewState) {
    if state.projection == Projection::Flat
        && let Some((at, outside)) =
            handles::pos_from_plane(camera, rect, state::over_plane(&state.scene, Endpoint::View))
    {
        handles::paint_eye(painter, at, outside);
    }
    if let Some((at, outside)) =
        handles::pos_from_plane(camera, rect, state::over_plane(&state.scene, Endpoint::Light))
    {
        handles::paint_sun(painter, at, outside);
    }
}

/// A text in the middle of an empty area.
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
