//! The ranking of a data set as one HTML file: methods, materials, thumbnails, and links to figures.

use std::collections::BTreeSet;

use svbrdf_core::loss::Estimate;

use super::markup::{Document, escaped, filled, number};
use super::tables::{HtmlTable, cell, row_heading};
use super::{plots, robust};
use svbrdf_evaluate::dataset::{DatasetReport, MaterialResult, MethodSummary, counted_loss, marks_table};
use svbrdf_evaluate::report::{Reader, Report as _, RobustReport};

const PAGE: &str = include_str!("ranking.html");
const STYLE: &str = concat!(include_str!("page.css"), include_str!("ranking.css"));
const SCRIPT: &str = include_str!("ranking.js");
/// The place of the bars in the table of the methods, beside the means and their intervals.
const BAR: usize = 5;

/// What a ranking shows of a material beside its losses.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MaterialView {
    /// Renderings of the ground truth and of the methods as a data URI; `None` where they cannot be read.
    pub(super) thumbnails: Option<String>,
    /// The address of its figure, relative to the page.
    pub(super) figure: Option<String>,
}

/// The ranking as HTML; `views` are those of the results, in their order, or none; `robust` tells whether the order survives.
pub fn ranking(report: &DatasetReport, views: &[MaterialView], robust: Option<&RobustReport>) -> String {
    let settings = &report.settings;
    let title =
        format!("Rendering loss over {} of {} materials", report.results.len(), settings.materials.len());
    let robust = robust.map_or(String::new(), robust::section);
    let sections = methods(report) + &robust + &metrics(report) + &marks(report) + &materials(report, views);
    let body = filled(PAGE, &[("title", &title), ("settings", &heading(report)), ("sections", &sections)]);
    Document { title: &title, style: STYLE, script: SCRIPT, body: &body }.html()
}

/// Everything that the numbers depend on.
fn heading(report: &DatasetReport) -> String {
    let settings = &report.settings;
    let accuracy = escaped(&settings.accuracy()).replace("+-", "&plusmn;");
    let (convention, pick) = (escaped(settings.convention.convention.name), &report.pick);
    format!(
        "Convention {convention}, {accuracy}, pick {pick}. {}. Repeat with <code>{}</code>",
        report.repetition.software,
        escaped(&report.repetition.command)
    )
}

fn methods(report: &DatasetReport) -> String {
    let has_losses = |summary: &&MethodSummary| summary.materials > 0;
    let means: Vec<Estimate> = report.methods.iter().filter(has_losses).map(estimate).collect();
    let axis = plots::axis(means.iter());
    let mut table = HtmlTable::of(report.table(Reader::Person), "name", true).titled();
    let bar = |summary| match has_losses(&summary) {
        true => plots::bar(&estimate(summary), axis),
        false => String::new(),
    };
    table.insert(BAR, "", report.methods.iter().map(bar));
    table.insert(
        BAR + 1,
        "against the best",
        report.methods.iter().map(|summary| verdict(summary).to_owned()),
    );
    let paired = report.best().map_or(String::new(), |best| {
        format!("Differences are paired: over the materials of both, against {}. ", escaped(&best.method))
    });
    let conditions: String =
        report.conditions().iter().map(|condition| format!("<li>{}</li>", escaped(condition))).collect();
    format!(
        r#"<section aria-labelledby="methods"><h2 id="methods">Methods</h2>{}<ul class="conditions">{conditions}</ul><p class="weak">{paired}The interval over materials covers other materials of this kind, the interval over scenes these materials alone.</p></section>"#,
        table.html()
    )
}

/// The mean of a method with its interval over materials.
fn estimate(summary: &MethodSummary) -> Estimate {
    Estimate { mean: summary.mean, standard_error: None, interval95: summary.interval95_materials }
}

/// The paired verdict on a method.
fn verdict(summary: &MethodSummary) -> &'static str {
    match (&summary.to_best, summary.ties_with_best) {
        _ if summary.materials == 0 => "no losses",
        _ if !summary.compared => "lacks materials",
        (None, _) => "best",
        (Some(_), true) if summary.to_best_interval95_materials.is_none() => "too few materials",
        (Some(_), true) => "no significant difference",
        (Some(_), false) => "worse",
    }
}

