//! The layers of `src/`: arrows between files go down, nowhere in a circle, not even between folders; and no type is spread over
//! many files. The compiler guards what the crates may use of one another.

mod graph;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use graph::{Arrow, CRATES, Source, arrows, circles};

/// From the bottom to the top. A module belongs to the longest name that it begins with; files of one layer may use one
/// another.
const LAYERS: [&[&str]; 22] = [
    &["core/choices", "core/error", "core/parallel", "core/progress", "core/text"],
    &["core/math"],
    &["core/statistics"],
    &["core/image"],
    &["core/model"],
    &["core/material"],
    &["core/render"],
    &["core/picture"],
    &["core/loss"],
    &["core/lib"],
    &["files"],
    &["evaluate/error"],
    &["evaluate/registration"],
    &["evaluate/diagnose", "evaluate/metrics", "evaluate/rank", "evaluate/why"],
    &["evaluate"],
    &["page"],
    &["gpu"],
    &["viewer/error", "viewer/message"],
    &["viewer/model"],
    &["viewer/jobs"],
    &["viewer"],
    &["cli", "lib", "main"],
];

/// Most files with inherent methods of one type.
const FILES_OF_A_TYPE: usize = 3;

/// The number of the layer of a file below `src`.
fn layer(file: &str) -> usize {
    let belongs =
        |name: &&str| file.strip_prefix(*name).is_some_and(|rest| rest.starts_with('/') || rest == ".rs");
    let longest = |layer: &[&str]| layer.iter().filter(|name| belongs(name)).map(|name| name.len()).max();
    let all = LAYERS.iter().enumerate().filter_map(|(i, names)| longest(names).map(|length| (length, i)));
    all.max().unwrap_or_else(|| panic!("src/{file} belongs to no layer")).1
}

fn upward(arrows: &[Arrow]) -> Vec<&Arrow> {
    arrows.iter().filter(|arrow| layer(&arrow.from) < layer(&arrow.to)).collect()
}

fn read(folder: &Path, files: &mut Vec<(String, Source)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            read(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
            let name = path.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/");
            files.push((name, Source::new(&fs::read_to_string(path).unwrap())));
        }
    }
}

/// The arrows between folders. A file at the root of a crate stands for itself.
fn of_folders(arrows: &[Arrow]) -> Vec<Arrow> {
    let folder = |file: &String| match file.rsplit_once('/') {
        Some((folder, _)) if !CRATES.contains(&folder) => folder.to_owned(),
        _ => file.clone(),
    };
    let between = arrows.iter().filter(|arrow| !arrow.passed_on).map(|arrow| Arrow {
        from: folder(&arrow.from),
        to: folder(&arrow.to),
        passed_on: false,
    });
    between.filter(|arrow| arrow.from != arrow.to).collect::<BTreeSet<_>>().into_iter().collect()
}

/// The types of a crate with inherent methods in many files, and these files.
fn spread_types(files: &[(String, Source)]) -> BTreeMap<(String, String), BTreeSet<&str>> {
    let mut files_of: BTreeMap<_, BTreeSet<&str>> = BTreeMap::new();
    for (file, source) in files {
        let part = file.split('/').next().unwrap_or_default();
        for name in &source.inherent_types {
            files_of.entry((part.to_owned(), name.clone())).or_default().insert(file);
        }
    }
    files_of.retain(|_, files| files.len() > FILES_OF_A_TYPE);
    files_of
}

#[test]
fn files_use_those_of_lower_layers_and_no_circle_and_no_spread_type_is_there() {
    let mut files = Vec::new();
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut files);
    let arrows = arrows(&files);
    assert!(arrows.len() > 500, "only {} arrows were found", arrows.len());
    assert_eq!(upward(&arrows), Vec::<&Arrow>::new());
    assert_eq!(circles(&arrows), Vec::<Vec<Arrow>>::new());
    assert_eq!(circles(&of_folders(&arrows)), Vec::<Vec<Arrow>>::new());
    assert_eq!(spread_types(&files), BTreeMap::new());
}

/// The arrows between planted files.
fn planted<const N: usize>(files: [(&str, &str); N]) -> Vec<Arrow> {
    arrows(&files.map(|(name, text)| (name.to_owned(), Source::new(text))))
}

#[test]
fn planted_arrows_and_circles_are_found() {
    for (user, is_upward) in [
        ("use crate::{math::Real, loss::{self as other, Loss}};", true),
        ("fn f() { println!(\"{:?}\", crate::loss::Loss) }", true),
        ("use crate::loss; fn f(_: &'static loss::Loss) {}", true),
        ("use svbrdf_core::loss::Loss;", true),
        ("use crate::loss::Number;", false),
        ("use other::loss::Loss;", false),
        ("#[cfg(test)] mod tests { use crate::loss::Loss; }", false),
    ] {
        let arrows = planted([
            ("core/loss/mod.rs", "mod sums; pub use sums::Loss; pub use crate::math::Real as Number;"),
            ("core/loss/sums.rs", "pub struct Loss;"),
            ("core/math/mod.rs", "pub trait Real {}"),
            ("core/material/mod.rs", user),
        ]);
        let found: Vec<_> = upward(&arrows).into_iter().map(|arrow| arrow.to.as_str()).collect();
        assert_eq!(found, &["core/loss/sums.rs"][..usize::from(is_upward)], "{user}");
    }
    let users = |arrows: &[Arrow]| -> Vec<String> {
        circles(arrows).into_iter().flatten().map(|arrow| arrow.from).collect()
    };
    // A parent that only declares and re-exports its children is in no circle.
    let of_files = planted([
        ("core/model/mod.rs", "pub mod a; mod b; pub use b::B; pub struct Parent;"),
        ("core/model/a.rs", "use super::{Parent, b::B}; pub struct A;"),
        ("core/model/b.rs", "pub struct B; fn f() { super::a::A; }"),
    ]);
    assert_eq!(users(&of_files), ["core/model/a.rs", "core/model/b.rs"]);
    let of_two_folders = planted([
        ("core/loss/mod.rs", "pub mod fused; pub mod sums;"),
        ("core/loss/sums.rs", "use super::fused::tile::Tile; pub struct Sum(Tile);"),
        ("core/loss/fused/tile.rs", "pub struct Tile;"),
        ("core/loss/fused/pass.rs", "use crate::loss::sums::Sum; pub struct Pass(Sum);"),
    ]);
    assert_eq!(users(&of_two_folders), [""; 0], "no files use one another");
    assert_eq!(users(&of_folders(&of_two_folders)), ["core/loss", "core/loss/fused"]);
}
