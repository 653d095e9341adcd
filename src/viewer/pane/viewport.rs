//! Viewport: the panes, drawn, and the gestures in them.

use eframe::egui::{self, Align, Layout, Rect, RichText, Sense, Vec2, vec2};

use svbrdf_core::material::Grid;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_gpu::{DisplayMode, DisplayParams, DisplayedDifference};

use crate::model::Model;
use crate::model::material::loaded::drawable;
use crate::model::view::{Projection, ViewState};
use crate::pane;
use crate::pane::Displayed;
use crate::pane::draft::DraftPolicy;
use crate::pane::gestures::{self, Gesture};
use crate::pane::gpu_view::GpuView;
use crate::pane::handles;
use crate::pane::placed::Placed;
use crate::pane::placed::{TITLE, cells, columns, picture_rect};
use crate::pane::scenery::{Hovered, PaneContent, PhotographUse, texels};
use crate::pane::title::{empty_pane, title_bar};
use crate::widgets::paint::{note, paint_hint};
use crate::widgets::theme;

/// A view steeper than this above the plane (its sine) is one from straight above.
const STEEP: f64 = 0.999;

/// Side of a pane below which handles would cover its picture, in points: they are shown under the pointer.
const HANDLES: f32 = 120.0;

/// Height of the strip below the panes, in points.
pub const STRIP: f32 = 92.0;

/// The state of the panes between frames.
#[derive(Debug, Default)]
pub struct Viewport {
    gesture: Option<Gesture>,
    /// Where the panes with materials were drawn, for the gestures of the next frame.
    drawn: Vec<(egui::Id, Rect)>,
    /// What is under the pointer.
    pub hovered: Option<Hovered>,
    /// The texel that was under the pointer last.
    pub last_texel: Option<[usize; 2]>,
    pub(super) policy: DraftPolicy,
    /// Whether pixels show the nearest of their texels: while something moves on a slow adapter.
    pub(super) is_draft: bool,
    /// Whether everything is shaded in full at once, for pictures that are saved.
    pub(super) is_exact: bool,
    /// Where the panes are.
    pub area: Option<Rect>,
    /// Size of a pane in physical pixels.
    pane_pixels: Vec2,
}

impl Viewport {
    /// Panes like these that are shaded in full before they are drawn.
    pub fn exact(&self) -> Self {
        Self { is_exact: true, ..Self::default() }
    }

    /// Carries out the gestures of the mouse in the panes, as the last frame has drawn them.
    pub fn gestures(&mut self, ctx: &egui::Context, model: &mut Model) {
        let Some(ground_truth) = model.materials.ground_truth() else { return };
        let grid = ground_truth.grid();
        for (id, rect) in &self.drawn {
            let Some(response) = ctx.read_response(*id) else { continue };
            let placed = self.placed(&model.view, grid, *rect);
            gestures::act(ctx, &response, &placed, &mut self.gesture, model);
        }
    }

    /// Draws the panes.
    pub fn ui(
        &mut self,
        ui: &mut egui::Ui,
        shown: &Displayed<'_>,
        next: &mut Model,
        gpu: Option<&mut GpuView>,
    ) {
        let area = ui.available_rect_before_wrap();
        self.area = Some(area);
        self.hovered = None;
        self.drawn.clear();
        let Some(gpu) = gpu else {
            let text = "No graphics adapter: materials cannot be drawn. The loss can be computed.";
            return note(ui, area, text);
        };
        if shown.materials().is_empty() {
            return empty(ui, area, shown);
        }
        let contents = shown.contents();
        let grid = shown.materials()[0].grid();
        let count = contents.len() + shown.empty().count();
        let columns = columns(area, count, grid);
        let cells = cells(area, count, columns, ui.pixels_per_point());
        if let Some(cell) = cells.first() {
            let pixels = picture_rect(ui, *cell).size() * ui.pixels_per_point();
            if pixels != self.pane_pixels {
                // The status line was drawn before.
                ui.ctx().request_repaint();
            }
            self.pane_pixels = pixels;
        }
        if let Err(problem) = self.shade(ui, gpu, shown, &contents) {
            return note(ui, area, &problem);
        }
        for (place, missing) in shown.empty() {
            cells.get(place).into_iter().for_each(|cell| empty_pane(ui, shown, missing, *cell));
        }
        let cell = |(number, content)| Some((content, *cells.get(shown.place(number))?));
        let panes: Vec<(PaneContent, Rect)> = contents.into_iter().enumerate().filter_map(cell).collect();
        self.hovered = panes.iter().find_map(|(content, cell)| {
            let placed = self.placed(shown.view(), grid, picture_rect(ui, *cell));
            Hovered::in_pane(ui, shown, *content, &placed)
        });
        self.last_texel = self.hovered.and_then(|hovered| hovered.texel).or(self.last_texel);
        for (i, (content, cell)) in panes.into_iter().enumerate() {
            let (title, _) = cell.split_top_bottom_at_y(cell.top() + TITLE);
            title_bar(ui, shown, i, content, title, next);
            let rect = picture_rect(ui, cell);
            self.pane(ui, shown, gpu, i, content, rect);
        }
    }

