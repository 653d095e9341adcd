//! Conventions of the sources of materials beyond layouts and names.

use svbrdf_files::read::Workflow;

use super::*;
use crate::support::pictures::layered_with_more;

/// Writes a picture of one value, the same in all channels.
fn plain(folder: &Path, name: &str, value: f64) {
    save(folder, &format!("{name}.png"), &picture(SIDE, SIDE, |_, _| [value; 3]), ImageFormat::Png);
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < EIGHT_BITS
}

#[test]
fn a_level_of_specular_scales_what_no_metal_reflects() {
    let folder = tempdir().unwrap();
    let level = GrayImage::from_pixel(SIDE as u32, SIDE as u32, [204].into());
    save(folder.path(), "w_specularLevel.png", &level.into(), ImageFormat::Png);
    plain(folder.path(), "w_basecolor", srgb(0.5));
    plain(folder.path(), "w_roughness", 0.5);
    plain(folder.path(), "w_metallic", 0.25);
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
    plain(folder.path(), "w_specular", srgb(0.04));
    let read = open(folder.path());
    assert!(near(read.material.texel(7).specular[0], 0.04));
    let note = "w_specularLevel.png is not used: the workflow is specular";
    assert!(read.notes.iter().any(|n| n.to_string().contains(note)), "{:?}", read.notes);
}

#[test]
fn maps_of_the_other_workflow_are_said_to_be_unused() {
    let folder = tempdir().unwrap();
    for name in ["basecolor", "diffuse", "specular", "metallic", "roughness"] {
        plain(folder.path(), name, 0.3);
    }
    let unused = |read: &Read<f64>| -> Vec<String> {
        let notes = read.notes.iter().map(ToString::to_string);
        let notes: Vec<_> = notes.collect();
        let notes = notes.iter().filter_map(|n| n.split_once(" is not used: the workflow"));
        notes.map(|(file, _)| file.rsplit('/').next().unwrap().to_owned()).collect()
    };
    assert_eq!(unused(&open(folder.path())), ["diffuse.png", "specular.png"]);
    let options = ReadOptions { workflow: Some(Workflow::Specular), ..ReadOptions::AUTO };
    assert_eq!(unused(&open_as(folder.path(), &options)), ["basecolor.png", "metallic.png"]);
}

#[test]
fn layers_of_no_use_are_said_to_be_unused() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.exr");
    layered_with_more(&path);
    let read = open(&path);
    assert_same(&read, HALF);
    for layer in ["opacity", "height"] {
        assert!(
            read.messages().any(|line| line == format!("Layer {layer} is not used.")),
            "{:?}",
            read.notes
        );
    }
}

#[test]
fn matfusion_adds_what_metal_reflects() {
    let folder = tempdir().unwrap();
    plain(folder.path(), "albedo", gamma(0.5));
    plain(folder.path(), "metalness", 0.75);
    plain(folder.path(), "roughness", 0.5);
    let specular = |preset| {
        let read = open_as(
            folder.path(),
            &ReadOptions { preset, albedo: Some(Albedo::Gamma22), ..ReadOptions::AUTO },
        );
        read.material.texel(0).specular[0]
    };
    assert!(near(specular(Some(Preset::MatFusion)), 0.04 + 0.375));
    assert!(near(specular(None), 0.01 + 0.375));
}

#[test]
fn names_know_more_of_y_than_presets() {
    let folder = tempdir().unwrap();
    let names = ["a_NormalDX.png", "a_diffuse.png", "a_roughness.png", "a_specular.png"];
    folder_of(names, folder.path(), |_, v| v);
    let turned = picture(SIDE, SIDE, |x, y| {
        let [r, g, b] = stored(0, x, y, |v| v);
        [r, 1.0 - g, b]
    });
    save(folder.path(), names[0], &turned, ImageFormat::Png);
    let preset = ReadOptions { preset: Some(Preset::SurfaceNet), ..ReadOptions::AUTO };
    assert_same(&open_as(folder.path(), &preset), EIGHT_BITS);
    let said = ReadOptions { normal_y: Some(NormalY::Up), ..preset };
    assert!(worst(&open_as(folder.path(), &said).material) > 0.1);
}

#[test]
fn a_median_that_contradicts_what_is_said_is_noticed() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "a.png", &packed("NDRS", 4, colours), ImageFormat::Png);
    let noticed = |albedo| {
        let read = open_as(&path, &ReadOptions { albedo: Some(albedo), ..ReadOptions::AUTO });
        read.notes.iter().any(|note| note.to_string().contains("as specified, but its median is 0.23"))
    };
    assert!(noticed(Albedo::Linear));
    assert!(!noticed(Albedo::Gamma22));
}

#[test]
fn a_picture_that_is_no_material_can_be_taken_as_diffuse() {
    let folder = tempdir().unwrap();
    let image = picture(4 * SIDE, SIDE, |x, _| [x as f64 / (4 * SIDE) as f64, 0.5, 0.2].map(srgb));
    let wide = save(folder.path(), "photo.png", &image, ImageFormat::Png);
    let tall = image.crop_imm(0, 0, 24, 16);
    let path = save(folder.path(), "other.png", &tall, ImageFormat::Png);
    assert!(refusal(&path).contains("24 x 16 pixels; give a packed image"), "{}", refusal(&path));
    for (path, size) in [(path, [24, 16]), (wide, [4 * SIDE, SIDE])] {
        let read = open_as(&path, &ReadOptions { order: Some(Order::D), ..ReadOptions::AUTO });
        assert_eq!(read.material.size(), size);
        let got = read.material.texel(5);
        assert!(near(got.diffuse[0], 5.0 / (4 * SIDE) as f64) && near(got.diffuse[1], 0.5), "{got:?}");
        assert_eq!((got.specular, got.roughness, got.normal.to_array()), ([0.04; 3], 0.5, [0.0, 0.0, 1.0]));
        assert!(read.unsure().any(|a| a.chosen == "roughness 0.5"), "{:#?}", read.assumptions);
    }
}
