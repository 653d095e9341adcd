//! A convention as text: TOML with a section for each part of its terms.

use std::fmt;
use std::ops::RangeInclusive;
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
        // As text, which convention files are read from, too: by one deserializer.
        toml::from_str(&table.to_string()).unwrap_or(*self)
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

/// Largest number of a convention: products of some of them are floats of 32 bits.
const LARGEST: f64 = 1e9;

/// The range of the numbers of a key.
fn range(key: &str) -> RangeInclusive<f64> {
    match key {
        "f0" | "r_min" | "nl_min" | "nv_min" | "nh_min" | "vh_min" | "cos_min" | "front_min" | "lz" => {
            0.0..=1.0
        }
        "r_max" | "D_cap" | "dot_max" | "cos_max" => 0.0..=f64::INFINITY,
        "half_extent" => 1e-9..=LARGEST,
        "epsilon" => 1e-30..=LARGEST,
        "u1" => 0.0..=1.0,
        "sigma_view" | "sigma_light" => 0.0..=10.0,
        "mu" => -10.0..=10.0,
        "shift" | "view" => -LARGEST..=LARGEST,
        "z" => 1e-9..=LARGEST,
        _ => 0.0..=LARGEST,
    }
}

/// Refuses a number that is not in the range of its key, and ends of a range in the wrong order.
fn check(section: &str, key: &str, value: &Value) -> Result<(), Error> {
    let bad = |problem: String| Err(Error::BadConvention { problem: format!("{section} {key}: {problem}") });
    let numbers: Vec<f64> = match value {
        Value::Float(number) => vec![*number],
        Value::Array(list) => list.iter().filter_map(Value::as_float).collect(),
        _ => Vec::new(),
    };
    let range = range(key);
    if let Some(number) = numbers.iter().find(|number| !range.contains(number)) {
        let [least, most, found] = [*range.start(), *range.end(), *number].map(short);
        return bad(format!("expected a number from {least} to {most}, found {found}"));
    }
    match numbers[..] {
        [low, high] if low > high => {
            bad(format!("expected the lower end first, found [{}, {}]", short(low), short(high)))
        }
        _ => Ok(()),
    }
}

impl Description {
    /// Refuses what cannot be computed.
    fn checked(self) -> Result<Self, Error> {
        let table = Table::try_from(&self).unwrap_or_default();
        let keys =
            table.iter().filter_map(|(section, keys)| Some((format!("[{section}]"), keys.as_table()?)));
        let scenes = table.get("scenes").and_then(Value::as_array).into_iter().flatten();
        let scenes = scenes.filter_map(|keys| Some(("[[scenes]]".to_owned(), keys.as_table()?)));
        for (section, keys) in keys.chain(scenes) {
            keys.iter().try_for_each(|(key, value)| check(&section, key, value))?;
        }
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_out_of_the_range_of_its_key_is_refused() {
        let mirror = |keys: &str| {
            format!(
                "[[scenes]]\nkind = \"mirror\"\ncount = 6\nmu = 0.5\nshift = [-1.0, 1.0]\nshift_z = 0.0001\n{keys}"
            )
        };
        for (text, problem) in [
            (
                "[light]\nfactor = 1e39".to_owned(),
                "[light] factor: expected a number from 0 to 1e9, found 1e39",
            ),
            (
                "[light]\nintensity = [1, 1, 1e100]".to_owned(),
                "[light] intensity: expected a number from 0 to 1e9",
            ),
            ("[light]\nlz = 1.5".to_owned(), "[light] lz: expected a number from 0 to 1, found 1.5"),
            ("[material]\nr_min = 2".to_owned(), "[material] r_min: expected a number from 0 to 1, found 2"),
            (
                "[material]\nr_max = -1".to_owned(),
                "[material] r_max: expected a number from 0 to inf, found -1",
            ),
            (
                "[specular]\nvh_min = nan".to_owned(),
                "[specular] vh_min: expected a number from 0 to 1, found NaN",
            ),
            (
                "[output]\nclip = [1, 0]".to_owned(),
                "[output] clip: expected the lower end first, found [1, 0]",
            ),
            (
                "[grid]\nhalf_extent = 0".to_owned(),
                "[grid] half_extent: expected a number from 1e-9 to 1e9, found 0",
            ),
            (
                "[loss]\nepsilon = 0".to_owned(),
                "[loss] epsilon: expected a number from 1e-30 to 1e9, found 0",
            ),
            (
                mirror("u1 = [0.5, 1.5]\nsigma_view = 0.75\nsigma_light = 0.75"),
                "[[scenes]] u1: expected a number from 0 to 1, found 1.5",
            ),
            (
                mirror("u1 = [0.0, 0.9]\nsigma_view = 0.75\nsigma_light = 1e9"),
                "[[scenes]] sigma_light: expected a number from 0 to 10, found 1e9",
            ),
        ] {
            let refused = text.parse::<Description>().unwrap_err().to_string();
            assert!(refused.contains(problem), "{text}: {refused}");
        }
        assert!("[material]\nr_max = inf\n[light]\nfactor = 1e9".parse::<Description>().is_ok());
    }
}
