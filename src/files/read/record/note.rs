//! Notes: the things that reading a material noticed, as values.

use std::path::PathBuf;

use derive_more::Display;

use crate::read::options::{Role, Workflow};

/// The reason why a file, a layer or a statement is not used, as the end of a sentence.
#[derive(Clone, Debug, PartialEq, Eq, Display)]
pub enum Unused {
    /// Its name is not the name of a map of a material.
    #[display("")]
    NotAMap,
    /// It is a number, a text or an array of another shape.
    #[display(": it is no picture")]
    NoPicture,
    #[display(": its format is not read")]
    Format,
    #[display(": its name does not name a map")]
    Unlabelled,
    #[display(": it is not named as the other maps are")]
    OtherStem,
    /// Another file holds the same map in a better form.
    #[display(": {to} is preferred")]
    Inferior { to: String },
    /// It is constant, and another picture of its map is not.
    #[display(": it is constant, and {other} is not")]
    Constant { other: String },
    /// The workflow does not use this map.
    #[display(": the workflow is {_0}")]
    Workflow(Workflow),
    #[display(": it holds heights, not normals")]
    Heights,
    /// Its pixels are neither normals nor heights.
    #[display(": its pixels do not look like normals")]
    NotNormals,
}

/// The subject of a decoding, for messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Display)]
pub enum Subject {
    /// A picture of a whole material.
    #[display("material")]
    Material,
    /// A picture whose name names no map.
    #[display("picture")]
    Picture,
    /// A photograph that renderings are compared with.
    #[display("photograph")]
    Photograph,
    #[display("{} map", _0.name())]
    Map(Role),
}

/// One thing that reading a material noticed, as a sentence.
#[derive(Clone, Debug, PartialEq, Display)]
#[non_exhaustive]
pub enum Note {
    #[display("{_0}")]
    Told(String),
    /// Something is ignored or changed that may alter the look of the material.
    #[display("{_0}")]
    Changed(String),
    /// A file is a map, by its name or by the file that lists it.
    #[display("The {} map is {file}.", map.name())]
    MapFile { map: Role, file: String },
    /// A file is a map because someone specified it.
    #[display("The {} map is {}, as specified.", map.name(), file.display())]
    MapSpecified { map: Role, file: PathBuf },
    #[display("{} lies outside of the folder of {}, which names it.", file.display(), by.display())]
    OutsideFolder { file: PathBuf, by: PathBuf },
    /// A file, a layer or a statement is not used.
    #[display("{what} is not used{why}.")]
    Unused { what: String, why: Unused },
    /// The maps are in a folder within the one that was opened.
    #[display("The maps are in the folder {folder} within.")]
    InFolder { folder: String },
    #[display("The image holds {count} materials, one in each row; this is number {index} from 0.")]
    Rows { count: usize, index: usize },
    /// The file holds several materials of these names; `index` counts from 0.
    #[display("{}", materials(names, *index))]
    Materials { names: Vec<String>, index: usize },
    /// The share of the texels that are empty.
    #[display(
        "The alpha of the {} map looks like a mask: {:.0}% of the texels are empty, and count as all others unless a mask is asked for.",
        map.name(), 100.0 * empty
    )]
    MaskInAlpha { map: Role, empty: f64 },
    /// The channels of a gray map differ by up to `channel_spread`, in [0, 1].
    #[display(
        "The red, green and blue of the {} map differ by up to {channel_spread:.4}; {} is used.",
        map.name(), if *map == Role::Roughness { "their mean" } else { "red" }
    )]
    ChannelsDiffer { map: Role, channel_spread: f64 },
    /// A chunk of a PNG or another header, by its name.
    #[display("The {_0} has a {_1} that declares it linear, which is ignored.")]
    LinearChunk(Subject, &'static str),
    #[display("The file of the {_0} holds several pages or frames; the first is used.")]
    FirstOnly(Subject),
    #[display("The {_0} has an ICC profile other than sRGB, which is ignored.")]
    Profile(Subject),
    #[display("The {_0} has a {_1} with primaries other than those of Rec. 709, which is ignored.")]
    PrimariesChunk(Subject, &'static str),
    #[display("The picture has primaries that enclose no white; its RGB is used as it is.")]
    Primaries,
    #[display("The {_0} is converted from the primaries that its file declares to those of Rec. 709.")]
    Converted(Subject),
    #[display("The {_0} is divided by its alpha, by which its file multiplies it.")]
    Unmultiplied(Subject),
    /// The layer may have no name.
    #[display(
        "{} has a data window beside its display window; the data is used as it is.",
        layer_name(layer)
    )]
    DataWindow { layer: String },
    #[display(
        "{} has data for {} x {} of the {} x {} texels of its display window; the rest is 0.",
        layer_name(layer), data[0], data[1], display[0], display[1]
    )]
    PartialData { layer: String, data: [usize; 2], display: [usize; 2] },
    /// How far the lengths of stored normals are from 1 on average, beyond the rounding of their codes.
    #[display("The lengths of the stored normals differ from 1 by {_0:.4} on average; they are normalized.")]
    NormalLengths(f64),
    /// The material was resized to the size of the ground truth.
    #[display("Resized from {} x {} to the {} x {} of the ground truth.", from[0], from[1], to[0], to[1])]
    Resized { from: [usize; 2], to: [usize; 2] },
}

impl Note {
    /// Whether a user need not be told unless they ask: a file is the map that its name or the user specifies, or normals are normalized.
    pub fn is_routine(&self) -> bool {
        matches!(self, Self::MapFile { .. } | Self::MapSpecified { .. } | Self::NormalLengths(_))
    }

    /// Whether it reports that something is ignored or changed that may alter the look of the material.
    pub fn changes_look(&self) -> bool {
        match self {
            Self::Changed(_) | Self::ChannelsDiffer { .. } | Self::Primaries => true,
            Self::LinearChunk(..) | Self::Profile(_) | Self::PrimariesChunk(..) => true,
            Self::DataWindow { .. } | Self::PartialData { .. } => true,
            Self::FirstOnly(_) | Self::MaskInAlpha { .. } => true,
            Self::Unused { why, .. } => {
                matches!(why, Unused::Heights | Unused::NotNormals | Unused::Format)
            }
            _ => false,
        }
    }
}

impl serde::Serialize for Note {
    /// The sentence.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
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