/// The metrics of the maps, where there are any: a row for each, a column for each method.
fn metrics(report: &DatasetReport) -> String {
    let names: BTreeSet<&String> = report.methods.iter().flat_map(|summary| summary.metrics.keys()).collect();
    if names.is_empty() {
        return String::new();
    }
    let row = |name: &String| {
        let cells = report.methods.iter().map(|summary| {
            let metric = summary.metrics.get(name);
            let interval = metric.and_then(|metric| metric.interval95_materials);
            with_interval(metric.map(|metric| metric.mean), interval)
        });
        [row_heading("", &escaped(name))].into_iter().chain(cells).collect()
    };
    let table = by_method(report, "Metric", names.into_iter().map(row));
    format!(
        r#"<section aria-labelledby="metrics"><h2 id="metrics">Metrics of the maps</h2>{table}<p class="weak">Means over materials, with their 95% intervals over materials.</p></section>"#
    )
}

/// A table with a column for each method.
fn by_method(report: &DatasetReport, first: &str, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let methods = report.methods.iter().map(|summary| summary.method.as_str());
    HtmlTable::new([first].into_iter().chain(methods), rows).html()
}

/// The marks of diagnoses, where there are any.
fn marks(report: &DatasetReport) -> String {
    let Some(table) = marks_table(report) else { return String::new() };
    let table = HtmlTable::of(table, "", false).html();
    format!(
        r#"<section aria-labelledby="marks"><h2 id="marks">What would explain a loss</h2>{table}<p class="weak">Numbers of materials. A mark that most materials of a method share is a convention of its files.</p></section>"#
    )
}

fn materials(report: &DatasetReport, views: &[MaterialView]) -> String {
    let none = MaterialView::default();
    let row = |(place, result): (usize, &MaterialResult)| {
        let name = material(&result.material, views.get(place).unwrap_or(&none));
        let losses = report.methods.iter().map(|summary| loss(report, result, &summary.method));
        [row_heading("material", &name)].into_iter().chain(losses).collect()
    };
    let table = by_method(report, "Material", report.results.iter().enumerate().map(row));
    let links = if views.iter().any(|view| view.figure.is_some()) {
        " A name with a link opens the interactive figure of the material, a file beside this one."
    } else {
        ""
    };
    format!(
        r#"<section aria-labelledby="materials"><h2 id="materials">Materials</h2>{table}<p class="weak">Loss, and its 95% interval over scenes. Renderings from left to right: ground truth, then the methods with a loss, in the order of the columns.{links}</p></section>"#
    )
}

/// The name of a material, its thumbnails and the link to its figure.
fn material(name: &str, view: &MaterialView) -> String {
    let name = escaped(name);
    let picture = view
        .thumbnails
        .as_ref()
        .map_or(String::new(), |data| format!(r#"<img class="thumbnails" src="{data}" alt="">"#));
    match &view.figure {
        Some(figure) => format!(r#"<a href="{}">{picture}{name}</a>"#, escaped(figure)),
        None => picture + &name,
    }
}

/// The cell of the loss of a material by a method: the one that counts, or why there is none.
fn loss(report: &DatasetReport, result: &MaterialResult, method: &str) -> String {
    if let Some(known) = counted_loss(result, method, report.pick) {
        return with_interval(Some(known.loss), Some(known.interval95));
    }
    let mut of_method = result.predictions.iter().filter(|prediction| prediction.method == method);
    let problem = of_method.find_map(|prediction| prediction.error.as_deref()).unwrap_or("no prediction");
    format!(r#"<td class="problem" data-sort="">{}</td>"#, escaped(problem))
}

/// A cell of a number above its interval, sorted by the number.
fn with_interval(value: Option<f64>, interval: Option<[f64; 2]>) -> String {
    let (Some(value), Some([low, high])) = (value, interval) else {
        return cell(&value.filter(|value| value.is_finite()).into(), true);
    };
    let [text, low, high] = [value, low, high].map(number);
    format!(r#"<td data-sort="{value}">{text}<small>{low} to {high}</small></td>"#)
}
