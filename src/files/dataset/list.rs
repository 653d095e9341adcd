//! Lists of cases: materials of folders matched by name, and tables of pairs.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use svbrdf_core::error::Error;
use svbrdf_core::text::line;

use super::record::{Candidate, Case};
use crate::open::NamedFile;
use crate::{inputs, memory};

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
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let numbers = text.split_once('/').map(|(number, of)| (number.parse(), of.parse()));
        match numbers {
            Some((Ok(number), Ok(of))) if 1 <= number && number <= of => Ok(Self { number, of }),
            _ => Err(Error::UnknownName {
                what: "part of a data set",
                found: text.to_owned(),
                known: "i/n with i from 1 to n, such as 1/4".to_owned(),
            }),
        }
    }
}

/// Matches the materials in the folder `ground_truths` with those of the same name in the folder of each method.
///
/// Every file or folder there is a material, by its name without extension; a folder that holds nothing but folders is searched
/// itself, and its name is put before theirs. Several predictions of a material are `name_0`, `name_1` and so on. A material
/// without a prediction by a method is kept: that is a missing prediction.
///
/// # Errors
/// [`Error::Unreadable`], and [`Error::NotAMaterial`] where there are no materials.
pub fn cases_of_folders(ground_truths: &Path, methods: &[(String, PathBuf)]) -> Result<Vec<Case>, Error> {
    let truths = entries(ground_truths)?;
    if truths.is_empty() {
        return Err(nothing_in(ground_truths, "materials"));
    }
    let found = methods.iter().map(|(_, folder)| entries(folder)).collect::<Result<Vec<_>, _>>()?;
    let case = |(index, (material, ground_truth)): (usize, (&String, &PathBuf))| {
        let mut candidates = Vec::new();
        for ((method, folder), found) in methods.iter().zip(&found) {
            let mut paths: Vec<PathBuf> = found.get(material).into_iter().cloned().collect();
            paths.extend((0..).map_while(|sample| found.get(&format!("{material}_{sample}")).cloned()));
            if paths.is_empty() {
                paths.push(folder.join(material));
            }
            let candidate = |(sample, path)| Candidate { method: line(method), sample, path };
            candidates.extend(paths.into_iter().enumerate().map(candidate));
        }
        Case { index, material: line(material), ground_truth: ground_truth.clone(), candidates }
    };
    Ok(truths.iter().enumerate().map(case).collect())
}

/// The materials of a folder by name.
fn entries(folder: &Path) -> Result<BTreeMap<String, PathBuf>, Error> {
    let mut found = BTreeMap::new();
    collect(folder, "", &mut found)?;
    Ok(found)
}

fn collect(folder: &Path, prefix: &str, found: &mut BTreeMap<String, PathBuf>) -> Result<(), Error> {
    for path in children(folder)? {
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
/// [`Error::Unreadable`]; [`Error::NotAMaterial`] where a column is missing or there are no rows; [`Error::Memory`].
pub fn cases_of_table(path: &Path) -> Result<Vec<Case>, Error> {
    let bad = |problem: csv::Error| Error::unreadable(path, std::io::Error::other(problem));
    let file = NamedFile::by_user(path).reader()?;
    inputs::protect(path);
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(file);
    let heading = reader.headers().map_err(bad)?.clone();
    let column = |name: &str| heading.iter().position(|heading| heading == name);
    let (Some(truth), Some(prediction)) = (column("ground_truth"), column("prediction")) else {
        return Err(nothing_in(path, "the columns ground_truth and prediction"));
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
        cases[at].candidates.push(Candidate { method, sample, path: folder.join(cell(prediction)) });
    }
    if cases.is_empty() {
        return Err(nothing_in(path, "rows"));
    }
    check_count(path, &cases).map(|()| cases)
}

/// Refuses a table of so many methods and materials that their comparison does not fit into memory: it has an entry for every
/// method and every material, whether the table has that pair or not.
///
/// # Errors
/// [`Error::Memory`].
fn check_count(path: &Path, cases: &[Case]) -> Result<(), Error> {
    /// A loss that may be missing, and what is computed of it, in bytes.
    const ENTRY: u64 = 128;
    let candidates = cases.iter().flat_map(|case| &case.candidates);
    let methods = candidates.map(|candidate| candidate.method.as_str()).collect::<HashSet<_>>().len() as u64;
    let materials = cases.len() as u64;
    let what =
        || format!("comparing {methods} methods over {materials} materials, as {} lists,", path.display());
    memory::reserve(methods.saturating_mul(materials).saturating_mul(ENTRY), what).map(drop)
}

fn nothing_in(path: &Path, expected: &str) -> Error {
    Error::NotAMaterial {
        path: path.to_owned(),
        expected: expected.to_owned(),
        found: "none".to_owned(),
        remedy: "give a folder of materials, or a table with a row for each pair".to_owned(),
    }
}
