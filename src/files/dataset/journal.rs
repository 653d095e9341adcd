//! The journal of a run over a data set: a JSON lines file to which results are added as they come.
//!
//! The first line, the head, has everything that all results depend on: the version of the program, the settings and the options of
//! reading. Every other line is the result of a material with the fingerprints of the files that it was computed from. A journal with
//! another head is refused; a line whose files have changed is computed again.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use svbrdf_core::error::Error;
use svbrdf_core::progress::Progress;

use super::evaluate::Evaluated;
use super::fingerprint::MaterialFiles;
use super::lock::Lock;
use super::record::{Case, DatasetReading, DatasetSettings, MaterialResult};
use crate::atomic::{folder_of, update};
use crate::inputs;
use crate::open::NamedFile;

/// The version of the format that is written and read.
const FORMAT: u32 = 3;
/// The key of the format in the head.
const KEY: &str = "svbrdf-journal";
/// Journals of the first format have no such key, but this one.
const KEY_OF_FIRST: &str = "target_error";
/// Most differences of two heads that an error names.
const MOST_NAMED: usize = 3;

/// Everything that all results of a journal depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Head {
    #[serde(rename = "svbrdf-journal")]
    format: u32,
    program: String,
    #[serde(flatten)]
    settings: DatasetSettings,
    reading: DatasetReading,
}

/// The result of a material, and what it was computed from.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Line {
    #[serde(flatten)]
    pub(super) result: MaterialResult,
    /// Of the ground truth, then of each prediction.
    files: Vec<MaterialFiles>,
}

/// A result of a journal that was computed again, because its files had changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recomputed {
    pub material: String,
    /// The first file that had changed.
    pub file: String,
}

/// `m3 is computed again: ours/m3.png has changed since its result was kept`.
impl fmt::Display for Recomputed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { material, file } = self;
        write!(f, "{material} is computed again: {file} has changed since its result was kept")
    }
}

/// A file to which results are added.
#[derive(Debug)]
pub(super) struct Journal {
    path: PathBuf,
    head: Head,
    file: Mutex<File>,
    /// Held while results are added.
    _lock: Lock,
}

impl Journal {
    /// Opens the journal at `path`, which may be there already, and the lines that it holds; those of `cases` whose files have
    /// changed are dropped and named.
    ///
    /// A last line that was cut off, as when the program was ended, is dropped. An empty file becomes a journal.
    ///
    /// # Errors
    /// [`Error::Unreadable`], [`Error::Unwritable`]; [`Error::BadJournal`] where the file has another head, contradicts itself, or
    /// is no journal; [`Error::JournalInUse`].
    pub(super) fn open(
        path: &Path,
        head: Head,
        cases: &[Case],
    ) -> Result<(Self, Vec<Line>, Vec<Recomputed>), Error> {
        let lock = Lock::take(path)?;
        let mut lines = Vec::new();
        let named = NamedFile::by_file(path, folder_of(path));
        if path.exists() && !is_empty(&named)? {
            let (found, known) = read(&named)?;
            if found != head {
                let problem = format!(
                    "it is of other settings, materials or methods: {}",
                    found.differences(&head, "this run")
                );
                return Err(bad(path, problem));
            }
            lines = known;
        }
        let mut recomputed = Vec::new();
        lines.retain(|line| {
            let case = cases.iter().find(|case| case.index == line.result.index);
            let Some(file) = case.and_then(|case| line.changed(case)) else { return true };
            recomputed.push(Recomputed { material: line.result.material.clone(), file });
            false
        });
        write(path, &head, &lines)?;
        let file = OpenOptions::new().append(true).open(path).map_err(|source| unwritable(path, source))?;
        Ok((Self { path: path.to_owned(), head, file: Mutex::new(file), _lock: lock }, lines, recomputed))
    }

