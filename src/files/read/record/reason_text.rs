//! The words for reasons.

use std::fmt;

use super::reason::{Reason, SpaceKnown};
use crate::read::options::{Albedo, NormalY, Role};

impl Reason {
    /// Reasons in which maps there are, and how they are called.
    fn of_maps(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
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
            Self::NormalPixels => f.write_str(
                "nearly all of its pixels look like normals, and no other file is named as the normal map",
            ),
            Self::NormalTile { number, share, next } => write!(
                f,
                "tile {number} looks like normals ({:.0}% of its pixels), the next best {:.0}%",
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
                write!(f, "{:.0}% of the texels have length 1 as stored", percent(share))
            }
            Self::UnitLength { signed: false, share } => {
                write!(f, "{:.0}% of the texels have length 1 if read so", percent(share))
            }
            Self::BlueConstant(value) => write!(f, "blue is {value:.0} everywhere"),
            Self::Curl(None) => f.write_str("the map has no slopes to tell from"),
            Self::Curl(Some(curl)) => write!(f, "the curl correlation is {curl:+.2}"),
            Self::CurlDown(curl) => {
                write!(f, "the curl correlation is {curl:+.2}, as of maps with y down")
            }
            Self::MostMapsUp(curl) => {
                write!(f, "most maps point up; the curl correlation is {curl:+.2}")
            }
            Self::ListedNormals { document } => {
                write!(f, "{document} lists the map, and its format defines it")
            }
            Self::Heights { file, correlations: [x, y] } => write!(
                f,
                "the slopes of {} correlate by {x:+.2} with x of the normals and by {y:+.2} with y",
                file.display()
            ),
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
            // The functions before have their words; the compiler asks here for those of a new reason.
            Self::Specified(..)
            | Self::NoMetallicMap(..)
            | Self::StorageConvention(..)
            | Self::ContradictedBy(..)
            | Self::FileName { .. }
            | Self::NormalName { .. }
            | Self::PackingName { .. }
            | Self::ColourSpace { .. }
            | Self::Weighed { .. }
            | Self::BothWorkflows
            | Self::PackedChannels { .. }
            | Self::LooksLikeNormals { .. }
            | Self::NameOfSet { .. }
            | Self::OpaqueSmoothness { .. }
            | Self::SpecularMedian { .. }
            | Self::NormalPixels
            | Self::NormalTile { .. }
            | Self::PresetOrder
            | Self::SvbrdfEvaluationName
            | Self::UsualOrder
            | Self::DiffuseAlone
            | Self::LeastComponent(..)
            | Self::TwoChannels
            | Self::RedConstant
            | Self::UnitLength { .. }
            | Self::BlueConstant(..)
            | Self::Curl(..)
            | Self::CurlDown(..)
            | Self::MostMapsUp(..)
            | Self::Heights { .. }
            | Self::ListedNormals { .. }
            | Self::MetallicMap { .. }
            | Self::SpecularMap
            | Self::NeitherMap
            | Self::NoNormalMap
            | Self::NoSpecularMap
            | Self::SpecularLevel { .. }
            | Self::SmallerMaps(..) => Ok(()),
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
                    SpaceKnown::Exactly => "",
                    SpaceKnown::Unknown => ", which is not known here",
                })
            }
            Self::Weighed { evidence, .. } => {
                let all: Vec<_> = evidence.iter().map(ToString::to_string).collect();
                f.write_str(&all.join("; "))
            }
            Self::BothWorkflows => f.write_str("there are both a specular and a metallic map"),
            Self::PackedChannels { map, file } => write!(
                f,
                "the channels of {} differ although it is named after the {} map",
                file.display(),
                map.name()
            ),
            Self::LooksLikeNormals { map, file } => {
                write!(
                    f,
                    "{} looks like normals although it is named after the {} map",
                    file.display(),
                    map.name()
                )
            }
            Self::NameOfSet { file } => {
                write!(f, "{file} has the name of the set, and no other file is its colour")
            }
            Self::OpaqueSmoothness { file } => {
                write!(f, "{} has no alpha, which holds smoothness", file.display())
            }
            _ => self.of_maps(f),
        }
    }
}
