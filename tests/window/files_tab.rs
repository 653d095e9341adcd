//! The tab that shows how each material was read.

use super::*;

#[needs(adapter)]
fn a_file_of_several_materials_has_a_chooser() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.mtl");
    for (name, rgb) in [("red", [180, 0, 0]), ("green", [0, 180, 0])] {
        let picture = image::RgbImage::from_pixel(8, 8, rgb.into());
        picture.save(folder.path().join(format!("{name}.png"))).unwrap();
    }
    let text = "newmtl red\nmap_Kd red.png\nPr 0.2\nnewmtl green\nmap_Kd green.png\nPr 0.7\n";
    std::fs::write(&path, text).unwrap();
    let mut window = on_files([path]);
    tab(&mut window, "Files");
    let diffuse = |app: &App| app.materials().next().unwrap().texel(0).diffuse;
    assert_eq!((diffuse(window.state())[0] > 0.0, diffuse(window.state())[1] > 0.0), (true, false));
    let name = window.state().names()[0].clone();
    choose(&mut window, &format!("material of {name}"), "1: green");
    wait(&mut window, "the other material", |app| !app.is_reading() && diffuse(app)[1] > 0.0);
    assert_eq!(diffuse(window.state())[0], 0.0);
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
}
