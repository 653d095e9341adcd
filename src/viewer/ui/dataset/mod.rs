//! Data set: the list of its materials, the contact sheet and the summary of its methods.

pub mod list;
pub mod rows;
pub mod sheet;
pub mod summary;

use eframe::egui;

use crate::jobs::dataset::DisplayedCases;
use crate::jobs::displayed::Displayed;
use crate::model::command::{Command, DatasetCommand};
use crate::model::dataset::list::ListView;
use crate::ui::widgets::bare;
use crate::ui::widgets::texture::PanelTextures;
use list::MaterialsDrawer;
use rows::Rows;
use sheet::ContactSheet;

/// The list and the sheet between frames.
#[derive(Debug, Default)]
pub struct DatasetUi {
    rows: Rows,
    /// What the last frame displayed.
    pub displayed: DisplayedCases,
    /// The first row of the list in sight, and how many are.
    in_sight: std::ops::Range<usize>,
    /// The material that the list has scrolled to.
    scrolled_to: Option<usize>,
}

impl DatasetUi {
    /// The commands of keys: the next and the previous material, the list, the sheet, a mark.
    pub fn keys(&mut self, ctx: &egui::Context, displayed: Displayed<'_>) -> Vec<Command> {
        let dataset = &displayed.model.dataset;
        self.rows.follow(displayed);
        if dataset.open.is_none() || ctx.text_edit_focused() {
            return Vec::new();
        }
        let pressed = |key| ctx.input_mut(|i| i.count_and_consume_key(egui::Modifiers::NONE, key));
        let mut commands = Vec::new();
        let steps = pressed(egui::Key::PageDown) as isize - pressed(egui::Key::PageUp) as isize;
        if steps != 0 && !dataset.sheet.is_open {
            let now = self.rows.row(dataset.wanted);
            let next = match now {
                Some(row) => row.saturating_add_signed(steps).min(self.rows.cases.len().saturating_sub(1)),
                None => 0,
            };
            commands.extend(self.rows.at(next).map(|(case, ahead)| DatasetCommand::Show { case, ahead }));
        }
        if pressed(egui::Key::A) % 2 == 1 {
            let list = ListView { is_open: !dataset.list.is_open, ..dataset.list.clone() };
            commands.push(DatasetCommand::SetList(list));
        }
        if pressed(egui::Key::S) % 2 == 1 {
            commands.push(DatasetCommand::ShowSheet(!dataset.sheet.is_open));
        }
        if pressed(egui::Key::K) % 2 == 1 {
            commands.push(DatasetCommand::ToggleMark);
        }
        commands.into_iter().map(Command::from).collect()
    }

    /// The materials that are listed, in their order.
    pub fn listed(&self) -> &[usize] {
        &self.rows.cases
    }

    /// The name of the window: which material is shown, and where it is in the list.
    pub fn title(&self, displayed: Displayed<'_>) -> Option<String> {
        let dataset = &displayed.model.dataset;
        let (open, shown) = (dataset.open.as_ref()?, dataset.shown?);
        let place = self.rows.row(shown).map(|row| format!(" ({} of {})", row + 1, self.rows.cases.len()));
        Some(format!("{}{}", open.name(shown), place.unwrap_or_default()))
    }

    /// The list, at the left.
    pub fn drawer(&mut self, ui: &mut egui::Ui, displayed: Displayed<'_>) -> Vec<Command> {
        self.rows.follow(displayed);
        self.displayed = DisplayedCases::default();
        let dataset = &displayed.model.dataset;
        let Some(open) = dataset.open.as_deref().filter(|_| dataset.list.is_open) else { return Vec::new() };
        let mut commands = Vec::new();
        // In a narrow window the panes keep most of the room.
        let width = (0.24 * ui.ctx().content_rect().width()).clamp(160.0, 250.0);
        let panel = bare(egui::Panel::left("materials"), ui).default_size(width).size_range(150.0..=560.0);
        panel.show(ui, |ui| {
            let mut drawer = MaterialsDrawer {
                displayed,
                open,
                rows: &self.rows,
                in_sight: &mut self.in_sight,
                scrolled_to: &mut self.scrolled_to,
            };
            commands = drawer.ui(ui);
        });
        self.displayed.cases =
            self.rows.cases.get(self.in_sight.clone()).map(<[usize]>::to_vec).unwrap_or_default();
        commands
    }

    /// The contact sheet, in place of the panes; `None` where it is closed.
    pub fn sheet(
        &mut self,
        ui: &mut egui::Ui,
        displayed: Displayed<'_>,
        textures: &mut PanelTextures,
    ) -> Option<Vec<Command>> {
        let dataset = &displayed.model.dataset;
        let open = dataset.open.as_deref().filter(|_| dataset.sheet.is_open)?;
        let mut sheet =
            ContactSheet { displayed, open, rows: &self.rows, textures, in_sight: &mut self.displayed };
        Some(sheet.ui(ui))
    }
}
