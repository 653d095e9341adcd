//! The findings as HTML without script: losses, shares of maps, worst scenes, directions of the light, reading, repetition.

use std::fmt::Write as _;

use svbrdf_core::loss::{Loss, Outcome};
use svbrdf_core::material::Material;
use svbrdf_core::model::scene::Kind;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::analyses::parts;
use svbrdf_evaluate::report::{Reader, Report as _, scenes_line};
use svbrdf_evaluate::robust::RobustReport;
use svbrdf_evaluate::why::{Attribution, Hemisphere};
use svbrdf_files::Error;

use super::content::{Findings, Repetition, Report};
use super::data::LinkedScene;
use super::exposure::exposure;
use super::markup::{MOST_NAMES, escaped, number, place};
use super::pictures::Rows;
use super::tables::HtmlTable;
use super::{pictures, plots};
use svbrdf_files::disk::atomic::SOFTWARE;

/// Thumbnails of the materials in a scene.
const THUMBNAILS: Rows = Rows { width: 128, columns: 5 };

/// The sections below the figure, and the scenes that they link.
///
/// # Errors
/// Those of renderings.
pub(super) fn sections(
    report: &Report<'_>,
    small: &[&Material<f32>],
    progress: &Progress,
) -> Result<(String, Vec<LinkedScene>), Error> {
    let mut html = String::new();
    let mut linked = Vec::new();
    if let Some(findings) = &report.findings {
        html += &losses(findings);
        html += &findings.robust.as_ref().map_or(String::new(), robust);
        html += &shares(&findings.attributions);
        let (scenes, of_scenes) = worst_scenes(report, findings, small, progress)?;
        html += &scenes;
        linked = of_scenes;
        html += &lights(findings);
    }
    html += &readings(report);
    html += &repetition(report);
    Ok((html, linked))
}

/// The losses in one line, or the least of many.
pub(super) fn summary(findings: &Findings) -> String {
    let one = |loss: &Loss| format!("{} {}", escaped(&loss.prediction), number(loss.estimate.mean));
    let all = &findings.loss.outcome.losses;
    let texts = match least(all).filter(|_| all.len() > MOST_NAMES) {
        Some(best) => format!("{}, the least of {}", one(&all[best]), all.len()),
        None => all.iter().map(one).collect::<Vec<_>>().join(", "),
    };
    format!("Rendering loss, convention {}: {texts}.", findings.loss.convention)
}

/// The prediction with the least loss.
fn least(all: &[Loss]) -> Option<usize> {
    (0..all.len()).min_by(|a, b| all[*a].estimate.mean.total_cmp(&all[*b].estimate.mean))
}

fn losses(findings: &Findings) -> String {
    let loss = &findings.loss;
    let all = &loss.outcome.losses;
    let axis = plots::axis(all.iter().map(|loss| &loss.estimate));
    let mut table = HtmlTable::of(loss.table(Reader::Person), "name", false).titled();
    table.insert(3, "", all.iter().map(|loss| plots::bar(&loss.estimate, axis)));
    let verdicts = verdicts(&loss.outcome);
    format!(
        r#"<section aria-labelledby="losses"><h2 id="losses">Rendering loss</h2>{}{verdicts}<p class="weak">Mean over scenes, texels and RGB of |ln(R<sub>gt</sub> + {}) &minus; ln(R<sub>pred</sub> + {})| against {}, {} &times; {} texels. {}</p></section>"#,
        table.html(),
        loss.epsilon,
        loss.epsilon,
        escaped(&loss.ground_truth),
        loss.size[0],
        loss.size[1],
        escaped(scenes_line(loss.outcome.sampling.as_ref(), &loss.outcome.scenes, loss.size).trim()),
    )
}

