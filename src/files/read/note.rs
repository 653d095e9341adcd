//! What reading a material noticed, as values. `Display` makes the sentence.

use std::fmt;
use std::path::PathBuf;

use super::choices::{Albedo, Workflow};
use super::role::Role;

/// Who specified an option or a map.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SpecifiedBy {
    /// The caller of this reading.
    Caller,
    /// The sidecar file of this name.
    Sidecar(String),
}

impl fmt::Display for SpecifiedBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Caller => f.write_str("as specified"),
            Self::Sidecar(name) => write!(f, "as saved in {name}"),
        }
    }
}

/// Why a file, a layer or a statement is not used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unused {
    /// Its name is not the name of a map of a material.
    NotAMap,
    /// Its name does not name a map.
    Unlabelled,
    /// Another file holds the same map in a better form.
    Inferior { to: String },
    /// It is constant, and another picture of its map is not.
    Constant { other: String },
    /// The workflow does not use this map.
    Workflow(Workflow),
    /// It holds heights, not normals.
    Heights,
    /// A factor of 0 would leave nothing of the map.
    FactorZero { map: Role },
    /// Blender writes this factor, and uses the picture alone.
    Blender,
}

/// What becomes of channels that should be equal and are not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gray {
    Red,
    Mean,
}

/// What is being decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A picture of a whole material.
    Material,
    /// A picture whose name names no map.
    Picture,
    /// A photograph that renderings are compared with.
    Photograph,
    Map(Role),
}

impl fmt::Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Material => f.write_str("material"),
            Self::Picture => f.write_str("picture"),
            Self::Photograph => f.write_str("photograph"),
            Self::Map(role) => write!(f, "{} map", role.name()),
        }
    }
}

/// One thing that reading a material noticed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// A file is a map, by its name or by the file that lists it.
    MapFile { map: Role, file: String },
    /// A file is a map because someone specified it.
    MapSpecified { map: Role, file: PathBuf, by: SpecifiedBy },
    /// Options come from this sidecar file.
    SidecarUsed { file: PathBuf },
    /// Row 0 is the lowest row.
    RowsFlipped { by: SpecifiedBy },
    /// A file, a layer or a statement is not used.
    Unused { what: String, why: Unused },
    /// The maps are in a folder within the one that was opened.
    InFolder { folder: String },
    /// The first tiles of a packed image are photos.
    Photos { count: usize, tiles: usize },
    /// The packed image holds a material in each row; `index` counts from 0.
    Rows { count: usize, index: usize },
    /// The file holds several materials of these names; `index` counts from 0.
    Materials { names: Vec<String>, index: usize },
    /// The file has features that change the look, which are not modelled and ignored.
    NotModelled { features: Vec<String> },
    /// The alpha channel of a map is not used.
    AlphaIgnored { map: Role },
    /// The channels of a gray map differ by up to `spread`.
    ChannelsDiffer { map: Role, spread: f64, used: Gray },
    /// The two widths of an anisotropic roughness differ by up to `spread`.
    Anisotropic { spread: f64 },
    /// The encoding that was specified for specular contradicts its median.
    SpecularMedian { chosen: Albedo, by: SpecifiedBy, median: f64, suggests: Albedo },
    /// Specular of OpenSVBRDF: a factor on 0.04.
    SpecularFactor { file: String },
    /// A layer without a name is taken as a preview.
    Preview,
    /// A gAMA chunk says that the values are linear.
    LinearGamma(Subject),
    /// EXIF orientation is ignored.
    Orientation(Subject),
    /// An ICC profile other than sRGB is ignored.
    Profile(Subject),
    /// The EXR has primaries other than those of Rec. 709.
    Primaries,
    /// The data window of a layer lies beside its display window. The layer may have no name.
    DataWindow { layer: String },
    /// A layer has data for a part of its display window only.
    PartialData { layer: String, data: [usize; 2], display: [usize; 2] },
    /// The file that an .mtl names is absent, and another one of its name is used.
    Substituted { file: String, by: PathBuf },
    /// Options of a picture in an .mtl that are not used.
    OptionsUnused { map: Role, options: Vec<String> },
    /// Statements of an .mtl that are not used.
    StatementsUnused(Vec<String>),
    /// The material was resized to the size of the ground truth.
    Resized { from: [usize; 2], to: [usize; 2] },
}

impl Note {
    /// Whether a user need not be told unless they ask: a file is the map that its name or the user says.
    pub fn is_routine(&self) -> bool {
        match self {
            Self::MapFile { .. } => true,
            Self::MapSpecified { by, .. } => *by == SpecifiedBy::Caller,
            _ => false,
        }
    }

    /// Whether it reports that something is ignored or changed that may alter the look of the material.
    pub fn changes_look(&self) -> bool {
        match self {
            Self::ChannelsDiffer { .. } | Self::Anisotropic { .. } | Self::SpecularMedian { .. } => true,
            Self::LinearGamma(_) | Self::Profile(_) | Self::Primaries => true,
            Self::DataWindow { .. } | Self::PartialData { .. } | Self::OptionsUnused { .. } => true,
            Self::Unused { why, .. } => matches!(why, Unused::FactorZero { .. } | Unused::Heights),
            _ => false,
        }
    }

