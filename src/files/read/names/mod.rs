//! Names of files and layers, and the map that each stands for. What the names of the files of a set have in common tells no map.

mod label;
mod listing;
mod words;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

pub(crate) use label::Label;
pub use listing::EXTENSIONS;
pub(crate) use listing::{LISTING, PICTURES, extension, folders, is_junk, list, listing, material_name};
pub(crate) use words::{is_named_as, is_named_within, size, words};

use crate::read::options::Role;
use words::words_of_file;

/// The label of each of these files, in their order.
///
/// `metal_albedo`, `metal_roughness` and `metal_xyz` are of a set named `metal`: what two maps or more have in common at
/// the beginning of their names is the name of their set, and the maps are in the words after it.
pub(crate) fn set_labels(names: &[String]) -> Vec<Option<Label>> {
    let all: Vec<Vec<String>> = names.iter().map(|name| words_of_file(name)).collect();
    let mut roles: BTreeMap<&[String], Vec<Role>> = BTreeMap::new();
    for words in &all {
        for count in 1..words.len() {
            let label = Label::of_words(words.clone(), count).filter(|label| label.role != Role::Ignored);
            let of_prefix = roles.entry(&words[..count]).or_default();
            of_prefix.extend(label.map(|label| label.role).filter(|role| !of_prefix.contains(role)));
        }
    }
    let is_set = |prefix: &[String]| roles.get(prefix).is_some_and(|roles| roles.len() > 1);
    let label = |words: &Vec<String>| {
        let common = (1..=words.len()).rev().find(|count| is_set(&words[..*count])).unwrap_or(0);
        Label::of_words(words.clone(), common)
    };
    all.iter().map(label).collect()
}

/// The sets among the files `names` of a folder, by the name of each: at least two files for different maps, the names of which have that
/// beginning in common. A file without a map does not have it, unless its other words stand beside most sets, as those of the inputs of a
/// network do: then it is listed with the set. A number alone, as that of another material, needs three.
pub fn sets(names: &[String]) -> BTreeMap<String, Vec<String>> {
    let mut by_stem: BTreeMap<Vec<String>, Vec<(&String, Role)>> = BTreeMap::new();
    for (name, label) in names.iter().zip(set_labels(names)) {
        if let Some(label) = label.filter(|label| label.role != Role::Ignored && !label.stem.is_empty()) {
            by_stem.entry(label.stem).or_default().push((name, label.role));
        }
    }
    let sets = by_stem.into_values().filter(|files| files.iter().any(|(_, role)| *role != files[0].1));
    let named = sets.filter_map(|files| {
        let all: Vec<String> = files.iter().map(|(name, _)| (*name).clone()).collect();
        let first = Path::new(&all[0]).file_stem()?.to_str()?.to_owned();
        let common = first.char_indices().rev().map(|(at, _)| &first[..at]).find(|start| {
            !start.is_empty()
                && !start.ends_with(char::is_alphanumeric)
                && all.iter().all(|name| name.starts_with(*start))
        })?;
        let name = common.trim_end_matches(|c: char| !c.is_alphanumeric());
        (!name.is_empty()).then(|| (name.to_owned(), all))
    });
    let named: BTreeMap<String, Vec<String>> = named.collect();
    let of_maps: BTreeSet<&String> = named.values().flatten().collect();
    let rest = |name: &String| named.keys().filter_map(|set| rest_of(name, set)).collect::<Vec<_>>();
    let mut beside: BTreeMap<String, usize> = BTreeMap::new();
    let others: Vec<&String> = names.iter().filter(|name| !of_maps.contains(name)).collect();
    others.iter().flat_map(|name| rest(name)).for_each(|rest| *beside.entry(rest).or_default() += 1);
    let is_of_most = |rest: &String| {
        let least = if rest.bytes().all(|byte| byte.is_ascii_digit()) { 3 } else { 2 };
        beside[rest] >= least && 2 * beside[rest] > named.len()
    };
    let is_alone =
        |set: &String| others.iter().filter_map(|name| rest_of(name, set)).all(|rest| is_of_most(&rest));
    let whole = |(set, files): (&String, &Vec<String>)| {
        let beside = others.iter().copied().filter(|name| rest_of(name, set).is_some());
        (set.clone(), files.iter().chain(beside).cloned().collect())
    };
    named.iter().filter(|(set, _)| is_alone(set)).map(whole).collect()
}

