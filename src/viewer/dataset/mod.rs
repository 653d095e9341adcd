//! Data set: the table of its materials and methods, its losses, and the material in the window.

pub mod cases;
pub mod cells;
pub mod heads;
pub mod losses;
pub mod matrix;
pub mod opening;
pub mod pictures;
pub mod places;
pub mod summary;
pub mod table;

use eframe::egui;

use crate::dataset::matrix::Matrix;
use crate::dataset::pictures::MatrixCell;
use crate::dataset::places::{DatasetUi, MatrixTable};
use crate::jobs::{Jobs, Shown};
use crate::model::Model;
use crate::widgets::bare;
use crate::widgets::paint::PanelTextures;

impl DatasetUi {
    /// What is known of the cell under the pointer, where the table is in the place of the panes.
    pub fn told(&self, shown: Shown<'_>) -> Option<String> {
        let matrix = Matrix::ask(shown).filter(|_| shown.model.dataset.table.has_pictures)?;
        let told = |cell: MatrixCell| format!("{}  {}", matrix.open.name(cell.case), matrix.told(cell));
        Some(self.hovered.map(told).unwrap_or_default())
    }

    /// The table in the place of the panes, where it is true that they are not drawn; or beside them, at the left.
    pub fn ui(
        &mut self,
        ui: &mut egui::Ui,
        shown: Shown<'_>,
        next: &mut Model,
        textures: &mut PanelTextures,
    ) -> bool {
        let Some(matrix) = &Matrix::ask(shown) else { return false };
        let (dataset, has_pictures) = (&shown.model.dataset, shown.model.dataset.table.has_pictures);
        dataset.in_sight.set(&[dataset.wanted]);
        (self.hovered, self.rows) = (None, Vec::new());
        let mut table = MatrixTable { matrix, state: self, textures, has_pictures };
        if has_pictures {
            table.ui(ui, next);
        } else if dataset.list.is_open {
            // In a narrow window the panes keep most of the room.
            let most = (0.3 * ui.ctx().content_rect().width()).max(170.0);
            let width = table::width(matrix.open.methods().len()).min(most);
            let width = shown.model.settings.list_width.unwrap_or(width);
            let panel =
                bare(egui::Panel::left("materials"), ui).default_size(width).size_range(150.0..=720.0);
            let now = panel.show(ui, |ui| table.ui(ui, next)).response.rect.width();
            if (now - width).abs() > 1.0 {
                next.settings.list_width = Some(now);
            }
        }
        has_pictures
    }
}

/// The name of the window: which material is shown, and where it is in the list.
pub fn title(shown: Shown<'_>) -> Option<String> {
    let (matrix, case) = (Matrix::ask(shown)?, shown.model.dataset.shown?);
    let place = matrix.row(case).map(|row| format!(" ({} of {})", row + 1, matrix.rows.len()));
    Some(format!("{}{}", matrix.open.name(case), place.unwrap_or_default()))
}

/// Goes to another material of the list, or to another prediction without one, by the keys of pages and arrows; Enter opens the row.
pub fn turn_pages(ctx: &egui::Context, model: &mut Model, jobs: &Jobs) {
    let (steps, enters) = if ctx.text_edit_focused() { (0, false) } else { steps(ctx) };
    if enters && model.dataset.table.has_pictures {
        model.dataset.show_table(false);
    }
    let next = match Matrix::ask(Shown { model, jobs }) {
        _ if steps == 0 => return,
        Some(matrix) => {
            let last = matrix.rows.len().saturating_sub(1);
            let now = matrix.row(model.dataset.wanted);
            matrix.at(now.map_or(0, |row| row.saturating_add_signed(steps).min(last)))
        }
        None => {
            let last = model.materials.predictions().len().saturating_sub(1);
            return model.view.choose(model.view.display.prediction.saturating_add_signed(steps).min(last));
        }
    };
    if let Some((case, ahead)) = next {
        model.dataset.show(case, ahead);
    }
}

/// How many materials on the keys of this frame go, and whether Enter is pressed that no control has.
fn steps(ctx: &egui::Context) -> (isize, bool) {
    use egui::{Key, Modifiers};
    let is_free = ctx.memory(|memory| memory.focused()).is_none();
    let pressed = |modifiers, key| ctx.input_mut(|i| i.count_and_consume_key(modifiers, key)) as isize;
    let pages = pressed(Modifiers::NONE, Key::PageDown) - pressed(Modifiers::NONE, Key::PageUp);
    let both = Modifiers::CTRL.plus(Modifiers::SHIFT);
    let tabs = -pressed(both, Key::Tab) + pressed(Modifiers::CTRL, Key::Tab);
    if !is_free {
        return (pages + tabs, false);
    }
    let arrows = pressed(Modifiers::NONE, Key::ArrowDown) - pressed(Modifiers::NONE, Key::ArrowUp);
    let most = isize::MAX / 4;
    let ends = pressed(Modifiers::NONE, Key::End) - pressed(Modifiers::NONE, Key::Home);
    (pages + tabs + arrows + most * ends, pressed(Modifiers::NONE, Key::Enter) > 0)
}
