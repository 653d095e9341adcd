//! Rows of the list and of the sheet: the materials in their order.

use svbrdf_evaluate::dataset::KnownLoss;
use svbrdf_evaluate::report::{Cell, Table};

use crate::dataset::losses;
use crate::jobs::Shown;
use crate::model::dataset::list::{CaseLosses, Listed};
use crate::model::material::loaded::drawable;
use crate::widgets::numbers::{means, significant};

/// The materials that are listed, in their order.
#[derive(Debug, Default)]
pub struct Rows {
    /// Their places in the data set.
    pub cases: Vec<usize>,
}

impl Rows {
    /// Those of the data set that is open, sorted and filtered.
    pub fn ask(shown: Shown<'_>) -> Self {
        let (dataset, losses) = (&shown.model.dataset, losses::ask(shown));
        let Some(open) = &dataset.open else { return Self::default() };
        let all = open.cases.iter().enumerate().map(|(case, one)| Listed {
            name: &one.material,
            losses: losses.row(case),
            is_marked: dataset.mark(&one.material).is_some_and(|mark| mark.is_marked),
        });
        let all: Vec<Listed<'_>> = all.collect();
        Self { cases: dataset.list.rows(&all) }
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

/// The losses of a material as text, with the digits that tell neighbours apart; nothing of a method without one.
pub fn texts(losses: &CaseLosses) -> Vec<String> {
    let known: Vec<_> = losses.by_method.iter().flatten().map(KnownLoss::estimate).collect();
    let mut texts = means(&known.iter().collect::<Vec<_>>()).into_iter();
    losses.by_method.iter().map(|one| one.and_then(|_| texts.next()).unwrap_or_default()).collect()
}

/// A line for each of `methods`: its loss with the interval, or why there is none.
pub fn lines(losses: &CaseLosses, methods: &[String]) -> String {
    let line = |(method, known): (&String, &Option<KnownLoss>)| match known {
        Some(known) => format!("{method}  {}", significant(&known.estimate()).join("  ")),
        None => {
            let problem = losses.problems.iter().find(|(of, _)| of == method);
            format!("{method}  {}", problem.map_or("", |(_, problem)| problem))
        }
    };
    let lines = methods.iter().zip(&losses.by_method).map(line);
    lines.map(|line| drawable(&line)).collect::<Vec<_>>().join("\n")
}

/// The chosen method: that of the chosen prediction, or the one that was chosen before the material in the window.
pub fn chosen_method(shown: Shown<'_>) -> Option<&str> {
    let model = shown.model;
    let chosen = model.materials.predictions().get(model.view.display.prediction);
    let is_here = model.dataset.shown.is_some();
    chosen.filter(|_| is_here).map(|one| one.material().name()).or(model.dataset.method.as_deref())
}

/// The materials that are listed: mark, note and the loss of each method.
pub fn table(shown: Shown<'_>) -> Table {
    let (dataset, losses) = (&shown.model.dataset, losses::ask(shown));
    let open = dataset.open.as_ref();
    let mut columns = vec!["material".to_owned(), "marked".to_owned(), "note".to_owned()];
    columns.extend(open.map(|open| open.methods().to_vec()).unwrap_or_default());
    let row = |case: &usize| -> Vec<Cell> {
        let name = open.map_or("", |open| open.name(*case));
        let mark = dataset.mark(name).cloned().unwrap_or_default();
        let known = losses.row(*case).map(|row| row.by_method.clone()).unwrap_or_default();
        let losses = (3..columns.len())
            .map(|column| known.get(column - 3).copied().flatten().map(|known| known.loss).into());
        [name.into(), mark.is_marked.into(), mark.note.into()].into_iter().chain(losses).collect()
    };
    let rows = Rows::ask(shown).cases.iter().map(row).collect();
    Table { columns, rows }
}