    fn pane(
        &mut self,
        ui: &mut egui::Ui,
        shown: &Displayed<'_>,
        gpu: &mut GpuView,
        number: usize,
        content: PaneContent,
        rect: Rect,
    ) {
        let id = ui.scope_id().with(("pane", number));
        let response = ui.interact(rect, id, Sense::drag());
        self.drawn.push((id, rect));
        let label = format!("Pane {}", shown.names_of(content, usize::MAX)[0]);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &label));
        let placed = self.placed(shown.view(), shown.materials()[0].grid(), rect);
        self.paint(ui, shown, gpu, (number, content), &placed);
    }

    fn paint(
        &self,
        ui: &egui::Ui,
        shown: &Displayed<'_>,
        gpu: &mut GpuView,
        (number, content): (usize, PaneContent),
        placed: &Placed,
    ) {
        let (rect, camera) = (placed.rect, placed.camera);
        let state = shown.view();
        let painter = ui.painter_at(rect);
        let background = theme::surround(shown.model.settings.dark).to_normalized_gamma_f32();
        let params = DisplayParams {
            camera,
            exposure_ev: state.exposure_ev,
            mode: content.mode,
            difference: content.difference.then(|| DisplayedDifference {
                kind: state.difference_kind(),
                range: shown.range() as f32,
                is_computed: state.is_computed(),
            }),
            encoding: state.display.quantity.into(),
            show_clipping: state.display.show_clipping,
            epsilon: state.convention().epsilon as f32,
            false_colour: state.display.false_colour,
            nearest: self.is_draft,
            background: [background[0], background[1], background[2]],
        };
        let drawn = match texels(shown, content) {
            Ok(drawn) => drawn,
            Err(hint) => {
                painter.rect_filled(rect, 0.0, theme::surround(shown.model.settings.dark));
                return paint_hint(&painter, rect, hint);
            }
        };
        gpu.paint(&painter, rect, number, drawn, params);
        self.paint_marks(&painter, shown, content, placed);
        let has_room = rect.size().min_elem() >= HANDLES || ui.rect_contains_pointer(rect);
        if state.display.quantity == Quantity::Rendering && has_room {
            handles::paint_endpoints(&painter, rect, &camera, state);
        }
        if content.mode == DisplayMode::Wipe(state.display.wipe * 2.0 - 1.0) {
            handles::paint_wipe(&painter, rect, state.display.wipe);
        }
        if let (2.., Some(one)) = (gpu.reduction(), shown.materials().first()) {
            let grid = one.grid();
            paint_hint(
                &painter,
                rect,
                &reduced(gpu.reduction(), grid, gpu.gpu.report.max_texture_side as usize),
            );
        } else if let Some(text) = hint(shown, content) {
            paint_hint(&painter, rect, &text);
        }
    }

    /// What is drawn over a pane about texels.
    fn paint_marks(
        &self,
        painter: &egui::Painter,
        shown: &Displayed<'_>,
        content: PaneContent,
        placed: &Placed,
    ) {
        let state = shown.view();
        let has_numbers = content.mode == DisplayMode::Value && shown.model.blind.is_none();
        if state.display.projection == Projection::Flat && has_numbers {
            let (index, difference) = (content.index, content.difference);
            placed.paint_numbers(painter, |texel| match (content.photograph, shown.photographs()) {
                (PhotographUse::Displayed, Some(all)) => all.at(index, texel).map(f64::from).to_vec(),
                _ => pane::numbers(shown, index, difference, texel),
            });
        }
        placed.paint_inspected(painter, &shown.model.inspection);
        let texel = self.hovered.and_then(|hovered| hovered.texel);
        if let Some(texel) = texel.filter(|_| self.gesture.is_none()) {
            placed.paint_crosshair(painter, texel);
        }
    }

    /// Screen pixels per texel in the middle of a pane.
    pub fn magnification(&self, grid: Grid, state: &ViewState) -> f32 {
        let rect = Rect::from_min_size(egui::Pos2::ZERO, self.pane_pixels);
        self.placed(state, grid, rect).side_in_the_middle()
    }

    /// The picture of a pane in `rect`.
    fn placed(&self, state: &ViewState, grid: Grid, rect: Rect) -> Placed {
        Placed { rect, camera: state.camera(grid, self.pane_pixels()), grid }
    }

    /// Width and height of the picture of a pane, in physical pixels; 0 before there is one.
    pub fn pane_pixels(&self) -> [f32; 2] {
        self.pane_pixels.into()
    }
}

