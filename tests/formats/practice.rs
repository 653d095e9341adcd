//! Sets of files that people have: what their names and channels mean.

use image::{Rgba, RgbaImage};

use svbrdf_files::read::Role;

use super::*;

const DARK: f64 = 0.31;

/// A picture that varies from left to right in the given channels, the others constant.
fn channels(folder: &Path, name: &str, of: impl Fn(f64) -> [f64; 3]) {
    put(folder, name, |x, _| of(x as f64 / (SIDE - 1) as f64));
}

fn mean_roughness(read: &Read<f64>) -> f64 {
    let plane = &read.material.planes().roughness;
    plane.iter().sum::<f64>() / plane.len() as f64
}

/// How colours are stored, and whether that is doubted.
fn albedo(folder: &Path) -> (String, bool) {
    let read = open(folder);
    (chosen(&read, What::Albedo).to_owned(), is_doubted(&read, What::Albedo))
}

fn is_doubted(read: &Read<f64>, what: What) -> bool {
    read.unsure().any(|a| a.what == what)
}

#[test]
fn one_statistic_of_specular_does_not_make_colours_linear() {
    let folder = grays(&[("diffuse", 0.4), ("roughness", 0.5)]);
    put(folder.path(), "normal_gl", bumps);
    // From 0 to 0.44, with a median of 0.055.
    let varied = |u: f64| [if u < 0.5 { 0.11 * u } else { 0.055 + 0.77 * (u - 0.5) }; 3];
    channels(folder.path(), "specular", varied);
    assert_eq!(chosen(&open(folder.path()), What::Albedo), "srgb");
    // All of it at 0.04: then it is linear, and so is diffuse.
    gray(folder.path(), "specular", 0.04);
    let read = open(folder.path());
    assert_eq!((chosen(&read, What::Albedo), chosen(&read, What::Specular)), ("linear", "linear"));
    gray(folder.path(), "specular", 0.22);
    assert_eq!(chosen(&open(folder.path()), What::Specular), "srgb");
    // Bright diffuse and specular at a linear 0.04: the evidence disagrees.
    gray(folder.path(), "diffuse", 0.98);
    gray(folder.path(), "specular", 0.04);
    let read = open(folder.path());
    assert_eq!((chosen(&read, What::Albedo), chosen(&read, What::Specular)), ("srgb", "linear"));
    assert!(is_doubted(&read, What::Albedo), "{:#?}", read.assumptions);
}

#[test]
fn a_roughness_of_packed_channels_is_not_their_mean() {
    let folder = grays(&[("basecolor", 0.5)]);
    put(folder.path(), "normal_gl", bumps);
    // As a glTF exporter writes it: red and blue are white.
    channels(folder.path(), "roughness", |u| [1.0, 2.0 * DARK * u, 1.0]);
    let read = open(folder.path());
    assert!((mean_roughness(&read) - DARK).abs() < EIGHT_BITS, "{}", mean_roughness(&read));
    assert!(is_doubted(&read, What::Layout) && read.material.texel(3).specular[0] < 0.05);
    // Roughness and metallic.
    channels(folder.path(), "roughness", |u| [1.0, 2.0 * DARK * u, u]);
    let read = open(folder.path());
    assert!((mean_roughness(&read) - DARK).abs() < EIGHT_BITS);
    assert!(is_doubted(&read, What::Layout) && read.maps.iter().any(|map| map.map == Role::Metallic));
    assert!(read.refuse_guesses(folder.path()).is_err());
    // Gray, with the noise of a JPEG: no doubt.
    channels(folder.path(), "roughness", |u| [u, (u + 0.02).min(1.0), u]);
    assert!(!is_doubted(&open(folder.path()), What::Layout));
}

#[test]
fn a_picture_of_blender_that_is_named_after_both_maps_holds_both() {
    let folder = grays(&[("X_BaseColor", 0.5)]);
    channels(folder.path(), "X_Metallic-X_Roughness", |u| [0.0, DARK, u]);
    let read = open(folder.path());
    assert!((mean_roughness(&read) - DARK).abs() < EIGHT_BITS);
    assert!(read.material.texel(SIDE - 1).diffuse[0] < 1e-9, "the metal is lost");
}

