//! The sentences of notes.

use std::fmt;

use super::note::{Gray, Note, SpecifiedBy, Subject, Unused};

impl fmt::Display for SpecifiedBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Caller => f.write_str("as specified"),
            Self::Sidecar(name) => write!(f, "as saved in {name}"),
        }
    }
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
            Self::OutsideFolder { file, by } => {
                write!(
                    f,
                    "{} lies outside of the folder of {}, which names it.",
                    file.display(),
                    by.display()
                )
            }
            Self::InFolder { folder } => write!(f, "The maps are in the folder {folder} within."),
            Self::Photos { count, tiles } => {
                write!(f, "The first {count} of {tiles} tiles are taken as photos and ignored.")
            }
            Self::Rows { count, index } => write!(
                f,
                "The image holds {count} materials, one in each row; this is number {index} from 0."
            ),
            Self::SpecularFactor { file } => {
                write!(f, "{file} is read as a factor on 0.04, as OpenSVBRDF writes it.")
            }
            Self::Preview => f.write_str("The unnamed layer is taken as a preview and ignored."),
            Self::Resized { from, to } => write!(
                f,
                "Resized from {} x {} to the {} x {} of the ground truth.",
                from[0], from[1], to[0], to[1]
            ),
            Self::Materials { .. }
            | Self::NotModelled { .. }
            | Self::ListedBy { .. }
            | Self::Gamut { .. }
            | Self::Substituted { .. }
            | Self::OptionsUnused { .. }
            | Self::StatementsUnused(_) => self.of_documents(f),
            Self::AlphaIgnored { .. }
            | Self::ChannelsLast { .. }
            | Self::ChannelsDiffer { .. }
            | Self::Anisotropic { .. }
            | Self::SpecularMedian { .. }
            | Self::LinearGamma(_)
            | Self::Orientation(_)
            | Self::Profile(_)
            | Self::Primaries
            | Self::DataWindow { .. }
            | Self::PartialData { .. } => self.of_pixels(f),
        }
    }
}

impl Note {
    /// The sentences of notes about documents that list their textures.
    fn of_documents(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Materials { names, index } => write!(f, "{}", materials(names, *index)),
            Self::NotModelled { features } => {
                write!(f, "These change the look and are not modelled: {}.", features.join(", "))
            }
            Self::ListedBy { file } => {
                write!(f, "{file} lists these pictures: open it to read them as it specifies.")
            }
            Self::Gamut { spaces } => write!(
                f,
                "Rec. 709 does not have some of the colours in {}; they are clipped to [0, 1].",
                spaces.join(", ")
            ),
            Self::Substituted { file, by } => write!(f, "{file} is absent; {} is used.", by.display()),
            Self::OptionsUnused { map, options } => {
                write!(f, "Options of the {} map that are not used: {}.", map.name(), options.join(", "))
            }
            Self::StatementsUnused(all) => {
                write!(f, "Statements of the .mtl that are not used: {}.", all.join(", "))
            }
            _ => Ok(()),
        }
    }

    /// The sentences of notes about pixels.
    fn of_pixels(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AlphaIgnored { map } => {
                write!(f, "The {} map is partly transparent; its alpha is ignored.", map.name())
            }
            Self::ChannelsDiffer { map, channel_spread, used } => {
                let used = if *used == Gray::Red { "red is used" } else { "their mean is used" };
                let map = map.name();
                write!(
                    f,
                    "The red, green and blue of the {map} map differ by up to {channel_spread:.4}; {used}."
                )
            }
            Self::Anisotropic { channel_spread } => write!(
                f,
                "The two widths of the roughness map differ by up to {channel_spread:.4}; an isotropic lobe replaces them."
            ),
            Self::SpecularMedian { chosen, by, median, suggests } => write!(
                f,
                "Specular is read as {chosen}, {by}, but its median is {median:.3}, which suggests {suggests}: check it."
            ),
            Self::Primaries
            | Self::DataWindow { .. }
            | Self::PartialData { .. }
            | Self::ChannelsLast { .. }
            | Self::LinearGamma(_)
            | Self::Orientation(_)
            | Self::Profile(_) => self.of_metadata(f),
            // `Display` has their words; the compiler asks here for those of a new note.
            Self::MapFile { .. }
            | Self::MapSpecified { .. }
            | Self::SidecarUsed { .. }
            | Self::RowsFlipped { .. }
            | Self::Unused { .. }
            | Self::InFolder { .. }
            | Self::OutsideFolder { .. }
            | Self::Photos { .. }
            | Self::Rows { .. }
            | Self::Materials { .. }
            | Self::NotModelled { .. }
            | Self::Gamut { .. }
            | Self::ListedBy { .. }
            | Self::SpecularFactor { .. }
            | Self::Preview
            | Self::Substituted { .. }
            | Self::OptionsUnused { .. }
            | Self::StatementsUnused(..)
            | Self::Resized { .. } => Ok(()),
        }
    }

    /// The sentences of notes about the metadata of a picture.
    fn of_metadata(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
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
            Self::ChannelsLast { array, shape } => {
                let whose = if array.is_empty() { "The array".to_owned() } else { format!("Array {array}") };
                let shape = shape.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
                write!(
                    f,
                    "{whose} of the shape ({shape}) is read as rows, columns and channels; channels could also come first."
                )
            }
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

impl fmt::Display for Unused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAMap => Ok(()),
            Self::Unlabelled => f.write_str(": its name does not name a map"),
            Self::OtherStem => f.write_str(": it is not named as the other maps are"),
            Self::Inferior { to } => write!(f, ": {to} is preferred"),
            Self::Constant { other } => write!(f, ": it is constant, and {other} is not"),
            Self::Workflow(workflow) => write!(f, ": the workflow is {workflow}"),
            Self::Heights => f.write_str(": it holds heights, not normals"),
            Self::NotNormals => f.write_str(": its pixels do not look like normals"),
            Self::FactorZero { map } => write!(f, ": nothing would be left of the {} map", map.name()),
            Self::Blender => f.write_str(": Blender, which wrote it, uses the picture alone"),
        }
    }
}
