//! Options of reading: how stored values are to be read. Options that are not specified are inferred, and reported.

mod choices;
mod role;
mod tiles;
pub(crate) mod transfer;
mod words;

use std::path::Path;

use serde::{Deserialize, Serialize};

use svbrdf_core::error::Error as CoreError;

use crate::error::Error;

pub use choices::{
    Albedo, Energy, NonFinite, NormalEncoding, NormalY, Preset, Reflectance, Roughness, Workflow,
};
pub use role::Role;
pub use tiles::Order;
pub use tiles::TileGrid;

/// The options with what is the same of each: a field, its key in files and on the command line, and the values of a key that stand
/// for no choice.
macro_rules! options {
    ($($(#[$about:meta])* $field:ident = $key:literal $(of $known:literal)?: $kind:ty,)+) => {
        /// How the files of a material are to be read. `None`: inferred from the files and reported; where the files do not
        /// tell, the default.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[serde(default)]
        pub struct ReadOptions {
            $($(#[$about])* #[serde(rename = $key)] pub $field: Option<$kind>,)+
        }

        impl ReadOptions {
            /// Everything is inferred.
            pub const AUTO: Self = Self { $($field: None,)+ };

            /// These options, and those of `saved` where neither they nor their preset specify anything.
            #[must_use]
            pub fn over(self, saved: Self) -> Self {
                let preset = self.preset.map(Preset::options).unwrap_or_default();
                Self { $($field: self.$field.or(if preset.$field.is_some() { None } else { saved.$field }),)+ }
            }

            /// These options, and those of their preset where they specify nothing; except y of normals, which names tell better.
            pub(crate) fn with_preset(self) -> Self {
                let Some(usual) = self.preset.map(Preset::options) else { return self };
                let usual = Self { specular: self.albedo.or(usual.specular), normal_y: None, ..usual };
                Self { $($field: self.$field.or(usual.$field),)+ }
            }

            /// The one option `key` with the value of this name.
            fn of_word(key: &str, value: &str) -> Result<Self, Error> {
                let auto = Self::AUTO;
                match key {
                    $($key => Ok(Self { $field: Some(options!(@value $key, value $(, $known)?)), ..auto }),)+
                    _ => {
                        let (found, known) = (key.to_owned(), Self::keys().join(", "));
                        Err(CoreError::unknown_name("option of reading", found, known).into())
                    }
                }
            }
        }
    };
    (@value $key:literal, $value:ident) => { $value.parse()? };
    (@value $key:literal, $value:ident, $known:literal) => {
        $value.parse().map_err(|_| CoreError::unknown_name($key, $value, $known))?
    };
}

options! {
    /// The conventions of a source of materials, for every option that is not specified.
    preset = "preset": Preset,
    /// Colour space of diffuse, base colour and, unless `specular` is specified, specular.
    albedo = "albedo": Albedo,
    /// Colour space of specular where it is another one.
    specular = "specular-albedo": Albedo,
    normal_y = "normal-y": NormalY,
    normal_encoding = "normal-encoding": NormalEncoding,
    roughness = "roughness": Roughness,
    workflow = "workflow": Workflow,
    /// Reflectance of dielectrics at normal incidence, where no map holds it.
    dielectric = "dielectric-f0": Reflectance,
    energy = "energy": Energy,
    /// Order of the tiles of a packed image.
    order = "order": Order,
    /// How a packed image is divided; needed where its tiles are not square.
    grid = "grid": TileGrid,
    /// Which of several materials, or rows of a packed image, from 0.
    exemplar = "exemplar" of "a whole number from 0": usize,
    /// Whether row 0 is the lowest: then the material is mirrored, normals with it.
    flip_v = "flip-v" of "true, false": bool,
    non_finite = "non-finite": NonFinite,
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
}

impl Preset {
    /// The options that it stands for. The direction of y is left open where names tell it.
    pub(crate) fn options(self) -> ReadOptions {
        let linear = (Albedo::Linear, Albedo::Linear);
        let gamma = (Albedo::Gamma22, Albedo::Gamma22);
        let srgb = (Albedo::Srgb, Albedo::Srgb);
        let (scaled, unscaled) = (Some(Energy::Scaled), Some(Energy::Unscaled));
        let up = Some(NormalY::Up);
        let metallic = Some(Workflow::Metallic);
        let specular = Some(Workflow::Specular);
        let ((albedo, of_specular), roughness, normal_y, workflow, energy) = match self {
            Self::Deschaintre | Self::Deschaintre18 | Self::SurfaceNet => {
                (linear, Roughness::R, up, specular, scaled)
            }
            Self::Gao => ((Albedo::Gamma22, Albedo::Linear), Roughness::R, up, specular, unscaled),
            Self::MaterialGan => (gamma, Roughness::Gamma22, up, specular, scaled),
            Self::LookAhead => (gamma, Roughness::R, up, specular, scaled),
            Self::MatFusion => (gamma, Roughness::R, up, None, unscaled),
            Self::DiffMat => (gamma, Roughness::R, Some(NormalY::Down), metallic, None),
            Self::OpenSvbrdf => (linear, Roughness::Anisotropic, up, specular, unscaled),
            Self::Gltf => (srgb, Roughness::R, up, metallic, None),
            Self::MaterialPalette => (gamma, Roughness::R, up, specular, unscaled),
            Self::PolyHaven | Self::AmbientCg => (srgb, Roughness::R, None, metallic, None),
            Self::SubstanceSg => (srgb, Roughness::Gloss, None, specular, None),
        };
        ReadOptions {
            albedo: Some(albedo),
            specular: Some(of_specular),
            roughness: Some(roughness),
            normal_y,
            workflow,
            energy,
            ..ReadOptions::AUTO
        }
    }
}
