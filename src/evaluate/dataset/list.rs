//! Lists of cases: materials of folders matched by name, and tables of pairs.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::text::line;
use svbrdf_files::Error;

use super::names;
use super::record::{CandidateFile, Case, Method, Source};
use crate::report::distinct_names;
use svbrdf_files::disk::open::NamedFile;
use svbrdf_files::disk::{inputs, memory};
use svbrdf_files::read::{batch, sets};

/// Extensions of files that are no materials.
const OTHER: [&str; 8] = ["json", "jsonl", "txt", "md", "csv", "yaml", "yml", "log"];

/// A part of a data set: every n-th material, from the i-th on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 1 to `of`.
    pub number: usize,
    pub of: usize,
}

impl Shard {
    /// The cases of this part.
    pub fn part(self, cases: Vec<Case>) -> Vec<Case> {
        cases.into_iter().filter(|case| case.index % self.of == self.number - 1).collect()
    }
}

impl FromStr for Shard {
    type Err = CoreError;

    fn from_str(text: &str) -> Result<Self, CoreError> {
        let numbers = text.split_once('/').map(|(number, of)| (number.parse(), of.parse()));
        match numbers {
            Some((Ok(number), Ok(of))) if 1 <= number && number <= of => Ok(Self { number, of }),
            _ => Err(CoreError::unknown_name(
                "part of a data set",
                text,
                "i/n with i from 1 to n, such as 1/4",
            )),
        }
    }
}

impl Source {
    /// Folders of materials; every method has the name that it is given or that of its folder, where need be with that of the one above.
    pub fn folders(ground_truths: PathBuf, methods: Vec<(Option<String>, PathBuf)>) -> Self {
        Self::Folders { ground_truths, methods: named(methods, method_name) }
    }

    /// Predictions of one ground truth; every one has the name that it is given or that of its file, where need be with folders.
    pub fn predictions(ground_truth: PathBuf, predictions: Vec<(Option<String>, PathBuf)>) -> Self {
        let stem = |path: &Path| {
            let stem = if path.is_dir() { path.file_name() } else { path.file_stem() };
            stem.map_or_else(|| path.display().to_string(), |stem| stem.to_string_lossy().into_owned())
        };
        Self::Predictions { ground_truth, predictions: named(predictions, stem) }
    }

    /// Its materials.
    ///
    /// # Errors
    /// As [`cases_of_folders`] and [`cases_of_table`].
    pub fn cases(&self) -> Result<Vec<Case>, Error> {
        match self {
            Self::Folders { ground_truths, methods } => cases_of_folders(ground_truths, methods),
            Self::Table(path) => cases_of_table(path),
            Self::Predictions { ground_truth, predictions } => {
                Ok(cases_of_predictions(ground_truth, predictions))
            }
        }
    }
}

/// The method of all [`Source::Predictions`].
const ONE_METHOD: &str = "prediction";

fn cases_of_predictions(ground_truth: &Path, predictions: &[Method]) -> Vec<Case> {
    let case = |(index, Method { name, path }): (usize, &Method)| {
        let (method, path) = (ONE_METHOD.to_owned(), path.clone());
        let candidates = vec![CandidateFile { method, sample: 0, path, missing: None }];
        Case { index, material: name.clone(), ground_truth: ground_truth.to_owned(), candidates }
    };
    predictions.iter().enumerate().map(case).collect()
}

/// Paths with the names that they are given, or that `name` has for them, told apart.
fn named(given: Vec<(Option<String>, PathBuf)>, name: impl Fn(&Path) -> String) -> Vec<Method> {
    let names: Vec<String> =
        given.iter().map(|(given, path)| given.clone().unwrap_or_else(|| name(path))).collect();
    let pairs: Vec<(&str, &Path)> =
        names.iter().zip(&given).map(|(name, (_, path))| (name.as_str(), path.as_path())).collect();
    let names = distinct_names(&pairs);
    names.into_iter().zip(given).map(|(name, (_, path))| Method { name, path }).collect()
}

