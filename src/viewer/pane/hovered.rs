//! Material and texel under the pointer.

use eframe::egui;

use crate::pane::handles::ndc_from_pos;
use crate::pane::placed::Placed;
use crate::pane::scenery::index_at;
use crate::pane::scenery::{PaneContent, Scenery};

/// What is under the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hovered {
    /// The index of the material there; the number of materials for a photograph.
    pub index: usize,
    /// The texel there; `None` beside the material.
    pub texel: Option<[usize; 2]>,
}

impl Hovered {
    /// What is under the pointer, if it is over this pane and nothing lies in between.
    pub fn in_pane(
        ui: &egui::Ui,
        scenery: &Scenery<'_>,
        content: PaneContent,
        placed: &Placed,
    ) -> Option<Self> {
        let pos = ui.input(|i| i.pointer.latest_pos()).filter(|pos| placed.rect.contains(*pos))?;
        let covered = ui.ctx().layer_id_at(pos).is_some_and(|layer| layer != ui.layer_id());
        if covered {
            return None;
        }
        let index = index_at(scenery, content, ndc_from_pos(placed.rect, pos)[0]);
        placed.point(pos).map(|point| Self { index, texel: placed.grid.texel_at(point) })
    }
}
