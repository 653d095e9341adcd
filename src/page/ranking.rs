//! The ranking of a data set as one HTML file: methods, materials, thumbnails, and links to figures.

use std::fmt::Write as _;

use svbrdf_core::loss::Estimate;

use super::markup::{Document, escaped, filled, number};
use super::plots;
use svbrdf_evaluate::dataset::{
    DatasetReport, MaterialResult, MethodSummary, counted_loss, mark_report, summarize_metrics,
};
use svbrdf_files::disk::atomic::SOFTWARE;

const PAGE: &str = include_str!("ranking.html");
const STYLE: &str = concat!(include_str!("page.css"), include_str!("ranking.css"));
const SCRIPT: &str = include_str!("ranking.js");

/// What a ranking shows of a material beside its losses.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MaterialView {
    /// Renderings of the ground truth and of the methods as a data URI; `None` where they cannot be read.
    pub(super) thumbnails: Option<String>,
    /// The address of its figure, relative to the page.
    pub(super) figure: Option<String>,
}

/// The ranking as HTML; `views` are those of the results, in their order, or none.
pub fn ranking(report: &DatasetReport, views: &[MaterialView]) -> String {
    let settings = &report.settings;
    let title =
        format!("Rendering loss over {} of {} materials", report.results.len(), settings.materials.len());
    let sections = methods(report) + &metrics(report) + &marks(report) + &materials(report, views);
    let body = filled(PAGE, &[("title", &title), ("settings", &heading(report)), ("sections", &sections)]);
    Document { title: &title, style: STYLE, script: SCRIPT, body: &body }.html()
}

/// Everything that the numbers depend on.
fn heading(report: &DatasetReport) -> String {
    let settings = &report.settings;
    let percent = 100.0 * settings.target_error;
    let (convention, pick) = (escaped(&settings.convention), &report.pick);
    format!(
        "Convention {convention}, &plusmn;{percent}% per loss, seed {}, pick {pick}. {SOFTWARE}. Repeat with <code>{}</code>",
        settings.seed,
        escaped(&report.command())
    )
}

fn methods(report: &DatasetReport) -> String {
    let methods = &report.ranking.methods;
    let means = methods.iter().filter(|summary| summary.materials > 0).map(estimate).collect::<Vec<_>>();
    let axis = plots::axis(means.iter());
    let mut rows = String::new();
    for summary in methods {
        let bar = if summary.materials > 0 { plots::bar(&estimate(summary), axis) } else { String::new() };
        let (difference, interval) = match &summary.to_best {
            None => (cell(None), "<td></td>".to_owned()),
            Some(to_best) => (cell(Some(to_best.mean)), ends(to_best.interval95_materials)),
        };
        let _ = write!(
            rows,
            r#"<tr><th scope="row" class="name">{}</th>{}{}<td>{bar}</td><td>{}</td>{difference}{interval}{}{}{}{}</tr>"#,
            escaped(&summary.method),
            cell(Some(summary.mean)),
            ends(summary.interval95_materials),
            verdict(summary),
            cell(Some(summary.median)),
            ends(Some(summary.interval95_scenes)),
            count(summary.materials),
            count(summary.failures),
        );
    }
    let paired = report.ranking.best().map_or(String::new(), |best| {
        format!("Differences are paired: over the materials of both, against {}. ", escaped(&best.method))
    });
    let conditions: String =
        report.conditions().iter().map(|condition| format!("<li>{}</li>", escaped(condition))).collect();
    format!(
        r#"<section aria-labelledby="methods"><h2 id="methods">Methods</h2><div class="wide"><table><thead><tr><th scope="col">Method</th><th scope="col">Mean loss</th><th scope="col">95% over materials</th><td></td><th scope="col">Against the best</th><th scope="col">&minus;&nbsp;best</th><th scope="col">95% over materials</th><th scope="col">Median</th><th scope="col">95% over scenes</th><th scope="col">Materials</th><th scope="col">Failed</th></tr></thead><tbody>{rows}</tbody></table></div><ul class="conditions">{conditions}</ul><p class="weak">{paired}The interval over materials covers other materials of this kind, the interval over scenes these materials alone.</p></section>"#
    )
}

/// The mean of a method with its interval over materials.
fn estimate(summary: &MethodSummary) -> Estimate {
    Estimate { mean: summary.mean, standard_error: None, interval95: summary.interval95_materials }
}

/// The paired verdict on a method.
fn verdict(summary: &MethodSummary) -> &'static str {
    match (&summary.to_best, summary.ties_with_best()) {
        _ if summary.materials == 0 => "no losses",
        _ if !summary.is_compared => "lacks materials",
        (None, _) => "best",
        (Some(difference), true) if difference.interval95_materials.is_none() => "too few materials",
        (Some(_), true) => "no significant difference",
        (Some(_), false) => "worse",
    }
}