    /// Adds a result with the fingerprints of its files, and returns its line.
    ///
    /// # Errors
    /// [`Error::Unwritable`].
    pub(super) fn add(&self, evaluated: Evaluated) -> Result<Line, Error> {
        let Evaluated { result, read, start } = evaluated;
        let files = read.iter().map(|(path, files)| MaterialFiles::new(path, files, start)).collect();
        let line = Line { result, files };
        let text = text_of(&self.path, &line)?;
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.write_all(text.as_bytes()).map_err(|source| unwritable(&self.path, source))?;
        Ok(line)
    }

    /// Writes the whole journal again: its bytes depend on `lines` alone, which are in order.
    ///
    /// # Errors
    /// [`Error::Unwritable`].
    pub(super) fn finish(&self, lines: &[Line]) -> Result<(), Error> {
        write(&self.path, &self.head, lines)
    }
}

impl Head {
    pub(super) fn new(settings: &DatasetSettings, reading: &DatasetReading) -> Self {
        let program = concat!("svbrdf ", env!("CARGO_PKG_VERSION")).to_owned();
        Self { format: FORMAT, program, settings: settings.clone(), reading: reading.clone() }
    }

    /// The fields in which `other` differs, with both values; `name` says what the other one is of.
    fn differences(&self, other: &Self, name: &str) -> String {
        let mut found = Vec::new();
        let [a, b] = [self, other].map(|head| serde_json::to_value(head).unwrap_or_default());
        compare(&a, &b, "", &mut found);
        let more = found.len().saturating_sub(MOST_NAMED);
        found.truncate(MOST_NAMED);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        format!("{}{more} in {name}", found.join(", "))
    }
}

/// Adds the leaves in which two values differ, each with its path from the root.
fn compare(a: &Value, b: &Value, path: &str, found: &mut Vec<String>) {
    match (a, b) {
        (Value::Object(a), Value::Object(b)) => {
            let keys: BTreeSet<&String> = a.keys().chain(b.keys()).collect();
            for key in keys {
                let [a, b] = [a, b].map(|all| all.get(key).unwrap_or(&Value::Null));
                compare(a, b, &format!("{path}.{key}"), found);
            }
        }
        _ if a == b => {}
        _ => {
            let text = |value: &Value| match value {
                Value::Null => "unspecified".to_owned(),
                Value::Array(all) => format!("a list of {}", all.len()),
                value => value.to_string(),
            };
            found.push(format!("{} is {}, but {}", path.trim_start_matches('.'), text(a), text(b)));
        }
    }
}

impl Line {
    /// Whether both are of one material, and not the same.
    fn contradicts(&self, other: &Self) -> bool {
        self.result.index == other.result.index && self.result != other.result
    }

    /// The first file of a case that is not what it was when the result was computed.
    fn changed(&self, case: &Case) -> Option<String> {
        let predictions = case.candidates.iter().map(|candidate| candidate.path.as_path());
        let paths: Vec<&Path> = [case.ground_truth.as_path()].into_iter().chain(predictions).collect();
        let changed = |index: usize| match (paths.get(index), self.files.get(index)) {
            (Some(path), Some(files)) => files.changed(path),
            (Some(path), None) => Some(path.display().to_string()),
            (None, files) => files.map(|files| files.path.clone()),
        };
        (0..paths.len().max(self.files.len())).find_map(changed)
    }
}

/// The results of several journals.
#[derive(Clone, Debug, PartialEq)]
pub struct Merged {
    pub settings: DatasetSettings,
    pub reading: DatasetReading,
    /// In the order of the data set.
    pub results: Vec<MaterialResult>,
}

