//! Properties of glTF beside textures and factors: extensions, scales, several materials.

use super::*;
use crate::formats::decoders::blocks;

/// A glTF of `materials` over the files `images`; `textures` as they stand in the file, and what else there is.
pub fn document(images: &[&str], textures: &str, materials: &str, more: &str) -> String {
    let images: Vec<_> = images.iter().map(|uri| format!(r#"{{"uri": "{uri}"}}"#)).collect();
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "images": [{}], "textures": [{textures}],
        "materials": [{materials}]{more}}}"#,
        images.join(", ")
    )
}

pub fn put(folder: &TempDir, text: &str) -> std::path::PathBuf {
    let path = folder.path().join("a.gltf");
    std::fs::write(&path, text).unwrap();
    path
}

pub const PLAIN: &str = r#"{"name": "wall", "normalTexture": {"index": 1}, "pbrMetallicRoughness": {
    "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 2}}}"#;
pub const IMAGES: [&str; 3] = ["base%20colour.png", "n.png", "orm.png"];
pub const THREE: &str = r#"{"source": 0}, {"source": 1}, {"source": 2}"#;

#[test]
fn textures_of_webp_open_and_extensions_of_meshes_do_not_refuse_the_file() {
    let folder = textures();
    save(folder.path(), "base.webp", &picture(SIDE, SIDE, |_, _| BASE.map(srgb)), ImageFormat::WebP);
    let textures = r#"{"extensions": {"EXT_texture_webp": {"source": 0}}}, {"source": 1}, {"source": 2}"#;
    let more = r#", "extensionsUsed": ["EXT_texture_webp", "KHR_mesh_quantization"],
        "extensionsRequired": ["EXT_texture_webp", "KHR_mesh_quantization", "KHR_draco_mesh_compression"],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 7}}]}]"#;
    let text = document(&["base.webp", "n.png", "orm.png"], textures, PLAIN, more);
    assert_is_of_textures(&open(&put(&folder, &text)), 1.0);
}

#[test]
fn textures_of_basis_universal_open() {
    let folder = textures();
    let (_, ktx2) = blocks();
    std::fs::write(folder.path().join("base.ktx2"), ktx2).unwrap();
    let textures = r#"{"extensions": {"KHR_texture_basisu": {"source": 0}}}"#;
    let material = r#"{"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": 0}}}"#;
    let read = open(&put(&folder, &document(&["base.ktx2"], textures, material, "")));
    assert_eq!(read.material.size(), [4 * SIDE, SIDE]);
}

#[test]
fn a_texture_without_a_picture_that_is_read_is_refused_with_its_extension() {
    let folder = textures();
    let textures = r#"{"extensions": {"EXT_texture_unknown": {"source": 0}}}, {"source": 1}, {"source": 2}"#;
    let text = document(&IMAGES, textures, PLAIN, "");
    let refused = refusal(&put(&folder, &text));
    assert!(refused.contains("EXT_texture_unknown") && refused.contains("base colour map"), "{refused}");
}

#[test]
fn the_scale_of_a_normal_texture_scales_slopes() {
    let folder = textures();
    let text = |scale: f64| {
        let normal = format!(r#""normalTexture": {{"index": 1, "scale": {scale}}}"#);
        let material = PLAIN.replace(r#""normalTexture": {"index": 1}"#, &normal);
        document(&IMAGES, THREE, &material, "")
    };
    let [plain, scaled] = [1.0, 0.5].map(|scale| open(&put(&folder, &text(scale))));
    for index in [3, 77, 200] {
        let [a, b] = [&plain, &scaled].map(|read| read.material.texel(index).normal.to_array());
        assert!((b[0] / b[2] - 0.5 * a[0] / a[2]).abs() < 1e-5, "{a:?}, {b:?}");
        assert!((b[1] / b[2] - 0.5 * a[1] / a[2]).abs() < 1e-5, "{a:?}, {b:?}");
    }
    assert_ne!(plain.material, scaled.material);
}

/// The only texel of a material of constants.
fn constant(extensions: &str) -> svbrdf_core::model::brdf::Texel<f64> {
    let folder = textures();
    let material = format!(
        r#"{{"name": "wall", "extensions": {{{extensions}}}, "pbrMetallicRoughness": {{
            "baseColorFactor": [0.5, 0.4, 0.3, 1], "metallicFactor": 0.25, "roughnessFactor": 0.5}}}}"#
    );
    let read = open(&put(&folder, &document(&[], "", &material, "")));
    assert_eq!(read.material.size(), [1, 1]);
    read.material.texel(0)
}

