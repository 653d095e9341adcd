//! Notes: the things that reading a material noticed, as values.

use std::path::PathBuf;

use crate::read::options::{Albedo, Role, Workflow};

/// The source of an option or a map that was specified.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SpecifiedBy {
    /// The caller of this reading.
    Caller,
    /// The sidecar file of this name.
    Sidecar(String),
}

/// The reason why a file, a layer or a statement is not used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unused {
    /// Its name is not the name of a map of a material.
    NotAMap,
    /// Its name does not name a map.
    Unlabelled,
    /// It is named after a map, but not as the other maps of the material are.
    OtherStem,
    /// Another file holds the same map in a better form.
    Inferior { to: String },
    /// It is constant, and another picture of its map is not.
    Constant { other: String },
    /// The workflow does not use this map.
    Workflow(Workflow),
    /// It holds heights, not normals.
    Heights,
    /// Its pixels are neither normals nor heights.
    NotNormals,
    /// A factor of 0 would leave nothing of the map.
    FactorZero { map: Role },
    /// Blender writes this factor, and uses the picture alone.
    Blender,
}

/// The value of a gray map whose channels differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gray {
    Red,
    Mean,
}

/// The subject of a decoding, for messages.
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
    /// A file that another one names lies outside of the folder of that file.
    OutsideFolder { file: PathBuf, by: PathBuf },
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
    /// A document beside the files of a set lists some of them, too.
    ListedBy { file: String },
    /// Colours of these colour spaces that Rec. 709 does not have are clipped.
    Gamut { spaces: Vec<String> },
    /// The alpha channel of a map is not used.
    AlphaIgnored { map: Role },
    /// The channels of a gray map differ by up to `spread`, in [0, 1].
    ChannelsDiffer { map: Role, channel_spread: f64, used: Gray },
    /// The two widths of an anisotropic roughness differ by up to `spread`.
    Anisotropic { channel_spread: f64 },
    /// The encoding that was specified for specular contradicts its median.
    SpecularMedian { chosen: Albedo, by: SpecifiedBy, median: f64, suggests: Albedo },
    /// Specular of OpenSVBRDF: a factor on 0.04.
    SpecularFactor { file: String },
    /// A layer without a name is taken as a preview.
    Preview,
    /// The channels of an array could be its first axis or its last: they are taken as the last. An array of a file by
    /// itself has no name.
    ChannelsLast { array: String, shape: Vec<u64> },
    /// A gAMA chunk declares the values linear.
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
    /// Whether a user need not be told unless they ask: a file is the map that its name or the user specifies.
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
            Self::LinearGamma(_) | Self::Profile(_) | Self::Primaries | Self::Gamut { .. } => true,
            Self::DataWindow { .. } | Self::PartialData { .. } | Self::OptionsUnused { .. } => true,
            Self::Unused { why, .. } => {
                matches!(why, Unused::FactorZero { .. } | Unused::Heights | Unused::NotNormals)
            }
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
}

impl serde::Serialize for Note {
    /// The sentence.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