/// The name of a method: that of its folder, or what its pattern adds to the name of a material.
fn method_name(path: &Path) -> String {
    let last = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned());
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let added = stem
        .filter(|stem| stem.contains(PLACEHOLDER))
        .map(|stem| stem.replace(PLACEHOLDER, "").trim_matches(|c: char| !c.is_alphanumeric()).to_owned());
    match added {
        Some(added) if !added.is_empty() => Some(added),
        Some(_) => path.parent().and_then(last),
        None if path.is_file() => path.file_stem().map(|stem| stem.to_string_lossy().into_owned()),
        None => last(path),
    }
    .unwrap_or_else(|| path.display().to_string())
}

/// Matches the materials in the folder `ground_truths` with those of the same name in the folder of each method, or at its pattern.
///
/// Every file or folder there is a material, by its name without extension, and so are the files of a set, one for each map, by what
/// their names have in common; a folder that holds nothing but folders is searched itself, and its name is put before theirs. Several
/// predictions of a material are `name_0`, `name_1` and so on. Other names are matched where that is one to one. A material without a
/// prediction by a method is kept: that is a missing prediction.
///
/// # Errors
/// [`Error::Unreadable`], and [`Error::NotADataSet`] where there are no materials.
pub fn cases_of_folders(ground_truths: &Path, methods: &[Method]) -> Result<Vec<Case>, Error> {
    let truths = entries(ground_truths)?;
    if truths.is_empty() {
        return Err(not_a_data_set(ground_truths, "materials", "none"));
    }
    let found =
        methods.iter().map(|method| Predictions::of(method, &truths)).collect::<Result<Vec<_>, _>>()?;
    let case = |(index, (material, ground_truth)): (usize, (&String, &PathBuf))| {
        let candidates =
            methods.iter().zip(&found).flat_map(|(method, found)| found.candidates(method, material));
        let candidates = candidates.collect();
        Case { index, material: line(material), ground_truth: ground_truth.clone(), candidates }
    };
    Ok(truths.iter().enumerate().map(case).collect())
}

/// The predictions of a method.
enum Predictions<'a> {
    /// Those in its folder, by name.
    InFolder(BTreeMap<String, PathBuf>),
    /// Those at a pattern.
    AtPattern(&'a str),
}

impl<'a> Predictions<'a> {
    fn of(method: &'a Method, truths: &BTreeMap<String, PathBuf>) -> Result<Self, Error> {
        if let Some(pattern) =
            method.path.to_str().filter(|path| path.contains(PLACEHOLDER) && !method.path.exists())
        {
            return Ok(Self::AtPattern(pattern));
        }
        let mut found = entries(&method.path)?;
        let is_sample_of = |name: &str, truth: &str| {
            let number = name.strip_prefix(truth).and_then(|rest| rest.strip_prefix('_'));
            number.is_some_and(|number| number.parse::<usize>().is_ok())
        };
        let has_name =
            |name: &str| truths.contains_key(name) || truths.keys().any(|truth| is_sample_of(name, truth));
        if found.keys().any(|name| has_name(name)) {
            return Ok(Self::InFolder(found));
        }
        let [materials, predictions] =
            [truths, &found].map(|all| all.keys().map(String::as_str).collect::<Vec<_>>());
        let pairs = names::matched(&materials, &predictions).into_iter();
        let pairs: Vec<_> =
            pairs.map(|(material, name)| (material.to_owned(), found[name].clone())).collect();
        found.extend(pairs);
        Ok(Self::InFolder(found))
    }

    /// The predictions of a material, or the one that is missing.
    fn candidates(&self, method: &Method, material: &str) -> Vec<CandidateFile> {
        let samples = (0..).map_while(|sample| self.get(&format!("{material}_{sample}")));
        let paths: Vec<PathBuf> = self.get(material).into_iter().chain(samples).collect();
        let one =
            |(sample, path, missing)| CandidateFile { method: line(&method.name), sample, path, missing };
        if paths.is_empty() {
            return vec![one((0, self.expected(method, material), Some(self.missing(method, material))))];
        }
        paths.into_iter().enumerate().map(|(sample, path)| one((sample, path, None))).collect()
    }

