//! Which map a file holds, by the words of its name.

/// One of the four maps of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Map {
    Normal,
    Diffuse,
    Roughness,
    Specular,
}

impl Map {
    /// In the order in which packed strips hold them.
    pub const ALL: [Self; 4] = [Self::Normal, Self::Diffuse, Self::Roughness, Self::Specular];

    pub fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Diffuse => "diffuse",
            Self::Roughness => "roughness",
            Self::Specular => "specular",
        }
    }

    /// The words that stand for this map in file names, the plainest first.
    pub fn words(self) -> &'static [&'static str] {
        match self {
            Self::Normal => &["normal", "normals", "nor", "nrm", "nrml", "norm", "nom"],
            Self::Diffuse => &["diffuse", "diff", "dif", "albedo"],
            Self::Roughness => &["roughness", "rough", "rgh"],
            Self::Specular => &["specular", "spec", "spe", "spc"],
        }
    }

    /// The map that the last telling word of a name names: `metal_spec_rough` is a roughness map.
    pub fn of_words(words: &[String]) -> Option<Self> {
        let map_of = |word: &String| Self::ALL.into_iter().find(|map| map.words().contains(&word.as_str()));
        words.iter().rev().find_map(map_of)
    }
}

/// The words of a file name, in lower case: it is split where no letter or digit is, and before a capital letter
/// that follows a small one.
pub fn words(name: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word = String::new();
    let mut after_small = false;
    for c in name.chars() {
        let border = !c.is_alphanumeric() || (after_small && c.is_uppercase());
        if border && !word.is_empty() {
            words.push(std::mem::take(&mut word));
        }
        if c.is_alphanumeric() {
            word.extend(c.to_lowercase());
        }
        after_small = c.is_lowercase();
    }
    if !word.is_empty() {
        words.push(word);
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fall_apart_into_lower_case_words() {
        assert_eq!(words("Wall02_NormalGL-2K .x"), ["wall02", "normal", "gl", "2k", "x"]);
        assert_eq!(words("__"), [""; 0]);
    }

    #[test]
    fn the_last_telling_word_names_the_map() {
        let map = |name| Map::of_words(&words(name));
        assert_eq!(map("metal_spec_rough"), Some(Map::Roughness));
        assert_eq!(map("gt_Normals"), Some(Map::Normal));
        assert_eq!(map("abnormal"), None);
    }

    #[test]
    fn no_word_names_two_maps() {
        for map in Map::ALL {
            for word in map.words() {
                assert_eq!(Map::of_words(&words(word)), Some(map), "{word}");
            }
        }
    }
}
