//! Names and documents of engines: resources of Godot, gloss in alpha, and fills that are no map.

use super::*;

/// Writes a picture of red, green, blue and alpha.
fn put_rgba(folder: &Path, name: &str, at: impl Fn(usize, usize) -> [f64; 4]) {
    let image = image::RgbaImage::from_fn(SIDE as u32, SIDE as u32, |x, y| {
        at(x as usize, y as usize).map(|v| (255.0 * v).round() as u8).into()
    });
    save(folder, &format!("{name}.png"), &image.into(), ImageFormat::Png);
}

/// A set as Material Maker exports it, of this base colour: the blue of `bark_orm` is 1 everywhere.
fn exported(base: f64) -> tempfile::TempDir {
    let folder = grays(&[("bark_albedo", srgb(base))]);
    put(folder.path(), "bark_normal", bumps);
    put(folder.path(), "bark_orm", |x, y| [0.9, texel(2, x, y)[0], 1.0]);
    folder
}

#[test]
fn a_resource_of_godot_beside_a_packed_picture_tells_what_its_channels_are() {
    let folder = exported(0.05);
    let text = |more: &str| {
        format!(
            "[gd_resource type=\"StandardMaterial3D\" format=2]\n\
            [ext_resource path=\"bark_albedo.png\" type=\"Texture\" id=1]\n\
            [ext_resource type=\"Texture2D\" path=\"res://bark/bark_orm.png\" id=\"2_x\"]\n[resource]\n\
            metallic = 0\nroughness = 0.5\nroughness_texture = ExtResource( \"2_x\" )\nroughness_texture_channel = 1\n{more}"
        )
    };
    let put = |text: &str| std::fs::write(folder.path().join("bark.tres"), text).unwrap();
    put(&text(""));
    let read = open(folder.path());
    let at = read.material.texel(77);
    assert_near(at.diffuse, [0.05; 3]);
    assert_near([at.roughness], [0.5 * texel(2, 77 % SIDE, 77 / SIDE)[0]]);
    let metallic = read.assumptions.iter().find(|a| a.chosen == "metallic 0").unwrap();
    assert!(metallic.why.is_stated() && metallic.to_string().contains("bark.tres"), "{metallic}");
    assert!(read.files.contains(&folder.path().join("bark.tres")), "{:?}", read.files);
    // Bound, it is a metal, and so it is in a resource of packed pictures or of others.
    let bound = "metallic_texture = ExtResource( \"2_x\" )\nmetallic_texture_channel = 2\n";
    let other = |from: &str, to: &str| text("").replace(from, to);
    for resource in [
        text("").replace("metallic = 0", "metallic = 1") + bound,
        other("StandardMaterial3D", "ORMMaterial3D"),
        other("bark_", "moss_"),
    ] {
        put(&resource);
        assert_near(open(folder.path()).material.texel(77).diffuse, [0.0; 3]);
    }
}

#[test]
fn metal_all_over_that_is_darker_than_metals_is_asked_about() {
    for (base, is_doubted) in [(0.05, true), (0.6, false)] {
        let read = open(exported(base).path());
        let doubts = read
            .unsure()
            .any(|a| a.what == What::Layout && a.to_string().contains("metallic is 1 everywhere"));
        assert_eq!(doubts, is_doubted, "{base}: {:#?}", read.assumptions);
    }
}

#[test]
fn gloss_in_the_alpha_of_metallic_is_found_by_its_name_and_where_nothing_else_is_roughness() {
    for (names, is_doubted) in [
        (["a_albedo", "a_normal_gl", "a_metallic_gloss"], false),
        (["a_albedo", "a_normal_gl", "a_MetallicGlossMap"], false),
        (["a_albedo", "a_normal_gl", "a_metallicmap"], true),
        (["Maple_Red_BC", "Maple_NM", "Maple_M"], true),
    ] {
        let folder = grays(&[(names[0], srgb(0.5))]);
        put(folder.path(), names[1], bumps);
        let metal = |x: usize| if x < SIDE / 2 { 0.0 } else { 1.0 };
        put_rgba(folder.path(), names[2], |x, y| [metal(x), 0.8, 0.0, 1.0 - texel(2, x, y)[0]]);
        let read = open(folder.path());
        for index in [0, 77, 200] {
            let (x, y) = (index % SIDE, index / SIDE);
            let got = read.material.texel(index);
            assert_near([got.roughness, got.diffuse[0]], [texel(2, x, y)[0], 0.5 * (1.0 - metal(x))]);
        }
        assert_eq!(
            read.unsure().any(|a| a.what == What::Layout),
            is_doubted,
            "{names:?}: {:#?}",
            read.assumptions
        );
    }
}