#[test]
fn specular_and_glossiness_in_one_picture_are_taken_apart() {
    let folder = grays(&[("m_diffuse", 0.5)]);
    let image = RgbaImage::from_fn(SIDE as u32, SIDE as u32, |x, _| Rgba([90, 90, 90, 40 + x as u8]));
    save(folder.path(), "m_specularGlossiness.png", &image.into(), ImageFormat::Png);
    let read = open(folder.path());
    let expected = |c: u8| ((f64::from(c) / 255.0 + 0.055) / 1.055).powf(2.4);
    let texel = read.material.texel(5);
    assert!((texel.specular[0] - expected(90)).abs() < 1e-9, "{texel:?}");
    assert!((texel.roughness - (1.0 - 45.0 / 255.0)).abs() < 1e-9, "{texel:?}");
    assert_eq!(certainty(&read, What::Roughness), Some(Certainty::Sure));
}

#[test]
fn names_of_libraries_and_engines_open() {
    for names in [
        ["rock_normal-ogl", "rock_albedo", "rock_roughness"],
        ["rock_NormalOGL", "rock_BaseColor", "rock_Roughness"],
        ["xyz_2K_Normal", "xyz_2K_Albedo", "xyz_2K_Gloss"],
        ["T_Rock_N", "T_Rock_B", "T_Rock_R"],
        ["Rock_Normal", "Rock_BaseMap", "Rock_MaskMap"],
        ["brick_n", "brick", "brick_r"],
    ] {
        let folder = tempdir().unwrap();
        put(folder.path(), names[0], bumps);
        gray(folder.path(), names[1], 0.25);
        gray(folder.path(), names[2], 0.0);
        let read = open(folder.path());
        let color = read.material.texel(0).diffuse[0];
        assert!(color > 0.03 && color < 0.08, "{names:?}: {color}");
        assert!(read.material.planes().normal[0].iter().any(|x| x.abs() > 0.05), "{names:?}: flat");
    }
}

#[test]
fn of_two_pictures_of_normals_y_up_is_preferred_and_a_constant_one_is_not_the_map() {
    let folder = grays(&[("a_albedo", 0.5), ("a_roughness", 0.5)]);
    put(folder.path(), "a_normal-ogl", bumps);
    put(folder.path(), "a_normal-dx", bumps);
    let read = open(folder.path());
    assert_eq!(chosen(&read, What::NormalY), "up");
    assert_notes(&read, &["a_normal-dx.png is not used"]);
    put(folder.path(), "a_normal-ogl", |_, _| [0.502, 0.502, 1.0]);
    let read = open(folder.path());
    assert!(read.material.planes().normal[0].iter().any(|x| x.abs() > 0.05), "the constant one is used");
}

#[test]
fn specular_beside_packed_metallic_does_not_switch_the_workflow_in_silence() {
    let folder = grays(&[("a_diff", 0.5), ("a_spec", 0.3)]);
    channels(folder.path(), "a_arm", |u| [1.0, DARK, u]);
    let read = open(folder.path());
    assert_eq!(chosen(&read, What::Workflow), "metallic");
    assert!(is_doubted(&read, What::Workflow));
}

#[test]
fn floats_of_normals_that_overshoot_are_not_signed() {
    let folder = tempdir().unwrap();
    // Unsigned normals, with one overshoot.
    put_exrs(folder.path(), |map, i, v| match (map, i) {
        (0, 7) => -0.16,
        (0, _) => 0.5 * v + 0.5,
        _ => v,
    });
    assert_eq!(chosen(&open(folder.path()), What::NormalEncoding), "unsigned");
}

#[test]
fn strict_reading_takes_names_and_specifications_only() {
    let folder = tempdir().unwrap();
    put(folder.path(), "normal_gl", bumps);
    gray(folder.path(), "basecolor", 0.5);
    gray(folder.path(), "metallic", 0.0);
    gray(folder.path(), "roughness", 0.5);
    let is_refused = || open(folder.path()).refuse_guesses(folder.path()).is_err();
    assert!(!is_refused(), "{:#?}", open(folder.path()).assumptions);
    // Where y points is measured then.
    std::fs::rename(folder.path().join("normal_gl.png"), folder.path().join("normal.png")).unwrap();
    assert!(is_refused());
    // A packed image is recognized by its pixels; with its order and the conventions of its source it is specified.
    let packed = put_strip(folder.path(), "a", "NDRS");
    assert!(open(&packed).refuse_guesses(&packed).is_err());
    let specified =
        ReadOptions { preset: Some(Preset::Deschaintre), order: Some(Order::NDRS), ..ReadOptions::AUTO };
    let read = open_as(&packed, &specified);
    assert!(read.refuse_guesses(&packed).is_ok(), "{:#?}", read.assumptions);
}

