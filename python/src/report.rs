//! Reports of the crate as Python takes them.

use pyo3::prelude::*;
use svbrdf_evaluate::report::Report;
use svbrdf_page::report_html;

use crate::errors::exception;

/// A report: its JSON, its text, and its CSV.
#[derive(Debug, IntoPyObject)]
pub struct ReportViews {
    json: String,
    text: String,
    /// Empty where rows are arrays.
    csv: String,
    /// The text for people with its table as HTML.
    html: String,
    /// What is known less well than requested.
    pub warnings: Vec<String>,
}

impl ReportViews {
    /// The views of `report`, without its rows where they are arrays.
    ///
    /// # Errors
    /// As [`Report::csv`].
    pub fn new(report: &(impl Report + ?Sized), has_rows: bool) -> PyResult<Self> {
        let csv = if has_rows { report.csv().map_err(exception)? } else { String::new() };
        let (text, html) = (report.text(), format!("<div>{}</div>", report_html(report)));
        let warnings = report.missed();
        Ok(Self { json: report.json().map_err(exception)?, csv, html, text, warnings })
    }
}

/// The JSON Schema of a report, by the name of its command; None for another name.
#[pyfunction]
pub fn schema(name: &str) -> Option<String> {
    serde_json::to_string(&svbrdf_evaluate::schema::named(name)?).ok()
}
