//! Reasons of assumptions, as values and as words.

use std::path::PathBuf;

use derive_more::Display;

use super::evidence::Evidence;
use super::evidence::StorageConvention;
use crate::read::options::{NormalY, Role};

/// The reason of an assumption.
#[derive(Clone, Debug, PartialEq, Display)]
#[non_exhaustive]
pub enum Reason {
    #[display("as specified")]
    Specified,
    #[display("as specified, but there is no metallic map")]
    NoMetallicMap,
    StorageConvention(StorageConvention),
    /// A convention that a measurement contradicts.
    #[display("{_0}, but {_1}: check it")]
    ContradictedBy(Box<Reason>, Box<Reason>),
    #[display("{file} is named so")]
    FileName {
        file: String,
    },
    #[display("{file} is named {}", if *y == NormalY::Up { "OpenGL" } else { "DirectX" })]
    NormalName {
        file: String,
        y: NormalY,
    },
    #[display("{} is named so; packings of this name differ", file.display())]
    PackingName {
        file: PathBuf,
    },
    #[display("the file declares {space}{}", if *is_known { "" } else { ", which is not known here" })]
    ColourSpace {
        space: String,
        is_known: bool,
    },
    /// Colours of 8 or 16 bits are display-encoded unless the evidence, weighed as log odds of linear, outweighs that.
    #[display("{}", evidence.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Weighed {
        log_odds: f64,
        evidence: Vec<Evidence>,
    },
    #[display("there are both a specular and a metallic map")]
    BothWorkflows,
    /// As the channels of a packed picture do.
    #[display(
        "the channels of {} differ although it is named after the {} map",
        file.display(), map.name()
    )]
    PackedChannels {
        map: Role,
        file: PathBuf,
    },
    #[display("{} looks like normals although it is named after the {} map", file.display(), map.name())]
    LooksLikeNormals {
        map: Role,
        file: PathBuf,
    },
    #[display("{file} has the name of the set, and no other file is its colour")]
    NameOfSet {
        file: String,
    },
    #[display("{} has an alpha that varies, as Unity stores smoothness, and no other file is the roughness", file.display())]
    SmoothnessInAlpha {
        file: PathBuf,
    },
    #[display("{} has no alpha, which holds smoothness", file.display())]
    OpaqueSmoothness {
        file: PathBuf,
    },
    // Measurements of pixels.
    #[display("nearly all of its pixels look like normals, and no other file is named as the normal map")]
    NormalPixels,
    /// Shares of the pixels of this tile and of the next best.
    #[display(
        "tile {number} looks like normals ({:.0}% of its pixels), the next best {:.0}%",
        100.0 * share, 100.0 * next
    )]
    NormalTile {
        number: usize,
        share: f64,
        next: f64,
    },
    /// The contradiction of a tile to the usual order.
    #[display("tile {number} {found}: it is no {} map, as in the usual order", map.name())]
    TileOf {
        number: usize,
        map: Role,
        found: &'static str,
    },
    #[display("no tile tells; it is the order of the preset")]
    PresetOrder,
    #[display("no tile looks like normals, and svbrdf-evaluation uses such names")]
    SvbrdfEvaluationName,
    #[display("no single tile looks like normals; this is the usual order")]
    UsualOrder,
    #[display("a picture of diffuse alone does not say it")]
    DiffuseAlone,
    #[display("the least component is {_0:.2}")]
    LeastComponent(f64),
    #[display("the map has two channels")]
    TwoChannels,
    #[display("red is 1 everywhere, alpha varies")]
    RedConstant,
    #[display(
        "{:.0}% of the texels have length 1 {}{}{}",
        100.0 * share, if *signed { "as stored" } else { "if read so" },
        if *share < 0.995 { ", the others are normalized" } else { "" },
        if *share < 0.6 { "; blue may hold another map, or they are no normals" } else { "" }
    )]
    UnitLength {
        signed: bool,
        share: f64,
    },
    #[display(
        "the map seems to be saved as colours, through the sRGB curve: {:.0}% of the texels have length 1 as they are, {:.0}% \
        without the curve; save it again as data",
        100.0 * share, 100.0 * without
    )]
    NormalsAsColours {
        share: f64,
        without: f64,
    },
    #[display("blue is {_0:.0} everywhere")]
    BlueConstant(f64),
    /// The curl correlation, where the map has slopes.
    #[display("{}", _0.map_or("the map has no slopes to tell from".to_owned(), curl))]
    Curl(Option<f64>),
    #[display("{}, as of maps with y down", curl(*_0))]
    CurlDown(f64),
    #[display("most maps point up; {}", curl(*_0))]
    MostMapsUp(f64),
    /// A document beside the normal map.
    #[display("{document} lists the map, and its format defines it")]
    ListedNormals {
        document: String,
    },
    #[display("the {} map has an alpha below 1, and EXR multiplies colours by it", map.name())]
    Premultiplied {
        map: Role,
    },
    #[display("the file declares primaries that enclose no white, and cannot be converted")]
    OtherPrimaries,
    /// Of a packed picture.
    #[display(
        "metallic is 1 everywhere, and programs also fill an unused channel so: where the surface is no metal, specify metallic=0"
    )]
    FilledMetallic,
    #[display(
        "the slopes of {} correlate by {:+.2} with x of the normals and by {:+.2} with y",
        file.display(), correlations[0], correlations[1]
    )]
    Heights {
        file: PathBuf,
        correlations: [f64; 2],
    },
    // The maps that are there.
    #[display("there is a metallic map: d = b (1 - m), s = f {}", match matfusion {
        false => "(1 - m) + b m",
        true => "+ b m as in MatFusion",
    })]
    MetallicMap {
        matfusion: bool,
    },
    #[display("there is a specular map")]
    SpecularMap,
    #[display("there is neither a specular nor a metallic map")]
    NeitherMap,
    #[display("there is no normal map; the surface is taken as flat")]
    NoNormalMap,
    #[display("there is no specular map; most dielectrics have it")]
    NoSpecularMap,
    #[display("{} is named so, and the principled model takes 0.04 at 0.5", file.display())]
    SpecularLevel {
        file: PathBuf,
    },
    #[display("the largest map has it; resampled bilinearly: {}", sizes(_0))]
    SmallerMaps(Vec<(Role, [usize; 2])>),
    // Values that were changed.
    #[display("no sample of the {} map takes more than {bits} of its 16 bits, which stand for [0, 1]", map.name())]
    FewBits {
        map: Role,
        bits: u32,
    },
    #[display("{count} samples of the {} map are NaN or infinite", map.name())]
    NotFinite {
        map: Role,
        count: usize,
    },
    #[display("{count} samples of the {} map lie outside, between {low} and {high}", map.name())]
    OutsideUnit {
        map: Role,
        count: usize,
        low: f64,
        high: f64,
    },
    #[display("{count} texels have no direction: they are black, gray or not finite")]
    NoDirection {
        count: usize,
    },
    #[display("{count} samples of diffuse and specular would reflect more light than arrives")]
    MoreThanAllLight {
        count: usize,
    },
}

