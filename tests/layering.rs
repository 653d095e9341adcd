//! The layers of `src/`: arrows between files go down, nowhere in a circle, not even between folders; and no type is spread over
//! many files. The compiler guards what the crates may use of one another.

mod graph;
mod source;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use graph::{Arrow, Tree, circles};

/// From the bottom to the top. A module belongs to the longest name that it begins with; files of one layer may use one
/// another.
const LAYERS: [&[&str]; 18] = [
    &["core/error", "core/progress", "core/text"],
    &["core/math"],
    &["core/statistics"],
    &["core/image"],
    &["core/model"],
    &["core/material"],
    &["core/render"],
    &["core/picture"],
    &["core/loss"],
    &["core/diagnose", "core/metrics", "core/rank", "core/report", "core/study", "core/why"],
    &["core/lib"],
    &["files"],
    &["gpu"],
    &["backend", "signals"],
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

fn source_files() -> Vec<(String, String)> {
    let mut files = Vec::new();
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut files);
    files
}

fn source_tree() -> Vec<Arrow> {
    let arrows = Tree::new(source_files()).arrows();
    assert!(arrows.len() > 500, "only {} arrows were found", arrows.len());
    arrows
}

/// The arrows between folders. A file at the root of a crate stands for itself.
fn of_folders(arrows: &[Arrow]) -> Vec<Arrow> {
    let folder = |file: &String| match file.rsplit_once('/') {
        None | Some(("core" | "files" | "gpu", _)) => file.clone(),
        Some((folder, _)) => folder.to_owned(),
    };
    let between = arrows.iter().filter(|arrow| !arrow.passed_on).map(|arrow| Arrow {
        from: folder(&arrow.from),
        to: folder(&arrow.to),
        passed_on: false,
    });
    between.filter(|arrow| arrow.from != arrow.to).collect::<BTreeSet<_>>().into_iter().collect()
}

/// The circles between folders, with the files that make them.
fn folder_circles(arrows: &[Arrow]) -> String {
    let folders = of_folders(arrows);
    circles(&folders).iter().map(|circle| told(circle, &folders)).collect()
}

