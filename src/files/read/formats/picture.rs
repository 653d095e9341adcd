//! One picture that holds a whole material: in tiles, or in named layers, as those of an EXR or the arrays of an npz.

use std::collections::HashMap;
use std::path::Path;

use svbrdf_core::progress::Progress;

use super::packed;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::decode::exr::NATIVE;
use crate::read::decode::{self, Decoded, Layer};
use crate::read::names::{Label, listing};
use crate::read::options::{Albedo, ReadOptions, Role, Roughness};
use crate::read::record::{Assumption, Certainty, Note, Reason, Subject, Unused, What};
use crate::read::stored::{Inferences, MapsByRole, StoredMap, StoredMaterial};

const PREVIEW: &str = "The unnamed layer is taken as a preview and ignored.";

/// A picture that may hold a whole material.
#[derive(Debug)]
pub(in crate::read) struct WholePicture {
    pub file: NamedFile,
    /// The error where its pixels are those of no packed picture; `None`: the error of its recognition.
    pub refusal: Option<Error>,
}

impl WholePicture {
    /// The picture of a file that the user names.
    pub(in crate::read) fn by_user(path: &Path) -> Self {
        Self { file: NamedFile::by_user(path), refusal: None }
    }

    /// Reads its maps; the picture is one step of `progress`.
    ///
    /// # Errors
    /// As [`Self::recognized`]; those of the picture.
    pub(super) fn read(self, options: &ReadOptions, progress: &Progress) -> Result<StoredMaterial, Error> {
        progress.begin(1);
        let decoded = decode::whole(&self.file, Subject::Material)?;
        progress.step()?;
        self.recognized(decoded, options)
    }

    /// The material within the decoded picture.
    ///
    /// # Errors
    /// [`Error::NotPacked`], [`Error::NotAMaterial`], [`Error::NoSuchExemplar`].
    pub(in crate::read) fn recognized(
        self,
        decoded: Decoded,
        options: &ReadOptions,
    ) -> Result<StoredMaterial, Error> {
        let Self { file, refusal } = self;
        let Decoded { mut layers, mut notes, batch } = decoded;
        if let Some(count) = batch {
            let exemplar = options.exemplar_of(count, file.path())?;
            for Layer { raster, .. } in layers.iter_mut().filter(|layer| layer.raster.height % count == 0) {
                let [width, height] = [raster.width, raster.height / count];
                *raster = raster.crop([0, exemplar * height], [width, height]);
            }
        }
        let found = match layers.pop() {
            Some(only) if layers.is_empty() && !is_named(&only) => {
                match packed::material(file.path(), &only.raster, only.meaning.as_deref(), options) {
                    // An array with a name is more likely a map of another name than a picture of another shape.
                    Err(Error::NotPacked { grid: None, .. }) if !only.name.is_empty() => {
                        of_layers(file.path(), vec![only], options)
                    }
                    found => found,
                }
            }
            last => of_layers(file.path(), layers.into_iter().chain(last).collect(), options),
        };
        let mut found = found.map_err(|error| match (error, refusal) {
            (
                Error::NotAMaterial { .. } | Error::MissingMap { .. } | Error::NotPacked { .. },
                Some(refusal),
            ) => refusal,
            (error, _) => error,
        })?;
        notes.append(&mut found.notes);
        Ok(StoredMaterial { notes, ..found })
    }
}

/// Whether the name of a layer names a map.
fn is_named(layer: &Layer) -> bool {
    Label::of(&layer.name).is_some()
}

/// The name of a layer, for messages.
pub(super) fn name(layer: &Layer) -> String {
    if layer.name.is_empty() { "one without a name".to_owned() } else { format!("`{}`", layer.name) }
}

fn unused(layer: &str) -> Note {
    Note::Unused { what: format!("Layer {layer}"), why: Unused::NotAMap }
}

/// The maps among `layers`, by their names; others are reported as not used.
///
/// # Errors
/// [`Error::NotAMaterial`] where maps are missing, or one is there twice.
fn of_layers(path: &Path, layers: Vec<Layer>, options: &ReadOptions) -> Result<StoredMaterial, Error> {
    let names: Vec<String> = layers.iter().map(name).collect();
    let listed = format!("the layers {}", listing(&names));
    let is_native = layers.iter().any(|layer| layer.meaning.as_deref() == Some(NATIVE));
    let mut maps = MapsByRole::default();
    let mut notes = Vec::new();
    let mut named: Vec<_> = layers.into_iter().map(|layer| (Label::of(&layer.name), layer)).collect();
    // `geo_normal` is none beside `normal`.
    named.sort_by_key(|(label, _)| label.as_ref().map_or(0, |label| label.stem.len()));
    let mut stems = HashMap::new();
    for (label, Layer { name, raster, .. }) in named {
        match label {
            Some(label) if label.role == Role::Ignored => notes.push(unused(&name)),
            Some(label) if stems.get(&label.role).is_some_and(|stem| *stem < label.stem.len()) => {
                notes.push(unused(&name));
            }
            Some(label) if maps.has(label.role) => {
                return Err(Error::NotAMaterial {
                    path: path.to_owned(),
                    expected: format!("one layer for the {} map", label.role.name()),
                    found: listed,
                    remedy: "rename the layers that are none".to_owned(),
                });
            }
            Some(label) => {
                let part = format!("layer {name}");
                stems.insert(label.role, label.stem.len());
                maps.add(label.role, StoredMap { raster, file: path.to_owned(), part });
            }
            None if name.is_empty() => notes.push(Note::Told(PREVIEW.to_owned())),
            None => notes.push(unused(&name)),
        }
    }
    let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let mut found = maps.material(path, name, &listed, options)?;
    let why = Reason::stated("the names of the layers name the maps");
    let layout = Assumption::new(What::Layout, "layers", why, Certainty::Sure);
    found.assumptions.insert(0, layout);
    notes.append(&mut found.notes);
    found.notes = notes;
    if is_native {
        found.inferred = Inferences::stated(Albedo::Linear, Roughness::R, "svbrdf wrote the file");
    } else {
        found.infer_floats();
    }
    Ok(found)
}