    /// Who specified what this note reports, where someone did.
    pub(crate) fn specified_by(&mut self) -> Option<&mut SpecifiedBy> {
        match self {
            Self::MapSpecified { by, .. } | Self::RowsFlipped { by } | Self::SpecularMedian { by, .. } => {
                Some(by)
            }
            _ => None,
        }
    }

    fn of_pixels(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AlphaIgnored { map } => {
                write!(f, "The {} map is partly transparent; its alpha is ignored.", map.name())
            }
            Self::ChannelsDiffer { map, spread, used } => {
                let used = if *used == Gray::Red { "red is used" } else { "their mean is used" };
                let map = map.name();
                write!(f, "The red, green and blue of the {map} map differ by up to {spread:.4}; {used}.")
            }
            Self::Anisotropic { spread } => write!(
                f,
                "The two widths of the roughness map differ by up to {spread:.4}; an isotropic lobe replaces them."
            ),
            Self::SpecularMedian { chosen, by, median, suggests } => write!(
                f,
                "Specular is read as {chosen}, {by}, but its median is {median:.3}, which suggests {suggests}: check it."
            ),
            Self::Primaries => {
                f.write_str("The EXR has primaries other than those of Rec. 709; its RGB is used as it is.")
            }
            Self::DataWindow { layer } => write!(
                f,
                "{} has a data window beside its display window; the data is used as it is.",
                layer_name(layer)
            ),
            Self::PartialData { layer, data, display } => write!(
                f,
                "{} has data for {} x {} of the {} x {} texels of its display window; the rest is 0.",
                layer_name(layer),
                data[0],
                data[1],
                display[0],
                display[1]
            ),
            Self::LinearGamma(subject) => {
                write!(f, "The {subject} has a gAMA chunk that declares it linear, which is ignored.")
            }
            Self::Orientation(subject) => {
                write!(f, "The {subject} has an EXIF orientation, which is ignored: rows are read as stored.")
            }
            Self::Profile(subject) => {
                write!(f, "The {subject} has an ICC profile other than sRGB, which is ignored.")
            }
            _ => Ok(()),
        }
    }
}

/// The first of the names, and which one was read.
fn materials(names: &[String], index: usize) -> String {
    const MOST_LISTED: usize = 12;
    let listed: Vec<_> =
        names.iter().enumerate().take(MOST_LISTED).map(|(i, n)| format!("{i} {n}")).collect();
    let more = names.len().saturating_sub(MOST_LISTED);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!(
        "The file holds {} materials: {}{more}. This is number {index} from 0.",
        names.len(),
        listed.join(", ")
    )
}

fn layer_name(layer: &str) -> String {
    if layer.is_empty() { "The picture".to_owned() } else { format!("Layer {layer}") }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MapFile { map, file } => write!(f, "The {} map is {file}.", map.name()),
            Self::MapSpecified { map, file, by } => {
                write!(f, "The {} map is {}, {by}.", map.name(), file.display())
            }
            Self::SidecarUsed { file } => {
                write!(f, "{} specifies how the material is read, unless an option does.", file.display())
            }
            Self::RowsFlipped { by } => {
                write!(f, "Row 0 is the lowest row, {by}: the material is mirrored.")
            }
            Self::Unused { what, why } => write!(f, "{what} is not used{why}."),
            Self::InFolder { folder } => write!(f, "The maps are in the folder {folder} within."),
            Self::Photos { count, tiles } => {
                write!(f, "The first {count} of {tiles} tiles are taken as photos and ignored.")
            }
            Self::Rows { count, index } => write!(
                f,
                "The image holds {count} materials, one in each row; this is number {index} from 0."
            ),
            Self::Materials { names, index } => write!(f, "{}", materials(names, *index)),
            Self::NotModelled { features } => {
                write!(f, "These change the look and are not modelled: {}.", features.join(", "))
            }
            Self::SpecularFactor { file } => {
                write!(f, "{file} is read as a factor on 0.04, as OpenSVBRDF writes it.")
            }
            Self::Preview => f.write_str("The unnamed layer is taken as a preview and ignored."),
            Self::Substituted { file, by } => write!(f, "{file} is absent; {} is used.", by.display()),
            Self::OptionsUnused { map, options } => {
                write!(f, "Options of the {} map that are not used: {}.", map.name(), options.join(", "))
            }
            Self::StatementsUnused(all) => {
                write!(f, "Statements of the .mtl that are not used: {}.", all.join(", "))
            }
            Self::Resized { from, to } => write!(
                f,
                "Resized from {} x {} to the {} x {} of the ground truth.",
                from[0], from[1], to[0], to[1]
            ),
            _ => self.of_pixels(f),
        }
    }
}

impl fmt::Display for Unused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAMap => Ok(()),
            Self::Unlabelled => f.write_str(": its name does not name a map"),
            Self::Inferior { to } => write!(f, ": {to} is preferred"),
            Self::Constant { other } => write!(f, ": it is constant, and {other} is not"),
            Self::Workflow(workflow) => write!(f, ": the workflow is {workflow}"),
            Self::Heights => f.write_str(": it holds heights, not normals"),
            Self::FactorZero { map } => write!(f, ": nothing would be left of the {} map", map.name()),
            Self::Blender => f.write_str(": Blender, which wrote it, uses the picture alone"),
        }
    }
}

impl serde::Serialize for Note {
    /// The sentence.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
