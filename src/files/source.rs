//! A source of a material: where it comes from and how it is read. The command line and the window open everything through it: files,
//! built-in materials and the entries of a session.
//!
//! ```
//! use svbrdf_core::progress::Progress;
//! use svbrdf_files::read::Read;
//! use svbrdf_files::source::MaterialSource;
//!
//! let read: Read<f32> = MaterialSource::built_in(1).read(&Progress::default())?;
//! assert_eq!(read.material.name(), "blurred normals");
//! # Ok::<(), svbrdf_files::Error>(())
//! ```

use std::fmt;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use svbrdf_core::math::real::Real;
use svbrdf_core::progress::Progress;

use crate::error::Error;
use crate::read::{MaterialPath, Read, ReadOptions};
use crate::samples;

/// Where a material is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// A file, a folder or a prefix of files.
    Path(PathBuf),
    /// The built-in material of this number, 0 for the ground truth.
    BuiltIn(usize),
}

impl Place {
    /// The path; `None` of a built-in material.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::Path(path) => Some(path),
            Self::BuiltIn(_) => None,
        }
    }
}

/// Where a material comes from and how it is read. In a session file, paths are relative to its folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MaterialSource {
    /// The name that it is given; `None` for that of its files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    #[serde(flatten)]
    pub place: Place,
    /// What is specified, which a sidecar file completes; a built-in material is read in its own way.
    #[serde(rename = "read", default)]
    pub options: ReadOptions,
    /// Whether the material is resized to the ground truth.
    #[serde(default)]
    pub fit: bool,
}

impl MaterialSource {
    /// The material at `path`, whose sidecar file completes `options`.
    pub fn path(path: PathBuf, options: ReadOptions) -> Self {
        Self { options, ..Self::at(Place::Path(path)) }
    }

    /// The built-in material of this number, 0 for the ground truth.
    pub fn built_in(number: usize) -> Self {
        Self::at(Place::BuiltIn(number))
    }

    fn at(place: Place) -> Self {
        Self { name: None, place, options: ReadOptions::AUTO, fit: false }
    }

    /// Its path; empty for a built-in material.
    pub fn location(&self) -> &Path {
        self.place.path().unwrap_or(Path::new(""))
    }

    /// Reads the material, in its own size; each file is one step of `progress`.
    ///
    /// # Errors
    /// As [`MaterialPath::read`]; [`Error::NoSuchBuiltIn`].
    pub fn read<T: Real>(&self, progress: &Progress) -> Result<Read<T>, Error> {
        let read: Read<T> = match &self.place {
            Place::BuiltIn(number) => samples::load_one(*number),
            Place::Path(path) => MaterialPath::new(path, &self.options).read(progress),
        }?;
        Ok(match &self.name {
            Some(name) => Read { material: read.material.renamed(name.clone()), ..read },
            None => read,
        })
    }

    /// The names that it may have once it is read, found without its pixels; at least one.
    pub fn possible_names(&self) -> Vec<String> {
        let of_files = || MaterialPath::new(self.location(), &self.options).possible_names();
        self.name.clone().map_or_else(of_files, |name| vec![name])
    }
}

impl From<PathBuf> for MaterialSource {
    /// The material at this path, of which nothing is specified.
    fn from(path: PathBuf) -> Self {
        Self::path(path, ReadOptions::AUTO)
    }
}

/// Its path, or that it is built in.
impl fmt::Display for MaterialSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Place::Path(path) => path.display().fmt(f),
            Place::BuiltIn(number) => write!(f, "built-in material {number}"),
        }
    }
}
