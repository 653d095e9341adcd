//! List of materials: which are listed, and in which order.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use svbrdf_evaluate::dataset::KnownLoss;

/// The losses of one material, by method.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CaseLosses {
    pub by_method: Vec<Option<KnownLoss>>,
    /// Why methods have none.
    pub problems: Vec<(String, String)>,
    /// Whether a loss is not above the floor of the ground truth, where floors are known.
    pub is_below_floor: bool,
}

impl CaseLosses {
    /// The largest difference of two losses.
    fn disagreement(&self) -> Option<f64> {
        let losses = || self.by_method.iter().flatten().map(|known| known.loss);
        let (least, most) = losses().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), loss| {
            (least.min(loss), most.max(loss))
        });
        (self.by_method.iter().flatten().count() > 1).then_some(most - least)
    }

    fn loss(&self, method: usize) -> Option<f64> {
        self.by_method.get(method).copied().flatten().map(|known| known.loss)
    }
}

/// What the list is sorted by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ListOrder {
    #[default]
    Name,
    /// Of this method, the largest first.
    Loss(usize),
    /// The largest difference of two methods, the largest first.
    Disagreement,
}

/// Which materials are listed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ListFilter {
    #[default]
    All,
    Marked,
    Failed,
    NotResolvable,
}

impl ListFilter {
    pub const ALL: [Self; 4] = [Self::All, Self::Marked, Self::Failed, Self::NotResolvable];

    pub fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Marked => "marked",
            Self::Failed => "failed",
            Self::NotResolvable => "not resolvable",
        }
    }
}

/// How the list is looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ListView {
    pub is_open: bool,
    pub order: ListOrder,
    /// Whether the order is the other way round.
    pub is_reversed: bool,
    /// Parts of names, in lower case.
    pub search: String,
    pub filter: ListFilter,
    /// The methods in the order of their columns, by name; those that are not among them come last.
    pub methods: Vec<String>,
}

impl Default for ListView {
    fn default() -> Self {
        Self {
            is_open: true,
            order: ListOrder::Name,
            is_reversed: false,
            search: String::new(),
            filter: ListFilter::All,
            methods: Vec::new(),
        }
    }
}

/// A material, as the list sorts it.
#[derive(Clone, Copy, Debug)]
pub struct Listed<'a> {
    pub name: &'a str,
    /// `None` until they are known.
    pub losses: Option<&'a CaseLosses>,
    pub is_marked: bool,
}

impl ListView {
    /// The places in `all` of the materials that are listed, in their order. What is not known comes last, in either direction; equal
    /// ones keep the order of their names.
    pub fn rows(&self, all: &[Listed<'_>]) -> Vec<usize> {
        let search = self.search.to_lowercase();
        let mut rows: Vec<(usize, Option<f64>)> = (0..all.len())
            .filter(|row| self.lists(&all[*row], &search))
            .map(|row| (row, self.value(&all[row])))
            .collect();
        if self.order != ListOrder::Name {
            rows.sort_by(|(_, a), (_, b)| self.compare(*a, *b));
        } else if self.is_reversed {
            rows.reverse();
        }
        rows.into_iter().map(|(row, _)| row).collect()
    }

    /// The columns of these methods, counted from 1, in their order.
    pub fn columns(&self, methods: &[String]) -> Vec<usize> {
        let place = |column: &usize| self.methods.iter().position(|one| *one == methods[column - 1]);
        let mut columns: Vec<usize> = (1..=methods.len()).collect();
        columns.sort_by_key(|column| place(column).unwrap_or(usize::MAX));
        columns
    }

    /// Moves a column of these methods to the place of another.
    pub fn move_column(&mut self, methods: &[String], column: usize, to: usize) {
        let mut columns = self.columns(methods);
        columns.retain(|one| *one != column);
        columns.insert(to.min(columns.len()), column);
        self.methods = columns.into_iter().map(|column| methods[column - 1].clone()).collect();
    }

    /// Sorts by `order`, or the other way round where it is sorted so.
    pub fn sort_by(&mut self, order: ListOrder) {
        self.is_reversed = self.order == order && !self.is_reversed;
        self.order = order;
    }

    fn lists(&self, one: &Listed<'_>, search: &str) -> bool {
        let is_of = |is: fn(&CaseLosses) -> bool| one.losses.is_some_and(is);
        let passes = match self.filter {
            ListFilter::All => true,
            ListFilter::Marked => one.is_marked,
            ListFilter::Failed => is_of(|losses| !losses.problems.is_empty()),
            ListFilter::NotResolvable => is_of(|losses| losses.is_below_floor),
        };
        passes && (search.is_empty() || one.name.to_lowercase().contains(search))
    }

    /// What a material is sorted by; the largest comes first.
    fn value(&self, one: &Listed<'_>) -> Option<f64> {
        match self.order {
            ListOrder::Name => None,
            ListOrder::Loss(method) => one.losses?.loss(method),
            ListOrder::Disagreement => one.losses?.disagreement(),
        }
    }

    fn compare(&self, a: Option<f64>, b: Option<f64>) -> Ordering {
        match (a, b) {
            (Some(a), Some(b)) if self.is_reversed => a.total_cmp(&b),
            (Some(a), Some(b)) => b.total_cmp(&a),
            (a, b) => b.is_some().cmp(&a.is_some()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn losses(all: &[Option<f64>]) -> CaseLosses {
        let known = |loss: &Option<f64>| {
            loss.map(|loss| KnownLoss { loss, standard_error: 0.0, interval95: [loss; 2], scenes: 9 })
        };
        let failed = all.iter().filter(|loss| loss.is_none());
        let problems = failed.map(|_| ("b".to_owned(), "cannot be read".to_owned())).collect();
        CaseLosses { by_method: all.iter().map(known).collect(), problems, is_below_floor: false }
    }

    #[test]
    fn the_list_is_sorted_searched_and_filtered_and_what_is_not_known_comes_last() {
        let all = [
            Some(losses(&[Some(0.3), Some(0.1)])),
            Some(losses(&[Some(0.1), Some(0.5)])),
            None,
            Some(losses(&[Some(0.2), None])),
        ];
        let names = ["brick", "bark", "Bricks", "tiles"];
        let listed: Vec<Listed<'_>> = names
            .iter()
            .zip(&all)
            .map(|(name, losses)| Listed { name, losses: losses.as_ref(), is_marked: *name == "bark" })
            .collect();
        let rows = |view: ListView| view.rows(&listed);
        let by = |order| ListView { order, ..ListView::default() };
        assert_eq!(rows(ListView::default()), [0, 1, 2, 3]);
        assert_eq!(rows(ListView { is_reversed: true, ..ListView::default() }), [3, 2, 1, 0]);
        assert_eq!(rows(by(ListOrder::Loss(0))), [0, 3, 1, 2]);
        assert_eq!(rows(ListView { is_reversed: true, ..by(ListOrder::Loss(0)) }), [1, 3, 0, 2]);
        assert_eq!(rows(by(ListOrder::Disagreement)), [1, 0, 2, 3]);
        assert_eq!(rows(ListView { search: "BRICK".to_owned(), ..ListView::default() }), [0, 2]);
        let only = |filter| rows(ListView { filter, ..ListView::default() });
        assert_eq!([only(ListFilter::Marked), only(ListFilter::Failed)], [vec![1], vec![3]]);
        assert!(only(ListFilter::NotResolvable).is_empty());
    }
}
