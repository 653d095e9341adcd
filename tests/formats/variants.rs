//! Several pictures for one map: of other sizes, of gloss, of layers; and files that are not read.

use super::*;
use crate::formats::decoders::put_bytes;

/// Writes a set of pictures of `side` texels of one value each.
fn put_set(folder: &Path, names: [&str; 3], side: usize, value: f64) {
    for name in names {
        let of = if name.contains("nor") { [0.5, 0.5, 1.0] } else { [value; 3] };
        save(folder, &format!("{name}.png"), &picture(side, side, |_, _| of), ImageFormat::Png);
    }
}

#[test]
fn of_two_sizes_in_one_folder_the_larger_complete_one_is_read_and_a_file_means_its_own() {
    let folder = tempdir().unwrap();
    put_set(folder.path(), ["rock_diff_1k", "rock_nor_gl_1k", "rock_rough_1k"], 8, 0.25);
    put_set(folder.path(), ["rock_diff_2k", "rock_nor_gl_2k", "rock_rough_2k"], 16, 0.5);
    let read = open(folder.path());
    assert_eq!((read.material.size(), read.material.texel(0).roughness), ([16; 2], 128.0 / 255.0));
    assert_notes(&read, &["rock_rough_1k.png is not used: rock_rough_2k.png is preferred"]);
    let read = open(&folder.path().join("rock_nor_gl_1k.png"));
    assert_eq!((read.material.size(), read.material.texel(0).roughness), ([8; 2], 64.0 / 255.0));
    // One that lacks a map is none.
    std::fs::remove_file(folder.path().join("rock_rough_2k.png")).unwrap();
    assert_eq!(open(folder.path()).material.size(), [8; 2]);
}

#[test]
fn a_colour_that_has_the_name_of_its_set_may_have_a_size_in_it() {
    let folder = tempdir().unwrap();
    put_set(folder.path(), ["brick_2k", "brick_2k_normal", "brick_2k_roughness"], SIDE, 0.5);
    assert_near(open(folder.path()).material.texel(0).diffuse, [0.214; 3]);
}

#[test]
fn roughness_is_preferred_to_its_gloss() {
    let folder = grays(&[("x_2K_Albedo", 0.5), ("x_2K_Gloss", 0.5), ("x_2K_Roughness", 0.25)]);
    put(folder.path(), "x_2K_Normal", bumps);
    let read = open(folder.path());
    assert_near([read.material.texel(0).roughness], [0.25]);
    assert_notes(&read, &["x_2K_Gloss.png is not used: x_2K_Roughness.png is preferred"]);
}

#[test]
fn maps_of_a_coat_are_not_those_of_the_material_below() {
    let folder = grays(&[("x_BaseColor", 0.5), ("x_Roughness", 0.25), ("x_Coat_Roughness", 0.1)]);
    gray(folder.path(), "x_Sheen_Color", 0.9);
    gray(folder.path(), "x_Sheen_Roughness", 0.9);
    put(folder.path(), "x_Normal", bumps);
    put(folder.path(), "x_ClearCoat_Normal", |_, _| [0.6, 0.6, 0.9]);
    let read = open(folder.path());
    assert_near([read.material.texel(0).roughness, read.material.texel(0).diffuse[0]], [0.25, 0.214]);
    assert_notes(&read, &["x_ClearCoat_Normal.png is not used", "x_Sheen_Color.png is not used"]);
    // But a coat may be a material.
    for name in ["x_coat_albedo", "x_coat_roughness", "x_coat_normal"] {
        put(folder.path(), name, bumps);
    }
    assert_refused(folder.path(), &["several: x, x_coat"]);
}

#[test]
fn a_map_in_a_format_that_is_not_known_is_named() {
    let folder = tempdir().unwrap();
    folder_of(["a_normal.png", "a_diffuse.png", "a_roughness.png", "a_height.png"], folder.path(), |_, v| v);
    put_bytes(folder.path(), "a_metallic.xyz", b"something");
    put_bytes(folder.path(), "b_metallic.xyz", b"something");
    put_bytes(folder.path(), "a_normal.png.import", b"[remap]");
    put_bytes(folder.path(), "a_normal.txt", b"by hand");
    let read = open(folder.path());
    assert_notes(&read, &["a_metallic.xyz is not used: its format is not read"]);
    assert!(
        !notes(&read).contains("b_metallic") && !notes(&read).contains("a_normal.txt"),
        "{}",
        notes(&read)
    );
    for name in ["a_metallic.heif", "a_metallic.dpx", "a_metallic.vtf"] {
        let path = put_bytes(folder.path(), name, b"SDPX\0\0\0\0\0\0\0\0");
        assert_refused(folder.path(), &[name]);
        std::fs::remove_file(path).unwrap();
    }
}
