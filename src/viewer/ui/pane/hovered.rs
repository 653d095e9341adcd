//! Point of a material under the pointer.

use eframe::egui;

use crate::viewer::ui::pane::cells::picture_rect;
use crate::viewer::ui::pane::handles::ndc_from_pos;
use crate::viewer::ui::pane::scenery::{Content, Scenery};
use crate::viewer::ui::pane::texels::index_at;

/// The point of a material under the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hovered {
    /// The index of the material there; the number of materials for a photograph.
    pub index: usize,
    /// The point (x, y) of the plane.
    pub point: [f32; 2],
}

impl Hovered {
    /// What is under the pointer, if it is over this pane and nothing lies in between.
    pub fn in_pane(ui: &egui::Ui, scenery: &Scenery<'_>, content: Content, cell: egui::Rect) -> Option<Self> {
        let rect = picture_rect(ui, cell);
        let pos = ui.input(|i| i.pointer.latest_pos()).filter(|pos| rect.contains(*pos))?;
        let covered = ui.ctx().layer_id_at(pos).is_some_and(|layer| layer != ui.layer_id());
        if covered {
            return None;
        }
        let [x, y] = ndc_from_pos(rect, pos);
        let pane = rect.size() * ui.pixels_per_point();
        let camera = scenery.state.camera(scenery.materials[0].grid(), pane.into());
        let index = index_at(scenery, content, x);
        camera.plane_from_ndc(x, y).map(|point| Self { index, point })
    }
}
