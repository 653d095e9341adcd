//! The tab that shows how each material was read.

use super::materials::{SIDE, strip};
use super::*;

#[needs(adapter)]
#[test]
fn each_map_has_one_line_a_badge_where_it_is_unsure_and_folded_drop_downs() {
    let folder = tempfile::tempdir().unwrap();
    // There is no normal map, and nobody knows whether there should be one.
    for (tile, name) in [(1, "diffuse"), (2, "roughness"), (3, "specular")] {
        let map = image::imageops::crop_imm(&strip(), tile * SIDE, 0, SIDE, SIDE).to_image();
        map.save(folder.path().join(format!("{name}.png"))).unwrap();
    }
    let mut window = on_files([folder.path().to_owned()]);
    tab(&mut window, "Files");
    window.set_size(vec2(1200.0, 1400.0));
    window.run_steps(4);
    let lines = |start: &str| -> Vec<String> {
        let nodes = window.query_all_by_label_contains(start).filter_map(|node| node.value());
        nodes.filter(|text| text.starts_with(start)).collect()
    };
    for map in ["Material: ", "Normal: ", "Diffuse: ", "Specular: ", "Roughness: "] {
        assert_eq!(lines(map).len(), 1, "{map} {:?}", lines(map));
    }
    assert_eq!(lines("Roughness: "), ["Roughness: r as stored: the map is named roughness"]);
    let why = "there is no normal map; the surface is taken as flat";
    assert_eq!(lines("Normal: "), [format!("Normal: no map, (0, 0, 1) everywhere unsure : {why}")]);
    assert!(lines("Diffuse: ")[0].contains("srgb") || lines("Diffuse: ")[0].contains("linear"));
    assert_eq!(window.query_all_by_role(Role::ComboBox).count(), 1, "that of the convention");
}

#[needs(adapter)]
#[test]
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
