//! A results folder: a small file for each answer, or for the result of each pair of a data set, named by the hash of everything that it
//! depends on.
//!
//! A result that is there is used, and one that is not is computed and added. Files appear whole, by a rename, and two processes that
//! compute one result write the same bytes. So runs may be interrupted, repeated and distributed, and need not know of each other.

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest as _, Sha256};

use svbrdf_core::progress::Progress;
use svbrdf_core::render::simd::Level;
use svbrdf_files::Error;

use svbrdf_files::disk::atomic::{SOFTWARE, update};
use svbrdf_files::disk::open::{NamedFile, hexadecimal};
use svbrdf_files::disk::paths::plain;
use svbrdf_files::disk::{inputs, own};

/// An answer, and what a user should know about its results folder.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptAnswer<R> {
    pub answer: R,
    /// The files that cannot be used: lines.
    pub notes: Vec<String>,
    /// How many results could not be added, and why.
    pub unkept: Option<String>,
}

/// What a result depends on.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Key {
    of: Value,
}

impl Key {
    /// That of a result of this program on this machine. It has a `method`, or an `analysis`.
    pub(crate) fn new(of: Value) -> Self {
        Self::at(Level::best(), of)
    }

    /// The same but for one of the things that it depends on.
    pub(crate) fn with(&self, name: &str, value: Value) -> Self {
        let mut of = self.of.clone();
        of[name] = value;
        Self { of }
    }

    /// Another version may compute other numbers, and remark on other things. The sums of another instruction set differ in their last
    /// digits.
    fn at(level: Level, mut of: Value) -> Self {
        of["software"] = SOFTWARE.into();
        of["simd"] = level.name().into();
        Self { of }
    }

