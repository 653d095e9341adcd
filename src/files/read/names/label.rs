//! The label of a file or layer: which map it holds, by the words of its name.

use super::words::telling_words;
use crate::read::options::{NormalY, Role, Roughness};

/// The map that a name stands for, and what else the name tells.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Label {
    pub role: Role,
    /// The telling word, in lower case, as in `normalgl`.
    pub word: String,
    /// The words that are left: the name of the material.
    pub stem: Vec<String>,
    pub normal_y: Option<NormalY>,
}

impl Label {
    /// The last telling word of a name wins: `metal_spec_rough` is a roughness map.
    pub(crate) fn of(name: &str) -> Option<Self> {
        Self::of_words(telling_words(name), 0)
    }

    /// The label of a name of these words, of which the first `common` ones are those of its set and tell no map.
    pub(super) fn of_words(mut words: Vec<String>, common: usize) -> Option<Self> {
        if let Some(label) = both_of_blender(&words) {
            return Some(label);
        }
        // Unreal's T_NAME_B: beside T, and only there, a B is a base colour.
        if words.len() > 2 && words[0] == "t" && words.last().is_some_and(|last| last == "b") {
            words.pop();
            words.push("bc".to_owned());
        }
        let last = last_label(&words, words.len(), common)?;
        let before = last_label(&words[..last.start], last.start, common).filter(|one| one.end == last.start);
        Some(before.and_then(|first| packed_pair(&first, &last)).unwrap_or(last).label(&words))
    }

    /// Whether the word is so short that it needs company.
    pub(crate) fn is_short(&self) -> bool {
        self.word.len() <= 2
    }

    /// The meaning of roughness that the word stands for.
    pub(crate) fn roughness(&self) -> Option<Roughness> {
        match self.word.as_str() {
            "axay" => Some(Roughness::Anisotropic),
            "maskmap" | "specgloss" => Some(Roughness::Gloss),
            word if ["glossiness", "gloss", "glossy", "smoothness"].iter().any(|end| word.ends_with(end)) => {
                Some(Roughness::Gloss)
            }
            _ => None,
        }
    }

    /// Whether heights are in the alpha of its picture.
    pub(crate) fn is_over_heights(&self) -> bool {
        self.role != Role::Ignored && HEIGHTS.iter().any(|end| end.len() > 1 && self.word.ends_with(end))
    }

    /// Whether the map holds heights.
    pub(crate) fn is_height(&self) -> bool {
        HEIGHTS.contains(&self.word.as_str())
    }

    /// Which of several files for one map is the better one: the higher. Y up before y down, gamma before linear, roughness before
    /// glossiness.
    pub(crate) fn rank(&self) -> u8 {
        match self.normal_y {
            Some(NormalY::Up) => 2,
            Some(NormalY::Down) => 0,
            None if self.word.contains("gammad") => 2,
            None if self.roughness() == Some(Roughness::Gloss) => 0,
            None => 1,
        }
    }
}

const HEIGHTS: [&str; 11] =
    ["displacement", "displace", "disp", "dsp", "height", "heightmap", "heights", "ht", "h", "bump", "bmp"];

/// The words of a name that stand for a map.
struct Telling {
    start: usize,
    end: usize,
    word: String,
    role: Role,
    normal_y: Option<NormalY>,
}

impl Telling {
    fn label(self, words: &[String]) -> Label {
        let Self { start, end, word, role, normal_y } = self;
        Label { role, word, stem: words[..start].iter().chain(&words[end..]).cloned().collect(), normal_y }
    }
}

/// The last of `words` that stand for a map, of which the first `common` do not count; `count` is how many the whole
/// name has.
fn last_label(words: &[String], count: usize, common: usize) -> Option<Telling> {
    (common + 1..=words.len()).rev().find_map(|end| {
        (1..=(end - common).min(4)).rev().find_map(|many| {
            let start = end - many;
            let word = without_map(words[start..end].concat());
            // A letter alone names a map only at the end.
            let short = word.len() <= 2 && !["ao", "ht"].contains(&word.as_str()) && end < count;
            let (role, normal_y) = if short { None } else { meaning(&word) }?;
            Some(Telling { start, end, word, role, normal_y })
        })
    })
}

/// Two maps whose names stand side by side are in one picture: normals with roughness in alpha, or normals or colours
/// with heights in alpha.
fn packed_pair(first: &Telling, last: &Telling) -> Option<Telling> {
    let is_height = HEIGHTS.contains(&last.word.as_str());
    let role = match (first.role, last.role) {
        (Role::Normal, Role::Roughness) => Role::NormalRoughness,
        (Role::Normal | Role::Base | Role::Diffuse, Role::Ignored) if is_height => first.role,
        _ => return None,
    };
    let word = format!("{}{}", first.word, last.word);
    Some(Telling { start: first.start, end: last.end, word, role, normal_y: first.normal_y })
}

/// The picture that Blender's export to glTF packs of two and names after both: `X_Metallic-X_Roughness`.
fn both_of_blender(words: &[String]) -> Option<Label> {
    let half = words.len() / 2;
    let (first, second) = words.split_at(half);
    let (a, b) = (first.split_last()?, second.split_last()?);
    let roles = [a.0, b.0].map(|word| Role::of_word(word));
    let both = [[Role::Metallic, Role::Roughness], [Role::Roughness, Role::Metallic]];
    let is_both = a.1 == b.1 && !a.1.is_empty() && both.iter().any(|pair| roles == pair.map(Some));
    is_both.then(|| Label {
        role: Role::OcclusionRoughnessMetallic,
        word: "metallicroughness".to_owned(),
        stem: a.1.to_vec(),
        normal_y: None,
    })
}

