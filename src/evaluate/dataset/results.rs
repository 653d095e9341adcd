//! A results folder: a small file for the result of each pair of a ground truth and a prediction, named by the hash of everything that
//! the result depends on.
//!
//! A result that is there is used, and one that is not is computed and added. Files appear whole, by a rename, and two processes that
//! compute one result write the same bytes. So runs may be interrupted, repeated and distributed, and need not know of each other.

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest as _, Sha256};

use svbrdf_core::progress::Progress;
use svbrdf_files::Error;

use super::record::PredictionResult;
use super::remark::Remark;
use svbrdf_files::disk::atomic::update;
use svbrdf_files::disk::open::{NamedFile, hexadecimal};
use svbrdf_files::disk::paths::plain;
use svbrdf_files::disk::{inputs, own};
use svbrdf_files::read::Neighbours;

/// The result of a pair of a ground truth and a prediction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct PairResult {
    /// What was noticed and assumed in reading the ground truth.
    pub(super) reading: Vec<Remark>,
    /// The loss that the ground truth cannot resolve, where diagnoses were asked for.
    pub(super) floor: Option<f64>,
    /// One with a loss: what fails is tried again.
    pub(super) prediction: PredictionResult,
    /// Those that the readings looked at.
    pub(super) neighbours: Vec<KnownNeighbours>,
}

/// The neighbours that a reading looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct KnownNeighbours {
    /// The pictures of diffuse and specular whose neighbours they are, among [`Key::files`].
    of: [usize; 2],
    sha256: String,
}

impl KnownNeighbours {
    /// `None` where they cannot be read, or were written since they were looked at.
    pub(super) fn of(neighbours: &Neighbours, key: &Key) -> Option<Self> {
        let sha256 = neighbours.digest().ok()?;
        let is_current = Neighbours::of(neighbours.maps().clone()) == *neighbours;
        let place = |map: &PathBuf| key.files.iter().position(|file| file == map);
        let [diffuse, specular] = neighbours.maps().each_ref().map(place);
        Some(Self { of: [diffuse?, specular?], sha256 }).filter(|_| is_current)
    }

    fn are_current(&self, key: &Key) -> bool {
        let maps = self.of.map(|place| key.files.get(place).cloned().unwrap_or_default());
        Neighbours::of(maps).digest().is_ok_and(|now| now == self.sha256)
    }
}

/// What the result of a pair depends on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Key {
    /// Everything but the neighbours.
    pub(super) of: Value,
    /// The files of the ground truth, then those of the prediction.
    pub(super) files: Vec<PathBuf>,
}

impl Key {
    /// `m0_ours_0123456789abcdef.json`.
    fn name(&self, material: &str) -> String {
        let method = self.of["method"].as_str().unwrap_or_default();
        format!("{}_{}_{:.16}.json", plain(material), plain(method), sha256(&self.of.to_string()))
    }

    /// Whether a file may be called so.
    fn is_name(name: &str) -> bool {
        let number = name.strip_suffix(".json").and_then(|stem| stem.rsplit('_').next());
        let is_digit = |c: u8| c.is_ascii_digit() || (b'a'..=b'f').contains(&c);
        number.is_some_and(|number| number.len() == 16 && number.bytes().all(is_digit))
    }
}

/// The content of a file.
#[derive(Serialize, Deserialize)]
struct ResultFile {
    /// What the result depends on: its hash is a part of the name.
    of: Value,
    result: PairResult,
    /// Of both: a file that was changed or damaged has another.
    sha256: String,
}

impl ResultFile {
    fn new(Key { of, .. }: &Key, result: &PairResult) -> Result<Self, serde_json::Error> {
        let sha256 = sha256(&format!("{of}{}", serde_json::to_string(result)?));
        Ok(Self { of: of.clone(), result: result.clone(), sha256 })
    }
}

/// A results folder.
#[derive(Debug)]
pub(super) struct ResultsFolder {
    path: PathBuf,
    notes: Mutex<Vec<String>>,
}

impl ResultsFolder {
    /// Opens the folder `path`, or makes it. Hidden files are not looked at.
    ///
    /// # Errors
    /// [`Error::Unwritable`] where there is no folder and none can be made, or one with other files; [`Error::Unreadable`].
    pub(super) fn open(path: &Path) -> Result<Self, Error> {
        if let Err(source) = fs::create_dir(path)
            && !path.is_dir()
        {
            let source = if path.exists() { io::Error::other("it is a file") } else { source };
            let remedy = "name a folder; the one above it has to be there and writable";
            return Err(Error::Unwritable { path: path.to_owned(), source, remedy });
        }
        let entries = fs::read_dir(path).map_err(|source| Error::unreadable(path, source))?.flatten();
        let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
        if let Some(other) = names.filter(|name| !name.starts_with('.') && !Key::is_name(name)).min() {
            let source = io::Error::other(format!("it holds other files than results, such as {other}"));
            let remedy = "name a folder of results, or one that is new or empty";
            return Err(Error::Unwritable { path: path.to_owned(), source, remedy });
        }
        Ok(Self { path: path.to_owned(), notes: Mutex::default() })
    }

    /// The result of a pair of this material, if it is there. A file that cannot be used is noted.
    pub(super) fn load(&self, material: &str, key: &Key) -> Option<PairResult> {
        let path = self.path.join(key.name(material));
        fs::symlink_metadata(&path).ok()?;
        let found = self.read(&path, key);
        found.unwrap_or_else(|problem| {
            let note = format!("{} cannot be used ({problem}): computed again", path.display());
            self.notes.lock().unwrap_or_else(PoisonError::into_inner).push(note);
            None
        })
    }

    /// The result in the file `path`; `None` where its neighbours have changed.
    fn read(&self, path: &Path, key: &Key) -> Result<Option<PairResult>, String> {
        let text = NamedFile::by_file(path, &self.path).text().map_err(|problem| problem.to_string())?;
        inputs::protect(path);
        let read = || -> Result<_, serde_json::Error> {
            let found: ResultFile = serde_json::from_str(&text)?;
            let expected = ResultFile::new(key, &found.result)?;
            Ok((found.of == expected.of && found.sha256 == expected.sha256).then_some(found.result))
        };
        let result = read().map_err(|problem| problem.to_string())?;
        let result =
            result.ok_or("its SHA-256 is another: it was changed, or is the result of another pair")?;
        Ok(Some(result).filter(|result| result.neighbours.iter().all(|one| one.are_current(key))))
    }

    /// Adds the result of a pair of this material.
    ///
    /// # Errors
    /// [`Error::Unwritable`]; [`Cancelled`](Error::is_cancelled).
    pub(super) fn add(
        &self,
        material: &str,
        key: &Key,
        result: &PairResult,
        progress: &Progress,
    ) -> Result<(), Error> {
        let path = self.path.join(key.name(material));
        own::check(&path)?;
        update(&path, progress, |file| {
            let content = ResultFile::new(key, result).map_err(io::Error::other)?;
            serde_json::to_writer(&mut *file, &content)?;
            file.write_all(b"\n")
        })
    }

    /// What a user should know.
    pub(super) fn notes(self) -> Vec<String> {
        let mut notes = self.notes.into_inner().unwrap_or_else(PoisonError::into_inner);
        notes.sort();
        notes
    }
}

fn sha256(text: &str) -> String {
    hexadecimal(Sha256::new_with_prefix(text))
}
