//! Names that tell materials apart.

use std::path::{Component, Path};

use svbrdf_core::text::line;

/// The names of materials, told apart: equal names take as many of the last parts of their paths as
/// that needs. The same path twice has the same name twice. Every name is a [`line`].
pub fn distinct_names(named: &[(&str, &Path)]) -> Vec<String> {
    let one = |&(name, path): &(&str, &Path)| {
        let clash: Vec<_> =
            named.iter().filter(|other| other.0 == name).map(|other| parts(other.1)).collect();
        let own = parts(path);
        let differ = |count: &usize| {
            let alike = |other: &&Vec<String>| last(other, *count) == last(&own, *count);
            clash.iter().filter(alike).all(|other| *other == own)
        };
        if clash.len() == 1 || clash.iter().all(|other| *other == own) {
            return name.to_owned();
        }
        let longest = clash.iter().map(Vec::len).max().unwrap_or(1);
        let count = (1..=longest).find(differ).unwrap_or(longest);
        last(&own, count).join("/")
    };
    named.iter().map(|material| line(&one(material))).collect()
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
    fn as_many_parts_of_a_path_as_it_takes() {
        assert_eq!(names([("gt", "gt.png"), ("a", "x/a.png")]), ["gt", "a"]);
        let runs = [("gt", "gt.png"), ("out", "runA/out"), ("out", "runB/out/")];
        assert_eq!(names(runs), ["gt", "runA/out", "runB/out"]);
        assert_eq!(names([("a", "a.png"), ("a", "a.exr")]), ["a.png", "a.exr"]);
        assert_eq!(names([("m", "x/1/m"), ("m", "y/1/m"), ("m", "y/2/m")]), ["x/1/m", "y/1/m", "2/m"]);
        assert_eq!(names([("m", "x/m"), ("m", "x/../x/m")]), ["m", "m"]);
        assert_eq!(names([("m", "/m"), ("m", "/x/m")]), ["m", "x/m"]);
    }
}