fn meaning(word: &str) -> Option<(Role, Option<NormalY>)> {
    for (ending, y) in [
        ("opengl", NormalY::Up),
        ("ogl", NormalY::Up),
        ("gl", NormalY::Up),
        ("directx", NormalY::Down),
        ("dx", NormalY::Down),
    ] {
        let normal = word.strip_suffix(ending).and_then(Role::of_word);
        if normal == Some(Role::Normal) {
            return Some((Role::Normal, Some(y)));
        }
    }
    // Passes of renderers that are light, not reflectance: DiffDir, "Glossy Indirect".
    let is_light = |end: &&str| word.strip_suffix(end).is_some_and(is_whole_word);
    if ["direct", "indirect", "dir", "ind"].iter().any(is_light) {
        return Some((Role::Ignored, None));
    }
    for family in ["outputsgammad", "outputs", "targets"] {
        let role = match word.strip_prefix(family) {
            Some("0") => Role::Normal,
            Some("1") => Role::Diffuse,
            Some("2") => Role::Roughness,
            Some("3") => Role::Specular,
            _ => continue,
        };
        return Some((role, None));
    }
    // What networks write: 0000001_Nout.png.
    let plain = match word {
        "nout" => "n",
        "dout" => "d",
        "rout" => "r",
        "sout" => "s",
        other => other,
    };
    Role::of_word(plain).map(|role| (role, None))
}

/// Whether a word of more than two letters stands for a map.
fn is_whole_word(word: &str) -> bool {
    word.len() > 2 && Role::of_word(word).is_some()
}

/// `roughness` of `roughnessmap`.
fn without_map(word: String) -> String {
    let plain = word.strip_suffix("map").filter(|rest| is_whole_word(rest) && Role::of_word(&word).is_none());
    plain.map(str::to_owned).unwrap_or(word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_telling_word_names_the_map() {
        let role = |name| Label::of(name).map(|label| label.role);
        for (name, expected) in [
            ("metal_spec_rough", Role::Roughness),
            ("gt_Normals", Role::Normal),
            ("Metal049A_1K-JPG_Color", Role::Base),
            ("FlightHelmet_LeatherPartsMat_OcclusionRoughMetal", Role::OcclusionRoughnessMetallic),
            ("wooden_table_02_arm_1k", Role::OcclusionRoughnessMetallic),
            ("x-outputs_gammad-3-", Role::Specular),
            ("T_Wall_BC", Role::Base),
            ("0000001_Rout", Role::Roughness),
            ("Metal_AmbientOcclusion", Role::Ignored),
            ("pd_texture", Role::Diffuse),
            ("ax_ay_texture", Role::Roughness),
            ("Rock_MaskMap", Role::MetallicSmoothness),
            ("Rock_SpecularLevel", Role::SpecularLevel),
            ("material_0_specularGlossiness", Role::SpecularGlossiness),
            ("X_Metallic-X_Roughness", Role::OcclusionRoughnessMetallic),
            ("old_Roughness-old_Metallic", Role::OcclusionRoughnessMetallic),
            ("metal_plate_rough", Role::Roughness),
            ("T_Rock_B", Role::Base),
            ("Rock_BaseMap", Role::Base),
            ("plank_base", Role::Base),
            ("Door_AlbedoTransparency", Role::Base),
            ("Door_MetalRoughness", Role::OcclusionRoughnessMetallic),
            ("moss_nrm_rgh", Role::NormalRoughness),
            ("moss_normal_gl_roughness", Role::NormalRoughness),
            ("moss_alb_ht", Role::Base),
            ("moss_normal_height", Role::Normal),
            ("moss_RoughnessMap", Role::Roughness),
            ("moss_metallic_gloss", Role::MetallicSmoothness),
            ("ViewLayer.DiffCol", Role::Diffuse),
            ("ViewLayer.Glossy Color", Role::Specular),
            ("ViewLayer.DiffInd", Role::Ignored),
            ("ViewLayer.Denoising Albedo", Role::Ignored),
            ("RGBA_diffuse_albedo", Role::Diffuse),
            ("moss_GlossMap", Role::Roughness),
        ] {
            assert_eq!(role(name), Some(expected), "{name}");
        }
        assert_eq!(role("plan_b"), None);
        assert_eq!(role("abnormal"), None);
        assert_eq!(role("Metal049A"), None);
    }

    #[test]
    fn names_tell_where_green_points() {
        let y = |name| Label::of(name).and_then(|label| label.normal_y);
        assert_eq!(y("a_NormalGL"), Some(NormalY::Up));
        assert_eq!(y("a_nor_dx_4k"), Some(NormalY::Down));
        assert_eq!(y("a_Normal_DirectX"), Some(NormalY::Down));
        assert_eq!(y("rock_normal-ogl"), Some(NormalY::Up));
        assert_eq!(y("NormalOGL"), Some(NormalY::Up));
        assert_eq!(y("a_normal"), None);
    }

    #[test]
    fn no_word_names_two_maps() {
        for role in Role::ALL {
            for word in role.words() {
                assert_eq!(Role::of_word(word), Some(role), "{word}");
            }
        }
    }
}