    /// `m0_ours_0123456789abcdef.json`.
    fn name(&self, material: &str) -> String {
        let of = self.of["method"].as_str().or(self.of["analysis"].as_str()).unwrap_or_default();
        format!("{}_{}_{:.16}.json", plain(material), plain(of), sha256(&self.of.to_string()))
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
struct ResultFile<R> {
    /// What the result depends on: its hash is a part of the name.
    of: Value,
    result: R,
    /// Of both: a file that was changed or damaged has another.
    sha256: String,
}

impl<R: Serialize> ResultFile<R> {
    fn new(Key { of }: &Key, result: R) -> Result<Self, serde_json::Error> {
        let sha256 = sha256(&format!("{of}{}", serde_json::to_string(&result)?));
        Ok(Self { of: of.clone(), result, sha256 })
    }
}

/// A results folder.
#[derive(Debug)]
pub(crate) struct ResultsFolder {
    path: PathBuf,
    notes: Mutex<Vec<String>>,
    unkept: Mutex<Unkept>,
}

/// The files that could not be written yet, the newest last, with their texts.
#[derive(Debug, Default)]
struct Unkept {
    files: Vec<(PathBuf, String)>,
    /// Why the last one could not.
    problem: String,
}

impl ResultsFolder {
    /// Opens the folder `path`, or makes it. Hidden files are not looked at.
    ///
    /// # Errors
    /// [`Error::Unwritable`] where there is no folder and none can be made, or one with other files; [`Error::Unreadable`].
    pub(crate) fn open(path: &Path) -> Result<Self, Error> {
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
        Ok(Self { path: path.to_owned(), notes: Mutex::default(), unkept: Mutex::default() })
    }

    /// The result of this material, if it is there. A file that cannot be used is noted.
    pub(crate) fn load<R: Serialize + DeserializeOwned>(&self, material: &str, key: &Key) -> Option<R> {
        let path = self.path.join(key.name(material));
        fs::symlink_metadata(&path).ok()?;
        let found = self.read(&path, key).map(Some);
        found.unwrap_or_else(|problem| {
            let note = format!("{} cannot be used ({problem}): computed again", path.display());
            self.notes.lock().unwrap_or_else(PoisonError::into_inner).push(note);
            None
        })
    }

    /// The result in the file `path`.
    fn read<R: Serialize + DeserializeOwned>(&self, path: &Path, key: &Key) -> Result<R, String> {
        let text = NamedFile::by_file(path, &self.path).text().map_err(|problem| problem.to_string())?;
        inputs::protect(path);
        let read = || -> Result<_, serde_json::Error> {
            let ResultFile { of, result, sha256 } = serde_json::from_str(&text)?;
            let expected = ResultFile::<R>::new(key, result)?;
            Ok((of == expected.of && sha256 == expected.sha256).then_some(expected.result))
        };
        let result = read().map_err(|problem| problem.to_string())?;
        let other = "its SHA-256 is another: it was changed, or is another result";
        result.ok_or_else(|| other.to_owned())
    }

    /// Adds the result of this material. Where it cannot be written, that is tried again after the next one that can, and at
    /// the end.
    ///
    /// # Errors
    /// [`Cancelled`](Error::is_cancelled); [`Error::Internal`].
    pub(crate) fn add(
        &self,
        material: &str,
        key: &Key,
        result: &impl Serialize,
        progress: &Progress,
    ) -> Result<(), Error> {
        let text = ResultFile::new(key, result).and_then(|content| serde_json::to_string(&content));
        let text = text.map_err(|problem| Error::Internal(format!("a result has no text: {problem}")))?;
        let path = self.path.join(key.name(material));
        self.unkept().files.push((path, text + "\n"));
        self.write(false, progress)
    }

    fn unkept(&self) -> MutexGuard<'_, Unkept> {
        self.unkept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Writes the newest file and, unless that fails, the others; all of them in any case where `has_written` is true.
    fn write(&self, mut has_written: bool, progress: &Progress) -> Result<(), Error> {
        let mut files = std::mem::take(&mut self.unkept().files);
        let mut failed = Vec::new();
        while let Some((path, text)) = files.pop() {
            let written = own::check(&path)
                .and_then(|()| update(&path, progress, |file| file.write_all(text.as_bytes())));
            match written {
                Ok(()) => has_written = true,
                Err(problem) if problem.is_cancelled() => return Err(problem),
                Err(problem) => {
                    self.unkept().problem = problem.to_string();
                    failed.push((path, text));
                    if !has_written {
                        break;
                    }
                }
            }
        }
        // Before those of other threads, which are newer.
        files.extend(failed.into_iter().rev());
        self.unkept().files.splice(0..0, files);
        Ok(())
    }

    /// Tries once more to write what could not be. What a user should know: notes, and the results that are not kept.
    ///
    /// # Errors
    /// [`Cancelled`](Error::is_cancelled).
    pub(crate) fn end(self, progress: &Progress) -> Result<(Vec<String>, Option<String>), Error> {
        self.write(true, progress)?;
        let unkept = self.unkept();
        let are = if unkept.files.len() == 1 { "result is" } else { "results are" };
        let text = || format!("{} {are} not kept: {}", unkept.files.len(), unkept.problem);
        let text = (!unkept.files.is_empty()).then(text);
        let mut notes = self.notes.lock().unwrap_or_else(PoisonError::into_inner).clone();
        notes.sort();
        Ok((notes, text))
    }
}

fn sha256(text: &str) -> String {
    hexadecimal(Sha256::new_with_prefix(text))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_instruction_set_has_its_own_keys() {
        let levels: Vec<_> = Level::all().into_iter().filter_map(|(_, level)| level).collect();
        let of = serde_json::json!({ "method": "m" });
        let key = |level: &Level| Key::at(*level, of.clone()).name("a");
        assert_eq!(levels.iter().map(key).collect::<BTreeSet<_>>().len(), levels.len());
        assert_eq!(Key::new(of.clone()).name("a"), key(&Level::best()));
    }

    #[test]
    fn what_could_not_be_kept_is_kept_as_soon_as_it_can_be() {
        let above = tempfile::tempdir().unwrap();
        let path = above.path().join("kept");
        let progress = Progress::default();
        let key = |number: u32| Key::new(serde_json::json!({ "method": "m", "n": number }));
        let count = || fs::read_dir(&path).map_or(0, |entries| entries.count());
        let folder = ResultsFolder::open(&path).unwrap();
        let add = |number| folder.add("a", &key(number), &number, &progress).unwrap();
        fs::remove_dir(&path).unwrap();
        (0..3).for_each(add);
        assert_eq!((count(), folder.unkept().files.len()), (0, 3));
        fs::create_dir(&path).unwrap();
        // One of them cannot be written still, which does not hold up the others.
        fs::create_dir(path.join(key(1).name("a"))).unwrap();
        add(3);
        assert_eq!(count(), 4);
        assert!((0..4).all(|number| folder.load("a", &key(number)) == (number != 1).then_some(number)));
        let (_, unkept) = folder.end(&progress).unwrap();
        let unkept = unkept.unwrap();
        assert!(
            unkept.starts_with("1 result is not kept: cannot write ") && unkept.contains("_m_"),
            "{unkept}"
        );
        // Files of results are told from all others.
        for name in
            ["m_0123456789abcdef.json", "a_m_0123456789abcdeF.json", "a_m_0123456789abcde.json", "a.json"]
        {
            assert_eq!(Key::is_name(name), name == "m_0123456789abcdef.json", "{name}");
        }
    }
}
