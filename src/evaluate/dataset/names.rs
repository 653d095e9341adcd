//! Names of predictions that are not those of the ground truths: which prediction is that of which material.

use std::collections::BTreeMap;

/// What tells a material in its name, among these names.
type Way = fn(&str, &[&str]) -> String;

/// The ways in which research codes name a prediction, the nearest one first: in other case, with a beginning or an end that all have, with
/// a counter behind it, with the same beginning.
const WAYS: [Way; 4] = [
    |name, _| name.to_lowercase(),
    |name, all| own_part(name, all).to_lowercase(),
    |name, all| without_counter(own_part(name, all)).to_lowercase(),
    |name, all| beginning(own_part(name, all)).to_lowercase(),
];

/// The prediction among `predictions` of each of `materials`, where none has the name of a material: by the first way that gives each
/// material that it matches one prediction and each prediction one material, and matches most.
pub(super) fn matched<'a>(materials: &[&'a str], predictions: &[&'a str]) -> BTreeMap<&'a str, &'a str> {
    let by = |way: &Way| {
        let [of_materials, of_predictions] = [materials, predictions].map(|names| keys(names, *way));
        let both = of_materials.into_iter().filter_map(|(key, one)| Some((one, *of_predictions.get(&key)?)));
        // A key that several of a side have, and one of the other, tells nothing about the others either.
        both.map(|(material, prediction)| material.zip(prediction)).collect::<Option<_>>().unwrap_or_default()
    };
    let found: Vec<BTreeMap<_, _>> = WAYS.iter().map(by).collect();
    let most = found.iter().map(BTreeMap::len).max().unwrap_or(0);
    found.into_iter().find(|pairs| pairs.len() == most).unwrap_or_default()
}

/// The names by what tells them; `None` where several have the same, unless it is all of the name of one.
fn keys<'a>(names: &[&'a str], way: Way) -> BTreeMap<String, Option<&'a str>> {
    let mut keys: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for name in names {
        keys.entry(way(name, names)).or_default().push(*name);
    }
    let only = |(key, all): (String, Vec<&'a str>)| {
        let whole = all.iter().copied().find(|name| name.to_lowercase() == key);
        let one = if let [one] = all[..] { Some(one) } else { whole };
        (key, one)
    };
    keys.into_iter().map(only).collect()
}

/// A name without what all of several names have at their beginning and their end, in whole words.
fn own_part<'a>(name: &'a str, all: &[&str]) -> &'a str {
    let Some((first, others)) = all.split_first().filter(|(_, others)| !others.is_empty()) else {
        return name;
    };
    let begins = |end: usize| others.iter().all(|other| other.starts_with(&first[..end]));
    let ends = |start: usize| others.iter().all(|other| other.ends_with(&first[start..]));
    let borders = || first.char_indices().filter(|(_, c)| !c.is_alphanumeric());
    let prefix = borders().map(|(at, c)| at + c.len_utf8()).filter(|end| begins(*end)).max().unwrap_or(0);
    let suffix = borders().map(|(at, _)| first.len() - at).filter(|length| ends(first.len() - length)).max();
    name.get(prefix..name.len().saturating_sub(suffix.unwrap_or(0)))
        .filter(|own| !own.is_empty())
        .unwrap_or(name)
}

/// A name without a number behind a separator at its end.
fn without_counter(name: &str) -> &str {
    let is_separator = |c: char| !c.is_alphanumeric();
    let trimmed = name.trim_end_matches(is_separator);
    let rest = trimmed.trim_end_matches(|c: char| c.is_ascii_digit());
    let is_counter = rest.len() < trimmed.len() && rest.ends_with(is_separator);
    let own = if is_counter { rest.trim_end_matches(is_separator) } else { trimmed };
    if own.is_empty() { name } else { own }
}

/// What stands before the first separator.
fn beginning(name: &str) -> &str {
    name.split(|c: char| !c.is_alphanumeric()).find(|part| !part.is_empty()).unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_matched_where_the_match_is_one_to_one() {
        type Row =
            (&'static [&'static str], &'static [&'static str], &'static [(&'static str, &'static str)]);
        let rows: [Row; 12] = [
            (&["Brick", "Wood"], &["brick", "wood"], &[("Brick", "brick"), ("Wood", "wood")]),
            (&["a", "b"], &["pred_a", "pred_b"], &[("a", "pred_a"), ("b", "pred_b")]),
            (&["m0", "m1"], &["m0_pred", "m1_pred"], &[("m0", "m0_pred"), ("m1", "m1_pred")]),
            (&["a", "b"], &["out_a_00001_", "out_b_00002_"], &[("a", "out_a_00001_"), ("b", "out_b_00002_")]),
            (&["01;Oak_x", "02;Tin_y"], &["01", "02"], &[("01;Oak_x", "01"), ("02;Tin_y", "02")]),
            // A common beginning within a word is a part of it.
            (&["0001", "0002"], &["0001_r", "0002_r"], &[("0001", "0001_r"), ("0002", "0002_r")]),
            // One material is not matched by another.
            (&["a", "b"], &["a_1"], &[("a", "a_1")]),
            (&["a"], &["b"], &[]),
            // Two candidates are none.
            (&["oak_1", "oak_2"], &["oak_a", "oak_b"], &[]),
            (&["01;x", "02;y"], &["01_a", "01_b", "02_a"], &[]),
            // What lies beside a material has its name and more.
            (&["01;x", "02;y"], &["01", "01_input", "02", "02_input"], &[("01;x", "01"), ("02;y", "02")]),
            // Other files of the folder.
            (&["01;x", "02;y"], &["01", "02", "gt_0", "gt_1"], &[("01;x", "01"), ("02;y", "02")]),
        ];
        for (materials, predictions, expected) in rows {
            let found: Vec<_> = matched(materials, predictions).into_iter().collect();
            assert_eq!(found, expected, "{materials:?} {predictions:?}");
        }
    }
}
