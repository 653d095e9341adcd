//! The findings as HTML without script: reports, worst scenes, reading, repetition.

use std::fmt::Write as _;

use svbrdf_core::loss::{Loss, Outcome};
use svbrdf_core::model::scene::Kind;
use svbrdf_evaluate::analyses::LossReport;
use svbrdf_evaluate::report::{Reader, Report as EvaluateReport, Table};
use svbrdf_files::disk::atomic::SOFTWARE;

use super::content::{Findings, PageReport};
use super::data::LinkedScene;
use super::markup::{MOST_NAMES, escaped, number, place, section, table};
use super::pictures::exposure;

/// The sections below the figure, and the scenes that they link.
pub(super) fn sections(report: &PageReport<'_>) -> (String, Vec<LinkedScene>) {
    let mut html = String::new();
    let mut linked = Vec::new();
    if let Some(findings) = &report.findings {
        html += &section("Rendering loss", &report_html(&findings.loss));
        html += &section("Which map", &report_html(&findings.blame));
        let (scenes, of_scenes) = worst_scenes(report, findings);
        html += &scenes;
        linked = of_scenes;
    }
    (html + &readings(report) + &repetition(report), linked)
}

/// A report as HTML: its settings, its table, and what its text has below that. A report of several tables is its text.
pub fn report_html(report: &(impl EvaluateReport + ?Sized)) -> String {
    text_html(&report.text(), &report.table(Reader::Person))
}

/// The text of a report as HTML, in which these are the `rows` of its table.
pub(super) fn text_html(text: &str, rows: &Table) -> String {
    let Some((above, below)) = text.split_once(&rows.text()) else {
        return format!("<pre>{}</pre>", escaped(text.trim_end()));
    };
    let above = escaped(above.trim_end()).replace('\n', "<br>");
    let below = match below.trim() {
        "" => String::new(),
        below => format!("<pre>{}</pre>", escaped(below)),
    };
    let cells = rows.rows.iter().map(|row| row.iter().map(|cell| escaped(&cell.text())).collect());
    format!(
        r#"<p class="weak">{above}</p>{}{below}"#,
        table(rows.columns.iter().map(|name| escaped(name)), cells)
    )
}

/// The losses in one line, or the least of many; then whether the least is significantly less than the others.
pub(super) fn summary(LossReport { outcome, convention, masked, .. }: &LossReport) -> String {
    let one = |loss: &Loss| format!("{} {}", escaped(&loss.prediction), number(loss.estimate.mean));
    let all = &outcome.losses;
    let best = (0..all.len()).min_by(|a, b| all[*a].estimate.mean.total_cmp(&all[*b].estimate.mean));
    let texts = match best.filter(|_| all.len() > MOST_NAMES) {
        Some(best) => format!("{}, the least of {}", one(&all[best]), all.len()),
        None => all.iter().map(one).collect::<Vec<_>>().join(", "),
    };
    let verdicts = best.map_or(String::new(), |best| verdicts(outcome, best));
    let masked = masked.map_or(String::new(), |kept| format!(" over the mask of {kept} texels"));
    format!("Rendering loss{masked}, convention {convention}: {texts}.{verdicts}")
}

/// The prediction with the least loss against all others, on the same scenes.
fn verdicts(outcome: &Outcome, best: usize) -> String {
    let all = &outcome.losses;
    let is_clear =
        |other: &usize| outcome.difference(*other, best).interval95.is_some_and(|[low, _]| low > 0.0);
    let (worse, ties): (Vec<usize>, Vec<usize>) =
        (0..all.len()).filter(|other| *other != best).partition(is_clear);
    let names = |of: &[usize]| match of.len() {
        count if count > MOST_NAMES => format!("{count} others"),
        _ => of.iter().map(|index| escaped(&all[*index].prediction)).collect::<Vec<_>>().join(", "),
    };
    let best = escaped(&all[best].prediction);
    let mut text = String::new();
    if !worse.is_empty() {
        let _ = write!(text, " {best} is closer to the ground truth than {}.", names(&worse));
    }
    if !ties.is_empty() {
        let _ = write!(text, " {best}: no significant difference from {}.", names(&ties));
    }
    text
}

fn worst_scenes(report: &PageReport<'_>, findings: &Findings) -> (String, Vec<LinkedScene>) {
    let mut items = String::new();
    let mut linked = Vec::new();
    for ranked in &findings.worst {
        let scene = ranked.scene;
        let losses = findings.loss.outcome.losses.iter().zip(&ranked.losses);
        let losses: Vec<String> =
            losses.map(|(loss, value)| format!("{} {}", escaped(&loss.prediction), number(*value))).collect();
        let kind = if scene.kind == Kind::Near { "Near-field" } else { "Distant" };
        let (light, view) = (place(scene.light), place(scene.view));
        let _ = write!(
            items,
            r#"<li><button type="button" data-scene="{}" disabled>{kind}, light {light}, view {view}: {}</button></li>"#,
            linked.len(),
            losses.join("; "),
        );
        let exposure = exposure(report.materials[0], &scene, &report.convention.drawn());
        linked.push(LinkedScene { scene, exposure });
    }
    let html = format!(
        "<p>The scenes of the loss with the largest mean loss of all predictions, on all texels{}. A click puts light and view of \
         the figure there.</p><ol>{items}</ol>",
        if report.is_masked { " of the mask" } else { "" }
    );
    (section("Worst scenes", &html), linked)
}

fn readings(report: &PageReport<'_>) -> String {
    if report.readings.iter().all(Vec::is_empty) {
        return String::new();
    }
    let one = |(material, lines): (&&svbrdf_core::material::Material<f32>, &Vec<String>)| {
        let items: String = lines.iter().map(|line| format!("<li>{}</li>", escaped(line))).collect();
        let name = escaped(material.name());
        format!("<details><summary>{name} ({})</summary><ul>{items}</ul></details>", lines.len())
    };
    let html: String = report.materials.iter().zip(&report.readings).map(one).collect();
    section("Assumptions in reading the files", &html)
}

fn repetition(report: &PageReport<'_>) -> String {
    let Some(command) = &report.command else { return String::new() };
    let command = escaped(command);
    section(
        "Repeating the numbers",
        &format!("<p>{SOFTWARE}. This makes this file:</p><pre><code>{command}</code></pre>"),
    )
}
