//! Matrix of a data set: a row for each material, a column for the ground truth and for each method.

use std::sync::Arc;

use svbrdf_core::loss::Estimate;
use svbrdf_evaluate::dataset::KnownLoss;
use svbrdf_evaluate::report::{Cell, Table};

use crate::dataset::losses::{self, DatasetLosses};
use crate::dataset::pictures::MatrixCell;
use crate::jobs::Shown;
use crate::jobs::answers::Answered;
use crate::model::dataset::OpenDataset;
use crate::model::dataset::list::{CaseLosses, Listed};
use crate::model::material::loaded::{LoadedMaterial, drawable};
use crate::widgets::numbers::{means, significant};

/// The data set that is open, as every part of the window reads it.
#[derive(Clone, Debug)]
pub struct Matrix<'a> {
    pub shown: Shown<'a>,
    pub open: &'a Arc<OpenDataset>,
    pub losses: Arc<Answered<DatasetLosses>>,
    /// The materials that are listed, sorted and filtered: their places in the data set.
    pub rows: Vec<usize>,
    /// The columns in the order of their places; that of the ground truth is the first.
    pub columns: Vec<usize>,
}

impl<'a> Matrix<'a> {
    /// `None` without a data set.
    pub fn ask(shown: Shown<'a>) -> Option<Self> {
        let (dataset, losses) = (&shown.model.dataset, losses::ask(shown));
        let open = dataset.open.as_ref()?;
        let all = open.cases.iter().enumerate().map(|(case, one)| Listed {
            name: &one.material,
            losses: losses.row(case),
            is_marked: dataset.mark(&one.material).is_some_and(|mark| mark.is_marked),
        });
        let rows = dataset.list.rows(&all.collect::<Vec<_>>());
        let columns = [vec![0], dataset.list.columns(open.methods())].concat();
        Some(Self { shown, open, losses, rows, columns })
    }

    /// The row of a material.
    pub fn row(&self, case: usize) -> Option<usize> {
        self.rows.iter().position(|one| *one == case)
    }

    /// The material in this row, and those around it, which are likely to be next.
    pub fn at(&self, row: usize) -> Option<(usize, Vec<usize>)> {
        let case = *self.rows.get(row)?;
        let around = [row.checked_add(1), row.checked_sub(1)].into_iter().flatten();
        Some((case, around.filter_map(|row| self.rows.get(row)).copied().collect()))
    }

    /// How many are listed, and how many losses are known.
    pub fn counts(&self) -> String {
        let (listed, all, noun) = (self.rows.len(), self.open.cases.len(), self.open.noun());
        let listed =
            if listed == all { format!("{all} {noun}s") } else { format!("{listed} of {all} {noun}s") };
        match self.losses.count() {
            known if known < all => format!("{listed}, losses of {known}"),
            _ => listed,
        }
    }

    /// The column of the chosen method: that of the chosen prediction, or the one that was chosen before the material in the window.
    pub fn chosen(&self) -> Option<usize> {
        let (model, methods) = (self.shown.model, self.open.methods());
        if self.open.is_of_predictions() {
            return Some(1);
        }
        let chosen = model.chosen_prediction().filter(|_| model.dataset.shown.is_some());
        let name = chosen.map(|one| one.material().name()).or(model.dataset.method.as_deref())?;
        Some(1 + methods.iter().position(|method| method == name)?)
    }

    /// The name of a column.
    pub fn column(&self, column: usize) -> &str {
        let method = column.checked_sub(1).and_then(|method| self.open.methods().get(method));
        method.map_or("ground truth", String::as_str)
    }

    /// The loss of a prediction.
    pub fn loss(&self, cell: MatrixCell) -> Option<KnownLoss> {
        *self.losses.row(cell.case)?.by_method.get(cell.column.checked_sub(1)?)?
    }

    /// Why a prediction has no loss.
    pub fn problem(&self, cell: MatrixCell) -> Option<&str> {
        let (losses, method) = (self.losses.row(cell.case)?, self.column(cell.column));
        losses.problems.iter().find(|(of, _)| of == method).map(|(_, problem)| problem.as_str())
    }

    /// What is known of a prediction: its loss with the interval, or why there is none, and the causes that its diagnosis found.
    pub fn told(&self, cell: MatrixCell) -> String {
        let number = self.loss(cell).map(|known| significant(&known.estimate()).join("  "));
        let text = number.unwrap_or_else(|| self.problem(cell).unwrap_or_default().to_owned());
        let causes = self.losses.causes(cell.case, self.column(cell.column)).collect::<Vec<_>>().join(", ");
        drawable([self.column(cell.column), &text, &causes].join("  ").trim_end())
    }

    /// The same of all predictions of a material, a line for each.
    pub fn lines(&self, case: usize) -> String {
        let columns = 1..=self.open.methods().len();
        columns.map(|column| self.told(MatrixCell { case, column })).collect::<Vec<_>>().join("\n")
    }
}

/// The losses of a material as text, with the digits that tell neighbours apart; nothing of a method without one.
pub fn texts(losses: &CaseLosses) -> Vec<String> {
    let known: Vec<_> = losses.by_method.iter().flatten().map(KnownLoss::estimate).collect();
    let mut texts = means(&known.iter().collect::<Vec<_>>()).into_iter();
    losses.by_method.iter().map(|one| one.and_then(|_| texts.next()).unwrap_or_default()).collect()
}

/// The loss of each prediction in the window, where it is known.
pub fn of_window(shown: Shown<'_>) -> Vec<Option<Estimate>> {
    let losses = losses::ask(shown);
    let known = |one: &LoadedMaterial| {
        let (case, method) = shown.model.dataset.place(one.slot)?;
        (*losses.row(case)?.by_method.get(method)?).map(|known| known.estimate())
    };
    shown.model.materials.predictions().iter().map(known).collect()
}

/// The materials that are listed: mark, note and the loss of each method.
pub fn table(shown: Shown<'_>) -> Table {
    let Some(matrix) = Matrix::ask(shown) else { return Table { columns: Vec::new(), rows: Vec::new() } };
    let methods = matrix.open.methods();
    let columns =
        ["material", "marked", "note"].map(str::to_owned).into_iter().chain(methods.iter().cloned());
    let row = |case: &usize| -> Vec<Cell> {
        let name = matrix.open.name(*case);
        let mark = shown.model.dataset.mark(name).cloned().unwrap_or_default();
        let losses = (1..=methods.len())
            .map(|column| matrix.loss(MatrixCell { case: *case, column }).map(|known| known.loss).into());
        [name.into(), mark.is_marked.into(), mark.note.into()].into_iter().chain(losses).collect()
    };
    Table { columns: columns.collect(), rows: matrix.rows.iter().map(row).collect() }
}
