//! Options of reading: how stored values are to be read. Options that are not specified are inferred, and reported.

mod choices;
mod role;
mod tiles;
pub(crate) mod transfer;
mod words;

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::changes::Remedy;
use crate::error::Error;

pub use choices::{
    Albedo, Energy, NonFinite, NormalEncoding, NormalY, Preset, Reflectance, Roughness, Workflow,
};
pub use role::Role;
pub use tiles::Order;
pub use tiles::TileGrid;

/// The options with what is the same of each.
macro_rules! options {
    ($($(#[$about:meta])* $field:ident: $kind:ty,)+) => {
        /// How the files of a material are to be read. `None`: inferred from the files and reported; where the files do not
        /// tell, the default.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[serde(default, rename_all = "kebab-case")]
        pub struct ReadOptions {
            $($(#[$about])* pub $field: Option<$kind>,)+
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
        }
    };
}

options! {
    /// The conventions of a source of materials, for every option that is not specified.
    preset: Preset,
    /// Colour space of diffuse, base colour and, unless `specular` is specified, specular.
    albedo: Albedo,
    /// Colour space of specular where it is another one.
    #[serde(rename = "specular-albedo")]
    specular: Albedo,
    normal_y: NormalY,
    normal_encoding: NormalEncoding,
    roughness: Roughness,
    workflow: Workflow,
    /// Reflectance of dielectrics at normal incidence, where no map holds it.
    #[serde(rename = "dielectric-f0")]
    dielectric: Reflectance,
    energy: Energy,
    /// Order of the tiles of a packed image.
    order: Order,
    /// How a packed image is divided; needed where its tiles are not square.
    grid: TileGrid,
    /// Which of several materials, or rows of a packed image, from 0.
    exemplar: usize,
    /// Whether row 0 is the lowest: then the material is mirrored, normals with it.
    flip_v: bool,
    non_finite: NonFinite,
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
            Self::Gltf | Self::Chord | Self::StableMaterials | Self::MatE => {
                (srgb, Roughness::R, up, metallic, None)
            }
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

impl ReadOptions {
    /// These options, and those of their preset where they specify nothing; except y of normals, which names tell better.
    pub(crate) fn with_preset(self) -> Self {
        let Some(preset) = self.preset else { return self };
        let usual = preset.options();
        Self {
            albedo: self.albedo.or(usual.albedo),
            specular: self.specular.or(self.albedo).or(usual.specular),
            normal_encoding: self.normal_encoding.or(usual.normal_encoding),
            roughness: self.roughness.or(usual.roughness),
            workflow: self.workflow.or(usual.workflow),
            energy: self.energy.or(usual.energy),
            ..self
        }
    }

    /// These options with the one that corrects the reading.
    ///
    /// # Errors
    /// [`UnknownName`](svbrdf_core::error::Error::UnknownName) for a value that the option does not have.
    pub fn with_remedy(self, remedy: Remedy) -> Result<Self, Error> {
        Ok(remedy.to_string().parse::<Self>()?.over(self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_values_of_remedies_are_those_of_the_options() {
        let both = ReadOptions {
            albedo: Some(Albedo::Linear),
            specular: Some(Albedo::Gamma22),
            ..ReadOptions::AUTO
        };
        assert_eq!(ReadOptions::AUTO.with_remedy(Remedy::Albedo("linear", Some("gamma2.2"))).unwrap(), both);
        let energies = ["scaled", "unscaled"].map(Remedy::Energy);
        let roughness = ["alpha", "gloss", "r"].map(Remedy::Roughness);
        let others = [Remedy::NormalY("up"), Remedy::NormalY("down"), Remedy::SpecularAlbedo("srgb")];
        for remedy in energies.into_iter().chain(roughness).chain(others) {
            ReadOptions::AUTO.with_remedy(remedy).unwrap();
        }
        assert!(ReadOptions::AUTO.with_remedy(Remedy::Energy("none")).is_err());
    }
}
