//! Read material: the four maps of a material, with all that was learnt in reading them.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use svbrdf_core::material::Material;
use svbrdf_evaluate::diagnose::Storage;
use svbrdf_evaluate::protocols::MaskSource;
use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::read::Read;
use svbrdf_files::source::{MaterialSource, Place};
use svbrdf_gpu::Gpu;

use crate::model::material::textures::Uploaded;

/// What identifies the maps of a material: the reading that brought them, which is never used twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MaterialId(u64);

impl MaterialId {
    /// Another one than all before.
    pub fn next() -> Self {
        static READINGS: AtomicU64 = AtomicU64::new(0);
        Self(READINGS.fetch_add(1, Ordering::Relaxed))
    }
}

/// A material that has been read, and where it comes from.
#[derive(Debug)]
pub struct ReadMaterial {
    pub id: MaterialId,
    /// Where it comes from, and how it was specified when it was opened.
    pub source: MaterialSource,
    /// Its maps, and how they were read; its mask is the one by which it is compared, outside of which it is gray.
    pub record: Read<f32>,
    /// How its maps are stored, for its diagnosis.
    pub storage: Storage,
    /// Its maps on the adapter, where there is one.
    pub uploaded: Option<Uploaded>,
    /// The stamps of the files that were read, in their order.
    stamps: Vec<Option<Stamp>>,
}

impl ReadMaterial {
    /// The material of what was read from `source`, which is sent to the adapter.
    pub fn new(source: MaterialSource, record: Read<f32>, gpu: Option<&Gpu>) -> Self {
        let storage = record.storage();
        let stamps = record.files.iter().map(|path| Stamp::of(path)).collect();
        let uploaded = gpu.map(|gpu| Uploaded::new(gpu, &record.material));
        Self { id: MaterialId::next(), source, record, storage, uploaded, stamps }
    }

    pub fn material(&self) -> &Material<f32> {
        &self.record.material
    }

    /// The path it was read from; empty for a built-in one.
    pub fn path(&self) -> &Path {
        self.source.location()
    }

    /// The files that were read, each with its stamp.
    pub fn files(&self) -> Vec<(PathBuf, Option<Stamp>)> {
        self.record.files.iter().cloned().zip(self.stamps.iter().copied()).collect()
    }

    /// The part of it, or a change of it, that is compared; it is read from the same files.
    pub fn part(&self, material: Material<f32>, gpu: Option<&Gpu>) -> Self {
        let uploaded = gpu.map(|gpu| Uploaded::new(gpu, &material));
        let record = Read { material, ..self.record.clone() };
        let (source, storage, stamps) = (self.source.clone(), self.storage.clone(), self.stamps.clone());
        Self { id: MaterialId::next(), source, record, storage, uploaded, stamps }
    }

    /// Whether its files are those that were read.
    pub fn is_of_now(&self) -> bool {
        self.record.files.iter().zip(&self.stamps).all(|(path, stamp)| Stamp::of(path) == *stamp)
    }

    /// What it takes to open it again.
    pub fn reopened(&self) -> MaterialSource {
        match self.source.place {
            Place::Path(_) => MaterialSource { options: self.record.options, ..self.source.clone() },
            Place::BuiltIn(_) => self.source.clone(),
        }
    }
}

/// Rules for every material that is opened.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rules {
    /// Whether a guess is an error.
    pub strict: bool,
    /// Whether a prediction of another size is resized to the ground truth.
    pub fit: bool,
    /// Which texels are compared, where not all are.
    pub mask: Option<MaskSource>,
}

/// The name that it is given, or the last part of its path.
pub fn label(source: &MaterialSource) -> String {
    match (&source.name, &source.place) {
        (Some(name), _) => name.clone(),
        (None, Place::BuiltIn(_)) => "built-in material".to_owned(),
        (None, Place::Path(path)) => file_name(path),
    }
}

/// The last part of a path, as text.
pub fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned())
}
