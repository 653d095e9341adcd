//! A material that was read, the record of how, and the storage of its values, for its diagnosis.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use svbrdf_core::material::Material;

use crate::changes::{Storage, StoredEncoding};
use crate::disk::memory::Reserved;
use crate::error::{Error, Guess};
use crate::read::interpret::Neighbours;
use crate::read::map_report::MapContent;
use crate::read::options::{Albedo, NormalY, ReadOptions, Role, Roughness};
use crate::read::record::{Assumption, Certainty, Note, What};

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

impl<T> Read<T> {
    /// The readings of its values and the steps of its maps. A map that comes from several files has the largest step of these.
    pub fn storage(&self) -> Storage {
        let chosen = |what| self.assumptions.iter().find(|a| a.what == what).map(|a| a.chosen.as_str());
        let transfer = |what| chosen(what).map_or(StoredEncoding::Unknown, transfer);
        let step = |of: &dyn Fn(Role) -> bool| {
            self.maps.iter().filter(|map| of(map.map)).map(|map| step(map.depth)).fold(0.0, f64::max)
        };
        let colours = transfer(What::Albedo);
        let has_specular = self.maps.iter().any(|map| map.map == Role::Specular);
        let is_colour = |role| matches!(role, Role::Diffuse | Role::Base | Role::Metallic);
        Storage {
            colours,
            specular: if has_specular { transfer(What::Specular) } else { colours },
            base_colour: !has_specular,
            normal_down: chosen(What::NormalY) == Some(NormalY::Down.name()),
            roughness: chosen(What::Roughness).filter(|name| *name != Roughness::R.name()).map(str::to_owned),
            // Assumed only where diffuse is not scaled.
            unscaled: self.assumptions.iter().any(|assumption| assumption.what == What::Energy),
            steps: [
                step(&|role| role == Role::Normal),
                step(&is_colour),
                step(&|role| if has_specular { role == Role::Specular } else { is_colour(role) }),
                step(&|role| role == Role::Roughness),
            ],
        }
    }
}

fn transfer(name: &str) -> StoredEncoding {
    match name.parse() {
        Ok(Albedo::Linear) => StoredEncoding::Linear,
        Ok(Albedo::Srgb) => StoredEncoding::Srgb,
        Ok(Albedo::Gamma22) => StoredEncoding::Gamma22,
        Ok(Albedo::Log) => StoredEncoding::Other,
        Err(_) => StoredEncoding::Unknown,
    }
}

/// The distance between two stored values; halves have 11 bits at 1, floats count as exact.
fn step(depth: &str) -> f64 {
    match depth {
        "8-bit" => 1.0 / 255.0,
        "16-bit" => 1.0 / 65_535.0,
        "half" => 1.0 / 2048.0,
        _ => 0.0,
    }
}
