//! The layers of `src/`: arrows between files go down, and nowhere in a circle.

mod graph;
mod source;

use std::fs;
use std::path::Path;

use graph::{Arrow, Tree, circles};

/// From the bottom to the top. A module belongs to the longest name that it begins with; files of one layer may use one
/// another.
const LAYERS: [&[&str]; 14] = [
    &["error", "progress", "text"],
    &["math"],
    &["image"],
    &["model"],
    &["material"],
    &["render"],
    &["files/atomic"],
    &["picture"],
    &["files"],
    &["loss"],
    &["dataset", "metrics", "photograph", "rank", "report", "samples", "study", "why"],
    &["gpu"],
    &["viewer"],
    &["cli", "lib", "main"],
];

/// The number of the layer of a file below `src`.
fn layer(file: &str) -> usize {
    let belongs =
        |name: &&str| file.strip_prefix(*name).is_some_and(|rest| rest.starts_with('/') || rest == ".rs");
    let longest = |layer: &[&str]| layer.iter().filter(|name| belongs(name)).map(|name| name.len()).max();
    let all = LAYERS.iter().enumerate().filter_map(|(i, names)| longest(names).map(|length| (length, i)));
    all.max().unwrap_or_else(|| panic!("src/{file} belongs to no layer")).1
}

fn upward(arrows: &[Arrow]) -> Vec<String> {
    let up = arrows.iter().filter(|arrow| layer(&arrow.from) < layer(&arrow.to));
    up.map(|arrow| format!("{} uses {}", arrow.from, arrow.to)).collect()
}

/// The files of a circle, and which uses which.
fn told(circle: &[String], arrows: &[Arrow]) -> String {
    let within =
        |arrow: &&Arrow| !arrow.passed_on && circle.contains(&arrow.from) && circle.contains(&arrow.to);
    let lines = arrows.iter().filter(within).map(|arrow| format!("\n    {} uses {}", arrow.from, arrow.to));
    format!("\n{circle:?}:{}", lines.collect::<String>())
}

fn read(folder: &Path, files: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            read(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
            let name = path.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/");
            files.push((name, fs::read_to_string(path).unwrap()));
        }
    }
}

fn source_tree() -> Vec<Arrow> {
    let mut files = Vec::new();
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut files);
    let arrows = Tree::new(files).arrows();
    assert!(arrows.len() > 500, "only {} arrows were found", arrows.len());
    arrows
}

#[test]
fn no_file_uses_a_layer_above_its_own() {
    assert_eq!(upward(&source_tree()), Vec::<String>::new());
}

#[test]
fn no_files_use_one_another_in_a_circle() {
    let arrows = source_tree();
    let found: String = circles(&arrows).iter().map(|circle| told(circle, &arrows)).collect();
    assert!(found.is_empty(), "circles:{found}");
}

/// The arrows between the planted files.
fn planted<const N: usize>(files: [(&str, &str); N]) -> Vec<Arrow> {
    Tree::new(files).arrows()
}

#[test]
fn a_planted_arrow_upward_is_found_in_a_use_line_and_in_an_inline_path() {
    let loss = ("loss/mod.rs", "pub struct Loss;");
    for user in [
        "use crate::loss::Loss;",
        "use crate::{error::Error, loss::{self as other, Loss}};",
        "pub(crate) use super::loss::Loss as Renamed;",
        "fn f() { let _ = crate::loss::Loss; }",
        "use crate::loss; fn f(_: &'static loss::Loss) {}",
        "use crate::loss::*;",
    ] {
        let arrows = planted([loss, ("material/mod.rs", user), ("error.rs", "pub struct Error;")]);
        assert_eq!(upward(&arrows), ["material/mod.rs uses loss/mod.rs"], "{user}");
    }
}

#[test]
fn what_is_no_code_of_the_program_is_no_arrow() {
    let loss = ("loss/mod.rs", "pub struct Loss;");
    for user in [
        "// use crate::loss::Loss;\n/* use crate::loss::Loss; */",
        "const TEXT: &str = \"\\\" use crate::loss::Loss;\"; const QUOTE: char = '\"';",
        "const TEXT: &str = r#\"\"use crate::loss::Loss;\"#;",
        "#[cfg(test)] mod tests { use crate::loss::Loss; fn f() { {} } }",
        "#[cfg(test)] use crate::loss::Loss;",
        "use other::loss::Loss; fn f() { other::loss::Loss; }",
    ] {
        assert_eq!(planted([loss, ("material/mod.rs", user)]), [], "{user}");
    }
}

#[test]
fn an_item_belongs_to_the_file_that_defines_it_not_to_the_one_that_re_exports_it() {
    let files = [
        ("loss/mod.rs", "mod sums; pub use sums::Sum; pub use crate::math::real::Real as Number;"),
        ("loss/sums.rs", "pub struct Sum;"),
        ("math/real.rs", "pub trait Real {}"),
        ("render/mod.rs", "use crate::loss::Number;"),
        ("viewer/mod.rs", "use crate::loss::{Number, Sum};"),
    ];
    let arrows = planted(files);
    let from = |file| arrows.iter().filter(move |arrow| arrow.from == file).map(|arrow| arrow.to.as_str());
    assert_eq!(from("viewer/mod.rs").collect::<Vec<_>>(), ["loss/sums.rs", "math/real.rs"]);
    assert_eq!(upward(&arrows), Vec::<String>::new());
}

#[test]
fn planted_circles_are_found() {
    let pair =
        [("model/a.rs", "use super::b::B; pub struct A;"), ("model/b.rs", "use super::a::A; pub struct B;")];
    assert_eq!(circles(&planted(pair)), [["model/a.rs", "model/b.rs"]]);

    let three = [
        ("model/a.rs", "use super::b::B; pub struct A;"),
        ("model/b.rs", "pub struct B; fn f() { super::c::C; }"),
        ("model/c.rs", "use crate::model::a; pub struct C(a::A);"),
    ];
    assert_eq!(circles(&planted(three)), [["model/a.rs", "model/b.rs", "model/c.rs"]]);

    let parent = [
        ("model/mod.rs", "mod a; use a::A; pub struct Parent(A);"),
        ("model/a.rs", "use super::Parent; pub struct A;"),
    ];
    assert_eq!(circles(&planted(parent)), [["model/a.rs", "model/mod.rs"]]);
    let inline = [
        ("model/mod.rs", "mod a; pub struct Parent; fn f() { a::f() }"),
        ("model/a.rs", "use super::Parent; pub fn f() {}"),
    ];
    assert_eq!(circles(&planted(inline)), [["model/a.rs", "model/mod.rs"]]);
    let program =
        [("cli/mod.rs", "mod a; fn f() { a::f() } pub fn g() {}"), ("cli/a.rs", "pub fn f() { super::g() }")];
    assert_eq!(circles(&planted(program)), [["cli/a.rs", "cli/mod.rs"]]);
}

#[test]
fn a_parent_that_only_declares_and_re_exports_its_children_is_in_no_circle() {
    let files = [
        ("model/mod.rs", "pub mod a; mod b; pub use b::B; pub struct Parent;"),
        ("model/a.rs", "use super::{Parent, b::B}; pub struct A;"),
        ("model/b.rs", "use super::Parent; pub struct B;"),
    ];
    assert_eq!(circles(&planted(files)), Vec::<Vec<String>>::new());
}
