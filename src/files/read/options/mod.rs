//! Options of reading: how stored values are to be read. Options that are not specified are inferred, and reported.

mod choices;
pub(crate) mod colour_space;
pub(super) mod extensions;
mod grid;
mod layered;
mod order;
mod preset;
mod role;
pub(crate) mod transfer;
mod words;

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::Error;
pub use choices::{Albedo, Energy, NonFinite, NormalEncoding, NormalY, Reflectance, Roughness, Workflow};
pub use grid::TileGrid;
pub use order::Order;
pub use preset::Preset;
pub use role::Role;

/// How the files of a material are to be read. `None`: inferred from the files and reported; where the files do not
/// tell, the default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct ReadOptions {
    /// The conventions of a source of materials, for every option that is not specified.
    pub preset: Option<Preset>,
    /// Colour space of diffuse, base colour and, unless `specular` is specified, specular.
    pub albedo: Option<Albedo>,
    /// Colour space of specular where it is another one.
    #[serde(rename = "specular-albedo")]
    pub specular: Option<Albedo>,
    pub normal_y: Option<NormalY>,
    pub normal_encoding: Option<NormalEncoding>,
    pub roughness: Option<Roughness>,
    pub workflow: Option<Workflow>,
    /// Reflectance of dielectrics at normal incidence, where no map holds it.
    #[serde(rename = "dielectric-f0")]
    pub dielectric: Option<Reflectance>,
    pub energy: Option<Energy>,
    /// Order of the tiles of a packed image.
    pub order: Option<Order>,
    /// How a packed image is divided; needed where its tiles are not square.
    pub grid: Option<TileGrid>,
    /// Which of several materials, or rows of a packed image, from 0.
    pub exemplar: Option<usize>,
    /// Whether row 0 is the lowest: then the material is mirrored, normals with it.
    pub flip_v: Option<bool>,
    pub non_finite: Option<NonFinite>,
}

impl ReadOptions {
    /// Which of the `count` materials of the file `path` is read. The only material of a file is read whatever the
    /// option: the same options may apply to several files.
    ///
    /// # Errors
    /// [`Error::NoSuchExemplar`].
    pub(crate) fn exemplar_of(&self, count: usize, path: &Path) -> Result<usize, Error> {
        match self.exemplar.unwrap_or(0) {
            _ if count < 2 => Ok(0),
            exemplar if exemplar < count => Ok(exemplar),
            exemplar => Err(Error::NoSuchExemplar { path: path.to_owned(), count, exemplar }),
        }
    }

    /// Everything is inferred.
    pub const AUTO: Self = Self {
        preset: None,
        albedo: None,
        specular: None,
        normal_y: None,
        normal_encoding: None,
        roughness: None,
        workflow: None,
        dielectric: None,
        energy: None,
        order: None,
        grid: None,
        exemplar: None,
        flip_v: None,
        non_finite: None,
    };
}