#[test]
fn a_missing_map_lists_its_names_and_no_junk() {
    let folder = grays(&[("rock_albedo", 0.5)]);
    for junk in ["rock_albedo.png.import", "rock.meta", "Thumbs.db"] {
        std::fs::write(folder.path().join(junk), "x").unwrap();
    }
    assert_refused(folder.path(), &["roughness", "rgh", "glossiness", "smoothness", "rock_albedo.png"]);
    let message = refusal(folder.path());
    assert!(![".import", "Thumbs", "meta"].iter().any(|junk| message.contains(junk)), "{message}");
}

#[test]
fn a_picture_named_metal_that_looks_like_normals_is_asked_about() {
    let folder = grays(&[("a_basecolor", 0.5), ("a_roughness", 0.5)]);
    put(folder.path(), "a_normal_gl", bumps);
    gray(folder.path(), "a_metal", 1.0);
    assert!(!is_doubted(&open(folder.path()), What::Layout));
    put(folder.path(), "a_metal", bumps);
    let read = open(folder.path());
    assert_notes(&read, &["looks like normals although it is named after"]);
    assert!(is_doubted(&read, What::Layout));
}

#[test]
fn specular_beside_diffuse_without_other_evidence_is_srgb_and_asked_about() {
    let folder = grays(&[("a_diffuse", 0.4), ("a_specular", 0.12), ("a_roughness", 0.5)]);
    assert_eq!(albedo(folder.path()), ("srgb".into(), true));
    // Glossiness is how artists name it, who do not store colours linear.
    std::fs::rename(folder.path().join("a_roughness.png"), folder.path().join("a_gloss.png")).unwrap();
    assert_eq!(albedo(folder.path()), ("srgb".into(), false));
}

#[test]
fn metals_darker_than_metals_are_linear_and_asked_about() {
    let folder = grays(&[("a_diffuse", 0.0), ("a_roughness", 0.5)]);
    for (specular, expected) in [(0.5, "linear"), (0.85, "srgb")] {
        gray(folder.path(), "a_specular", specular);
        assert_eq!(albedo(folder.path()), (expected.into(), true));
    }
}

#[test]
fn a_colour_that_is_too_dark_if_encoded_is_asked_about() {
    let folder = grays(&[("a_roughness", 0.5), ("a_metallic", 0.0)]);
    for (colour, doubted) in [(0.4, false), (0.07, true)] {
        gray(folder.path(), "a_basecolor", colour);
        assert_eq!(albedo(folder.path()), ("srgb".into(), doubted));
    }
}

/// A material of which the pixels do not tell whether it is linear.
fn undecided(folder: &Path, stem: &str) {
    gray(folder, &format!("{stem}diffuse"), 0.4);
    gray(folder, &format!("{stem}specular"), 0.12);
    gray(folder, &format!("{stem}roughness"), 0.5);
}

#[test]
fn materials_beside_tell_what_the_pixels_of_one_do_not() {
    for (specular, expected) in [(0.04, "linear"), (0.22, "srgb")] {
        // In folders beside one another.
        let folder = tempdir().unwrap();
        let [one, other] = ["one", "other"].map(|name| folder.path().join(name));
        for folder in [&one, &other] {
            std::fs::create_dir(folder).unwrap();
            undecided(folder, "");
        }
        assert!(is_doubted(&open(&one), What::Albedo));
        gray(&other, "specular", specular);
        let read = open(&one);
        assert_eq!(chosen(&read, What::Albedo), expected);
        assert_notes(&read, &["1 neighbouring material"]);
        // What a neighbour holds is not a file of the material.
        assert!(read.files.iter().all(|file| file.starts_with(&one)));
        // In one folder, of other stems.
        let folder = tempdir().unwrap();
        undecided(folder.path(), "one_");
        undecided(folder.path(), "other_");
        gray(folder.path(), "other_specular", specular);
        assert_eq!(chosen(&open(&folder.path().join("one_")), What::Albedo), expected);
    }
}
