//! The ranking of a data set as one HTML file: its verdict, its report, and a sheet of materials with links to figures.

use super::findings::{report_html, text_html};
use super::markup::{Document, escaped, number, section, table};
use svbrdf_evaluate::dataset::{DatasetReport, FEWEST, MaterialResult, MethodSummary, counted_loss};
use svbrdf_evaluate::report::{Reader, Report as _};
use svbrdf_evaluate::robust::RobustReport;

/// What a ranking shows of a material beside its losses.
#[derive(Debug, Default)]
pub struct MaterialView {
    /// Renderings of the ground truth and of the methods of the report, in their order, as data URIs; `None` where one cannot be read.
    pub(super) pictures: Vec<Option<String>>,
    /// The address of its figure, relative to the page.
    pub(super) figure: Option<String>,
}

/// The ranking as HTML; `views` are those of the results, in their order, or none; `robust` tells whether the order survives.
pub fn ranking(report: &DatasetReport, views: &[MaterialView], robust: Option<&RobustReport>) -> String {
    let (count, all) = (report.results.len(), report.settings.materials.len());
    let of = if count == all { String::new() } else { format!(" of {all}") };
    let title = format!("Rendering loss over {count}{of} materials");
    let verdict = overall(report);
    let survives =
        robust.map_or(String::new(), |robust| section("Does the order survive?", &report_html(robust)));
    // The heading has the command.
    let text = report.text().replace(&format!("\n{}\n", report.repetition), "");
    let body = format!(
        r#"<header><h1>{title}</h1><p class="verdict">{verdict}</p><p class="weak">{}</p></header><main>{}{survives}{}</main>"#,
        repetition(report, robust.is_some()),
        section("Methods", &text_html(&text, &report.table(Reader::Person))),
        section("Materials", &materials(report, views)),
    );
    let (title, description, style) = (title.as_str(), verdict.as_str(), include_str!("page.css"));
    Document { title, description, style, script: "", body: &body }.html()
}

/// How the ranking is made again, and of which files.
fn repetition(report: &DatasetReport, is_robust: bool) -> String {
    let files: String =
        report.files.iter().map(|(whose, sha256)| format!("sha256 {sha256} {}\n", escaped(whose))).collect();
    let files = match files.is_empty() {
        true => files,
        false => format!("<details><summary>Files</summary><pre>{files}</pre></details>"),
    };
    format!(
        "{}. Repeat with <code>{}</code>{files}",
        report.repetition.software,
        escaped(&report.repetition.command) + if is_robust { " --robust" } else { "" }
    )
}

/// The verdict in a sentence: the best method, which are worse, and which cannot be told from it.
fn overall(report: &DatasetReport) -> String {
    let Some(best) = report.best() else { return "No methods are compared.".to_owned() };
    let one = |summary: &MethodSummary| format!("{} ({})", escaped(&summary.method), number(summary.mean));
    let compared = || report.methods.iter().skip(1).filter(|summary| summary.compared);
    let (ties, worse): (Vec<_>, Vec<_>) = compared().partition(|summary| summary.ties_with_best);
    let [ties, worse] = [ties, worse].map(|of| of.into_iter().map(one).collect::<Vec<_>>()).map(listed);
    let count = report.compared_materials.len();
    let name = one(best);
    if worse.is_empty() && ties.is_empty() {
        return format!("{name} has losses of {count} materials; no other method is compared.");
    }
    let least = format!("{name} has the least mean loss over {count} materials");
    if count < FEWEST && worse.is_empty() {
        return format!(
            "{least}, before {ties}; the materials are too few to tell of a significant difference."
        );
    }
    match (worse.is_empty(), ties.is_empty()) {
        (true, _) => format!("{least}, with no significant difference from {ties}."),
        (_, true) => format!("{least}, significantly less than {worse}."),
        _ => format!("{least}, significantly less than {worse}, with no significant difference from {ties}."),
    }
}

/// The parts of a list in a sentence.
fn listed(mut parts: Vec<String>) -> String {
    let last = parts.pop().unwrap_or_default();
    if parts.is_empty() { last } else { format!("{} and {last}", parts.join(", ")) }
}

/// The sheet of the materials: a row for each, with a picture above each loss.
fn materials(report: &DatasetReport, views: &[MaterialView]) -> String {
    let none = MaterialView::default();
    let has_pictures = views.iter().any(|view| !view.pictures.is_empty());
    let row = |(place, result): (usize, &MaterialResult)| {
        let view = views.get(place).unwrap_or(&none);
        let name = linked(escaped(&result.material), view);
        let of = |column: usize, what: &str| picture(view, column, what, &result.material);
        let truth = has_pictures.then(|| of(0, "ground truth"));
        let losses = (1..)
            .zip(&report.methods)
            .map(|(column, summary)| of(column, &summary.method) + &loss(report, result, &summary.method));
        [name].into_iter().chain(truth).chain(losses).collect::<Vec<_>>()
    };
    let columns: &[&str] = if has_pictures { &["Material", "Ground truth"] } else { &["Material"] };
    let methods = report.methods.iter().map(|summary| escaped(&summary.method));
    let headings = columns.iter().map(|name| (*name).to_owned()).chain(methods);
    let rows = report.results.iter().enumerate().map(row);
    let pictures = if has_pictures {
        " All pictures have one light; those of a material have the exposure of its ground truth."
    } else {
        ""
    };
    let links = if views.iter().any(|view| view.figure.is_some()) {
        " A link opens the interactive figure of the material: a file beside this one."
    } else {
        ""
    };
    format!(
        r#"<div class="sheet">{}</div><p class="weak">Loss, and its 95% interval over scenes.{pictures}{links}</p>"#,
        table(headings, rows)
    )
}

/// HTML with a link to the figure of a material, where it has one.
fn linked(html: String, view: &MaterialView) -> String {
    match &view.figure {
        Some(figure) => format!(r#"<a href="{}">{html}</a>"#, escaped(figure)),
        None => html,
    }
}

/// The picture of a column, which leads to the figure.
fn picture(view: &MaterialView, column: usize, what: &str, material: &str) -> String {
    let Some(data) = view.pictures.get(column).and_then(Option::as_ref) else { return String::new() };
    let alt = format!("{}, {}", escaped(material), escaped(what));
    linked(format!(r#"<img src="{data}" alt="{alt}">"#), view)
}

/// The loss of a material by a method: the one that counts with its interval, or why there is none.
fn loss(report: &DatasetReport, result: &MaterialResult, method: &str) -> String {
    if let Some(known) = counted_loss(result, method, report.pick) {
        let [low, high] = known.interval95.map(number);
        return format!("{}<small>{low} to {high}</small>", number(known.loss));
    }
    let mut of_method = result.predictions.iter().filter(|prediction| prediction.method == method);
    let problem = of_method.find_map(|prediction| prediction.error.as_deref()).unwrap_or("no prediction");
    format!(r#"<span class="problem">{}</span>"#, escaped(problem))
}
