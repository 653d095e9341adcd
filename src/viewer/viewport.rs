//! The panes, drawn, and what the mouse does in them.

use std::collections::BTreeSet;

use eframe::egui::{self, Rect, Sense, Vec2};

use super::cells::{TITLE, cells, free_cell, picture_rect};
use super::command::Command;
use super::gestures::{self, Gesture, PaneTarget};
use super::gpu_view::GpuView;
use super::handles;
use super::hovered::Hovered;
use super::marks::Placed;
use super::pace::{Pace, PaneView, REST};
use super::pane_texels::texels;
use super::pane_text::{note, paint_hint};
use super::panes::{Content, PhotographUse, Scenery};
use super::readout::{self, Readout};
use super::shaded::{BAND, ShadedPart, ShadingRequest};
use super::sight;
use super::slot::Slot;
use super::state::{Projection, ViewState};
use super::theme;
use super::title::title_bar;
use super::visible::shaded_part;
use crate::gpu::{DisplayMode, DisplayParams, DisplayedDifference, ShadeParams};
use crate::material::Grid;
use crate::picture::camera::Camera;
use crate::picture::quantity::Quantity;

/// The state of the panes between frames.
#[derive(Debug, Default)]
pub(super) struct Viewport {
    gesture: Option<Gesture>,
    /// What is under the pointer.
    pub hovered: Option<Hovered>,
    /// The texel that was under the pointer last.
    pub last_texel: Option<[usize; 2]>,
    pace: Pace,
    /// Whether pixels show the nearest of their texels: while something moves on a slow adapter.
    is_draft: bool,
    /// Whether everything is shaded in full at once, for pictures that are saved.
    exact: bool,
    /// Whether the difference or the value of the chosen prediction fills an empty place.
    pub shows_extra: bool,
    /// Size of a pane in physical pixels.
    pane_pixels: Vec2,
}

impl Viewport {
    /// Panes that are shaded in full before they are drawn.
    pub(super) fn exact() -> Self {
        Self { exact: true, ..Self::default() }
    }

    /// Draws the panes and returns the commands of the mouse in them.
    pub(super) fn ui(
        &mut self,
        ui: &mut egui::Ui,
        scenery: &Scenery<'_>,
        gpu: Option<&mut GpuView>,
    ) -> Vec<Command> {
        let area = ui.available_rect_before_wrap();
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
        let contents = scenery.contents();
        let grid = scenery.slots[0].loaded.material.grid();
        let cells = cells(area, scenery.undivided, contents.len(), grid, ui.pixels_per_point());
        if let Some(cell) = cells.first() {
            self.pane_pixels = picture_rect(ui, *cell).size() * ui.pixels_per_point();
        }
        if let Err(problem) = self.shade(ui, gpu, scenery, &contents) {
            note(ui, area, &problem);
            return Vec::new();
        }
        let free = free_cell(area, &cells);
        let mut panes: Vec<(Content, Rect)> = contents.into_iter().zip(cells).collect();
        let extra = scenery.extra().zip(free);
        self.shows_extra = extra.is_some();
        panes.extend(extra);
        let mut on_material = panes.iter().filter(|(content, _)| scenery.corner_editor(*content).is_none());
        self.hovered = on_material.find_map(|(content, cell)| Hovered::in_pane(ui, scenery, *content, *cell));
        if let Some(texel) = self.hovered.and_then(|hovered| scenery.state.texel_at(grid, hovered.point)) {
            self.last_texel = Some(texel);
        }
        let mut commands = Vec::new();
        for (i, (content, cell)) in panes.into_iter().enumerate() {
            commands.extend(self.pane(ui, scenery, gpu, i, content, cell));
        }
        commands
    }

