//! Outputs never replace the files that they are made from.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use image::{GrayImage, Luma};

use super::{fail, folder, succeed};

/// Every file of a folder with its bytes.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files = entries.filter(|path| path.is_file());
    files
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read(&path).unwrap()))
        .collect()
}

#[test]
fn an_output_does_not_replace_a_file_that_was_read() {
    let folder = folder();
    fs::copy(folder.path().join("gt.png"), folder.path().join("photo.png")).unwrap();
    GrayImage::from_pixel(8, 8, Luma([99])).save(folder.path().join("rough.png")).unwrap();
    succeed(folder.path(), "convert gt.png gt.exr");
    succeed(folder.path(), "convert gt.png m.glb");
    succeed(folder.path(), "convert gt.png m.mtlx");
    let before = contents(folder.path());
    for args in [
        "render gt.png -o gt.png",
        "render gt.png -o ./gt.png",
        "render gt.exr -o gt.exr",
        "strip gt.png a.png -o a.png",
        "map gt.png a.png -o gt.png --near 4 --distant 4",
        "map gt.png a.png -o a.png --over lights --side 4",
        "photo photo.png gt.png --flash --fov 45 -o photo.png",
        "photo photo.png gt.png --flash --fov 45 -o gt.png",
        "study gt.png a.png --plot gt.png",
        "convert a.png a.png",
        "convert m.glb m.glb",
        "convert m.mtlx m.mtlx",
        "convert gt.png rough.png --map roughness=rough.png",
    ] {
        let error = fail(folder.path(), args, 1);
        assert!(error.contains("made from") && error.contains("name another file"), "{args}: {error}");
    }
    assert!(contents(folder.path()) == before, "a file has changed");
    succeed(folder.path(), "render gt.png -o b.png");
}

#[test]
fn an_output_does_not_replace_a_map_of_a_set_or_a_document() {
    let folder = folder();
    let at = folder.path();
    succeed(at, "convert gt.png set");
    fs::write(at.join("m.mtl"), "newmtl m\nmap_Kd set/diffuse.png\nmap_Pr set/roughness.png\n").unwrap();
    let before = contents(&at.join("set"));
    let names: Vec<_> = before.keys().cloned().collect();
    assert_eq!(names.len(), 4);
    for name in &names {
        fail(at, &format!("render set -o set/{name}"), 1);
    }
    fail(at, "render m.mtl -o set/diffuse.png", 1);
    assert!(contents(&at.join("set")) == before, "a map has changed");
}

#[cfg(unix)]
#[test]
fn an_output_does_not_replace_an_input_through_a_link() {
    let folder = folder();
    let at = folder.path();
    std::os::unix::fs::symlink("gt.png", at.join("soft.png")).unwrap();
    fs::hard_link(at.join("gt.png"), at.join("hard.png")).unwrap();
    let before = contents(at);
    for output in ["soft.png", "hard.png"] {
        fail(at, &format!("render gt.png -o {output}"), 1);
    }
    assert!(contents(at) == before, "a file has changed");
}

#[test]
fn the_extension_of_a_table_is_checked() {
    let folder = folder();
    let error = fail(folder.path(), "study gt.png a.png -o b.png", 64);
    assert!(error.contains("use one of: .csv"), "{error}");
}