/// The types with inherent methods in many files, and these files.
fn spread_types(files: &[(String, String)]) -> Vec<String> {
    let mut files_of: BTreeMap<(String, String), BTreeSet<&str>> = BTreeMap::new();
    for (file, text) in files {
        let part = file.split('/').next().unwrap_or_default();
        for name in source::inherent_types(text) {
            files_of.entry((part.to_owned(), name)).or_default().insert(file);
        }
    }
    let many = files_of.into_iter().filter(|(_, files)| files.len() > FILES_OF_A_TYPE);
    many.map(|((part, name), files)| format!("{name} of {part}: {files:?}")).collect()
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

#[test]
fn no_folders_use_one_another_in_a_circle() {
    let found = folder_circles(&source_tree());
    assert!(found.is_empty(), "circles:{found}");
}

#[test]
fn no_type_has_inherent_methods_in_more_than_three_files() {
    assert_eq!(spread_types(&source_files()), Vec::<String>::new());
}

#[test]
fn planted_circles_of_folders_are_found() {
    let arrows = planted([
        ("core/loss/mod.rs", "pub mod fused; pub mod sums; pub struct Loss;"),
        ("core/loss/sums.rs", "use super::fused::tile::Tile; pub struct Sum(Tile);"),
        ("core/loss/fused/mod.rs", "pub mod tile; pub mod pass;"),
        ("core/loss/fused/tile.rs", "pub struct Tile;"),
        ("core/loss/fused/pass.rs", "use crate::loss::sums::Sum; pub struct Pass(Sum);"),
    ]);
    assert_eq!(circles(&arrows), Vec::<Vec<String>>::new(), "no files use one another");
    assert_eq!(circles(&of_folders(&arrows)), [["core/loss", "core/loss/fused"]]);
}

#[test]
fn a_planted_type_of_many_files_is_found() {
    let other = "impl fmt::Display for App {} impl<T: Into<App>> Other<T> { fn f() -> impl Sized {} }";
    let file = |n: usize| (format!("viewer/{n}.rs"), format!("impl App {{ fn f{n}() {{}} }} {other}"));
    let files: Vec<_> = (0..4).map(file).collect();
    assert_eq!(spread_types(&files[..3]), Vec::<String>::new());
    let found = spread_types(&files);
    assert!(found.len() == 2 && found[0].starts_with("App of viewer"), "{found:?}");
}

#[test]
fn arrows_between_crates_are_found() {
    let files = [
        ("core/lib.rs", "pub mod loss;"),
        ("core/loss/mod.rs", "pub struct Loss;"),
        ("files/lib.rs", "mod read; use svbrdf_core::loss;"),
        ("files/read/mod.rs", "use crate::loss::Loss; use svbrdf_core::loss::Loss as Same;"),
        ("lib.rs", "pub use svbrdf_core::loss::Loss;"),
        ("main.rs", "mod cli;"),
        ("cli/mod.rs", "use svbrdf::Loss;"),
    ];
    let arrows = planted(files);
    let to = |from| arrows.iter().filter(move |a| a.from == from).map(|a| a.to.as_str()).collect::<Vec<_>>();
    assert_eq!([to("files/read/mod.rs"), to("cli/mod.rs")], [["core/loss/mod.rs"], ["core/loss/mod.rs"]]);
}

/// The arrows between the planted files.
fn planted<const N: usize>(files: [(&str, &str); N]) -> Vec<Arrow> {
    Tree::new(files).arrows()
}

#[test]
fn a_planted_arrow_upward_is_found_in_a_use_line_and_in_an_inline_path() {
    let loss = ("core/loss/mod.rs", "pub struct Loss;");
    for user in [
        "use crate::loss::Loss;",
        "use crate::{error::Error, loss::{self as other, Loss}};",
        "pub(crate) use super::loss::Loss as Renamed;",
        "fn f() { let _ = crate::loss::Loss; }",
        "use crate::loss; fn f(_: &'static loss::Loss) {}",
        "use crate::loss::*;",
    ] {
        let arrows = planted([loss, ("core/material/mod.rs", user), ("core/error.rs", "pub struct Error;")]);
        assert_eq!(upward(&arrows), ["core/material/mod.rs uses core/loss/mod.rs"], "{user}");
    }
}

#[test]
fn what_is_no_code_of_the_program_is_no_arrow() {
    let loss = ("core/loss/mod.rs", "pub struct Loss;");
    for user in [
        "// use crate::loss::Loss;\n/* use crate::loss::Loss; */",
        "const TEXT: &str = \"\\\" use crate::loss::Loss;\"; const QUOTE: char = '\"';",
        "const TEXT: &str = r#\"\"use crate::loss::Loss;\"#;",
        "#[cfg(test)] mod tests { use crate::loss::Loss; fn f() { {} } }",
        "#[cfg(test)] use crate::loss::Loss;",
        "use other::loss::Loss; fn f() { other::loss::Loss; }",
    ] {
        assert_eq!(planted([loss, ("core/material/mod.rs", user)]), [], "{user}");
    }
}

#[test]
fn an_item_belongs_to_the_file_that_defines_it_not_to_the_one_that_re_exports_it() {
    let files = [
        ("core/loss/mod.rs", "mod sums; pub use sums::Sum; pub use crate::math::real::Real as Number;"),
        ("core/loss/sums.rs", "pub struct Sum;"),
        ("core/math/real.rs", "pub trait Real {}"),
        ("core/render/mod.rs", "use crate::loss::Number;"),
        ("viewer/mod.rs", "use svbrdf_core::loss::{Number, Sum};"),
    ];
    let arrows = planted(files);
    let from = |file| arrows.iter().filter(move |arrow| arrow.from == file).map(|arrow| arrow.to.as_str());
    assert_eq!(from("viewer/mod.rs").collect::<Vec<_>>(), ["core/loss/sums.rs", "core/math/real.rs"]);
    assert_eq!(upward(&arrows), Vec::<String>::new());
}

#[test]
fn planted_circles_are_found() {
    let pair = [
        ("core/model/a.rs", "use super::b::B; pub struct A;"),
        ("core/model/b.rs", "use super::a::A; pub struct B;"),
    ];
    assert_eq!(circles(&planted(pair)), [["core/model/a.rs", "core/model/b.rs"]]);

    let three = [
        ("core/model/a.rs", "use super::b::B; pub struct A;"),
        ("core/model/b.rs", "pub struct B; fn f() { super::c::C; }"),
        ("core/model/c.rs", "use crate::model::a; pub struct C(a::A);"),
    ];
    assert_eq!(circles(&planted(three)), [["core/model/a.rs", "core/model/b.rs", "core/model/c.rs"]]);

    let parent = [
        ("core/model/mod.rs", "mod a; use a::A; pub struct Parent(A);"),
        ("core/model/a.rs", "use super::Parent; pub struct A;"),
    ];
    assert_eq!(circles(&planted(parent)), [["core/model/a.rs", "core/model/mod.rs"]]);
    let inline = [
        ("core/model/mod.rs", "mod a; pub struct Parent; fn f() { a::f() }"),
        ("core/model/a.rs", "use super::Parent; pub fn f() {}"),
    ];
    assert_eq!(circles(&planted(inline)), [["core/model/a.rs", "core/model/mod.rs"]]);
    let program =
        [("cli/mod.rs", "mod a; fn f() { a::f() } pub fn g() {}"), ("cli/a.rs", "pub fn f() { super::g() }")];
    assert_eq!(circles(&planted(program)), [["cli/a.rs", "cli/mod.rs"]]);
}

#[test]
fn a_parent_that_only_declares_and_re_exports_its_children_is_in_no_circle() {
    let files = [
        ("core/model/mod.rs", "pub mod a; mod b; pub use b::B; pub struct Parent;"),
        ("core/model/a.rs", "use super::{Parent, b::B}; pub struct A;"),
        ("core/model/b.rs", "use super::Parent; pub struct B;"),
    ];
    assert_eq!(circles(&planted(files)), Vec::<Vec<String>>::new());
}
