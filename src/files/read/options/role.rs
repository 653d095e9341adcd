//! The maps of a material, and the words of file names that stand for them.

use svbrdf_core::material::Map;

/// What a picture of a material is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    Normal,
    /// Base colour of the metallic workflow; also what is called albedo or colour.
    Base,
    Diffuse,
    Specular,
    /// Reflectance of dielectrics: 0.08 where it is 1.
    SpecularLevel,
    Roughness,
    Metallic,
    /// Red occlusion, green roughness, blue metallic.
    OcclusionRoughnessMetallic,
    /// Red roughness, green metallic, blue occlusion.
    RoughnessMetallicOcclusion,
    /// Red metallic, green roughness, blue occlusion.
    MetallicRoughnessOcclusion,
    /// Red metallic, alpha smoothness: Unity.
    MetallicSmoothness,
    /// Red, green and blue normals, alpha roughness.
    NormalRoughness,
    /// Red, green and blue specular, alpha glossiness: the extension of glTF.
    SpecularGlossiness,
    /// A map that a material does not need, such as occlusion or height.
    Ignored,
}

const BASE: &[&str] = &[
    "basecolor",
    "basecolour",
    "basemap",
    "base",
    "albedo",
    "color",
    "colour",
    "col",
    "alb",
    "bc",
    "kd",
    "albedotransparency",
    "albedoopacity",
    "albedoalpha",
    "basecolortransparency",
    "basecoloropacity",
    "basecoloralpha",
];

const SPECULAR: &[&str] = &[
    "specular",
    "spec",
    "spe",
    "spc",
    "specularity",
    "reflection",
    "reflectance",
    "f0",
    "specularcolor",
    "specularcolour",
    "specularalbedo",
    "speccol",
    "glosscol",
    "glossycolor",
    "glossycolour",
    "s",
    "ps",
];

const PACKED: &[&str] = &[
    "occlusionroughnessmetallic",
    "occlusionroughmetal",
    "metallicroughness",
    "roughnessmetallic",
    "occlusionroughnessmetalness",
    "metalroughness",
    "metalrough",
    "metallicrough",
    "metalnessroughness",
    "roughnessmetalness",
    "roughnessmetal",
    "roughmetal",
    "orm",
    "arm",
    "ks",
];

/// Words of maps that a material does not need.
const IGNORED: &[&str] = &[
    "ao",
    "ambientocclusion",
    "occlusion",
    "occ",
    "displacement",
    "displace",
    "disp",
    "dsp",
    "height",
    "heightmap",
    "heights",
    "ht",
    "h",
    "bump",
    "bmp",
    "opacity",
    "alpha",
    "mask",
    "emission",
    "emissive",
    "emit",
    "tangent",
    "pos",
    "render",
    "rendering",
    "rendered",
    "input",
    "inputs",
    "preview",
    "thumb",
    "flow",
    "depth",
    "transcol",
    "transmissioncolor",
    "denoisingalbedo",
    "denoisingnormal",
];

impl Role {
    /// The map of the material that it becomes; `None` for one that becomes several.
    pub fn map(self) -> Option<Map> {
        match self {
            Self::Normal => Some(Map::Normal),
            Self::Base | Self::Diffuse => Some(Map::Diffuse),
            Self::Specular | Self::SpecularLevel => Some(Map::Specular),
            Self::Roughness => Some(Map::Roughness),
            _ => None,
        }
    }

    /// The name for users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Base => "base colour",
            Self::Diffuse => "diffuse",
            Self::Specular => "specular",
            Self::SpecularLevel => "specular level",
            Self::Roughness => "roughness",
            Self::Metallic => "metallic",
            Self::OcclusionRoughnessMetallic
            | Self::RoughnessMetallicOcclusion
            | Self::MetallicRoughnessOcclusion
            | Self::MetallicSmoothness => "packed roughness and metallic",
            Self::NormalRoughness => "normal and roughness",
            Self::SpecularGlossiness => "specular and glossiness",
            Self::Ignored => "unused",
        }
    }

    /// The words that stand for this map, the plainest first. Words of one or two letters count only beside others.
    pub fn words(self) -> &'static [&'static str] {
        match self {
            Self::Normal => {
                &["normal", "normals", "nor", "nrm", "nrml", "norm", "nom", "nmap", "nm", "n", "normalao"]
            }
            Self::Base => BASE,
            Self::Diffuse => &[
                "diffuse",
                "diff",
                "dif",
                "d",
                "pd",
                "diffcol",
                "diffusecolor",
                "diffusecolour",
                "diffusealbedo",
            ],
            Self::Specular => SPECULAR,
            Self::SpecularLevel => &["specularlevel"],
            Self::Roughness => {
                &["roughness", "rough", "rgh", "r", "glossiness", "gloss", "glossy", "smoothness", "axay"]
            }
            Self::Metallic => &["metallic", "metalness", "metal", "met", "mtl", "m"],
            Self::OcclusionRoughnessMetallic => PACKED,
            Self::RoughnessMetallicOcclusion => &["rmo", "rma", "roughnessmetallicocclusion"],
            Self::MetallicRoughnessOcclusion => &["mra"],
            Self::MetallicSmoothness => &[
                "metallicsmoothness",
                "maskmap",
                "metallicgloss",
                "metallicglossiness",
                "metalgloss",
                "metalsmoothness",
            ],
            Self::NormalRoughness => &["normalroughness", "normalsmoothness", "normalgloss"],
            Self::SpecularGlossiness => &["specularglossiness", "specgloss", "specularsmoothness"],
            Self::Ignored => IGNORED,
        }
    }

    pub const ALL: [Self; 14] = [
        Self::Normal,
        Self::Base,
        Self::Diffuse,
        Self::Specular,
        Self::SpecularLevel,
        Self::Roughness,
        Self::Metallic,
        Self::OcclusionRoughnessMetallic,
        Self::RoughnessMetallicOcclusion,
        Self::MetallicRoughnessOcclusion,
        Self::MetallicSmoothness,
        Self::NormalRoughness,
        Self::SpecularGlossiness,
        Self::Ignored,
    ];

    /// The channels of roughness and of metallic where both are in one picture; 3 is alpha.
    pub fn packing(self) -> Option<[usize; 2]> {
        match self {
            Self::OcclusionRoughnessMetallic => Some([1, 2]),
            Self::RoughnessMetallicOcclusion => Some([0, 1]),
            Self::MetallicRoughnessOcclusion => Some([1, 0]),
            Self::MetallicSmoothness => Some([3, 0]),
            _ => None,
        }
    }

    pub(crate) fn is_colour(self) -> bool {
        matches!(self, Self::Base | Self::Diffuse | Self::Specular | Self::SpecularGlossiness)
    }

    /// Whether its picture holds roughness or glossiness.
    pub(crate) fn has_roughness(self) -> bool {
        matches!(self, Self::Roughness | Self::SpecularGlossiness | Self::NormalRoughness)
            || self.packing().is_some()
    }

    /// The names that a file of this map can have, for messages: the plainest words that need no others beside them.
    pub fn examples(self) -> String {
        const MOST: usize = 8;
        let words = self.words().iter().filter(|word| word.len() > 2).take(MOST);
        words.copied().collect::<Vec<_>>().join(", ")
    }

    /// The map that a word stands for.
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|role| role.words().contains(&word))
    }
}

impl serde::Serialize for Role {
    /// The name.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}
