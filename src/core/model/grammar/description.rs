//! A convention as text: TOML with a section for each part of its terms.

use std::fmt;
use std::str::FromStr;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::{
    DiffuseTerms, GridTerms, LightTerms, LossTerms, MapTerms, OutputTerms, RendererTerms, SceneTerms,
    SpecularTerms,
};
use crate::error::Error;
use crate::text::of_json;

/// A renderer, its loss and its scenes, with their name and source.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "Text", into = "Text")]
pub struct Description {
    pub name: String,
    /// The repository or publication that it restates.
    pub source: Option<String>,
    /// The commit or release.
    pub version: Option<String>,
    pub terms: RendererTerms,
    pub loss: LossTerms,
    pub scenes: Vec<SceneTerms>,
}

/// The sections of the text.
#[derive(Clone, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Text {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    source: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    version: Option<String>,
    material: MapTerms,
    specular: SpecularTerms,
    diffuse: DiffuseTerms,
    light: LightTerms,
    output: OutputTerms,
    grid: GridTerms,
    loss: LossTerms,
    scenes: Vec<SceneTerms>,
}

impl From<Text> for Description {
    fn from(text: Text) -> Self {
        let Text { name, source, version, material, specular, diffuse, light, output, grid, loss, scenes } =
            text;
        let terms = RendererTerms { material, specular, diffuse, light, output, grid };
        Self { name, source, version, terms, loss, scenes }
    }
}

impl From<Description> for Text {
    fn from(description: Description) -> Self {
        let Description { name, source, version, terms, loss, scenes } = description;
        let RendererTerms { material, specular, diffuse, light, output, grid } = terms;
        Self { name, source, version, material, specular, diffuse, light, output, grid, loss, scenes }
    }
}

/// The keys that are printed whatever their values.
const ALWAYS: [&str; 15] = [
    "name",
    "material",
    "alpha",
    "normal",
    "D",
    "G",
    "denominator",
    "F",
    "diffuse",
    "lz",
    "falloff",
    "factor",
    "transfer",
    "sampling",
    "orientation",
];

/// A term in which two renderers differ.
#[derive(Clone, Debug, PartialEq)]
pub struct TermDifference {
    pub section: String,
    pub key: String,
    /// The value of the first, in words; "none" where it has none.
    pub own: String,
    /// That of the other.
    pub other: String,
}

impl RendererTerms {
    /// The sections of keys. A struct of numbers, words and lists has no value that TOML lacks.
    fn table(&self) -> Table {
        Table::try_from(self).unwrap_or_default()
    }

    /// Every key with its section and its value.
    fn values(&self) -> Vec<(String, String, Value)> {
        let keys = self.table().into_iter().flat_map(|(section, keys)| {
            let keys = keys.as_table().cloned().unwrap_or_default().into_iter();
            keys.map(move |(key, value)| (section.clone(), key, value))
        });
        keys.collect()
    }

    /// The terms in which `self` differs from `other`.
    pub fn differences(&self, other: &Self) -> Vec<TermDifference> {
        let (own, others) = (self.values(), other.values());
        let value = |values: &[(String, String, Value)], section: &str, key: &str| {
            let found = values.iter().find(|(s, k, _)| s == section && k == key);
            found.map_or_else(|| "none".to_owned(), |(_, _, value)| plain(value))
        };
        let missing = others.iter().filter(|(s, k, _)| !own.iter().any(|(os, ok, _)| os == s && ok == k));
        let both = own.iter().chain(missing).map(|(section, key, _)| TermDifference {
            section: section.clone(),
            key: key.clone(),
            own: value(&own, section, key),
            other: value(&others, section, key),
        });
        both.filter(|difference| difference.own != difference.other).collect()
    }

    /// These terms with one of `other`.
    pub fn with(&self, section: &str, key: &str, other: &Self) -> Self {
        let (mut table, others) = (self.table(), other.table());
        let value = others.get(section).and_then(|keys| keys.get(key));
        if let Some(keys) = table.get_mut(section).and_then(Value::as_table_mut) {
            match value {
                Some(value) => drop(keys.insert(key.to_owned(), value.clone())),
                None => drop(keys.remove(key)),
            }
        }
        table.try_into().unwrap_or(*self)
    }
}

/// A value in words, without quotes.
fn plain(value: &Value) -> String {
    match value {
        Value::String(word) => word.clone(),
        Value::Float(number) => short(*number),
        Value::Array(list) => format!("[{}]", list.iter().map(plain).collect::<Vec<_>>().join(", ")),
        other => other.to_string(),
    }
}

/// A number as it is written by hand.
fn short(number: f64) -> String {
    if number != 0.0 && number.is_finite() && !(1e-3..1e6).contains(&number.abs()) {
        format!("{number:e}")
    } else {
        number.to_string()
    }
}

/// TOML, without the terms that have the value of [`RendererTerms::BASE`].
impl fmt::Display for Description {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        static BASE: LazyLock<Table> =
            LazyLock::new(|| Table::try_from(Description::default()).unwrap_or_default());
        let mut table = Table::try_from(self).map_err(|_| fmt::Error)?;
        for (section, keys) in &mut table {
            let (Some(keys), Some(base)) = (keys.as_table_mut(), BASE.get(section).and_then(Value::as_table))
            else {
                continue;
            };
            keys.retain(|key, value| {
                ALWAYS.contains(&key) || section == "loss" || base.get(key) != Some(value)
            });
        }
        table.retain(|_, value| value.as_array().is_none_or(|list| !list.is_empty()));
        f.write_str(&toml::to_string(&table).map_err(|_| fmt::Error)?)
    }
}

/// The problem of a TOML text, with its line.
fn of_toml(text: &str, problem: &toml::de::Error) -> String {
    let before = problem.span().and_then(|span| text.get(..span.start));
    let line =
        before.map_or_else(String::new, |before| format!("line {}: ", 1 + before.matches('\n').count()));
    line + &of_json(&problem.message())
}

impl FromStr for Description {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let description: Self = toml::from_str(text)
            .map_err(|problem| Error::BadConvention { problem: of_toml(text, &problem) })?;
        description.checked()
    }
}

impl Description {
    /// Refuses what cannot be computed.
    fn checked(self) -> Result<Self, Error> {
        let bad = |problem: String| Err(Error::BadConvention { problem });
        for (section, key, value) in self.terms.values() {
            let numbers: Vec<f64> = match &value {
                Value::Float(number) => vec![*number],
                Value::Array(list) => list.iter().filter_map(Value::as_float).collect(),
                _ => Vec::new(),
            };
            let may_be_infinite = matches!(key.as_str(), "r_max" | "D_cap" | "dot_max" | "cos_max");
            let is_right = |x: &f64| *x >= 0.0 && (x.is_finite() || may_be_infinite);
            if let Some(number) = numbers.iter().find(|x| !is_right(x)) {
                return bad(format!("[{section}] {key}: expected a number of at least 0, found {number}"));
            }
            if let [low, high] = numbers[..]
                && low > high
            {
                return bad(format!(
                    "[{section}] {key}: expected the lower end first, found [{low}, {high}]"
                ));
            }
            if key == "half_extent" && numbers == [0.0] {
                return bad(format!("[{section}] {key}: expected a number above 0, found 0"));
            }
        }
        match self.loss.epsilon {
            Some(epsilon) if !(epsilon > 0.0 && epsilon.is_finite()) => {
                bad(format!("[loss] epsilon: expected a number above 0, found {epsilon}"))
            }
            _ => Ok(self),
        }
    }
}
