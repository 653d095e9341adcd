//! Reports of the crate as Python takes them.

use pyo3::prelude::*;
use svbrdf_evaluate::report::{Cell, Reader, Report};

use crate::errors::exception;

/// A report: its JSON, its text, and its CSV.
#[derive(Debug, IntoPyObject)]
pub struct Views {
    json: String,
    text: String,
    /// Empty where rows are arrays.
    csv: String,
    /// The text for people with its table as HTML.
    html: String,
    /// What is known less well than requested.
    warnings: Vec<String>,
}

impl Views {
    /// The views of `report`.
    ///
    /// # Errors
    /// As [`Report::json`].
    pub fn new(report: &(impl Report + ?Sized)) -> PyResult<Self> {
        Ok(Self { csv: report.csv().map_err(exception)?, ..Self::without_rows(report)? })
    }

    /// The views of a `report` whose rows are arrays.
    ///
    /// # Errors
    /// As [`Report::json`].
    pub fn without_rows(report: &(impl Report + ?Sized)) -> PyResult<Self> {
        let (text, table) = (report.text(), report.table(Reader::Person));
        let (above, below) = text.split_once(&table.text()).unwrap_or(("", &text));
        let cells = |element: &str, texts: &mut dyn Iterator<Item = String>| -> String {
            texts.map(|text| format!("<{element}>{}</{element}>", escaped(&text))).collect()
        };
        let row = |row: &Vec<Cell>| format!("<tr>{}</tr>", cells("td", &mut row.iter().map(Cell::text)));
        let rows: String = table.rows.iter().map(row).collect();
        let html = format!(
            r#"<div><p>{}</p><div style="overflow-x: auto"><table><thead><tr>{}</tr></thead><tbody>{rows}</tbody></table></div><pre>{}</pre></div>"#,
            escaped(above.trim_end()).replace('\n', "<br>"),
            cells("th", &mut table.columns.into_iter()),
            escaped(below.trim()),
        );
        let warnings = report.missed().iter().map(ToString::to_string).collect();
        Ok(Self { json: report.json().map_err(exception)?, csv: String::new(), html, text, warnings })
    }
}

/// A text as HTML.
#[pyfunction]
pub fn escaped(text: &str) -> String {
    svbrdf_page::escaped(text)
}

/// The JSON Schema of a report, by the name of its command; None for another name.
#[pyfunction]
pub fn schema(name: &str) -> Option<String> {
    serde_json::to_string(&svbrdf_evaluate::schema::named(name)?).ok()
}