/// Whether the order of methods or predictions survives other questions: the sentence, each pair that changes sides, and the order under
/// every question.
pub(super) fn robust(report: &RobustReport) -> String {
    let changes: String = report.changes().map(|change| format!("<li>{}</li>", escaped(&change))).collect();
    let changes =
        if changes.is_empty() { changes } else { format!(r#"<ul class="conditions">{changes}</ul>"#) };
    format!(
        r#"<section aria-labelledby="robust"><h2 id="robust">Does the order survive?</h2><p>{}</p>{changes}{}<p class="weak">Tau: Kendall's tau to the order by default, 1 where no pair changes sides; differences that are not significant are no changes.</p></section>"#,
        escaped(&report.sentence),
        HtmlTable::of(report.table(Reader::Person), "", false).titled().html(),
    )
}

/// The ends of an interval as texts.
fn interval(interval: Option<[f64; 2]>) -> [String; 2] {
    interval.map_or(["unknown".to_owned(), "unknown".to_owned()], |ends| ends.map(number))
}

/// The prediction with the least loss against every other one, on the same scenes.
fn verdicts(outcome: &Outcome) -> String {
    let all = &outcome.losses;
    let Some(best) = least(all).filter(|_| all.len() > 1) else { return String::new() };
    let mut items = String::new();
    for other in (0..all.len()).filter(|other| *other != best) {
        let difference = outcome.difference(other, best);
        let is_clear = difference.interval95.is_some_and(|[low, _]| low > 0.0);
        let verdict =
            if is_clear { "is closer to the ground truth than" } else { "no significant difference from" };
        let [low, high] = interval(difference.interval95);
        let colon = if is_clear { "" } else { ":" };
        let _ = write!(
            items,
            "<li>{}{colon} {verdict} {}: difference of the losses {}, 95% interval {low} to {high}, same scenes.</li>",
            escaped(&all[best].prediction),
            escaped(&all[other].prediction),
            number(difference.mean),
        );
    }
    format!("<ul>{items}</ul>")
}

fn shares(attributions: &[Attribution]) -> String {
    let mut html = String::from(
        r#"<section aria-labelledby="shares"><h2 id="shares">Share of each map</h2><p>The Shapley value of a map: the mean of what it adds to the loss over all orders in which the maps can become wrong. The four values add up to the loss.</p>"#,
    );
    let axis = plots::axis(attributions.iter().flat_map(|one| one.maps.iter().map(|share| &share.shapley)));
    for one in attributions {
        let mut table = HtmlTable::of(parts(&one.maps, &one.loss), "", false).titled();
        table.insert(2, "", one.maps.iter().map(|share| plots::bar(&share.shapley, axis)));
        let note = one.note().map_or(String::new(), |note| format!("<p>{}</p>", escaped(&note)));
        let _ = write!(html, r#"<h3>{}</h3>{}{note}"#, escaped(&one.prediction), table.html());
    }
    html + "</section>"
}

fn worst_scenes(
    report: &Report<'_>,
    findings: &Findings,
    small: &[&Material<f32>],
    progress: &Progress,
) -> Result<(String, Vec<LinkedScene>), Error> {
    let mut items = String::new();
    let mut linked = Vec::new();
    let outcome = &findings.loss.outcome;
    for ranked in &findings.worst {
        let scene = ranked.scene;
        let drawn = report.convention.drawn();
        let exposure = exposure(report.materials[0], &scene, &drawn);
        let picture = pictures::thumbnail(small, &scene, &drawn, exposure, THUMBNAILS, progress)?;
        let losses: Vec<String> = outcome
            .losses
            .iter()
            .zip(&ranked.losses)
            .map(|(loss, value)| format!("{} {}", escaped(&loss.prediction), number(*value)))
            .collect();
        let kind = if scene.kind == Kind::Near { "Near-field" } else { "Distant" };
        let (light, view) = (place(scene.light), place(scene.view));
        let _ = write!(
            items,
            r#"<li><button type="button" data-scene="{}" disabled><img src="{picture}" alt="Renderings of the materials"><span>Loss: {}</span><span class="weak">{kind}, light {light}, view {view}</span></button></li>"#,
            linked.len(),
            losses.join("; "),
        );
        linked.push(LinkedScene { scene, exposure });
    }
    let html = format!(
        r#"<section aria-labelledby="worst"><h2 id="worst">Worst scenes</h2><p>The scenes of the loss with the largest mean loss of all predictions, on all texels; the ground truth first, each exposed to its brightest 1%. A click puts light and view of the figure there.</p><ol class="scenes">{items}</ol></section>"#
    );
    Ok((html, linked))
}

fn lights(findings: &Findings) -> String {
    let map: &Hemisphere = &findings.lights;
    let most = map.losses.iter().flatten().copied().filter(|loss| !loss.is_nan()).fold(0.0, f64::max);
    let mut figures = String::new();
    for (index, loss) in findings.loss.outcome.losses.iter().enumerate() {
        let worst = map.worst(index).map_or(String::new(), |(direction, loss)| {
            format!("largest {} at {}, circled", number(loss), place(direction))
        });
        let _ = write!(
            figures,
            "<figure>{}<figcaption>{}: mean {} &plusmn; {}, {worst}</figcaption></figure>",
            plots::directions(map, index, &loss.prediction, most),
            escaped(&loss.prediction),
            number(map.mean(index)),
            number(map.standard_error(index)),
        );
    }
    format!(
        r#"<section aria-labelledby="lights"><h2 id="lights">Loss over directions of the light</h2><p>Distant light, view along the normal; seen from above, x to the right, y up. A click puts the light of the figure there.</p><div class="maps">{figures}</div>{}</section>"#,
        plots::legend(most)
    )
}

fn readings(report: &Report<'_>) -> String {
    if report.readings.iter().all(Vec::is_empty) {
        return String::new();
    }
    let mut html = String::from(
        r#"<section aria-labelledby="reading"><h2 id="reading">Assumptions in reading the files</h2>"#,
    );
    for (material, lines) in report.materials.iter().zip(&report.readings) {
        let items: String = lines.iter().map(|line| format!("<li>{}</li>", escaped(line))).collect();
        let name = escaped(material.name());
        let _ =
            write!(html, "<details><summary>{name} ({})</summary><ul>{items}</ul></details>", lines.len());
    }
    html + "</section>"
}

fn repetition(report: &Report<'_>) -> String {
    let Some(Repetition { command, session }) = &report.repetition else { return String::new() };
    let convention = report.convention;
    let seed = report.findings.as_ref().and_then(|findings| findings.loss.sampled.seed);
    let seed = seed.map_or(String::new(), |seed| format!(", seed {seed}"));
    let session = session.as_ref().map_or(String::new(), |[name, text]| {
        let (name, text) = (escaped(name), escaped(text));
        format!("<details><summary>{name}</summary><pre><code>{text}</code></pre></details>")
    });
    let how = if session.is_empty() {
        "This makes this file:"
    } else {
        "With the session below saved beside it, this makes this file:"
    };
    format!(
        r#"<section aria-labelledby="repeat"><h2 id="repeat">Repeating the numbers</h2><p>{SOFTWARE}, convention {}, epsilon {}{seed}. {how}</p><pre><code>{}</code></pre>{session}</section>"#,
        convention.name,
        convention.epsilon,
        escaped(command)
    )
}
