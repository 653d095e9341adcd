//! Reports of the crate as Python takes them.

use pyo3::prelude::*;
use svbrdf_evaluate::report::{Cell, Reader, Report};

use crate::errors::exception;

/// A report: its JSON, its text, and its table for data frames.
#[derive(Debug, IntoPyObject)]
pub struct Views {
    json: String,
    text: String,
    columns: Vec<String>,
    rows: Vec<Vec<CellItem>>,
    /// The text above the table for people, the table, and the text below it.
    shown: (String, Vec<String>, Vec<Vec<String>>, String),
    /// What is known less well than requested.
    warnings: Vec<String>,
}

impl Views {
    /// The views of `report`.
    ///
    /// # Errors
    /// As [`Report::json`].
    pub fn new(report: &(impl Report + ?Sized)) -> PyResult<Self> {
        let table = report.table(Reader::Program);
        Ok(Self {
            rows: table.rows.into_iter().map(items).collect(),
            columns: table.columns,
            ..Self::without_rows(report)?
        })
    }

    /// The views of a `report` whose rows are arrays.
    ///
    /// # Errors
    /// As [`Report::json`].
    pub fn without_rows(report: &(impl Report + ?Sized)) -> PyResult<Self> {
        let (text, table) = (report.text(), report.table(Reader::Person));
        let (above, below) = match text.split_once(&table.text()) {
            Some((above, below)) => (above.trim_end().to_owned(), below.trim().to_owned()),
            None => (String::new(), text.clone()),
        };
        let rows = table.rows.iter().map(|row| row.iter().map(Cell::text).collect()).collect();
        Ok(Self {
            json: report.json().map_err(exception)?,
            text,
            shown: (above, table.columns, rows, below),
            columns: Vec::new(),
            rows: Vec::new(),
            warnings: report.missed().iter().map(ToString::to_string).collect(),
        })
    }
}

fn items(row: Vec<Cell>) -> Vec<CellItem> {
    row.into_iter().map(CellItem::from).collect()
}

/// A value of a table.
#[derive(Debug, IntoPyObject)]
enum CellItem {
    Text(String),
    Integer(u64),
    Number(f64),
    Truth(bool),
    /// None in Python.
    Empty(Option<bool>),
}

impl From<Cell> for CellItem {
    fn from(cell: Cell) -> Self {
        match cell {
            Cell::Missing(_) => Self::Empty(None),
            Cell::Text(text) => Self::Text(text),
            Cell::Integer(number) => Self::Integer(number),
            Cell::Number(number) | Cell::Share(number) | Cell::Digits(_, number) | Cell::Stops(number) => {
                Self::Number(number)
            }
            Cell::Single(number) => Self::Number(f64::from(number)),
            Cell::Truth(truth) => Self::Truth(truth),
            Cell::Interval(..) | Cell::Point(_) => Self::Text(cell.text()),
        }
    }
}
