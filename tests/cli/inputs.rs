//! Outputs never replace the files that they are made from.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use image::{GrayImage, Luma};

use super::{assert_has, fail, files, folder, succeed};

/// Every file of a folder with its bytes.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let named = files(folder).into_iter().filter(|name| folder.join(name).is_file());
    named.map(|name| (name.clone(), fs::read(folder.join(name)).unwrap())).collect()
}

#[test]
fn an_output_does_not_replace_a_file_that_was_read() {
    let folder = folder();
    let at = folder.path();
    fs::copy(at.join("gt.png"), at.join("photo.png")).unwrap();
    GrayImage::from_pixel(8, 8, Luma([99])).save(at.join("rough.png")).unwrap();
    for out in ["gt.exr", "m.glb", "m.mtlx", "set"] {
        succeed(at, &format!("convert gt.png {out}"));
    }
    fs::write(at.join("m.mtl"), "newmtl m\nmap_Kd set/diffuse.png\nmap_Pr set/roughness.png\n").unwrap();
    let before = [contents(at), contents(&at.join("set"))];
    assert_eq!(before[1].len(), 4);
    let maps = before[1].keys().map(|name| format!("render set -o set/{name}"));
    let others = [
        "render gt.png -o gt.png",
        "render gt.png -o ./gt.png",
        "render gt.exr -o gt.exr",
        "render m.mtl -o set/diffuse.png",
        "strip gt.png a.png -o a.png",
        "map gt.png a.png -o gt.png --near 4 --distant 4",
        "map gt.png a.png -o a.png --over lights --side 4",
        "photo photo.png gt.png --view 0,0,2 --light 0,0,2 -o photo.png",
        "photo photo.png gt.png --view 0,0,2 --light 0,0,2 -o gt.png",
        "study gt.png a.png --plot gt.png",
        "convert a.png a.png",
        "convert m.glb m.glb",
        "convert m.mtlx m.mtlx",
        "convert gt.png rough.png --map roughness=rough.png",
    ];
    for args in others.map(str::to_owned).into_iter().chain(maps) {
        assert_has(&fail(at, &args, 1), &["made from", "name another file"]);
    }
    assert!([contents(at), contents(&at.join("set"))] == before, "a file has changed");
    succeed(at, "render gt.png -o b.png");
    assert_has(&fail(at, "study gt.png a.png -o b.png", 64), &["use .csv"]);
}
