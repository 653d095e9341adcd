//! Conventions of the sources of materials beyond layouts and names.

use svbrdf_files::read::Workflow;

use super::*;
use crate::support::pictures::layered_with_more;

#[test]
fn a_level_of_specular_scales_what_no_metal_reflects() {
    let folder = grays(&[
        ("w_specularLevel", 0.8),
        ("w_basecolor", srgb(0.5)),
        ("w_roughness", 0.5),
        ("w_metallic", 0.25),
    ]);
    let read = open(folder.path());
    let got = read.material.texel(7);
    assert!(near(got.diffuse[0], 0.375) && near(got.specular[1], 0.08 * 0.8 * 0.75 + 0.125), "{got:?}");
    assert_eq!(chosen(&read, What::Specular), "0.08 times the level");
    assert!(read.maps.iter().any(|map| map.map == svbrdf_files::read::Role::SpecularLevel));
    // Without metal it is all that is known of specular.
    std::fs::remove_file(folder.path().join("w_metallic.png")).unwrap();
    let read = open(folder.path());
    assert!(near(read.material.texel(7).specular[2], 0.064) && near(read.material.texel(7).diffuse[0], 0.5));
    assert_eq!(chosen(&read, What::Missing), "normal (0, 0, 1)", "{:#?}", read.assumptions);
    // A map of specular itself says more.
    gray(folder.path(), "w_specular", srgb(0.04));
    let read = open(folder.path());
    assert!(near(read.material.texel(7).specular[0], 0.04));
    assert_notes(&read, &["w_specularLevel.png is not used: the workflow is specular"]);
}

#[test]
fn maps_of_the_other_workflow_are_said_to_be_unused() {
    let folder = tempdir().unwrap();
    for name in ["basecolor", "diffuse", "specular", "metallic", "roughness"] {
        gray(folder.path(), name, 0.3);
    }
    let metallic = ["basecolor.png", "metallic.png"];
    let specular = ["diffuse.png", "specular.png"];
    for (workflow, unused, used) in
        [(None, specular, metallic), (Some(Workflow::Specular), metallic, specular)]
    {
        let read = open_as(folder.path(), &ReadOptions { workflow, ..ReadOptions::AUTO });
        assert_notes(
            &read,
            &unused.map(|name| format!("{name} is not used: the workflow")).each_ref().map(|n| &n[..]),
        );
        assert!(
            !used.iter().any(|name| notes(&read).contains(&format!("{name} is not used"))),
            "{}",
            notes(&read)
        );
    }
}

#[test]
fn layers_of_no_use_are_said_to_be_unused() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.exr");
    layered_with_more(&path);
    let read = open(&path);
    assert_same(&read, HALF);
    assert_notes(&read, &["Layer opacity is not used.", "Layer height is not used."]);
}

#[test]
fn matfusion_adds_what_metal_reflects() {
    let folder = grays(&[("albedo", gamma(0.5)), ("metalness", 0.75), ("roughness", 0.5)]);
    let specular = |preset| {
        let options = ReadOptions { preset, albedo: Some(Albedo::Gamma22), ..ReadOptions::AUTO };
        open_as(folder.path(), &options).material.texel(0).specular[0]
    };
    assert!(near(specular(Some(Preset::MatFusion)), 0.04 + 0.375));
    assert!(near(specular(None), 0.01 + 0.375));
}

#[test]
fn names_know_more_of_y_than_presets() {
    let folder = tempdir().unwrap();
    folder_of(
        ["a_NormalDX.png", "a_diffuse.png", "a_roughness.png", "a_specular.png"],
        folder.path(),
        |_, v| v,
    );
    put(folder.path(), "a_NormalDX", turned);
    let preset = ReadOptions { preset: Some(Preset::SurfaceNet), ..ReadOptions::AUTO };
    assert_same(&open_as(folder.path(), &preset), EIGHT_BITS);
    let said = ReadOptions { normal_y: Some(NormalY::Up), ..preset };
    assert!(worst(&open_as(folder.path(), &said).material) > 0.1);
}

#[test]
fn a_median_that_contradicts_what_is_said_is_noticed() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "a.png", &packed("NDRS", 4, colours), ImageFormat::Png);
    for (albedo, noticed) in [(Albedo::Linear, true), (Albedo::Gamma22, false)] {
        let read = open_as(&path, &ReadOptions { albedo: Some(albedo), ..ReadOptions::AUTO });
        assert_eq!(notes(&read).contains("as specified, but its median is 0.23"), noticed, "{albedo}");
    }
}

#[test]
fn a_picture_that_is_no_material_can_be_taken_as_diffuse() {
    let folder = tempdir().unwrap();
    let image = picture(4 * SIDE, SIDE, |x, _| [x as f64 / (4 * SIDE) as f64, 0.5, 0.2].map(srgb));
    let wide = save(folder.path(), "photo.png", &image, ImageFormat::Png);
    let tall = image.crop_imm(0, 0, 24, 16);
    let path = save(folder.path(), "other.png", &tall, ImageFormat::Png);
    assert_refused(&path, &["24 x 16 pixels; give a packed image"]);
    for (path, size) in [(path, [24, 16]), (wide, [4 * SIDE, SIDE])] {
        let read = open_as(&path, &ReadOptions { order: Some(Order::D), ..ReadOptions::AUTO });
        assert_eq!(read.material.size(), size);
        let got = read.material.texel(5);
        assert!(near(got.diffuse[0], 5.0 / (4 * SIDE) as f64) && near(got.diffuse[1], 0.5), "{got:?}");
        assert_eq!((got.specular, got.roughness, got.normal.to_array()), ([0.04; 3], 0.5, [0.0, 0.0, 1.0]));
        assert!(read.unsure().any(|a| a.chosen == "roughness 0.5"), "{:#?}", read.assumptions);
    }
}
