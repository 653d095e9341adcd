//! A protocol, its parts and how it is written.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use sha2::{Digest as _, Sha256};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::{FileScenes, LossOptions};
use svbrdf_core::material::Mask;
use svbrdf_core::math::real::Real;
use svbrdf_core::model::named_scenes::NamedScenes;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::disk::open::{NamedFile, hexadecimal};
use svbrdf_files::read::{Read, ReadOptions, read_mask};

use crate::error::Error;
use crate::metrics::MetricSelection;
use crate::registration::Registration;

/// A protocol.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Protocol {
    /// Of the format.
    pub version: u32,
    pub name: String,
    /// What it computes, in a sentence.
    pub about: String,
    pub source: ProtocolSource,
    #[serde(default)]
    pub ground_truths: Side,
    #[serde(default)]
    pub predictions: Side,
    /// How predictions of another size may lie on their ground truths; which of them, the maps decide. None: any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub registration: Vec<Registration>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mask: Option<MaskSource>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scenes: Option<Scenes>,
    /// The convention of the loss and of renderings, by its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub convention: Option<String>,
    /// The rows of its table; none: the loss alone.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub metrics: Vec<Row>,
    /// The file that it was read from.
    #[serde(skip)]
    pub file: Option<PathBuf>,
}

/// Where a protocol is from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProtocolSource {
    pub paper: String,
    #[serde(default)]
    pub code: String,
    #[serde(default)]
    pub commit: String,
    /// The functions of the code that it follows.
    #[serde(default)]
    pub follows: String,
    /// What of it is not here, or is otherwise.
    #[serde(default)]
    pub differs: String,
}

/// How the files of a side are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Side {
    /// As on the command line: `albedo=linear,roughness=r`.
    #[serde(default, with = "words")]
    pub read: ReadOptions,
    /// Roughness is a factor times what is read, and an offset.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roughness: Option<[f64; 2]>,
}

/// Of a ground truth without a mask in alpha.
const NO_ALPHA: &str = "no alpha of the ground truth is 0 or 1 nearly everywhere, and 1 somewhere";

/// Which texels are compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MaskSource {
    /// The texels that are opaque in the alpha of the ground truth.
    Alpha,
    /// All, of which the others are black in both.
    AlphaElseBlack,
    /// The texels that are white in a picture, or opaque in its alpha; `{}` in its path stands for the name of the material.
    File(PathBuf),
}

impl MaskSource {
    /// The mask of this name or path, as sessions have it.
    pub fn named(path: &Path) -> Self {
        match path.to_str() {
            Some("alpha") => Self::Alpha,
            Some("alpha-else-black") => Self::AlphaElseBlack,
            _ => Self::File(path.to_owned()),
        }
    }

    /// The picture of this material, where it is one.
    fn file(&self, material: &str) -> Option<NamedFile> {
        let Self::File(path) = self else { return None };
        Some(NamedFile::by_user(path.to_string_lossy().replace("{}", material)))
    }

    /// The digest of the picture of this material.
    pub(crate) fn digest(&self, material: &str) -> Option<String> {
        let bytes = self.file(material)?.bytes().ok()?;
        Some(hexadecimal(Sha256::new().chain_update(bytes)))
    }

    /// The mask of the ground truth `material` that was read.
    ///
    /// # Errors
    /// [`Error::NoMask`]; where the picture cannot be read.
    pub fn of<T: Real>(&self, material: &str, read: &Read<T>) -> Result<Mask, Error> {
        let (found, problem) = match self.file(material) {
            Some(file) => {
                (read_mask(&file, &read.options)?, format!("{} keeps no texel", file.path().display()))
            }
            None => (read.mask.clone(), NO_ALPHA.to_owned()),
        };
        let mask = found.ok_or(Error::NoMask { problem })?;
        let [size, expected] = [mask.size(), read.material.size()];
        if size == expected {
            return Ok(mask);
        }
        let [[w, h], [width, height]] = [size, expected];
        let problem = format!("it has {w} x {h} texels, and the ground truth {width} x {height}");
        Err(Error::NoMask { problem })
    }
}

/// As it is typed: `alpha`, `alpha-else-black`, or the path of a picture.
impl fmt::Display for MaskSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Alpha => f.write_str("alpha"),
            Self::AlphaElseBlack => f.write_str("alpha-else-black"),
            Self::File(path) => write!(f, "{}", path.display()),
        }
    }
}

