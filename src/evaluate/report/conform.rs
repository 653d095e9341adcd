//! Conformance of a renderer to a convention, and the terms in which it differs.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use svbrdf_core::model::grammar::{Description, RendererTerms};
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::text::percent;

use super::Report;
use super::table::{Cell, Field, Reader, Table};
use crate::conform::{self, RenderedPoints, TermGap, VerdictKind};

/// The terms of a renderer that are not at their defaults, by section and key as in the TOML of a convention.
pub type TermsByKey = BTreeMap<String, BTreeMap<String, TermValue>>;

/// The value of a term.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum TermValue {
    Truth(bool),
    Number(f64),
    Word(String),
    Numbers(Vec<f64>),
}

/// Whether a renderer conforms to a convention, and in which terms it differs.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ConformReport {
    /// `conforms`; `differs`; or `unknown`: it is no member of the grammar of conventions, or the points do not decide.
    verdict: VerdictKind,
    /// The convention that the renderer is compared with.
    convention: String,
    /// The named conventions with the same renderer.
    same_as: Vec<String>,
    /// The terms of the renderer; `None` where the verdict is unknown.
    renderer: Option<TermsByKey>,
    /// The terms of the nearest member of the grammar, where the verdict is unknown; otherwise `None`.
    nearest: Option<TermsByKey>,
    /// Differences from the convention; none where the verdict is unknown.
    differences: Vec<TermGap>,
    /// Root mean square of the differences of radiances that remain, relative to the radiances.
    residual: f64,
    /// The precision of the given radiances: float32 or float64.
    storage: &'static str,
    /// The number of points.
    points: usize,
    /// Factors on the diffuse and the specular lobe of the convention, where these alone differ: they are no terms of the grammar.
    lobe_factors: Option<[f64; 2]>,
    /// The renderer as a convention, with the loss and the scenes of the expected one.
    #[serde(skip)]
    found: Description,
}

impl ConformReport {
    /// The report on an answer, compared with the convention `asked`.
    pub fn new(answer: &RenderedPoints, asked: &Description) -> Self {
        let identified = conform::identify(answer);
        let mut verdict = conform::verdict(&identified, asked);
        let is_known = verdict.kind != VerdictKind::Unknown;
        let mut lobe_factors = None;
        if !is_known {
            let light = asked.terms.light.factor * asked.terms.light.intensity[0];
            lobe_factors = conform::lobe_factors(answer, &asked.terms)
                .map(|factors| factors.map(|factor| factor / light));
            let lobes = ["diffuse lobe", "specular lobe"].into_iter().zip(lobe_factors.into_iter().flatten());
            let lobes = lobes.filter(|(_, factor)| (factor - 1.0).abs() > 1e-4);
            verdict.differences = lobes.map(|(lobe, factor)| lobe_gap(lobe, factor)).collect();
        }
        if lobe_factors.is_some() {
            (verdict.kind, verdict.residual) = (VerdictKind::Differs, 0.0);
        }
        let is_same =
            |other: &&Description| conform::verdict(&identified, other).kind == VerdictKind::Conforms;
        let same: Vec<String> = match is_known {
            true => named::all().iter().filter(is_same).map(|other| other.name.clone()).collect(),
            false => Vec::new(),
        };
        let found = Description {
            name: "found".to_owned(),
            source: None,
            version: None,
            terms: verdict.terms,
            ..asked.clone()
        };
        let terms = by_key(&verdict.terms);
        Self {
            verdict: verdict.kind,
            convention: asked.name.clone(),
            same_as: same,
            renderer: is_known.then(|| terms.clone()),
            nearest: (!is_known && lobe_factors.is_none()).then_some(terms),
            lobe_factors,
            differences: verdict.differences,
            residual: verdict.residual,
            storage: if identified.is_single { "float32" } else { "float64" },
            points: answer.points.len(),
            found,
        }
    }

    /// Whether the renderer is that of the convention.
    pub fn conforms(&self) -> bool {
        self.verdict == VerdictKind::Conforms
    }

    /// The convention that was found, with the loss and the scenes of the one it was compared with; `None` where it is unknown.
    pub fn found(&self) -> Option<&Description> {
        self.renderer.is_some().then_some(&self.found)
    }

    fn sentence(&self) -> String {
        let convention = &self.convention;
        let sentence = |one: &TermGap| format!("{} is {}, not {}", one.term, one.found, one.expected);
        let differences: Vec<String> = self.differences.iter().map(sentence).collect();
        match self.verdict {
            VerdictKind::Conforms => format!("The renderer conforms to `{convention}`."),
            VerdictKind::Differs => format!("As `{convention}`, but {}.", listed(&differences)),
            VerdictKind::Unknown => format!(
                "The renderer is none of this grammar, nor `{convention}` with a factor on either lobe: {} of every radiance remains at \
                the nearest member.",
                percent(self.residual)
            ),
        }
    }
}

/// A factor on a lobe of the convention.
fn lobe_gap(lobe: &str, factor: f64) -> TermGap {
    let gap = Some((factor - 1.0).abs());
    TermGap {
        term: lobe.to_owned(),
        found: format!("{factor:.4} times as large"),
        expected: "1".to_owned(),
        gap,
    }
}

/// Words in a sentence.
fn listed(words: &[String]) -> String {
    match words {
        [] => "without a difference that is certain".to_owned(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// The terms that the TOML of a convention has, without its loss.
fn by_key(terms: &RendererTerms) -> TermsByKey {
    let text = Description { terms: *terms, ..Description::default() }.to_string();
    let mut sections: TermsByKey = toml::from_str::<BTreeMap<String, toml::Value>>(&text)
        .unwrap_or_default()
        .into_iter()
        .filter_map(|(section, keys)| Some((section, keys.try_into().ok()?)))
        .collect();
    sections.remove("loss");
    sections
}

const FIELDS: [Field<TermGap>; 4] = [
    ("term", "term", |row| row.term.clone().into()),
    ("found", "found", |row| row.found.clone().into()),
    ("expected", "expected", |row| row.expected.clone().into()),
    ("gap", "gap", |row| Cell::or(row.gap, "")),
];

impl Report for ConformReport {
    fn heading(&self) -> String {
        let mut text = self.sentence() + "\n";
        text += &format!(
            "Remaining difference {:.1e} relative ({}), {} points.\n",
            self.residual, self.storage, self.points
        );
        let others: Vec<String> = self
            .same_as
            .iter()
            .filter(|name| **name != self.convention)
            .map(|name| format!("`{name}`"))
            .collect();
        if !others.is_empty() {
            text += &format!("It renders as {} does.\n", others.join(", "));
        }
        text += &format!(
            "What points do not tell is as in `{}`: where texels and rows lie, and pi, intensity and exposure but by their product.\n",
            self.convention
        );
        text
    }

    fn table(&self, reader: Reader) -> Table {
        let mut table = Table::fields(&FIELDS, &self.differences, reader);
        if reader == Reader::Person {
            let gap = |gap: f64| {
                if gap < 10.0 { percent(gap).into() } else { Cell::from("above 1000%".to_owned()) }
            };
            for (row, difference) in table.rows.iter_mut().zip(&self.differences) {
                row[3] = difference.gap.map_or(Cell::Missing(""), gap);
            }
        }
        table
    }
}