    fn get(&self, name: &str) -> Option<PathBuf> {
        match self {
            Self::InFolder(found) => found.get(name).cloned(),
            Self::AtPattern(pattern) => Some(at(pattern, name)).filter(|path| is_there(path)),
        }
    }

    fn expected(&self, method: &Method, material: &str) -> PathBuf {
        match self {
            Self::InFolder(_) => method.path.join(material),
            Self::AtPattern(pattern) => at(pattern, material),
        }
    }

    /// What is there instead.
    fn missing(&self, method: &Method, material: &str) -> String {
        let none = format!("no prediction named {material} in {}", method.path.display());
        let Self::InFolder(found) = self else {
            return format!("no prediction at {}", self.expected(method, material).display());
        };
        let is_near = |name: &str| name.starts_with(material) || name.ends_with(material);
        let Some((name, path)) = found.iter().find(|(name, _)| is_near(name)) else { return none };
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        let pattern = method.path.join(file.replacen(material, PLACEHOLDER, 1));
        let folders = material.contains('/') || name.contains('/');
        match folders {
            true => format!("{none}; found {name}"),
            false => format!("{none}; found {file}: if this is it, name the pattern {}", pattern.display()),
        }
    }
}

/// Stands for the name of a material in the pattern of a method.
const PLACEHOLDER: &str = "{}";

/// The path of a material by the pattern of a method.
fn at(pattern: &str, material: &str) -> PathBuf {
    PathBuf::from(pattern.replace(PLACEHOLDER, material))
}

/// Whether there is a file or folder of this path, or, where it names no form of files, files of a set that begin with it.
fn is_there(path: &Path) -> bool {
    let Some(name) = path.file_name().map(|name| name.to_string_lossy()) else { return false };
    if path.exists() || path.extension().is_some() {
        return path.exists();
    }
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let begins =
        |entry: PathBuf| entry.file_name().is_some_and(|entry| entry.to_string_lossy().starts_with(&*name));
    children(parent).is_ok_and(|entries| entries.into_iter().any(begins))
}

/// The materials of a folder, or of a file of batches, by name.
fn entries(folder: &Path) -> Result<BTreeMap<String, PathBuf>, Error> {
    let mut found = BTreeMap::new();
    if let Some(count) = batch(folder) {
        let names = (1..=count).map(|number| format!("{number:04}"));
        return Ok(names.map(|name| (name.clone(), folder.join(name))).collect());
    }
    collect(folder, "", &mut found)?;
    Ok(found)
}

fn collect(folder: &Path, prefix: &str, found: &mut BTreeMap<String, PathBuf>) -> Result<(), Error> {
    let all = children(folder)?;
    let files: Vec<String> = all
        .iter()
        .filter(|path| path.is_file())
        .filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned()))
        .collect();
    let sets = sets(&files);
    let in_set: HashSet<&String> = sets.values().flatten().collect();
    found.extend(sets.keys().map(|name| (format!("{prefix}{name}"), folder.join(name))));
    for path in all {
        let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if in_set.contains(&file) {
            continue;
        }
        let Some(name) = path.file_stem().map(|name| name.to_string_lossy().into_owned()) else { continue };
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        if name.starts_with('.') || (path.is_file() && OTHER.contains(&extension.as_str())) {
            continue;
        }
        let whole = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if path.is_dir() {
            let inside = children(&path)?;
            if !inside.is_empty() && inside.iter().all(|path| path.is_dir()) {
                collect(&path, &format!("{prefix}{whole}/"), found)?;
                continue;
            }
            found.insert(format!("{prefix}{whole}"), path);
        } else {
            found.insert(format!("{prefix}{name}"), path);
        }
    }
    Ok(())
}