/// The metrics of the maps, where there are any: a row for each, a column for each method.
fn metrics(report: &DatasetReport) -> String {
    let all: Vec<_> =
        report.ranking.methods.iter().map(|summary| summarize_metrics(report, summary)).collect();
    let mut names: Vec<&String> = all.iter().flat_map(|metrics| metrics.keys()).collect();
    names.sort();
    names.dedup();
    if names.is_empty() {
        return String::new();
    }
    let row = |name: &&String| {
        let cells = all.iter().map(|metrics| {
            let interval = metrics.get(*name).and_then(|metric| metric.interval95_materials);
            with_interval(metrics.get(*name).map(|metric| metric.mean), interval)
        });
        format!(r#"<tr><th scope="row">{}</th>{}</tr>"#, escaped(name), cells.collect::<String>())
    };
    let rows: String = names.iter().map(row).collect();
    format!(
        r#"<section aria-labelledby="metrics"><h2 id="metrics">Metrics of the maps</h2><div class="wide"><table><thead><tr><th scope="col">Metric</th>{}</tr></thead><tbody>{rows}</tbody></table></div><p class="weak">Means over materials, with their 95% intervals over materials.</p></section>"#,
        method_headings(report)
    )
}

/// The marks of diagnoses, where there are any.
fn marks(report: &DatasetReport) -> String {
    let rows = mark_report::rows(report);
    let Some((headings, rows)) = rows.split_first() else { return String::new() };
    let headings: String =
        headings.iter().map(|heading| format!(r#"<th scope="col">{}</th>"#, escaped(heading))).collect();
    let row = |cells: &Vec<String>| {
        let (name, numbers) = cells.split_first().map_or(("", &[][..]), |(name, rest)| (name.as_str(), rest));
        let numbers: String = numbers.iter().map(|number| format!("<td>{}</td>", escaped(number))).collect();
        format!(r#"<tr><th scope="row">{}</th>{numbers}</tr>"#, escaped(name))
    };
    let rows: String = rows.iter().map(row).collect();
    format!(
        r#"<section aria-labelledby="marks"><h2 id="marks">What would explain a loss</h2><div class="wide"><table><thead><tr>{headings}</tr></thead><tbody>{rows}</tbody></table></div><p class="weak">Numbers of materials. A mark that most materials of a method share is a convention of its files.</p></section>"#
    )
}

fn materials(report: &DatasetReport, views: &[MaterialView]) -> String {
    let none = MaterialView::default();
    let mut rows = String::new();
    for (place, result) in report.results.iter().enumerate() {
        let cells: String =
            report.ranking.methods.iter().map(|summary| loss(report, result, &summary.method)).collect();
        let name = material(&result.material, views.get(place).unwrap_or(&none));
        let _ = write!(rows, r#"<tr><th scope="row" class="material">{name}</th>{cells}</tr>"#);
    }
    let links = if views.iter().any(|view| view.figure.is_some()) {
        " A name with a link opens the interactive figure of the material, a file beside this one."
    } else {
        ""
    };
    format!(
        r#"<section aria-labelledby="materials"><h2 id="materials">Materials</h2><div class="wide"><table><thead><tr><th scope="col">Material</th>{}</tr></thead><tbody>{rows}</tbody></table></div><p class="weak">Loss, and its 95% interval over scenes. Renderings from left to right: ground truth, then the methods with a loss, in the order of the columns.{links}</p></section>"#,
        method_headings(report)
    )
}

fn method_headings(report: &DatasetReport) -> String {
    report
        .ranking
        .methods
        .iter()
        .map(|summary| format!(r#"<th scope="col">{}</th>"#, escaped(&summary.method)))
        .collect()
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
    let problem = of_method.find_map(|prediction| prediction.result.as_ref().err());
    let problem = problem.map_or("no prediction", String::as_str);
    format!(r#"<td class="problem" data-sort="">{}</td>"#, escaped(problem))
}

/// A cell that is sorted by its number.
fn cell(value: Option<f64>) -> String {
    match value.filter(|value| value.is_finite()) {
        Some(value) => format!(r#"<td data-sort="{value}">{}</td>"#, number(value)),
        None => r#"<td data-sort=""></td>"#.to_owned(),
    }
}

fn with_interval(value: Option<f64>, interval: Option<[f64; 2]>) -> String {
    let (Some(value), Some([low, high])) = (value, interval) else { return cell(value) };
    let [text, low, high] = [value, low, high].map(number);
    format!(r#"<td data-sort="{value}">{text}<small>{low} to {high}</small></td>"#)
}

/// A cell with the ends of an interval, sorted by the lower one.
fn ends(interval: Option<[f64; 2]>) -> String {
    match interval.filter(|[low, _]| !low.is_nan()) {
        Some([low, high]) => {
            let texts = [low, high].map(number);
            format!(r#"<td data-sort="{low}">{} to {}</td>"#, texts[0], texts[1])
        }
        None => r#"<td data-sort="">&ndash;</td>"#.to_owned(),
    }
}

fn count(number: usize) -> String {
    format!(r#"<td data-sort="{number}">{number}</td>"#)
}