#[test]
fn constants_without_textures_open_as_one_texel() {
    let texel = constant("");
    assert_near(texel.diffuse, BASE.map(|b| 0.75 * b), 1e-5);
    assert_near(texel.specular, BASE.map(|b| 0.75 * 0.04 + 0.25 * b), 1e-5);
    assert!((texel.roughness - 0.5).abs() < 1e-6);
}

#[test]
fn a_texture_whose_map_is_constant_decides_the_size() {
    let folder = textures();
    // Alpha, which is the strength of the reflection, is 1 everywhere.
    save(folder.path(), "s.png", &picture(32, 16, |_, _| [0.5; 3]), ImageFormat::Png);
    let material = r#"{"extensions": {"KHR_materials_specular": {"specularFactor": 0.5, "specularTexture": {"index": 0}}}}"#;
    let read = open(&put(&folder, &document(&["s.png"], r#"{"source": 0}"#, material, "")));
    assert_eq!(read.material.size(), [32, 16]);
    // A picture of another shape is not the size of the maps.
    let both = r#"{"extensions": {"KHR_materials_specular": {"specularTexture": {"index": 0}}},
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}}"#;
    let text = document(&["s.png", "base%20colour.png"], r#"{"source": 0}, {"source": 1}"#, both, "");
    assert_eq!(open(&put(&folder, &text)).material.size(), [SIDE; 2]);
}

#[test]
fn specular_and_the_index_of_refraction_decide_what_a_dielectric_reflects() {
    let reflected = |ior: f64| ((ior - 1.0) / (ior + 1.0)).powi(2);
    let ior = constant(r#""KHR_materials_ior": {"ior": 2.0}"#);
    assert_near(ior.specular, BASE.map(|b| 0.75 * reflected(2.0) + 0.25 * b), 1e-5);
    let said = r#""KHR_materials_ior": {"ior": 1.45}, "KHR_materials_specular": {"specularFactor": 0.75,
        "specularColorFactor": [0.1, 0.2, 30.0]}"#;
    let colours = [0.1 * reflected(1.45), 0.2 * reflected(1.45), 1.0];
    let expected = [0, 1, 2].map(|c| 0.75 * 0.75 * colours[c] + 0.25 * BASE[c]);
    assert_near(constant(said).specular, expected, 1e-5);
}

#[test]
fn the_textures_of_specular_count() {
    let folder = textures();
    let image = image::RgbaImage::from_pixel(4, 4, [188, 188, 255, 51].into());
    save(folder.path(), "s.png", &image.into(), ImageFormat::Png);
    let material = r#"{"extensions": {"KHR_materials_specular": {"specularTexture": {"index": 0},
        "specularColorTexture": {"index": 0}}}, "pbrMetallicRoughness": {"metallicFactor": 0}}"#;
    let read = open(&put(&folder, &document(&["s.png"], r#"{"source": 0}"#, material, "")));
    // 188 of 255 stands for 0.5029 in sRGB; alpha is 0.2.
    assert_near(
        read.material.texel(5).specular,
        [0.040 * 0.2 * 0.502_887, 0.040 * 0.2 * 0.502_887, 0.008],
        1e-5,
    );
}

#[test]
fn one_transform_of_all_textures_opens_and_different_ones_are_refused_by_name() {
    let folder = textures();
    let text = |of_base: &str, of_others: &str| {
        let transform = |scale: &str| {
            format!(r#", "extensions": {{"KHR_texture_transform": {{"scale": [{scale}, {scale}]}}}}}}"#)
        };
        let material = PLAIN
            .replace(r#""index": 0}"#, &format!(r#""index": 0{}"#, transform(of_base)))
            .replace(r#""index": 1}"#, &format!(r#""index": 1{}"#, transform(of_others)))
            .replace(r#""index": 2}"#, &format!(r#""index": 2{}"#, transform(of_others)));
        document(&IMAGES, THREE, &material, "")
    };
    assert_is_of_textures(&open(&put(&folder, &text("3.1", "3.1"))), 1.0);
    let refused = refusal(&put(&folder, &text("3", "2")));
    assert!(refused.contains("KHR_texture_transform") && refused.contains("baseColorTexture"), "{refused}");
}

#[test]
fn of_many_materials_the_first_with_textures_opens_and_all_are_named() {
    let folder = textures();
    let materials = format!(r#"{{"name": "glass"}}, {PLAIN}, {{"name": "brass"}}"#);
    let text = document(&IMAGES, THREE, &materials, "");
    let path = put(&folder, &text);
    let read = open(&path);
    assert_is_of_textures(&read, 1.0);
    assert!(says(&read, "0 glass, 1 wall, 2 brass"), "{:?}", read.notes);
    let options = ReadOptions { exemplar: Some(2), ..ReadOptions::AUTO };
    let brass = svbrdf_files::read::read::<f64>(&path, &options, &Progress::default()).unwrap();
    assert_eq!((brass.material.name(), brass.material.size()), ("brass", [1, 1]));
}

#[test]
fn a_material_without_a_name_has_that_of_its_file() {
    let folder = textures();
    for nameless in [PLAIN.replacen(r#""name": "wall", "#, "", 1), PLAIN.replacen("wall", " ", 1)] {
        let text = document(&IMAGES, THREE, &nameless, "");
        let read = open(&put(&folder, &text));
        assert_eq!(read.material.name(), "a");
        let several = document(&IMAGES, THREE, &format!("{nameless}, {PLAIN}"), "");
        let read = open(&put(&folder, &several));
        assert_eq!(read.material.name(), "a");
        assert!(says(&read, "0 unnamed, 1 wall"), "{:?}", read.notes);
    }
}

#[test]
fn extensions_that_are_not_modelled_are_named_unless_they_are_off() {
    let folder = textures();
    let said = |factor: f64| {
        let coat = format!(r#""extensions": {{"KHR_materials_clearcoat": {{"clearcoatFactor": {factor}}}}}"#);
        let material = PLAIN.replacen(r#""name": "wall""#, &format!(r#""name": "wall", {coat}"#), 1);
        let text = document(&IMAGES, THREE, &material, "");
        says(&open(&put(&folder, &text)), "KHR_materials_clearcoat")
    };
    assert!(said(0.5));
    assert!(!said(0.0));
}

#[test]
fn transforms_that_differ_by_rounding_turns_and_tiles_are_one_and_other_coordinates_are_said() {
    let folder = textures();
    let text = |of_base: &str, of_others: &str| {
        let material = PLAIN
            .replace(r#""index": 0}"#, &format!(r#""index": 0{of_base}}}"#))
            .replace(r#""index": 2}"#, &format!(r#""index": 2{of_others}}}"#));
        document(&IMAGES, THREE, &material, "")
    };
    let transform = |of: &str| format!(r#", "extensions": {{"KHR_texture_transform": {{{of}}}}}"#);
    for (of, is_same) in [
        (r#""offset": [4e-7, -4e-7]"#, true),
        (r#""rotation": 6.283185307179586"#, true),
        (r#""rotation": -12.566370614359172, "offset": [2, -1]"#, true),
        (r#""scale": [1, 1.0000001]"#, true),
        (r#""offset": [0.5, 0]"#, false),
        (r#""rotation": 1.57"#, false),
        (r#""scale": [2, 2]"#, false),
    ] {
        let path = put(&folder, &text(&transform(of), ""));
        match is_same {
            true => assert_is_of_textures(&open(&path), 1.0),
            false => assert!(refusal(&path).contains("KHR_texture_transform"), "{of}"),
        }
    }
    let said = "TEXCOORD_1 of baseColorTexture, TEXCOORD_0 of metallicRoughnessTexture";
    for (of, is_said) in [
        (r#", "texCoord": 1"#.to_owned(), true),
        (transform(r#""texCoord": 1"#), true),
        (transform(""), false),
    ] {
        assert_eq!(says(&open(&put(&folder, &text(&of, ""))), said), is_said, "{of}");
    }
}

#[test]
fn normals_of_a_gltf_are_three_components_though_blue_is_1_everywhere() {
    let folder = textures();
    let flat = |x: usize, y: usize| [stored(0, x, y, |v| v)[0], stored(0, x, y, |v| v)[1], 1.0];
    save(folder.path(), "n.png", &picture(SIDE, SIDE, flat), ImageFormat::Png);
    let read = open(&put(&folder, &document(&IMAGES, THREE, PLAIN, "")));
    assert_eq!(certainty(&read, What::NormalEncoding), Some(Certainty::Sure), "{:#?}", read.assumptions);
    for index in [3, 77, 200] {
        let [x, y, _] = texel(0, index % SIDE, index / SIDE);
        let length = (x * x + y * y + 1.0).sqrt();
        assert_near(
            read.material.texel(index).normal.to_array(),
            [x / length, y / length, 1.0 / length],
            BOUND,
        );
    }
}
