//! Why something was assumed, as values. `Display` makes the words.

use std::fmt;
use std::path::PathBuf;

use super::choices::{Albedo, NormalY};
use super::note::SpecifiedBy;
use super::role::Role;

/// A convention that files follow, by their format, names or layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StorageConvention {
    /// This program wrote the file.
    Native,
    /// This program wrote the file, with its encoding in a text chunk.
    NativeText,
    Floats,
    SeparateColours,
    MtlColours,
    DeschaintreOrder,
    MaterialGanOrder,
    MatFusionOrder,
    SvbrdfEvaluationOrder,
    PackedNormals,
    DiffMatNames,
    MaterialGanNames,
    NumberedResults,
    GammadNames,
    DeschaintreNames,
    SurfaceNetFolder,
    Gltf,
    MaterialXNormals,
    /// The file lists its textures.
    ListedTextures,
    LayerNames,
    RoughnessName,
    NvdiffrecPacking,
    /// The built-in materials.
    BuiltIn,
}

impl fmt::Display for StorageConvention {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Native => "svbrdf wrote the file",
            Self::NativeText => "svbrdf wrote the file, with its encoding",
            Self::Floats => "floats are linear",
            Self::SeparateColours => "colours in separate files are sRGB by convention",
            Self::MtlColours => "colours of an .mtl are sRGB by convention",
            Self::DeschaintreOrder => "Deschaintre et al. store this order in this way",
            Self::MaterialGanOrder => "MaterialGAN and its successors store this order in this way",
            Self::MatFusionOrder => "MatFusion stores this order in this way",
            Self::SvbrdfEvaluationOrder => "svbrdf-evaluation appears to store this order in this way",
            Self::PackedNormals => "all known sources of packed maps do this",
            Self::DiffMatNames => "DiffMat writes these names and depths, with y down by default",
            Self::MaterialGanNames => "MaterialGAN and its successors use these names and this encoding",
            Self::NumberedResults => "the results of Deschaintre et al. 2020 are numbered in this way",
            Self::GammadNames => "the names contain gammad",
            Self::DeschaintreNames => "the networks of Deschaintre et al. write these names, linear",
            Self::SurfaceNetFolder => "the data sets of SurfaceNet look like this, and are linear",
            Self::Gltf => "the specification of glTF 2.0 defines it",
            Self::MaterialXNormals => "MaterialX defines normals in this way",
            Self::ListedTextures => "the file lists its textures",
            Self::LayerNames => "the names of the layers name the maps",
            Self::RoughnessName => "the map is named roughness",
            Self::NvdiffrecPacking => "nvdiffrec writes it beside map_Kd",
            Self::BuiltIn => "the built-in materials are stored in this way",
        })
    }
}

/// Why something was assumed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    Specified(SpecifiedBy),
    /// Metallic was specified, but there is no metallic map.
    NoMetallicMap(SpecifiedBy),
    StorageConvention(StorageConvention),
    /// A convention that a measurement contradicts.
    ContradictedBy(Box<Reason>, Box<Reason>),
    /// The file name says so.
    FileName {
        file: String,
    },
    /// The file name says where y points.
    NormalName {
        file: String,
        y: NormalY,
    },
    /// The file name says how channels are packed; packings of this name differ.
    PackingName {
        file: PathBuf,
    },
    /// The file declares this colour space.
    ColourSpace {
        space: String,
        known: Known,
    },
    // What pixels say.
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
    // Which maps there are.
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
pub enum Known {
    Exactly,
    /// Gamma 2.2 is the nearest encoding that is known.
    Nearly,
    Unknown,
}

impl Reason {
    /// Who specified it, where someone did.
    pub(crate) fn specified_by(&mut self) -> Option<&mut SpecifiedBy> {
        match self {
            Self::Specified(by) | Self::NoMetallicMap(by) => Some(by),
            _ => None,
        }
    }