fn curl(correlation: f64) -> String {
    format!("the curl correlation is {correlation:+.2}")
}

fn sizes(maps: &[(Role, [usize; 2])]) -> String {
    let one = |(map, [w, h]): &(Role, [usize; 2])| format!("{} from {w} x {h}", map.name());
    maps.iter().map(one).collect::<Vec<_>>().join(", ")
}

impl Reason {
    /// Whether a specification, a name, or the user states it: not only a measurement of pixels, and not a custom that a
    /// file need not follow.
    pub fn is_stated(&self) -> bool {
        use StorageConvention as C;
        match self {
            Self::Specified | Self::NoMetallicMap | Self::FileName { .. } | Self::NormalName { .. } => true,
            Self::MetallicMap { .. } | Self::SpecularMap | Self::NeitherMap => true,
            Self::ColourSpace { is_known, .. } => *is_known,
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

    /// Whether it is no more than a custom of some codes, that pixels may outweigh.
    pub(crate) fn is_custom_of_codes(&self) -> bool {
        use StorageConvention as C;
        let Self::StorageConvention(convention) = self else { return false };
        matches!(
            convention,
            C::DeschaintreOrder
                | C::MaterialGanOrder
                | C::MatFusionOrder
                | C::MaterialGanNames
                | C::NumberedResults
                | C::DeschaintreNames
                | C::SurfaceNetFolder
        )
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
