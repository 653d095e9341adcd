//! The ranking of a data set as one HTML file: methods, materials, thumbnails, and links to figures.

use svbrdf_core::loss::Estimate;

use super::markup::{Document, escaped, filled, number};
use super::tables::{HtmlTable, cell, row_heading};
use super::{findings, plots};
use svbrdf_evaluate::dataset::{
    DatasetReport, FEWEST, MaterialResult, MethodSummary, MetricRow, Pick, best_by_metric, counted_loss,
    is_better_larger, marks_table,
};
use svbrdf_evaluate::report::{Reader, Report as _};
use svbrdf_evaluate::robust::RobustReport;

const PAGE: &str = include_str!("ranking.html");
const STYLE: &str = concat!(include_str!("page.css"), include_str!("ranking.css"));
const SCRIPT: &str = include_str!("ranking.js");
/// The place of the bars in the table of the methods, beside the means and their intervals.
const BAR: usize = 5;

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
    let settings = &report.settings;
    let (count, all) = (report.results.len(), settings.materials.len());
    let of = if count == all { String::new() } else { format!(" of {all}") };
    let title = format!("Rendering loss over {count}{of} materials");
    let verdict = overall(report);
    let robust = robust.map_or(String::new(), findings::robust);
    let sections = methods(report) + &robust + &materials(report, views) + &metrics(report) + &marks(report);
    let settings = heading(report, !robust.is_empty());
    let parts = [("title", &title), ("verdict", &verdict), ("settings", &settings), ("sections", &sections)];
    let body = filled(PAGE, &parts.map(|(key, text)| (key, text.as_str())));
    let (title, description) = (title.as_str(), verdict.as_str());
    Document { title, description, style: STYLE, script: SCRIPT, body: &body }.html()
}

/// Everything that the numbers depend on.
fn heading(report: &DatasetReport, is_robust: bool) -> String {
    let settings = &report.settings;
    let accuracy = escaped(&settings.accuracy()).replace("+-", "&plusmn;");
    let convention = escaped(settings.convention.convention.name);
    let pick = match report.pick {
        Pick::Fixed => String::new(),
        pick => format!(", of several predictions of a material the {pick}"),
    };
    let files: String =
        report.files.iter().map(|(whose, sha256)| format!("sha256 {sha256} {}\n", escaped(whose))).collect();
    let files = match files.is_empty() {
        true => files,
        false => format!("<details><summary>Files</summary><pre>{files}</pre></details>"),
    };
    format!(
        "Convention {convention}, {accuracy}{pick}. {}. Repeat with <code>{}</code>{files}",
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
        (Some(_), true) if summary.worse_on.is_some_and(|[_, all]| all < FEWEST) => "too few materials",
        (Some(_), true) => "no significant difference",
        (Some(_), false) => "worse",
    }
}

/// The metrics of the maps, where there are any: a row for each, a column for each method.
fn metrics(report: &DatasetReport) -> String {
    let all = best_by_metric(report);
    if all.is_empty() {
        return String::new();
    }
    let row = |(row, best): &(MetricRow, Vec<bool>)| {
        let compared = report.methods.iter().zip(best).filter(|(summary, _)| summary.compared);
        let differ = compared.into_iter().any(|(_, best)| !best);
        let cells = report.methods.iter().zip(best).map(|(summary, best)| {
            let known = row.value(summary);
            let interval = known.and_then(|known| known.1);
            let class = if *best && differ { "best" } else { "" };
            with_interval(known.map(|known| known.0), interval, class, "")
        });
        let arrow = if is_better_larger(&row.metric) { "\u{2191}" } else { "\u{2193}" };
        [row_heading("", &format!("{} {arrow}", escaped(&row.title())))].into_iter().chain(cells).collect()
    };
    let table = by_method(report, &["Metric"], all.iter().map(row));
    format!(
        r#"<section aria-labelledby="metrics"><h2 id="metrics">Metrics of the maps</h2>{table}<p class="weak">Means over materials, with their 95% intervals over materials. &uarr;: larger is better; &darr;: smaller is better. Bold: the best, and what has no significant difference from it, where any has one.</p></section>"#
    )
}

/// A table with a column for each method.
fn by_method(report: &DatasetReport, first: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let methods = report.methods.iter().map(|summary| summary.method.as_str());
    HtmlTable::new(first.iter().copied().chain(methods), rows).html()
}

/// The marks of diagnoses, where there are any.
fn marks(report: &DatasetReport) -> String {
    let Some(table) = marks_table(report) else { return String::new() };
    let table = HtmlTable::of(table, "", false).html();
    format!(
        r#"<section aria-labelledby="marks"><h2 id="marks">What would explain a loss</h2>{table}<p class="weak">Numbers of materials. A mark that most materials of a method share is a convention of its files.</p></section>"#
    )
}

/// The sheet of the materials: a row for each, with a picture above each loss.
fn materials(report: &DatasetReport, views: &[MaterialView]) -> String {
    let none = MaterialView::default();
    let has_pictures = views.iter().any(|view| !view.pictures.is_empty());
    let row = |(place, result): (usize, &MaterialResult)| {
        let view = views.get(place).unwrap_or(&none);
        let name = linked(escaped(&result.material), view);
        let of = |column: usize, what: &str| picture(view, column, what, &result.material);
        let truth = has_pictures.then(|| format!("<td>{}</td>", of(0, "ground truth")));
        let losses = (1..)
            .zip(&report.methods)
            .map(|(column, summary)| loss(report, result, &summary.method, &of(column, &summary.method)));
        [row_heading("material", &name)].into_iter().chain(truth).chain(losses).collect()
    };
    let columns: &[&str] = if has_pictures { &["Material", "Ground truth"] } else { &["Material"] };
    let table = by_method(report, columns, report.results.iter().enumerate().map(row));
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
        r#"<section aria-labelledby="materials" class="sheet"><h2 id="materials">Materials</h2>{table}<p class="weak">Loss, and its 95% interval over scenes.{pictures}{links}</p></section>"#
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

/// The cell of the loss of a material by a method: the one that counts, or why there is none.
fn loss(report: &DatasetReport, result: &MaterialResult, method: &str, picture: &str) -> String {
    if let Some(known) = counted_loss(result, method, report.pick) {
        return with_interval(Some(known.loss), Some(known.interval95), "", picture);
    }
    let mut of_method = result.predictions.iter().filter(|prediction| prediction.method == method);
    let problem = of_method.find_map(|prediction| prediction.error.as_deref()).unwrap_or("no prediction");
    format!(r#"<td class="problem" data-sort="">{picture}{}</td>"#, escaped(problem))
}

/// A cell of a number above its interval and below a picture, sorted by the number.
fn with_interval(value: Option<f64>, interval: Option<[f64; 2]>, class: &str, picture: &str) -> String {
    let Some(value) = value.filter(|value| value.is_finite()) else { return cell(&None::<f64>.into(), true) };
    let text = number(value);
    let interval = interval.map_or(String::new(), |ends| {
        let [low, high] = ends.map(number);
        format!("<small>{low} to {high}</small>")
    });
    let class = if class.is_empty() { String::new() } else { format!(r#" class="{class}""#) };
    format!(r#"<td data-sort="{value}"{class}>{picture}<span>{text}</span>{interval}</td>"#)
}