impl FromStr for MaskSource {
    type Err = CoreError;

    fn from_str(text: &str) -> Result<Self, CoreError> {
        match Self::named(Path::new(text)) {
            Self::File(_) if !text.contains(['.', '/', '\\']) => {
                let known = "alpha, or a picture such as mask.png or masks/{}.png";
                Err(CoreError::unknown_name("mask", text, known))
            }
            found => Ok(found),
        }
    }
}

impl Serialize for MaskSource {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for MaskSource {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

/// The scenes of the loss and of renderings.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scenes {
    #[serde(default)]
    pub near: Option<usize>,
    #[serde(default)]
    pub distant: Option<usize>,
    /// A named set, in place of numbers.
    #[serde(default)]
    pub lights: Option<String>,
}

/// A row of the table of a protocol.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The name of a metric, which has its space in it.
    pub metric: String,
    /// What the source calls it.
    pub label: String,
    #[serde(default)]
    pub over_materials: Aggregate,
}

/// What is made of the values of the materials.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Aggregate {
    #[default]
    Mean,
    Median,
    /// From the mean square error of all materials, for RMSE and PSNR.
    Pooled,
}

impl Protocol {
    /// What a command line has of it: its name, or the path of its file.
    pub fn argument(&self) -> String {
        self.file.as_ref().map_or_else(|| self.name.clone(), |file| file.display().to_string())
    }

    /// Its scenes, where it has some, in place of those of `typed` options, of the same seed and texels.
    ///
    /// # Errors
    /// [`CoreError::UnknownName`] for lights that have no name.
    pub fn options(&self, typed: &LossOptions) -> Result<LossOptions, Error> {
        let Some(Scenes { near, distant, lights }) = &self.scenes else { return Ok(typed.clone()) };
        let named = |name: &String| {
            let scenes = NamedScenes::named(name, NamedScenes::FOV_DEGREES)?.scenes()?;
            Ok::<_, CoreError>(FileScenes { name: name.clone(), path: PathBuf::new(), scenes })
        };
        let file = lights.as_ref().map(named).transpose()?;
        let LossOptions { seed, texels, .. } = *typed;
        Ok(LossOptions { near: *near, distant: *distant, file, seed, texels, ..LossOptions::default() })
    }

    /// Its convention, or the default.
    ///
    /// # Errors
    /// [`CoreError::UnknownName`].
    pub fn chosen_convention(&self) -> Result<ChosenConvention, Error> {
        Ok(self.convention.as_deref().map(ChosenConvention::read).transpose()?.unwrap_or_default())
    }

    /// The metrics of its rows.
    pub fn selection(&self) -> MetricSelection {
        MetricSelection::of_names(self.metrics.iter().map(|row| row.metric.clone()).collect())
    }
}

/// The name, and the source.
impl fmt::Display for Protocol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ProtocolSource { paper, code, commit, .. } = &self.source;
        write!(f, "{} ({paper}", self.name)?;
        if !code.is_empty() {
            write!(f, "; {code}")?;
        }
        if !commit.is_empty() {
            write!(f, "@{commit}")?;
        }
        f.write_str(")")
    }
}

impl Row {
    /// The metric, or what it is called over all materials together.
    pub fn summary(&self) -> String {
        match (self.over_materials, self.metric.split_once('_')) {
            (Aggregate::Pooled, Some((measure, of))) => format!("{measure}_pooled_{of}"),
            _ => self.metric.clone(),
        }
    }
}

/// By its name, for settings.
pub(crate) fn by_name<S: Serializer>(protocol: &Option<Protocol>, serializer: S) -> Result<S::Ok, S::Error> {
    protocol.as_ref().map(ToString::to_string).serialize(serializer)
}

/// Options of reading as words.
mod words {
    use serde::{Deserialize as _, Deserializer, Serializer, de::Error as _};
    use svbrdf_files::read::ReadOptions;

    pub(super) fn serialize<S: Serializer>(options: &ReadOptions, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&options.words())
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<ReadOptions, D::Error> {
        let text = String::deserialize(deserializer)?;
        if text.is_empty() { Ok(ReadOptions::AUTO) } else { text.parse().map_err(D::Error::custom) }
    }
}
