//! Data set: the list of its materials, the contact sheet and the summary of its methods.

pub mod cases;
pub mod list;
pub mod losses;
pub mod opening;
pub mod pictures;
pub mod rows;
pub mod sheet;
pub mod summary;

use eframe::egui;

use crate::dataset::list::MaterialsDrawer;
use crate::dataset::rows::Rows;
use crate::dataset::sheet::ContactSheet;
use crate::jobs::{Jobs, Shown};
use crate::model::Model;
use crate::widgets::bare;
use crate::widgets::paint::PanelTextures;

/// The list between frames.
#[derive(Debug, Default)]
pub struct DatasetUi {
    /// The first row of the list in sight, and how many are.
    in_sight: std::ops::Range<usize>,
    /// The material that the list has scrolled to.
    scrolled_to: Option<usize>,
}

impl DatasetUi {
    /// The list, at the left.
    pub fn drawer(&mut self, ui: &mut egui::Ui, shown: Shown<'_>, next: &mut Model) {
        let dataset = &shown.model.dataset;
        dataset.in_sight.set(&[dataset.wanted]);
        let Some(open) = dataset.open.as_deref().filter(|_| dataset.list.is_open) else { return };
        let rows = Rows::ask(shown);
        // In a narrow window the panes keep most of the room.
        let width = (0.24 * ui.ctx().content_rect().width()).clamp(160.0, 250.0);
        let panel = bare(egui::Panel::left("materials"), ui).default_size(width).size_range(150.0..=560.0);
        panel.show(ui, |ui| {
            let mut drawer = MaterialsDrawer {
                shown,
                open,
                losses: losses::ask(shown),
                rows: &rows,
                in_sight: &mut self.in_sight,
                scrolled_to: &mut self.scrolled_to,
            };
            drawer.ui(ui, &mut next.dataset);
        });
        let in_sight = rows.cases.get(self.in_sight.clone()).unwrap_or_default();
        dataset.in_sight.set(&[&[dataset.wanted], in_sight].concat());
    }
}

/// The contact sheet, in place of the panes; false where it is closed.
pub fn sheet(ui: &mut egui::Ui, shown: Shown<'_>, next: &mut Model, textures: &mut PanelTextures) -> bool {
    let dataset = &shown.model.dataset;
    let Some(open) = dataset.open.as_ref().filter(|_| dataset.sheet.is_open) else { return false };
    let (rows, losses) = (&Rows::ask(shown), losses::ask(shown));
    ContactSheet { shown, open, rows, losses, textures }.ui(ui, next);
    true
}

/// The name of the window: which material is shown, and where it is in the list.
pub fn title(shown: Shown<'_>) -> Option<String> {
    let dataset = &shown.model.dataset;
    let (name, case) = (dataset.open.as_ref()?.name(dataset.shown?), dataset.shown?);
    let rows = Rows::ask(shown);
    let place = rows.row(case).map(|row| format!(" ({} of {})", row + 1, rows.cases.len()));
    Some(format!("{name}{}", place.unwrap_or_default()))
}

/// Goes to another material of the list, or to another prediction without one, by the keys of pages and arrows.
pub fn turn_pages(ctx: &egui::Context, model: &mut Model, jobs: &Jobs) {
    let steps = if ctx.text_edit_focused() { 0 } else { steps(ctx) };
    if steps == 0 || model.dataset.sheet.is_open {
        return;
    }
    if model.dataset.open.is_none() {
        let (now, last) =
            (model.view.display.prediction, model.materials.predictions().len().saturating_sub(1));
        return model.view.choose(now.saturating_add_signed(steps).min(last));
    }
    let rows = Rows::ask(Shown { model, jobs });
    let last = rows.cases.len().saturating_sub(1);
    let next = rows.row(model.dataset.wanted).map_or(0, |row| row.saturating_add_signed(steps).min(last));
    if let Some((case, ahead)) = rows.at(next) {
        model.dataset.show(case, ahead);
    }
}

/// How many materials on the keys of this frame go.
fn steps(ctx: &egui::Context) -> isize {
    use egui::{Key, Modifiers};
    let is_free = ctx.memory(|memory| memory.focused()).is_none();
    let pressed = |modifiers, key| ctx.input_mut(|i| i.count_and_consume_key(modifiers, key)) as isize;
    let pages = pressed(Modifiers::NONE, Key::PageDown) - pressed(Modifiers::NONE, Key::PageUp);
    let both = Modifiers::CTRL.plus(Modifiers::SHIFT);
    let tabs = -pressed(both, Key::Tab) + pressed(Modifiers::CTRL, Key::Tab);
    if !is_free {
        return pages + tabs;
    }
    let arrows = pressed(Modifiers::NONE, Key::ArrowDown) - pressed(Modifiers::NONE, Key::ArrowUp);
    let most = isize::MAX / 4;
    let ends = pressed(Modifiers::NONE, Key::End) - pressed(Modifiers::NONE, Key::Home);
    pages + tabs + arrows + most * ends
}
