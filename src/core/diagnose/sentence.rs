//! A diagnosis in words.

use super::finding::{Diagnosis, Finding, Hypothesis, Value};
use super::remedy::Remedy;
use super::words::displacement;
use crate::loss::Estimate;

/// Least share of the loss, in percent, from which a cause is named.
const LIKELY_CAUSE: f64 = 50.0;

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
    let sentences: Vec<String> = diagnosis.marked().map(sentence_of).collect();
    if sentences.is_empty() {
        return "No error of exposure, alignment or reading explains 10% of the loss.".to_owned();
    }
    sentences.join(" ")
}

/// What a finding would lower the loss by, and its probable cause where the share is at least 50%.
pub fn sentence_of(finding: &Finding) -> String {
    let share = 100.0 * finding.share.unwrap_or(0.0);
    let (correction, reason) = words(finding);
    // A small share is no evidence of a cause.
    let reason = if share >= LIKELY_CAUSE { reason } else { "" };
    format!("{correction} would lower the loss by {share:.0}%{reason}.")
}

/// The correction as the subject of a sentence, and what it suggests.
fn words(finding: &Finding) -> (String, &'static str) {
    let name = match &finding.value {
        Value::Name(name) => *name,
        _ => "",
    };
    match (finding.hypothesis, &finding.value) {
        (Hypothesis::Exposure, Value::Number(stops)) => {
            let verb = if *stops > 0.0 { "Brightening" } else { "Darkening" };
            (format!("{verb} the prediction by {:.2} stops", stops.abs()), ": its exposure differs")
        }
        (Hypothesis::ExposureRgb, _) => {
            ("A factor on each colour channel".to_owned(), ": its white balance differs")
        }
        (Hypothesis::Shift, Value::Displacement([right, down])) => (
            format!("Moving the prediction {}", displacement([-right, -down])),
            ": it is probably misaligned",
        ),
        (Hypothesis::Symmetry, _) => (
            format!("The transformation {name} of the prediction"),
            ": its rows, columns or axes probably differ from those of the ground truth",
        ),
        (Hypothesis::NormalY, _) => {
            let direction = if finding.remedy == Some(Remedy::NormalY("up")) { "up" } else { "down" };
            let kind = if direction == "up" {
                ": the file is probably OpenGL"
            } else {
                ": the file is probably DirectX"
            };
            (format!("Reading the normals with Y {direction}"), kind)
        }
        (Hypothesis::NormalX, _) => ("Reading the normals with X flipped".to_owned(), ""),
        (Hypothesis::AlbedoEncoding, _) => {
            (format!("Reading the colours as {}", encoding(name)), ": they are probably stored so")
        }
        (Hypothesis::SpecularEncoding, _) => {
            (format!("Reading specular as {}", encoding(name)), ": it is probably stored so")
        }
        (Hypothesis::Roughness, _) => match name {
            "gloss" => {
                ("Reading roughness as 1 - roughness".to_owned(), ": the file probably holds glossiness")
            }
            "root" => {
                ("Taking the square root of roughness".to_owned(), ": the file probably holds alpha = r^2")
            }
            _ => ("Squaring roughness".to_owned(), ": it is probably stored as a square root"),
        },
        (Hypothesis::Channels, _) => ("Swapping red and blue".to_owned(), ": the file is probably BGR"),
        (Hypothesis::Energy, _) => (
            format!("Reading diffuse as {name} by (1 - specular)"),
            ": its renderer probably scales diffuse in another way",
        ),
        (hypothesis, _) => (format!("The change {}", hypothesis.name()), ""),
    }
}

fn encoding(name: &str) -> &'static str {
    if name == "linear" { "linear" } else { "sRGB" }
}
