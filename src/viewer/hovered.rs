//! What is under the pointer.

use eframe::egui;

use super::cells::picture_rect;
use super::handles::ndc_from_pos;
use super::pane_texels::slot_at;
use super::panes::{Content, Scenery};

/// The point of a material under the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hovered {
    /// The slot of the material there; the number of slots for a photograph.
    pub slot: usize,
    /// The point (x, y) of the plane.
    pub point: [f32; 2],
}

impl Hovered {
    /// What is under the pointer, if it is over this pane and nothing lies in between.
    pub(super) fn in_pane(
        ui: &egui::Ui,
        scenery: &Scenery<'_>,
        content: Content,
        cell: egui::Rect,
    ) -> Option<Self> {
        let rect = picture_rect(ui, cell);
        let pos = ui.input(|i| i.pointer.latest_pos()).filter(|pos| rect.contains(*pos))?;
        let covered = ui.ctx().layer_id_at(pos).is_some_and(|layer| layer != ui.layer_id());
        if covered {
            return None;
        }
        let [x, y] = ndc_from_pos(rect, pos);
        let camera = scenery.camera(scenery.slots[0].loaded.material.grid(), rect.width() / rect.height());
        let slot = slot_at(scenery, content, x);
        camera.plane_from_ndc(x, y).map(|point| Self { slot, point })
    }
}
