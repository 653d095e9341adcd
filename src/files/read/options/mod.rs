//! Options of reading: how stored values are to be read. Options that are not specified are inferred, and reported. In words they
//! are `KEY=VALUE`, with the keys and values of sidecar files.

mod choices;
mod role;
mod tiles;
pub(crate) mod transfer;

use std::path::Path;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

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

    /// The keys, in alphabetical order.
    pub fn keys() -> Vec<String> {
        Self::AUTO.object().into_iter().map(|(key, _)| key).collect()
    }

    /// `KEY=VALUE` for every value of the options that have few.
    pub fn examples() -> Vec<String> {
        fn of<T: ToString>(key: &str, all: impl IntoIterator<Item = T>) -> Vec<String> {
            all.into_iter().map(|value| format!("{key}={}", value.to_string())).collect()
        }
        [
            of("albedo", Albedo::ALL),
            of("specular-albedo", Albedo::ALL),
            of("normal-y", NormalY::ALL),
            of("normal-encoding", NormalEncoding::ALL),
            of("roughness", Roughness::ALL),
            of("workflow", Workflow::ALL),
            of("energy", Energy::ALL),
            of("order", Order::ALL),
            of("flip-v", [true, false]),
            of("non-finite", NonFinite::ALL),
            of("preset", Preset::ALL),
        ]
        .concat()
    }

    /// The specified options as `KEY=VALUE`, in the order of [`ReadOptions::keys`], with commas between them.
    pub fn words(&self) -> String {
        let words = self.object().into_iter().filter_map(|(key, value)| match value {
            Value::Null => None,
            Value::String(text) => Some(format!("{key}={text}")),
            other => Some(format!("{key}={other}")),
        });
        words.collect::<Vec<_>>().join(",")
    }

    /// These options and `others`.
    ///
    /// # Errors
    /// [`Error::SpecifiedTwice`] where both specify an option.
    pub fn and(self, others: Self) -> Result<Self, Error> {
        let mut all = self.object();
        for (key, value) in others.object().into_iter().filter(|(_, value)| !value.is_null()) {
            if all.get(&key).is_some_and(|value| !value.is_null()) {
                return Err(Error::SpecifiedTwice { option: key });
            }
            all.insert(key, value);
        }
        serde_json::from_value(all.into()).map_err(|error| Error::Internal(error.to_string()))
    }

    /// Every option by its key; null where it is not specified.
    pub(crate) fn object(&self) -> Map<String, Value> {
        match serde_json::to_value(self) {
            Ok(Value::Object(all)) => all,
            _ => Map::new(),
        }
    }
}

impl FromStr for ReadOptions {
    type Err = Error;

    /// Options as [`ReadOptions::words`] writes them: `albedo=srgb,normal-y=down`.
    fn from_str(text: &str) -> Result<Self, Error> {
        text.split(',').try_fold(Self::AUTO, |options, word| {
            let Some((key, value)) = word.split_once('=') else {
                let (found, known) = (word.to_owned(), "KEY=VALUE, such as albedo=srgb".to_owned());
                return Err(CoreError::unknown_name("option of reading", found, known).into());
            };
            options.and(Self::of_word(key.trim(), value.trim())?)
        })
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Every option with all of its values, or some where there are many.
    fn values() -> Vec<(&'static str, Vec<String>)> {
        fn of<T: ToString>(all: impl IntoIterator<Item = T>) -> Vec<String> {
            all.into_iter().map(|value| value.to_string()).collect()
        }
        vec![
            ("preset", of(Preset::ALL)),
            ("albedo", of(Albedo::ALL)),
            ("specular-albedo", of(Albedo::ALL)),
            ("normal-y", of(NormalY::ALL)),
            ("normal-encoding", of(NormalEncoding::ALL)),
            ("roughness", of(Roughness::ALL)),
            ("workflow", of(Workflow::ALL)),
            ("dielectric-f0", of(["0.0", "0.04", "0.3333333333333333", "1.0"])),
            ("energy", of(Energy::ALL)),
            ("order", of(Order::ALL)),
            ("grid", of(["1x1", "4x1", "64x64"])),
            ("exemplar", of([0, 7])),
            ("flip-v", of([true, false])),
            ("non-finite", of(NonFinite::ALL)),
        ]
    }

    #[test]
    fn options_in_words_are_read_as_they_were() {
        let values = values();
        let mut keys: Vec<_> = values.iter().map(|(key, _)| (*key).to_owned()).collect();
        keys.sort();
        assert_eq!(keys, ReadOptions::keys(), "every key is tested");
        for seed in 0..2000_usize {
            // Each option is left out or has one of its values, all in combinations that do not repeat early.
            let pick = |(place, (key, all)): (usize, &(&str, Vec<String>))| {
                let choice = (seed * (2 * place + 3) + seed / (place + 1)) % (all.len() + 1);
                all.get(choice).map(|value| format!("{key}={value}"))
            };
            let mut words: Vec<String> = values.iter().enumerate().filter_map(pick).collect();
            words.sort();
            let text = words.join(",");
            if !text.is_empty() {
                assert_eq!(text.parse::<ReadOptions>().unwrap().words(), text);
            }
        }
    }
}
