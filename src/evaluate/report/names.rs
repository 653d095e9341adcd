//! Names that tell materials apart.

use std::path::{Component, Path};

use svbrdf_core::text::line;

/// The names of materials, told apart: equal names are replaced by the part of their paths that tells them apart, such as the
/// folder of a method, or where it takes several by those. The same path twice has the same name twice. Every name is a [`line()`].
pub fn distinct_names(named: &[(&str, &Path)]) -> Vec<String> {
    let all: Vec<_> = named.iter().map(|(name, path)| (*name, parts(path))).collect();
    let short: Vec<String> = all.iter().map(|one| name(one, &all, true)).collect();
    let is_taken = |index: usize| {
        (0..all.len()).any(|other| short[other] == short[index] && all[other].1 != all[index].1)
    };
    let of =
        |index: usize| if is_taken(index) { name(&all[index], &all, false) } else { short[index].clone() };
    (0..all.len()).map(|index| line(&of(index))).collect()
}

/// A name with its path in parts.
type Named<'a> = (&'a str, Vec<String>);

/// The name of one of `all`; where it is `short`, without the parts of its path that all with its name have.
fn name((name, own): &Named<'_>, all: &[Named<'_>], short: bool) -> String {
    let clash: Vec<&Vec<String>> =
        all.iter().filter(|other| other.0 == *name).map(|other| &other.1).collect();
    if clash.iter().all(|other| *other == own) {
        return (*name).to_owned();
    }
    let longest = clash.iter().map(|parts| parts.len()).max().unwrap_or(1);
    let is_own =
        |count: usize| clash.iter().all(|other| last(other, count) != last(own, count) || *other == own);
    let count = (1..=longest).find(|count| is_own(*count)).unwrap_or(longest);
    let whole = last(own, count);
    if !short {
        return whole.join("/");
    }
    let part = |parts: &Vec<String>, back: usize| parts.iter().rev().nth(back).cloned();
    let tells_apart = |back: &usize| {
        let differ = |one: &&Vec<String>| {
            let found = part(one, *back);
            found.is_some() && clash.iter().all(|other| part(other, *back) != found || other == one)
        };
        clash.iter().all(differ)
    };
    if let Some(found) = (0..longest).find(tells_apart).and_then(|back| part(own, back)) {
        return found;
    }
    let is_common = |back: &usize| clash.iter().all(|other| part(other, *back) == part(own, *back));
    let common = (0..longest).take_while(is_common).count();
    let least = clash.iter().map(|parts| parts.len()).min().unwrap_or(0);
    let cut = if common < least.min(count) { common } else { 0 };
    whole[..whole.len() - cut].join("/")
}

/// The parts of a path from the root on.
fn parts(path: &Path) -> Vec<String> {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut parts = Vec::new();
    for component in absolute.components() {
        match component {
            Component::Normal(part) => parts.push(part.to_string_lossy().into_owned()),
            Component::ParentDir => drop(parts.pop()),
            _ => {}
        }
    }
    parts
}

fn last(parts: &[String], count: usize) -> &[String] {
    &parts[parts.len().saturating_sub(count)..]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names<const N: usize>(named: [(&str, &str); N]) -> [String; N] {
        let all: Vec<_> = named.iter().map(|(name, path)| (*name, Path::new(*path))).collect();
        distinct_names(&all).try_into().unwrap()
    }

    #[test]
    fn the_parts_of_a_path_that_it_takes() {
        assert_eq!(names([("gt", "gt.png"), ("a", "x/a.png")]), ["gt", "a"]);
        let runs = [("gt", "gt.png"), ("out", "runA/out"), ("out", "runB/out/")];
        assert_eq!(names(runs), ["gt", "runA", "runB"]);
        assert_eq!(names([("a", "a.png"), ("a", "a.exr")]), ["a.png", "a.exr"]);
        assert_eq!(names([("m", "x/1/m"), ("m", "y/1/m"), ("m", "y/2/m")]), ["x/1", "y/1", "2"]);
        assert_eq!(names([("m", "x/m"), ("m", "x/../x/m")]), ["m", "m"]);
        assert_eq!(names([("m", "/m"), ("m", "/x/m")]), ["m", "x/m"]);
        let methods = [("tiles", "gt/tiles.png"), ("tiles", "ours/tiles.png"), ("tiles", "theirs/tiles.png")];
        assert_eq!(names(methods), ["gt", "ours", "theirs"]);
        // What tells them apart is the name of another one.
        let taken = [("ours", "ours.png"), ("m", "ours/m"), ("m", "gt/m")];
        assert_eq!(names(taken), ["ours", "ours/m", "gt"]);
    }
}
