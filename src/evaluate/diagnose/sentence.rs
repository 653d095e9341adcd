//! A diagnosis in words.

use super::finding::{Alternative, Diagnosis, Finding, Hypothesis, Value};
use svbrdf_core::loss::Estimate;
use svbrdf_files::changes::Change;
use svbrdf_files::changes::displacement;
use svbrdf_files::read::NormalY;

/// Least share of the loss, in percent, from which a cause is named.
const LIKELY_CAUSE: f64 = 50.0;

/// What was searched, where nothing of it explains the loss. The ranges are those of the alignments.
const NOTHING: &str = "No exposure, displacement up to a quarter of a side, scale from 0.8 to 1.25, symmetry, factor on diffuse or \
    specular, or other reading of the files explains 10% of the loss.";

/// What explains the loss, in one or more sentences: the marked findings, the largest share first. `floor`: the loss that the ground
/// truth resolves.
pub fn sentence(diagnosis: &Diagnosis, floor: Option<&Estimate>) -> String {
    let loss = diagnosis.loss.mean;
    if loss == 0.0 {
        return "The prediction equals the ground truth.".to_owned();
    }
    if let Some(floor) = floor.filter(|floor| loss <= floor.mean) {
        return format!(
            "The loss is not resolvable with this ground truth, whose floor is {:.4}.",
            floor.mean
        );
    }
    let marked: Vec<&Finding> = diagnosis.marked().collect();
    match marked[..] {
        [] => NOTHING.to_owned(),
        [one] => sentence_of(one),
        _ => together(&marked, 100.0 * diagnosis.explained.unwrap_or(0.0)),
    }
}

/// What a finding would lower the loss by, and its cause where the share is at least 50%.
pub fn sentence_of(finding: &Finding) -> String {
    let share = 100.0 * finding.share;
    // A small share is no evidence of a cause.
    let cause = if share >= LIKELY_CAUSE { cause(finding) } else { None };
    let cause = cause.map(|cause| format!(": {cause}")).unwrap_or_default();
    format!("{} would lower the loss by {share:.0}%{cause}.{}", correction(finding), notes(finding))
}

/// The same for several findings.
fn together(marked: &[&Finding], share: f64) -> String {
    let mut corrections: Vec<String> = marked.iter().map(|finding| correction(finding)).collect();
    for other in &mut corrections[1..] {
        let (first, rest) = other.split_at(1);
        *other = first.to_lowercase() + rest;
    }
    let last = corrections.pop().unwrap_or_default();
    let causes: Vec<String> = marked.iter().filter_map(|finding| cause(finding)).collect();
    let is_likely = share >= LIKELY_CAUSE && !causes.is_empty();
    let causes = if is_likely { format!(": {}", causes.join("; ")) } else { String::new() };
    let notes: String = marked.iter().map(|finding| notes(finding)).collect();
    format!("{} and {last} would lower the loss by {share:.0}%{causes}.{notes}", corrections.join(", "))
}

/// Another change that explains as much, and that no option corrects a reading.
fn notes(finding: &Finding) -> String {
    let other = finding.alternative.map(|Alternative { change, explains_more }| {
        format!(" Another change that explains {}: {change}.", if explains_more { "more" } else { "as much" })
    });
    let is_reading = matches!(finding.change, Some(Change::Reading(_) | Change::GroundTruth(_)));
    let none = if is_reading && finding.remedy.is_none() {
        " No option corrects this reading: change the maps."
    } else {
        ""
    };
    format!("{}{none}", other.unwrap_or_default())
}

/// The value of a finding that is a name.
fn name(finding: &Finding) -> &'static str {
    if let Value::Name(name) = finding.value { name } else { "" }
}