/// What a name that begins with the words of a set has after them.
fn rest_of(name: &str, set: &str) -> Option<String> {
    let stem = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
    words(&stem).strip_prefix(words(set).as_slice()).map(|rest| rest.join("_"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn roles(names: &[&str]) -> Vec<Option<Role>> {
        let names: Vec<String> = names.iter().map(|name| format!("{name}.png")).collect();
        set_labels(&names).into_iter().map(|label| label.map(|label| label.role)).collect()
    }

    #[test]
    fn the_name_of_a_set_is_not_the_word_of_a_map() {
        let rough = Some(Role::Roughness);
        assert_eq!(roles(&["metal_color", "metal_nmral", "metal_rough"]), [Some(Role::Base), None, rough]);
        assert_eq!(
            roles(&["color_4_n", "color_4_d", "color_4_thing"]),
            [Some(Role::Normal), Some(Role::Diffuse), None]
        );
        assert_eq!(roles(&["metal", "metal_n", "metal_r"]), [None, Some(Role::Normal), rough]);
    }

    #[test]
    fn words_that_are_not_the_name_of_a_set_tell_maps() {
        assert_eq!(roles(&["a_normal_gl", "a_normal_dx", "a_rough"])[..2], [Some(Role::Normal); 2]);
        assert_eq!(roles(&["a_metal_rough", "a_color"])[0], Some(Role::OcclusionRoughnessMetallic));
        assert_eq!(roles(&["metal_color"]), [Some(Role::Base)]);
        assert_eq!(roles(&["metallic", "roughness", "color"])[0], Some(Role::Metallic));
    }

    #[test]
    fn the_name_of_the_set_stays_part_of_the_stem() {
        let names = ["metal_color.png", "metal_normal.png"].map(str::to_owned);
        let stems: Vec<_> = set_labels(&names).into_iter().map(|label| label.unwrap().stem).collect();
        assert_eq!(stems, [["metal"], ["metal"]]);
    }

    #[test]
    fn files_for_the_maps_of_a_material_are_a_set_and_packed_pictures_are_none() {
        let sets = |names: &[&str]| {
            let names: Vec<String> = names.iter().map(|name| format!("{name}.png")).collect();
            sets(&names).into_iter().map(|(name, files)| (name, files.len())).collect::<Vec<_>>()
        };
        let of = |name: &str, count: usize| (name.to_owned(), count);
        assert_eq!(
            sets(&["01_Nout", "01_Dout", "01_Rout", "01_Sout", "02_Nout", "02_Dout"]),
            [of("01", 4), of("02", 2)]
        );
        assert_eq!(sets(&["oak_normal", "oak_rough", "tin"]), [of("oak", 2)]);
        assert_eq!(sets(&["oak", "tin", "metal_1", "metal_2", "rough_n"]), []);
        assert_eq!(sets(&["oak_normal", "oak_rough", "oak_2"]), [], "whose is the third?");
        let with_input =
            ["a", "b", "c"].map(|name| ["Nout", "Dout", "input"].map(|map| format!("{name}_{map}")));
        let with_input: Vec<&str> = with_input.iter().flatten().map(String::as_str).collect();
        assert_eq!(sets(&with_input), [of("a", 3), of("b", 3), of("c", 3)]);
        assert_eq!(sets(&with_input[..6]), [of("a", 3), of("b", 3)]);
        assert_eq!(
            sets(&["a_Nout", "a_Dout", "a_2", "b_Nout", "b_Dout", "b_2"]),
            [],
            "whose are the others?"
        );
    }
}