    fn of_pixels(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = |share: &f64| 100.0 * share;
        match self {
            Self::SpecularMedian { median, suggests } => {
                write!(f, "the median of specular is {median:.3}, ")?;
                match suggests {
                    Some(Albedo::Linear) => f.write_str("near a linear 0.04"),
                    Some(_) => f.write_str("near an encoded 0.04"),
                    None => f.write_str("which is inconclusive; colours are sRGB by convention"),
                }
            }
            Self::NormalPixels => {
                f.write_str("nearly all of its pixels look like normals, though its name does not name a map")
            }
            Self::NormalTile { number, share, next } => write!(
                f,
                "tile {number} looks like normals ({:.0} % of its pixels), the next best {:.0} %",
                percent(share),
                percent(next)
            ),
            Self::PresetOrder => f.write_str("no tile tells; it is the order of the preset"),
            Self::SvbrdfEvaluationName => {
                f.write_str("no tile looks like normals, and svbrdf-evaluation uses such names")
            }
            Self::UsualOrder => f.write_str("no single tile looks like normals; this is the usual order"),
            Self::DiffuseAlone => f.write_str("a picture of diffuse alone does not say it"),
            Self::LeastComponent(least) => write!(f, "the least component is {least:.2}"),
            Self::TwoChannels => f.write_str("the map has two channels"),
            Self::RedConstant => f.write_str("red is 1 everywhere, alpha varies"),
            Self::UnitLength { signed: true, share } => {
                write!(f, "{:.0} % of the texels have length 1 as stored", percent(share))
            }
            Self::UnitLength { signed: false, share } => {
                write!(f, "{:.0} % of the texels have length 1 if read so", percent(share))
            }
            Self::BlueConstant(value) => write!(f, "blue is {value:.0} everywhere"),
            Self::Curl(None) => f.write_str("the map has no slopes to tell from"),
            Self::Curl(Some(curl)) => write!(f, "the curl correlation is {curl:+.2}"),
            Self::CurlDown(curl) => {
                write!(f, "the curl correlation is {curl:+.2}, which no surface with y up has")
            }
            Self::MostMapsUp(curl) => {
                write!(f, "most maps point up; the curl correlation is {curl:+.2}")
            }
            _ => self.of_values(f),
        }
    }

    fn of_values(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { map, count } => {
                write!(f, "{count} samples of the {} map are NaN or infinite", map.name())
            }
            Self::OutsideUnit { map, count, low, high } => {
                write!(f, "{count} samples of the {} map lie outside, between {low} and {high}", map.name())
            }
            Self::NoDirection { count } => {
                write!(f, "{count} texels have a vector without length, or one that is not finite")
            }
            Self::MoreThanAllLight { count } => {
                write!(f, "{count} samples of diffuse and specular would reflect more light than arrives")
            }
            Self::Exponent(exponent) => write!(
                f,
                "there is neither map_Pr nor Pr; the highlight of Ns {exponent} is as wide: r = (2 / (Ns + 2))^(1/4)"
            ),
            Self::MtlFactor { key } => {
                write!(f, "{key} is a factor by the definition of MTL; some programs use the picture alone")
            }
            _ => Ok(()),
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Specified(by) => by.fmt(f),
            Self::NoMetallicMap(by) => write!(f, "{by}, but there is no metallic map"),
            Self::StorageConvention(convention) => convention.fmt(f),
            Self::ContradictedBy(reason, measured) => write!(f, "{reason}, but {measured}: check it"),
            Self::FileName { file } => write!(f, "{file} is named so"),
            Self::NormalName { file, y } => {
                write!(f, "{file} is named {}", if *y == NormalY::Up { "OpenGL" } else { "DirectX" })
            }
            Self::PackingName { file } => {
                write!(f, "{} is named so; packings of this name differ", file.display())
            }
            Self::ColourSpace { space, known } => {
                write!(f, "the file declares {space}")?;
                f.write_str(match known {
                    Known::Exactly => "",
                    Known::Nearly => "; 2.2 is the nearest that is known",
                    Known::Unknown => ", which is not known here",
                })
            }
            Self::MetallicMap { matfusion: false } => {
                f.write_str("there is a metallic map: d = b (1 - m), s = f (1 - m) + b m")
            }
            Self::MetallicMap { matfusion: true } => {
                f.write_str("there is a metallic map: d = b (1 - m), s = f + b m as in MatFusion")
            }
            Self::SpecularMap => f.write_str("there is a specular map"),
            Self::NeitherMap => f.write_str("there is neither a specular nor a metallic map"),
            Self::NoNormalMap => f.write_str("there is no normal map; the surface is taken as flat"),
            Self::NoSpecularMap => f.write_str("there is no specular map; most dielectrics have it"),
            Self::SpecularLevel { file } => {
                write!(f, "{} is named so, and the principled model takes 0.04 at 0.5", file.display())
            }
            Self::SmallerMaps(maps) => {
                f.write_str("the largest map has it; resampled bilinearly: ")?;
                let one = |(map, [w, h]): &(Role, [usize; 2])| format!("{} from {w} x {h}", map.name());
                f.write_str(&maps.iter().map(one).collect::<Vec<_>>().join(", "))
            }
            _ => self.of_pixels(f),
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
