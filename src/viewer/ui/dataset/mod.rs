//! Data set: the list of its materials, the contact sheet and the summary of its methods.

pub mod list;
pub mod sheet;
pub mod summary;

use eframe::egui;

use crate::jobs::dataset::DisplayedCases;
use crate::jobs::displayed::Displayed;
use crate::model::command::{Command, DatasetCommand};
use crate::model::dataset::list::{ListView, Listed};
use crate::ui::widgets::bare;
use crate::ui::widgets::texture::PanelTextures;
use list::MaterialsDrawer;
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
    summary: summary::SummaryUi,
}

/// The materials that are listed, in their order.
#[derive(Debug, Default)]
pub struct Rows {
    key: Option<RowsKey>,
    /// Their places in the data set.
    pub cases: Vec<usize>,
}

/// What the rows depend on.
#[derive(Clone, Debug, PartialEq)]
struct RowsKey {
    dataset: usize,
    generation: u64,
    list: ListView,
    marked: Vec<String>,
}

impl Rows {
    /// Sorts and filters again where something has changed.
    fn follow(&mut self, displayed: Displayed<'_>) {
        let (dataset, losses) = (&displayed.model.dataset, &displayed.jobs.dataset.losses);
        let Some(open) = &dataset.open else {
            *self = Self::default();
            return;
        };
        let marked = dataset.marks.iter().filter(|(_, mark)| mark.is_marked).map(|(name, _)| name.clone());
        let key = RowsKey {
            dataset: std::sync::Arc::as_ptr(open).addr(),
            generation: losses.generation,
            list: dataset.list.clone(),
            marked: marked.collect(),
        };
        if self.key.as_ref() == Some(&key) {
            return;
        }
        let all = open.cases.iter().enumerate().map(|(case, one)| Listed {
            name: &one.material,
            losses: losses.row(case),
            is_marked: dataset.mark(&one.material).is_some_and(|mark| mark.is_marked),
        });
        let all: Vec<Listed<'_>> = all.collect();
        self.cases = dataset.list.rows(&all);
        self.key = Some(key);
    }

    /// The row of a material.
    pub fn row(&self, case: usize) -> Option<usize> {
        self.cases.iter().position(|one| *one == case)
    }

    /// The material in this row, and those around it, which are likely to be next.
    pub fn at(&self, row: usize) -> Option<(usize, Vec<usize>)> {
        let case = *self.cases.get(row)?;
        let around = [row.checked_add(1), row.checked_sub(1)].into_iter().flatten();
        Some((case, around.filter_map(|row| self.cases.get(row)).copied().collect()))
    }
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
    pub fn drawer(
        &mut self,
        ui: &mut egui::Ui,
        displayed: Displayed<'_>,
        textures: &mut PanelTextures,
    ) -> Vec<Command> {
        self.rows.follow(displayed);
        self.displayed = DisplayedCases::default();
        let dataset = &displayed.model.dataset;
        let Some(open) = dataset.open.as_deref().filter(|_| dataset.list.is_open) else { return Vec::new() };
        let mut commands = Vec::new();
        let panel = bare(egui::Panel::left("materials"), ui).default_size(250.0).size_range(150.0..=560.0);
        panel.show(ui, |ui| {
            let mut drawer = MaterialsDrawer {
                displayed,
                open,
                rows: &self.rows,
                in_sight: &mut self.in_sight,
                scrolled_to: &mut self.scrolled_to,
                textures,
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

    /// The tab of the methods.
    pub fn summary(&mut self, ui: &mut egui::Ui, displayed: Displayed<'_>) -> Vec<Command> {
        self.summary.ui(ui, displayed, &self.rows)
    }
}
