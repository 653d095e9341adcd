//! A material that was read, and the record of how.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use svbrdf_core::material::Material;

use crate::disk::memory::Reserved;
use crate::error::{Error, Guess};
use crate::read::gather::Neighbours;
use crate::read::gather::map_report::MapContent;
use crate::read::options::ReadOptions;
use crate::read::record::{Assumption, Certainty, Note};

/// A material, and how it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Read<T> {
    pub material: Material<T>,
    /// The assumptions, each with its reason.
    pub assumptions: Vec<Assumption>,
    /// Other things that were noticed.
    pub notes: Vec<Note>,
    /// The files that were read, each once, for watching. None for a material from memory.
    pub files: Vec<PathBuf>,
    /// The pictures of other materials that were looked at, where its own pixels leave the encoding of its colours open.
    pub neighbours: Option<Neighbours>,
    /// A report on each map as stored.
    pub maps: Vec<MapContent>,
    /// The options that it was read with: those of the caller and, unless it excluded them, those of the sidecar file.
    pub options: ReadOptions,
    /// The options of the sidecar file.
    pub saved: ReadOptions,
    /// The memory of the material. It counts towards the limit while this lives.
    pub memory: Arc<Reserved>,
}

impl<T> Read<T> {
    /// Notes and assumptions, a line each.
    pub fn messages(&self) -> impl Iterator<Item = String> {
        self.notes.iter().map(ToString::to_string).chain(self.assumptions.iter().map(ToString::to_string))
    }

    /// The names of the materials of a file of several, and which of them this is, from 0: without
    /// [`ReadOptions::exemplar`] the default.
    pub fn materials(&self) -> Option<(&[String], usize)> {
        self.notes.iter().find_map(|note| match note {
            Note::Materials { names, index } => Some((names.as_slice(), *index)),
            _ => None,
        })
    }

    /// The assumptions whose alternatives are as plausible.
    pub fn unsure(&self) -> impl Iterator<Item = &Assumption> {
        self.assumptions.iter().filter(|a| a.certainty == Certainty::Unsure)
    }

    /// Refuses guesses; `path` is the material that was read.
    ///
    /// A material passes that is read as the user, a specification, or the names of files, layers and formats specify:
    /// nothing is unsure, the interpretation of no value rests on a measurement of pixels alone, and nothing that changes
    /// the look is ignored.
    ///
    /// # Errors
    /// [`Error::Guessed`].
    pub fn refuse_guesses(&self, path: &Path) -> Result<(), Error> {
        let guessed = self.assumptions.iter().filter(|a| a.is_guess());
        let assumptions = guessed.map(|a| Guess { text: a.to_string(), key: a.what.key() });
        let changing = self.notes.iter().filter(|note| note.changes_look());
        let ignored = changing.map(|note| Guess { text: note.to_string(), key: None });
        match assumptions.chain(ignored).collect::<Vec<_>>() {
            guesses if guesses.is_empty() => Ok(()),
            guesses => Err(Error::Guessed { path: path.to_owned(), guesses }),
        }
    }
}