/// The correction as the subject of a sentence.
fn correction(finding: &Finding) -> String {
    let name = name(finding);
    match (finding.hypothesis, &finding.value) {
        (Hypothesis::Exposure, Value::Number(stops)) => {
            let verb = if *stops > 0.0 { "Brightening" } else { "Darkening" };
            format!("{verb} the prediction by {:.2} stops", stops.abs())
        }
        (Hypothesis::ExposureRgb, _) => "A factor on each colour channel".to_owned(),
        (Hypothesis::Shift, Value::Displacement([right, down])) => {
            format!("Moving the prediction {}", displacement([-right, -down]))
        }
        (Hypothesis::Placement, _) => finding.change.map_or_else(String::new, placed),
        (Hypothesis::DiffuseFactor, Value::Number(factor)) => format!("Multiplying diffuse by {factor:.3}"),
        (Hypothesis::SpecularFactor, Value::Number(factor)) => format!("Multiplying specular by {factor:.3}"),
        (Hypothesis::Symmetry, _) => format!("The transformation {name} of the prediction"),
        (Hypothesis::NormalY, _) => format!("Reading the normals with Y {}", direction(finding)),
        (Hypothesis::NormalX, _) => "Reading the normals with X flipped".to_owned(),
        (Hypothesis::AlbedoEncoding, _) => format!("Reading the colours as {}", encoding(name)),
        (Hypothesis::DiffuseEncoding, _) => format!("Reading diffuse as {}", encoding(name)),
        (Hypothesis::SpecularEncoding, _) => format!("Reading specular as {}", encoding(name)),
        (Hypothesis::Roughness, _) => match name {
            "gloss" => "Reading roughness as 1 - roughness".to_owned(),
            "root" => "Taking the square root of roughness".to_owned(),
            _ => "Squaring roughness".to_owned(),
        },
        (Hypothesis::Channels, _) => "Swapping red and blue".to_owned(),
        (Hypothesis::Energy, _) => format!("Reading diffuse as {name} by (1 - specular)"),
        (Hypothesis::GroundTruth, _) => format!("Reading the ground truth with {name}"),
        (hypothesis, _) => format!("The change {}", hypothesis.name()),
    }
}

/// A placement as the subject of a sentence: `The prediction scaled by 0.9000`.
fn placed(change: Change) -> String {
    format!("The prediction {change}")
}

/// What the correction suggests; "probably" unless it is certain.
fn cause(finding: &Finding) -> Option<String> {
    let cause = match finding.hypothesis {
        Hypothesis::Exposure => "its exposure ~differs",
        Hypothesis::ExposureRgb => "its white balance ~differs",
        Hypothesis::Shift | Hypothesis::Placement => "it is ~misaligned",
        Hypothesis::DiffuseFactor => "its diffuse ~has another scale",
        Hypothesis::SpecularFactor => "its specular ~has another scale",
        Hypothesis::Symmetry => "its rows, columns or axes ~differ from those of the ground truth",
        Hypothesis::NormalY if direction(finding) == "up" => "the file is ~OpenGL",
        Hypothesis::NormalY => "the file is ~DirectX",
        Hypothesis::AlbedoEncoding => "they are ~stored so",
        Hypothesis::DiffuseEncoding | Hypothesis::SpecularEncoding => "it is ~stored so",
        Hypothesis::Roughness => match name(finding) {
            "gloss" => "the file ~holds glossiness",
            "root" => "the file ~holds alpha = r^2",
            _ => "it is ~stored as a square root",
        },
        Hypothesis::Channels => "the file is ~BGR",
        Hypothesis::Energy => "its renderer ~scales diffuse in another way",
        Hypothesis::GroundTruth => "the ground truth is ~read wrongly",
        _ => return None,
    };
    Some(cause.replace('~', if finding.certain { "" } else { "probably " }))
}

/// The direction of Y that a finding suggests.
fn direction(finding: &Finding) -> &'static str {
    finding.remedy.and_then(|remedy| remedy.normal_y).unwrap_or(NormalY::Down).name()
}

fn encoding(name: &str) -> &'static str {
    match name {
        "linear" => "linear",
        "gamma2.2" => "gamma 2.2",
        _ => "sRGB",
    }
}
