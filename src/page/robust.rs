//! Section of a page on the robustness of an order: whether it survives other questions.

use svbrdf_evaluate::report::{Reader, Report as _, RobustReport};

use super::markup::escaped;
use super::tables::HtmlTable;

/// The sentence, each pair that changes sides, and the order under every question.
pub(super) fn section(report: &RobustReport) -> String {
    let changes: String = report.changes().map(|change| format!("<li>{}</li>", escaped(&change))).collect();
    let changes =
        if changes.is_empty() { changes } else { format!(r#"<ul class="conditions">{changes}</ul>"#) };
    format!(
        r#"<section aria-labelledby="robust"><h2 id="robust">Does the order survive?</h2><p>{}</p>{changes}{}<p class="weak">Tau: Kendall's tau to the order by default, 1 where no pair changes sides; differences that are not significant are no changes.</p></section>"#,
        escaped(report.sentence()),
        HtmlTable::of(report.table(Reader::Person), "", false).titled().html(),
    )
}
