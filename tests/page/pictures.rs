//! The pictures of pages in the documentation.

use std::fs;
use std::path::Path;

use super::browser::Page;
use super::ranking::READY;
use crate::support::surroundings::command;

/// Runs a program with these words in a folder.
fn run(folder: &Path, program: &str, words: &str) {
    let status = command(program).args(words.split(' ')).current_dir(folder).status().unwrap();
    assert!(status.success(), "{program} {words}");
}

#[test]
#[ignore = "writes assets/pictures/{report,ranking}.jpg: cargo xtask bless pages"]
fn write_the_pictures_of_pages() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (folder, program) = (tempfile::tempdir().unwrap(), env!("CARGO_BIN_EXE_svbrdf"));
    let html = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    run(folder.path(), program, "report -o report.html");
    let mut page = Page::open(&html("report.html"), [1366, 1180]);
    page.save_jpeg(&root.join("assets/pictures/report.jpg"));
    drop(page);
    run(folder.path(), "python3", root.join("python/examples/make_materials.py").to_str().unwrap());
    let rank =
        "rank --dataset gt soft plain sharp --read sharp:roughness=alpha --figures all -o ranking.html";
    run(folder.path(), program, rank);
    let mut page = Page::open_until(&html("ranking.html"), [1100, 860], READY);
    page.evaluate("document.querySelector('.sheet').scrollIntoView()");
    page.save_jpeg(&root.join("assets/pictures/ranking.jpg"));
}