/// The badge of a pane whose adapter has no room for all texels, of which it takes at most `limit` along a side.
fn reduced(stride: usize, grid: Grid, limit: usize) -> String {
    let reason = match grid.width.max(grid.height) {
        side if side > limit => {
            format!("The adapter takes at most {limit} along a side, and these are {side}")
        }
        _ => "The adapter's memory is full".to_owned(),
    };
    format!("Reduced display: one of {stride} x {stride} texels. {reason}. Losses use all texels.")
}

/// What a pane says at its bottom, where its picture may puzzle.
fn hint(shown: &Displayed<'_>, content: PaneContent) -> Option<String> {
    let state = shown.view();
    let (convention, drawn) = (state.convention().name, state.convention().drawn().name);
    if state.display.quantity == Quantity::Rendering && drawn != convention {
        return Some(format!("drawn as {drawn}"));
    }
    let [x, y, z] = state.scene.view;
    let steep = z > STEEP * (x * x + y * y + z * z).sqrt();
    let perspective = state.display.projection == Projection::Perspective;
    if perspective && steep {
        return Some("Perspective from straight above: right-drag to tilt".to_owned());
    }
    let is_new = content.index == 0
        && !shown.model.settings.has_dragged
        && !shown.is_picture
        && state.display.quantity == Quantity::Rendering;
    is_new.then(|| "left-drag moves the light, Space + left-drag pans".to_owned())
}

/// Says why there is no material.
fn empty(ui: &mut egui::Ui, area: Rect, shown: &Displayed<'_>) {
    let text = match shown.model.dataset.missing.first() {
        _ if !shown.model.materials.openings.is_empty() => "Reading...",
        Some(missing) => missing.problem.as_str(),
        None => "Open a material with Ctrl+O, or drop files or folders here.",
    };
    let middle = area.shrink2(vec2(0.1 * area.width(), 0.45 * area.height()));
    let builder = egui::UiBuilder::new().max_rect(middle).layout(Layout::top_down(Align::Center));
    ui.scope_builder(builder, |ui| ui.label(RichText::new(drawable(text)).size(15.0)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_badge_tells_a_limit_of_the_adapter_from_a_lack_of_memory() {
        let of = |width| reduced(2, Grid { width, height: 8 }, 16_384);
        assert!(of(16_400).contains("at most 16384 along a side, and these are 16400"), "{}", of(16_400));
        assert!(of(16_384).contains("memory is full"), "{}", of(16_384));
    }
}