/// The entries of a folder, by name.
fn children(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let listed = || -> std::io::Result<Vec<PathBuf>> {
        std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect()
    };
    if folder.is_file() {
        return Err(not_a_data_set(folder, "a folder of materials", "a file"));
    }
    let mut paths = listed().map_err(|source| Error::unreadable(folder, source))?;
    paths.sort();
    Ok(paths)
}

/// Reads a CSV table with the columns `ground_truth` and `prediction`, and, where they are given, `method` and `material`.
///
/// Paths are relative to the folder of the table. Rows of the same ground truth are one material, in the order of the first; several
/// rows of one method are samples, in their order.
///
/// # Errors
/// [`Error::Unreadable`]; [`Error::NotADataSet`] where a column or a cell is missing or there are no rows; [`Error::Memory`].
pub fn cases_of_table(path: &Path) -> Result<Vec<Case>, Error> {
    let bad = |problem: csv::Error| match problem.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            not_a_data_set(
                path,
                &format!("{expected_len} cells in line {line}, as in the first"),
                &len.to_string(),
            )
        }
        _ => Error::unreadable(path, std::io::Error::other(problem)),
    };
    let file = NamedFile::by_user(path).reader()?;
    inputs::protect(path);
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(file);
    let heading = reader.headers().map_err(bad)?.clone();
    let column = |name: &str| heading.iter().position(|heading| heading == name);
    let (Some(truth), Some(prediction)) = (column("ground_truth"), column("prediction")) else {
        let found = heading.iter().collect::<Vec<_>>().join(", ");
        return Err(not_a_data_set(path, "the columns ground_truth and prediction", &found));
    };
    let [method, material] = [column("method"), column("material")];
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut cases: Vec<Case> = Vec::new();
    // The place of each ground truth, and the samples of each method: a table may have a million rows.
    let mut places: HashMap<PathBuf, usize> = HashMap::new();
    let mut samples: HashMap<(usize, String), usize> = HashMap::new();
    for row in reader.records() {
        let row = row.map_err(bad)?;
        let cell = |column: usize| row.get(column).unwrap_or_default();
        let ground_truth = folder.join(cell(truth));
        let method = line(method.map_or("prediction", cell));
        let at = *places.entry(ground_truth.clone()).or_insert(cases.len());
        if at == cases.len() {
            let stem = ground_truth.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let material = line(&material.map_or(stem, |column| cell(column).to_owned()));
            cases.push(Case { index: at, material, ground_truth, candidates: Vec::new() });
        }
        let count = samples.entry((at, method.clone())).or_insert(0);
        let sample = *count;
        *count += 1;
        let path = folder.join(cell(prediction));
        cases[at].candidates.push(CandidateFile { method, sample, path, missing: None });
    }
    if cases.is_empty() {
        return Err(not_a_data_set(path, "rows below the titles", "none"));
    }
    check_count(path, &cases).map(|()| cases)
}

/// Refuses a table of so many methods and materials that tables of their losses do not fit into memory: a page has a cell for every
/// method and every material, whether the table of pairs has that pair or not.
///
/// # Errors
/// [`Error::Memory`].
fn check_count(path: &Path, cases: &[Case]) -> Result<(), Error> {
    /// The cell of a loss, in bytes.
    const ENTRY: u64 = 128;
    let candidates = cases.iter().flat_map(|case| &case.candidates);
    let methods = candidates.map(|candidate| candidate.method.as_str()).collect::<HashSet<_>>().len() as u64;
    let materials = cases.len() as u64;
    let what =
        || format!("comparing {methods} methods over {materials} materials, as {} lists,", path.display());
    memory::reserve(methods.saturating_mul(materials).saturating_mul(ENTRY), what).map(drop)
}

fn not_a_data_set(path: &Path, expected: &str, found: &str) -> Error {
    Error::NotADataSet {
        path: path.to_owned(),
        expected: expected.to_owned(),
        found: found.to_owned(),
        remedy: "give folders of materials, or a CSV table with a row for each pair",
    }
}
