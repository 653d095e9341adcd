//! Reasons of assumptions, as values. `Display` makes the words.

use std::path::PathBuf;

use super::evidence::Evidence;
use super::note::SpecifiedBy;
use super::storage_convention::StorageConvention;
use crate::read::options::{Albedo, NormalY, Role};

/// The reason of an assumption.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    Specified(SpecifiedBy),
    /// Metallic was specified, but there is no metallic map.
    NoMetallicMap(SpecifiedBy),
    StorageConvention(StorageConvention),
    /// A convention that a measurement contradicts.
    ContradictedBy(Box<Reason>, Box<Reason>),
    /// The file name states it.
    FileName {
        file: String,
    },
    /// The file name states the direction of y.
    NormalName {
        file: String,
        y: NormalY,
    },
    /// The file name states how channels are packed; packings of this name differ.
    PackingName {
        file: PathBuf,
    },
    /// The file declares this colour space.
    ColourSpace {
        space: String,
        known: SpaceKnown,
    },
    /// Colours of 8 or 16 bits are display-encoded unless the evidence, weighed as log odds of linear, outweighs that.
    Weighed {
        log_odds: f64,
        evidence: Vec<Evidence>,
    },
    /// There are a metallic and a specular map, and no name tells which workflow is meant.
    BothWorkflows,
    /// The channels of a picture that is named after one gray map differ like the channels of a packed picture.
    PackedChannels {
        map: Role,
        file: PathBuf,
    },
    /// A picture looks like normals, but is named after another map.
    LooksLikeNormals {
        map: Role,
        file: PathBuf,
    },
    /// Only its name, which is the name of the set, suggests that a picture is the colour.
    NameOfSet {
        file: String,
    },
    /// The picture has no alpha, which should hold smoothness.
    OpaqueSmoothness {
        file: PathBuf,
    },
    // Measurements of pixels.
    SpecularMedian {
        median: f64,
        suggests: Option<Albedo>,
    },
    /// Nearly all pixels look like normals, though the name does not name a map.
    NormalPixels,
    /// One tile looks like normals; shares of its pixels and of the next best tile's.
    NormalTile {
        number: usize,
        share: f64,
        next: f64,
    },
    /// No tile tells the order, which is that of the preset.
    PresetOrder,
    SvbrdfEvaluationName,
    UsualOrder,
    DiffuseAlone,
    LeastComponent(f64),
    TwoChannels,
    RedConstant,
    /// Share of the texels that have unit length if read so.
    UnitLength {
        signed: bool,
        share: f64,
    },
    BlueConstant(f64),
    /// The curl correlation, where the map has slopes.
    Curl(Option<f64>),
    CurlDown(f64),
    MostMapsUp(f64),
    /// A document beside the normal map lists it, and its format defines y.
    ListedNormals {
        document: String,
    },
    /// Correlations of the slopes of heights with x and with y of the normals.
    Heights {
        file: PathBuf,
        correlations: [f64; 2],
    },
    // The maps that are there.
    MetallicMap {
        matfusion: bool,
    },
    SpecularMap,
    NeitherMap,
    NoNormalMap,
    NoSpecularMap,
    SpecularLevel {
        file: PathBuf,
    },
    SmallerMaps(Vec<(Role, [usize; 2])>),
    // Values that were changed.
    NotFinite {
        map: Role,
        count: usize,
    },
    OutsideUnit {
        map: Role,
        count: usize,
        low: f64,
        high: f64,
    },
    NoDirection {
        count: usize,
    },
    MoreThanAllLight {
        count: usize,
    },
    /// Roughness from the exponent of Blinn and Phong.
    Exponent(f32),
    /// A factor of an .mtl beside a picture.
    MtlFactor {
        key: String,
    },
}

/// How well a colour space is known here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpaceKnown {
    Exactly,
    Unknown,
}

impl Reason {
    /// Whether a specification, a name, or the user states it: not only a measurement of pixels, and not a custom that a
    /// file need not follow.
    pub fn is_stated(&self) -> bool {
        use StorageConvention as C;
        match self {
            Self::Specified(_) | Self::NoMetallicMap(_) | Self::FileName { .. } | Self::NormalName { .. } => {
                true
            }
            Self::MetallicMap { .. } | Self::SpecularMap | Self::NeitherMap => true,
            Self::ColourSpace { known, .. } => *known == SpaceKnown::Exactly,
            // A flat map points nowhere.
            Self::Curl(None) => true,
            // A picture that is named after normals holds them in the usual way where their lengths confirm it.
            Self::UnitLength { signed, share } => *signed || *share > 0.9,
            Self::LeastComponent(_) | Self::TwoChannels => true,
            Self::Weighed { log_odds, evidence } => {
                *log_odds < 0.0 && evidence.iter().all(Evidence::is_custom)
            }
            Self::StorageConvention(convention) => matches!(
                convention,
                C::Native
                    | C::NativeText
                    | C::Gltf
                    | C::AsoboNormals
                    | C::MaterialXNormals
                    | C::MaterialXSurface
                    | C::ListedTextures
                    | C::LayerNames
                    | C::GammadNames
                    | C::RoughnessName
                    | C::BuiltIn
                    | C::Floats
                    | C::SeparateColours
                    | C::MtlColours
                    | C::SpecularGlossiness
            ),
            _ => false,
        }
    }

    /// Who specified it, where someone did.
    pub(crate) fn specified_by(&mut self) -> Option<&mut SpecifiedBy> {
        match self {
            Self::Specified(by) | Self::NoMetallicMap(by) => Some(by),
            _ => None,
        }
    }
}

impl From<StorageConvention> for Reason {
    fn from(convention: StorageConvention) -> Self {
        Self::StorageConvention(convention)
    }
}

impl serde::Serialize for Reason {
    /// The words.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