    fn pane(
        &mut self,
        ui: &mut egui::Ui,
        scenery: &Scenery<'_>,
        gpu: &mut GpuView,
        number: usize,
        content: Content,
        cell: Rect,
    ) -> Vec<Command> {
        let mut commands = Vec::new();
        let (title, _) = cell.split_top_bottom_at_y(cell.top() + TITLE);
        commands.extend(title_bar(ui, scenery, number, content, title));
        let rect = picture_rect(ui, cell);
        if let Some(editor) = scenery.corner_editor(content) {
            commands.extend(editor.ui(ui, rect, number));
            return commands;
        }

        let response = ui.interact(rect, ui.scope_id().with(("pane", number)), Sense::drag());
        let kind = match (number < scenery.contents().len(), content.difference) {
            (true, _) => "Pane",
            (false, true) => "Difference pane",
            (false, false) => "Value pane",
        };
        let label = format!("{kind} {}", scenery.name_of(content));
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &label));
        let camera = scenery.camera(scenery.slots[0].loaded.material.grid(), rect.width() / rect.height());
        self.paint(ui, scenery, gpu, (number, content), rect, camera);

        let target = PaneTarget {
            rect,
            camera: &camera,
            state: scenery.state,
            highlight_follows: scenery.highlight_follows,
            view_handle: scenery.view_handle,
            grid: scenery.slots[0].loaded.material.grid(),
            armed: scenery.inspect.armed,
        };
        commands.extend(gestures::commands(ui, &response, &target, &mut self.gesture));
        commands
    }

    fn paint(
        &self,
        ui: &egui::Ui,
        scenery: &Scenery<'_>,
        gpu: &mut GpuView,
        (number, content): (usize, Content),
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
            difference: content.difference.then(|| DisplayedDifference {
                kind: state.difference_kind(),
                range: scenery.range as f32,
                is_computed: state.is_error_map(),
            }),
            encoding: state.quantity.into(),
            show_clipping: state.show_clipping,
            epsilon: state.convention().epsilon as f32,
            tiled: state.tiled,
            false_colour: state.false_colour,
            nearest: self.is_draft,
            background: [background[0], background[1], background[2]],
        };
        let drawn = match texels(gpu, scenery, content) {
            Ok(drawn) => drawn,
            Err(hint) => {
                painter.rect_filled(rect, 0.0, theme::surround(scenery.dark));
                return paint_hint(&painter, rect, hint);
            }
        };
        gpu.paint(&painter, rect, number, drawn, params);
        self.paint_marks(&painter, scenery, content, rect, &camera);
        if state.quantity == Quantity::Rendering {
            handles::paint_endpoints(&painter, rect, &camera, state, scenery.view_handle);
        }
        if content.mode == DisplayMode::Wipe(state.wipe * 2.0 - 1.0) {
            handles::paint_wipe(&painter, rect, state.wipe);
        }
        if let Some(text) = sight::hint(scenery, rect.width() / rect.height()) {
            paint_hint(&painter, rect, text);
        }
    }

    /// Shades every material in a pane; on a slow adapter only what the screen needs while something moves, and the rest bit by
    /// bit.
    fn shade(
        &mut self,
        ui: &egui::Ui,
        gpu: &mut GpuView,
        scenery: &Scenery<'_>,
        contents: &[Content],
    ) -> Result<(), String> {
        let state = scenery.state;
        let params =
            ShadeParams { scene: state.scene, convention: state.convention(), quantity: state.quantity };
        let (now, seconds) = ui.input(|i| (i.time, i.unstable_dt));
        let software = gpu.gpu.report.software;
        let seen = PaneView { params, zoom: state.zoom, pan: state.pan };
        let moves = self.pace.frame(seen, now, seconds, software);
        if moves {
            ui.ctx().request_repaint_after_secs(REST as f32 + 0.01);
        }
        let grid = scenery.slots[0].loaded.material.grid();
        let is_large = grid.width * grid.height > BAND && (software || self.pace.is_slow());
        // What is compared with an error map or a photograph, and what is saved, is never shaded in part.
        let is_exact = self.exact || state.is_error_map() || scenery.photograph.is_some();
        self.is_draft = moves && !is_exact;
        let part = if self.is_draft || is_large && !is_exact {
            shaded_part(state, grid, self.aspect(), self.magnification(grid, state))
        } else {
            ShadedPart::Whole
        };
        let sharpens = !moves && part != ShadedPart::Whole;
        let asked = ShadingRequest { params, part, sharpens, waits: scenery.reading, exact: is_exact };
        gpu.keep_only(scenery.slots, contents.len() + 1);
        let shown: BTreeSet<usize> = contents.iter().flat_map(|one| [one.slot, one.reference]).collect();
        let slots: Vec<&Slot> = shown.into_iter().map(|index| &scenery.slots[index]).collect();
        if gpu.shade(&slots, asked)? {
            ui.ctx().request_repaint();
        }
        Ok(())
    }

    /// What is drawn over a pane about texels.
    fn paint_marks(
        &self,
        painter: &egui::Painter,
        scenery: &Scenery<'_>,
        content: Content,
        rect: Rect,
        camera: &Camera,
    ) {
        let grid = scenery.slots[0].loaded.material.grid();
        let placed = Placed { rect, camera, grid };
        let state = scenery.state;
        if state.tiled {
            // A texel is in four places.
            return;
        }
        if state.projection == Projection::Flat && content.mode == DisplayMode::Value {
            let (slot, difference) = (content.slot, content.difference);
            let photographs = scenery.photograph.and_then(|photograph| photograph.all).map(AsRef::as_ref);
            let read = Readout { slots: scenery.slots, state, error_maps: scenery.error_maps, photographs };
            placed.paint_numbers(painter, |texel| match (content.photograph, photographs) {
                (PhotographUse::Shown, Some(photographs)) => readout::photograph(photographs, slot, texel),
                _ => readout::shown(read, slot, difference, texel),
            });
        }
        placed.paint_inspected(painter, scenery.inspect);
        let texel = self.hovered.and_then(|hovered| scenery.state.texel_at(grid, hovered.point));
        if let Some(texel) = texel.filter(|_| self.gesture.is_none()) {
            placed.paint_crosshair(painter, texel);
        }
    }

    /// Screen pixels per texel in the middle of a pane.
    pub(super) fn magnification(&self, grid: Grid, state: &ViewState) -> f32 {
        let camera = state.fitted_camera(grid, self.aspect()).zoomed(state.zoom, state.pan);
        let rect = Rect::from_min_size(egui::Pos2::ZERO, self.pane_pixels);
        let middle = camera.plane_from_ndc(0.0, 0.0).and_then(|point| grid.texel_at(point));
        let middle = middle.unwrap_or([grid.width / 2, grid.height / 2]);
        Placed { rect, camera: &camera, grid }.texel_side(middle)
    }

    /// Width of a pane over its height; 1 before there is one.
    pub(super) fn aspect(&self) -> f32 {
        let aspect = self.pane_pixels.x / self.pane_pixels.y;
        if aspect.is_finite() && aspect > 0.0 { aspect } else { 1.0 }
    }

    /// The magnification at which a texel of `grid` covers one physical pixel.
    pub(super) fn one_to_one_zoom(&self, grid: Grid) -> f32 {
        let [half_width, _] = grid.half_extent();
        let aspect = self.pane_pixels.x / self.pane_pixels.y;
        let fitted = Camera::flat(grid, aspect).origin_right.x;
        let pixels_per_texel = self.pane_pixels.x * half_width / fitted / grid.width as f32;
        if pixels_per_texel.is_finite() && pixels_per_texel > 0.0 { pixels_per_texel.recip() } else { 1.0 }
    }
}
