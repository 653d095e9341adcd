//! Rows of the tables: what is written, how it is read, and what must be read.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use tempfile::{TempDir, tempdir};

use super::files::Content;

/// A row: what is written, how it is read, and what must be read.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Case {
    pub name: String,
    /// Sets of files of the table that are there, before those of the case itself.
    pub(super) with: Vec<String>,
    /// Files by name. An empty text removes one.
    pub(super) files: toml::Table,
    /// The path in the folder: without one the only file, or else the folder.
    pub(super) open: Option<String>,
    /// Options of reading.
    pub(super) read: String,
    /// Maps that are specified one by one.
    pub(super) maps: Vec<String>,
    /// Words that the message must have. With them the case must be refused, else it must not.
    pub(super) refused: Vec<String>,
    /// Whether it is the material of the formulas.
    pub(super) same: bool,
    /// Formulas of the maps that must be read, and how far a number may be off.
    pub(super) normal: Option<String>,
    pub(super) diffuse: Option<String>,
    pub(super) specular: Option<String>,
    pub(super) roughness: Option<String>,
    pub(super) within: Option<f64>,
    pub(super) size: Option<[usize; 2]>,
    /// The name of the material.
    pub(super) called: Option<String>,
    /// What is unsure, in the order of the assumptions: nothing else may be.
    pub(super) doubts: Vec<String>,
    /// Parts of its assumptions and notes, and such that none of them may have.
    pub(super) says: Vec<String>,
    pub(super) hides: Vec<String>,
    /// The names of the files that were read, sorted.
    pub(super) reads: Option<Vec<String>>,
    /// Whether strict reading refuses it.
    pub(super) guessed: Option<bool>,
    /// Of metadata: the line of the table in docs/formats.md.
    pub(super) format: String,
    pub(super) field: String,
    pub(super) done: String,
    /// Whether the file that is opened is a seed of damaged files.
    pub seed: bool,
}

/// The cases of a table and its sets of files.
pub(super) struct Table {
    pub(super) sets: BTreeMap<String, toml::Table>,
    pub(super) cases: Vec<Case>,
}

/// The table `tests/materials/NAME.toml`; a case with `each` stands for one of each row of that: its first line has names, which stand in
/// the case as `$NAME`, the others their values, with two spaces or more between them.
pub(super) fn table(name: &str) -> Table {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/materials").join(name).with_extension("toml");
    let mut all: toml::Table =
        std::fs::read_to_string(&path).unwrap().parse().unwrap_or_else(|e| panic!("{name}: {e}"));
    let sets = all.remove("sets").map(|sets| sets.try_into().unwrap()).unwrap_or_default();
    let rows: Vec<toml::Table> = all.remove("case").unwrap().try_into().unwrap();
    assert!(all.is_empty(), "{name}: {all:?}");
    let cases = rows.into_iter().flat_map(|mut row| {
        let Some(each) = row.remove("each") else { return vec![row] };
        let mut lines = each.as_str().unwrap().lines().filter(|line| !line.trim().is_empty()).map(columns);
        let names = lines.next().unwrap();
        // The longest name first: one may begin with another.
        let mut order: Vec<usize> = (0..names.len()).collect();
        order.sort_by_key(|at| std::cmp::Reverse(names[*at].len()));
        lines
            .map(|line| {
                assert_eq!(line.len(), names.len(), "{line:?}");
                let row = substituted(&row.clone().into(), &|text| {
                    order
                        .iter()
                        .fold(text.to_owned(), |text, &at| text.replace(&format!("${}", names[at]), line[at]))
                });
                let mut row: toml::Table = row.try_into().unwrap();
                row["name"] = format!("{}, {}", row["name"].as_str().unwrap(), line.join(" ")).into();
                row
            })
            .collect()
    });
    let case = |row: toml::Table| {
        let name = row["name"].to_string();
        row.try_into().unwrap_or_else(|error| panic!("{name}: {error}"))
    };
    Table { sets, cases: cases.map(case).collect() }
}

fn columns(line: &str) -> Vec<&str> {
    line.split("  ")
        .map(str::trim)
        .filter(|cell| !cell.is_empty())
        .map(|cell| if cell == "-" { "" } else { cell })
        .collect()
}

/// The value with `of` in place of each text and key.
fn substituted(value: &toml::Value, of: &dyn Fn(&str) -> String) -> toml::Value {
    match value {
        toml::Value::String(text) => match of(text).as_str() {
            is @ ("true" | "false") => (is == "true").into(),
            text => text.into(),
        },
        toml::Value::Array(all) => all.iter().map(|one| substituted(one, of)).collect::<Vec<_>>().into(),
        toml::Value::Table(all) => {
            let pairs = all.iter().map(|(key, one)| (of(key), substituted(one, of)));
            toml::Table::from_iter(pairs).into()
        }
        other => other.clone(),
    }
}

impl Case {
    /// Whether it is read as a strip whatever it looks like.
    pub fn is_strip(&self) -> bool {
        self.read.contains("order=ndrs")
    }

    /// Writes the files; returns the folder and the path to open.
    pub(super) fn put(&self, sets: &BTreeMap<String, toml::Table>) -> (TempDir, PathBuf) {
        let folder = tempdir().unwrap();
        let mut all = toml::Table::new();
        for name in &self.with {
            all.extend(sets.get(name).unwrap_or_else(|| panic!("no set {name}")).clone());
        }
        all.extend(self.files.clone());
        all.retain(|_, content| content.as_str() != Some(""));
        for (name, content) in &all {
            Content::from(content.clone()).put(&folder.path().join(name));
        }
        let only = if all.len() == 1 { all.keys().next().cloned() } else { None };
        let path = match self.open.clone().or(only).as_deref() {
            None | Some(".") => folder.path().to_owned(),
            Some(name) => folder.path().join(name),
        };
        (folder, path)
    }
}
