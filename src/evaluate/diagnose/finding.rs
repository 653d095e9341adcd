//! Findings of a diagnosis: the loss under each hypothesis.

use std::fmt;

use serde::Serialize;

use svbrdf_core::loss::Estimate;
use svbrdf_core::statistics::sort_by_number;
use svbrdf_core::text::quoted;
use svbrdf_files::changes::Change;
use svbrdf_files::read::{ReadOptions, Storage};

svbrdf_core::choices! {
    /// An explanation of a loss that is tried, in the order of the lines.
    #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
    Hypothesis, "hypothesis":
    /// One factor on the radiance.
    Exposure = "exposure",
    /// A factor on each channel.
    ExposureRgb = "exposure_rgb",
    /// A displacement by whole texels.
    Shift = "shift",
    /// A displacement by parts of a texel, in another scale.
    Placement = "placement",
    /// Maps mirrored or turned.
    Symmetry = "symmetry",
    /// A factor on diffuse.
    DiffuseFactor = "diffuse_factor",
    /// A factor on specular.
    SpecularFactor = "specular_factor",
    NormalY = "normal_y",
    NormalX = "normal_x",
    AlbedoEncoding = "albedo_encoding",
    DiffuseEncoding = "diffuse_encoding",
    SpecularEncoding = "specular_encoding",
    Roughness = "roughness",
    Channels = "channels",
    Energy = "energy",
    /// Another reading of the ground truth.
    GroundTruth = "ground_truth",
}

impl Hypothesis {
    /// The lines of a prediction that is stored so: maps without an encoding that is known to be another one have no line for it.
    pub fn of(storage: &Storage) -> impl Iterator<Item = Self> {
        let [colours, specular] =
            [storage.colours, storage.specular].map(|transfer| !Storage::encodings(transfer).is_empty());
        let has_specular = !storage.base_colour;
        Self::ALL.into_iter().filter(move |hypothesis| match hypothesis {
            Self::AlbedoEncoding => colours && (specular || !has_specular),
            Self::DiffuseEncoding => colours && has_specular,
            Self::SpecularEncoding => specular && has_specular,
            _ => true,
        })
    }

    /// The unit of its value.
    pub fn unit(self) -> Option<&'static str> {
        match self {
            Self::Exposure | Self::ExposureRgb => Some("stops"),
            Self::Shift | Self::Placement => Some("texels"),
            _ => None,
        }
    }
}

/// The value of a hypothesis.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum Value {
    /// The stops that the prediction would have to be brightened by.
    Number(f64),
    /// Stops of red, green and blue.
    Numbers([f64; 3]),
    /// How far the prediction is displaced to the right and down.
    Displacement([f64; 2]),
    /// How much larger the prediction is, and how far it is displaced to the right and down about its centre.
    Placement([f64; 3]),
    /// What would have to be done with the prediction, or how it would have to be read.
    Name(&'static str),
}

/// Numbers have two decimals, texels none; `0.40`, `-0.05 -0.03 -0.03`, `3 -2`, `flipped`.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => f.write_str(&hundredths(*number)),
            Self::Numbers(numbers) => f.write_str(&numbers.map(hundredths).join(" ")),
            Self::Displacement([x, y]) => write!(f, "{x} {y}"),
            Self::Placement([scale, x, y]) => write!(f, "{scale:.4}, {} {}", hundredths(*x), hundredths(*y)),
            Self::Name(name) => f.write_str(name),
        }
    }
}

/// Two decimals, without the sign of a number that rounds to 0.
fn hundredths(number: f64) -> String {
    let text = format!("{number:.2}");
    if text == "-0.00" { "0.00".to_owned() } else { text }
}

/// Another change in place of one that is marked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alternative {
    pub change: Change,
    /// Whether it explains 5% of the loss more.
    pub explains_more: bool,
}

/// The loss under a hypothesis.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Finding {
    pub hypothesis: Hypothesis,
    /// The value with the least loss in the pilot.
    pub value: Value,
    pub unit: Option<&'static str>,
    /// The loss under the hypothesis.
    pub loss: f64,
    /// The 95% confidence interval of this loss.
    pub interval95: Option<[f64; 2]>,
    /// The part of the loss that disappears under the hypothesis, paired by scenes; negative where the loss grows.
    pub share: f64,
    /// The 95% confidence interval of the share, from the paired differences.
    pub share_interval95: Option<[f64; 2]>,
    /// The probability of such a fall where there is none, corrected for the number of hypotheses (Holm).
    pub p: f64,
    /// Whether the loss falls significantly and by at least 10% beside the corrections of the other marked findings. Never where
    /// the loss is below the floor.
    pub marked: bool,
    /// Whether the marked findings explain the whole loss, and no other change in place of this one does.
    #[serde(skip)]
    pub certain: bool,
    /// Another change in place of this one that explains as much, or more.
    #[serde(skip)]
    pub alternative: Option<Alternative>,
    /// The options of reading that correct it; a report writes them as an option of the command line.
    #[serde(skip)]
    pub remedy: Option<ReadOptions>,
    /// What is changed with the value; `None` where it changes nothing.
    #[serde(skip)]
    pub change: Option<Change>,
}

/// What might explain the loss of one prediction.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// The name of the prediction.
    pub prediction: String,
    /// Its loss over the scenes of the evaluation.
    pub loss: Estimate,
    /// The part of the loss that disappears under all marked findings together; `None` without marks.
    pub explained: Option<f64>,
    /// In the order of [`Hypothesis`].
    pub findings: Vec<Finding>,
}

impl Finding {
    /// The options that correct the reading of the prediction.
    pub fn remedy_of_prediction(&self) -> Option<ReadOptions> {
        self.remedy.filter(|_| self.hypothesis != Hypothesis::GroundTruth)
    }

    /// What `--read` takes to correct the reading of the ground truth or of the prediction with these names: `run 2:normal-y=down`.
    pub fn statement(&self, names: [&str; 2]) -> Option<String> {
        self.remedy.map(|remedy| format!("{}:{}", self.corrected(names), remedy.words()))
    }

    /// The option of the command line, quoted for a shell: `--read 'run 2:normal-y=down'`.
    pub fn command_option(&self, names: [&str; 2]) -> Option<String> {
        self.statement(names).map(|statement| format!("--read {}", quoted(statement)))
    }

    /// Which of the two is read otherwise.
    fn corrected<'a>(&self, [ground_truth, prediction]: [&'a str; 2]) -> &'a str {
        if self.hypothesis == Hypothesis::GroundTruth { ground_truth } else { prediction }
    }
}

impl Diagnosis {
    /// The marked findings, the largest share first.
    pub fn marked(&self) -> impl Iterator<Item = &Finding> {
        let mut marked: Vec<_> = self.findings.iter().filter(|finding| finding.marked).collect();
        sort_by_number(&mut marked, |finding| -finding.share);
        marked.into_iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rounds_to_0_has_no_sign() {
        let numbers = [-0.004, -0.0, 0.004, -0.006].map(|number| Value::Number(number).to_string());
        assert_eq!(numbers, ["0.00", "0.00", "0.00", "-0.01"]);
        assert_eq!(Value::Numbers([-0.001, 0.2, -1.0]).to_string(), "0.00 0.20 -1.00");
    }
}
