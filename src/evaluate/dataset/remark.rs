//! A remark on how a material of a data set was read.

use serde::{Deserialize, Serialize};

use svbrdf_files::read::{Assumption, Note, Read, What};

/// The doubt about an alpha that is no more than noted.
pub(super) const MASK: &str = "with an alpha that looks like a mask (--mask alpha leaves its texels out)";

/// One thing that was noticed or assumed in reading a material.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Remark {
    /// What the number of materials with remarks like it is of, such as "without normal map" or "with unsure albedo=srgb"; `None` for a remark
    /// on nothing that is in doubt.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
    /// The remark, as `info` prints it.
    pub text: String,
}

impl Remark {
    /// The remarks on a material that was read.
    pub(super) fn of<T>(read: &Read<T>) -> Vec<Self> {
        let notes = read.notes.iter().map(|note| Self { doubt: of_note(note), text: note.to_string() });
        let assumptions = read.assumptions.iter();
        notes
            .chain(assumptions.map(|one| Self { doubt: of_assumption(one), text: one.to_string() }))
            .collect()
    }
}

fn of_note(note: &Note) -> Option<String> {
    if matches!(note, Note::MaskInAlpha { .. }) {
        return Some(MASK.to_owned());
    }
    (!note.is_routine()).then(|| "with notes".to_owned())
}

fn of_assumption(assumption: &Assumption) -> Option<String> {
    // As in "specular 0.04".
    let map = assumption.chosen.split(' ').next().unwrap_or_default();
    assumption.is_doubtful().then(|| match assumption.what {
        What::Missing => format!("without {map} map"),
        What::Size => "with resized maps".to_owned(),
        What::Values => "with changed values".to_owned(),
        What::Layout => "with unsure layout".to_owned(),
        // As `--read` takes it.
        what => format!("with unsure {}={}", what.key().unwrap_or(what.name()), assumption.chosen),
    })
}