/// The results of several journals of one data set.
///
/// # Errors
/// [`Error::Unreadable`]; [`Error::BadJournal`] where they have different heads, or results are missing or not the same.
pub fn merged(paths: &[PathBuf]) -> Result<Merged, Error> {
    let mut first: Option<(&Path, Head)> = None;
    let mut all: BTreeMap<usize, MaterialResult> = BTreeMap::new();
    for path in paths {
        let (head, lines) = read(&NamedFile::by_user(path))?;
        match &first {
            None => first = Some((path, head)),
            Some((other, expected)) if head != *expected => {
                let differences = head.differences(expected, &other.display().to_string());
                return Err(bad(
                    path,
                    format!("it is of other settings, materials or methods: {differences}"),
                ));
            }
            Some(_) => {}
        }
        for Line { result, .. } in lines {
            let name = result.material.clone();
            if all.insert(result.index, result.clone()).is_some_and(|before| before != result) {
                return Err(bad(path, format!("its result of {name} differs from that of another journal")));
            }
        }
    }
    let (Some((_, head)), Some(last)) = (first, paths.last()) else {
        return Err(bad(Path::new(""), "there is no journal".to_owned()));
    };
    let count = head.settings.materials.len();
    let missing = (0..count).filter(|index| !all.contains_key(index)).count();
    if missing > 0 {
        return Err(bad(last, format!("{missing} of {count} materials are in none of the journals")));
    }
    let Head { settings, reading, .. } = head;
    Ok(Merged { settings, reading, results: all.into_values().collect() })
}

/// The cases whose results are not there yet.
pub(super) fn remaining(cases: &[Case], lines: &[Line]) -> Vec<Case> {
    let is_done = |case: &&Case| lines.iter().any(|line| line.result.index == case.index);
    cases.iter().filter(|case| !is_done(case)).cloned().collect()
}

fn is_empty(file: &NamedFile) -> Result<bool, Error> {
    let found = file.open()?.metadata().map_err(|source| Error::unreadable(file.path(), source))?;
    Ok(found.len() == 0)
}

fn read(file: &NamedFile) -> Result<(Head, Vec<Line>), Error> {
    let path = file.path();
    let text = file.text()?;
    inputs::protect(path);
    if text.is_empty() {
        return Err(bad(path, "it is empty, and no journal of a data set".to_owned()));
    }
    let complete = text.rfind('\n').map_or("", |end| &text[..end]);
    let mut lines = complete.lines();
    let is_not =
        |problem: serde_json::Error| bad(path, format!("it is no journal of a data set ({problem})"));
    let head: Value = serde_json::from_str(lines.next().unwrap_or_default()).map_err(is_not)?;
    if let Some(problem) = unknown_format(&head) {
        return Err(bad(path, problem));
    }
    let head = serde_json::from_value(head).map_err(is_not)?;
    let mut lines: Vec<Line> = lines.map(serde_json::from_str).collect::<Result<_, _>>().map_err(is_not)?;
    lines.sort_by_key(|line| line.result.index);
    if let Some(pair) = lines.windows(2).find(|pair| pair[0].contradicts(&pair[1])) {
        let name = &pair[0].result.material;
        return Err(bad(path, format!("it has two results of {name}, which differ")));
    }
    lines.dedup_by_key(|line| line.result.index);
    Ok((head, lines))
}

/// The problem of a head of another format.
fn unknown_format(head: &Value) -> Option<String> {
    match head.get(KEY).and_then(Value::as_u64) {
        Some(format) if format == u64::from(FORMAT) => None,
        Some(format) => Some(format!("its format is {format}, expected {FORMAT}: another version of the program made it")),
        None if head.get(KEY_OF_FIRST).is_some() => Some(
            "it was made by an earlier version, which did not record how the materials were read; its results have to be computed \
                again"
                .to_owned(),
        ),
        None => None,
    }
}

fn write(path: &Path, head: &Head, lines: &[Line]) -> Result<(), Error> {
    let mut text = text_of(path, head)?;
    for line in lines {
        text += &text_of(path, line)?;
    }
    update(path, &Progress::default(), |file| file.write_all(text.as_bytes()))
}

fn text_of(path: &Path, value: &impl Serialize) -> Result<String, Error> {
    let text = serde_json::to_string(value).map_err(|problem| unwritable(path, problem.into()))?;
    Ok(text + "\n")
}

fn bad(path: &Path, problem: String) -> Error {
    Error::BadJournal { path: path.to_owned(), problem }
}

fn unwritable(path: &Path, source: std::io::Error) -> Error {
    Error::Unwritable {
        path: path.to_owned(),
        source,
        remedy: "check that its folder is writable and the disk not full",
    }
}
