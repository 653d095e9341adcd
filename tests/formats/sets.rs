//! Sets of files, by their names.

use super::*;

#[test]
fn names_of_research_codes_bring_their_encoding() {
    type Encode = fn(usize, f64) -> f64;
    let all: Encode = |_, v| gamma(v);
    let colours: Encode = |map, v| if map == 2 { v } else { gamma(v) };
    let raw: Encode = |_, v| v;
    let table = [
        (["nom.png", "dif.png", "rgh.png", "spe.png"], all, "gamma2.2"),
        (["a-outputs-0-.png", "a-outputs-1-.png", "a-outputs-2-.png", "a-outputs-3-.png"], raw, "linear"),
        (
            [
                "a-outputs_gammad-0-.png",
                "a-outputs_gammad-1-.png",
                "a-outputs_gammad-2-.png",
                "a-outputs_gammad-3-.png",
            ],
            colours,
            "gamma2.2",
        ),
        (NAMES, raw, "linear"),
        (["001_Nout.png", "001_Dout.png", "001_Rout.png", "001_Sout.png"], raw, "linear"),
    ];
    for (names, encode, expected) in table {
        let folder = tempdir().unwrap();
        folder_of(names, folder.path(), encode);
        let read = open(folder.path());
        assert_eq!(chosen(&read, What::Albedo), expected, "{names:?}: {:#?}", read.assumptions);
        assert_same(&read, 2.5 * EIGHT_BITS);
    }
}

#[test]
fn one_file_of_a_set_opens_the_set() {
    let folder = tempdir().unwrap();
    for (stem, value) in [("w", None), ("v", Some(0.5))] {
        let names = NAMES.map(|name| format!("{stem}_{name}"));
        folder_of(names.each_ref().map(|name| &name[..]), folder.path(), |_, v| value.unwrap_or(v));
    }
    let read = open(&folder.path().join("w_roughness.png"));
    assert_eq!(read.material.name(), "w");
    assert_same(&read, EIGHT_BITS);
    assert_refused(folder.path(), &["several: v, w"]);
}

#[test]
fn metallic_sets_of_every_library_become_diffuse_and_specular() {
    let base = [0.5, 0.4, 0.3];
    let libraries: [(&str, &[&str; 4]); 5] = [
        (
            "ambientCG",
            &["M1_1K-PNG_Color", "M1_1K-PNG_NormalGL", "M1_1K-PNG_Roughness", "M1_1K-PNG_Metalness"],
        ),
        ("Poly Haven", &["wood_diff_1k", "wood_nor_gl_1k", "wood_rough_1k", "wood_metal_1k"]),
        ("Substance", &["T_BaseColor", "T_Normal_OpenGL", "T_Roughness", "T_Metallic"]),
        ("MatSynth", &["basecolor", "normal", "roughness", "metallic"]),
        ("Unreal", &["T_Wall_BC", "T_Wall_N", "T_Wall_R", "T_Wall_M"]),
    ];
    for (library, names) in libraries {
        let folder = tempdir().unwrap();
        put(folder.path(), names[0], |_, _| base.map(srgb));
        put(folder.path(), names[1], bumps);
        put(folder.path(), names[2], |x, y| texel(2, x, y));
        put(folder.path(), names[3], |x, _| [if x < SIDE / 2 { 0.0 } else { 1.0 }; 3]);
        let read = open(folder.path());
        assert_eq!(chosen(&read, What::Workflow), "metallic", "{library}");
        let (left, right) = (read.material.texel(0), read.material.texel(SIDE - 1));
        for (c, base) in base.into_iter().enumerate() {
            let matte = (left.diffuse[c] - base).abs() < 0.005 && (left.specular[c] - 0.04).abs() < 1e-9;
            let metal = right.diffuse[c].abs() < 1e-9 && (right.specular[c] - base).abs() < 0.005;
            assert!(matte && metal, "{library}: {left:?}, {right:?}");
        }
    }
}

#[test]
fn packed_occlusion_roughness_metallic_is_taken_apart() {
    for name in ["a_OcclusionRoughMetal", "a_orm", "a_arm_2k", "a_metallicRoughness"] {
        let folder = grays(&[("a_BaseColor", srgb(0.5))]);
        put(folder.path(), "a_Normal", bumps);
        put(folder.path(), name, |x, y| [1.0, texel(2, x, y)[0], 1.0]);
        let read = open(folder.path());
        for index in [0, 77, 200] {
            let expected = texel(2, index % SIDE, index / SIDE)[0];
            assert!((read.material.texel(index).roughness - expected).abs() < EIGHT_BITS, "{name}");
        }
        assert!((read.material.texel(3).specular[0] - 0.5).abs() < 0.005, "{name}");
    }
}

#[test]
fn glossiness_is_turned_into_roughness() {
    let folder = tempdir().unwrap();
    let names = ["s_Normal.png", "s_Diffuse.png", "s_Glossiness.png", "s_Specular.png"];
    folder_of(names, folder.path(), |map, v| if map == 2 { 1.0 - v } else { srgb(v) });
    let read = open(folder.path());
    assert_eq!((chosen(&read, What::Roughness), chosen(&read, What::Albedo)), ("gloss", "srgb"));
    assert_same(&read, 2.0 * EIGHT_BITS);
}

#[test]
fn maps_of_differing_sizes_are_resampled_to_the_largest_and_said() {
    let folder = tempdir().unwrap();
    folder_of(NAMES, folder.path(), |_, v| v);
    let half = GrayImage::from_pixel(SIDE as u32 / 2, SIDE as u32 / 2, [102].into());
    save(folder.path(), "roughness.png", &half.into(), ImageFormat::Png);
    let read = open(folder.path());
    assert_eq!(read.material.size(), [SIDE; 2]);
    assert!(read.material.planes().roughness.iter().all(|r| (r - 0.4).abs() < 1e-9));
    assert_notes(&read, &["roughness from 8 x 8"]);
}

/// Writes map number `map` under `name`, encoded.
fn put_map(folder: &Path, name: &str, map: usize, encode: impl Fn(f64) -> f64) {
    put(folder, name, |x, y| stored(map, x, y, &encode));
}

#[test]
fn maps_of_a_shared_stem_go_to_every_set_of_its_prefix() {
    let folder = tempdir().unwrap();
    for colour in ["black", "white"] {
        put_map(folder.path(), &format!("bishop_{colour}_normal"), 0, |v| v);
        put_map(folder.path(), &format!("bishop_{colour}_diffuse"), 1, |v| v);
        put_map(folder.path(), &format!("bishop_{colour}_roughness"), 2, |v| v);
    }
    put_map(folder.path(), "bishop_shared_specular", 3, |v| v);
    put_map(folder.path(), "king_shared_specular", 1, |v| v);
    for path in ["bishop_white", "bishop_black_normal.png"] {
        let read = open(&folder.path().join(path));
        assert_same(&read, EIGHT_BITS);
        assert_notes(&read, &["bishop_shared_specular"]);
    }
    assert_refused(folder.path(), &["several: bishop_black, bishop_white"]);
}

#[test]
fn numbered_files_are_the_maps_of_deschaintre_if_the_first_looks_like_normals() {
    let folder = tempdir().unwrap();
    for (map, encode) in [|v| v, gamma, |v| v, gamma].into_iter().enumerate() {
        put_map(folder.path(), &format!("crane_{map}"), map, encode);
    }
    let read = open(folder.path());
    assert_eq!(
        (chosen(&read, What::Albedo), certainty(&read, What::Albedo)),
        ("gamma2.2", Some(Certainty::Unsure))
    );
    assert_same(&read, 2.5 * EIGHT_BITS);
    put_map(folder.path(), "crane_0", 2, |v| v);
    assert_refused(folder.path(), &["crane_0.png without the look of normals"]);
    put_map(folder.path(), "crane_0", 0, |v| v);
    put_map(folder.path(), "crane_4", 1, |v| v);
    assert_refused(folder.path(), &["crane_4.png"]);
}

#[test]
fn opensvbrdf_opens_with_its_widths_and_its_scale() {
    let folder = tempdir().unwrap();
    let file = |name: &str| folder.path().join(format!("{name}_texture.exr"));
    let image = |value: &dyn Fn(usize, usize) -> [f64; 3]| {
        let rgb = |x: u32, y: u32| image::Rgb(value(x as usize, y as usize).map(|v| v as f32));
        DynamicImage::from(image::Rgb32FImage::from_fn(SIDE as u32, SIDE as u32, rgb))
    };
    let save =
        |name, value: &dyn Fn(usize, usize) -> [f64; 3]| rgb_exr(&file(name), &image(value).to_rgb32f());
    save("normal", &|x, y| stored(0, x, y, |v| v));
    save("pd", &|x, y| texel(1, x, y));
    save("ps", &|x, y| texel(3, x, y).map(|s| s / 0.04));
    // The widths are twice and half of alpha = r^2.
    save("ax_ay", &|x, y| {
        let alpha = texel(2, x, y)[0].powi(2);
        [2.0 * alpha, 0.5 * alpha, 0.0].map(|a| a.min(1.0))
    });
    save("tangent", &|_, _| [1.0, 0.5, 0.5]);
    let read = open(folder.path());
    assert_eq!(chosen(&read, What::Roughness), "axay", "{:#?}", read.assumptions);
    assert_notes(&read, &["a factor on 0.04", "two widths"]);
    for index in 0..SIDE * SIDE {
        let [d, r, s] = [1, 2, 3].map(|map| texel(map, index % SIDE, index / SIDE));
        let got = read.material.texel(index);
        let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5);
        assert!(near(got.diffuse, d) && near(got.specular, s), "{got:?}");
        // Below the width 1 at which 2 alpha is cut off.
        if r[0] < 0.7 {
            assert!((got.roughness - r[0]).abs() < 1e-5, "{got:?}, not {r:?}");
        }
    }
}

#[test]
fn a_picture_of_normals_is_found_though_its_name_is_misspelt() {
    let folder = tempdir().unwrap();
    folder_of(
        ["wall_nroaml.png", "wall_diffuse.png", "wall_roughness.png", "wall_specular.png"],
        folder.path(),
        |_, v| v,
    );
    let read = open(folder.path());
    assert_same(&read, EIGHT_BITS);
    assert!(read.unsure().any(|a| a.chosen == "normal is wall_nroaml.png"), "{:#?}", read.assumptions);
}

#[test]
fn packings_of_engines_are_taken_apart() {
    let [rough, metal] = [|x, y| texel(2, x, y)[0], |_: usize, _: usize| 1.0];
    type Pixel = fn(f64, f64) -> [f64; 4];
    let table: [(&str, Pixel, bool); 5] = [
        ("a_MaskMap", |r, m| [m, 1.0, 0.3, 1.0 - r], false),
        ("a_MetallicSmoothness", |r, m| [m, m, m, 1.0 - r], false),
        ("a_mra", |r, m| [m, r, 0.3, 1.0], true),
        ("a_rma", |r, m| [r, m, 0.3, 1.0], true),
        ("a_ks", |r, m| [0.0, r, m, 1.0], false),
    ];
    for (name, pixel, unsure) in table {
        let folder = tempdir().unwrap();
        put_map(folder.path(), "a_normal", 0, |v| v);
        gray(folder.path(), "a_kd", srgb(0.5));
        let image = image::RgbaImage::from_fn(SIDE as u32, SIDE as u32, |x, y| {
            let (x, y) = (x as usize, y as usize);
            pixel(rough(x, y), metal(x, y)).map(|v| (255.0 * v).round() as u8).into()
        });
        save(folder.path(), &format!("{name}.png"), &image.into(), ImageFormat::Png);
        let read = open(folder.path());
        for index in [0, 77, 200] {
            let got = read.material.texel(index);
            assert_near([got.roughness, got.specular[0]], [rough(index % SIDE, index / SIDE), 0.5]);
            assert!(got.diffuse[0].abs() < 1e-9, "{name}: {got:?}");
        }
        let doubts = read.unsure().any(|a| a.why.to_string().contains("packings of this name differ"));
        assert_eq!(doubts, unsure, "{name}: {:#?}", read.assumptions);
    }
}

#[test]
fn of_two_files_for_a_map_the_better_is_taken_and_it_is_said() {
    let folder = tempdir().unwrap();
    folder_of(NAMES, folder.path(), |_, v| v);
    put_map(folder.path(), "roughness", 1, |v| v);
    map_exr(&folder.path().join("roughness.exr"), 2, |_, v| v);
    let read = open(folder.path());
    assert_same(&read, EIGHT_BITS);
    assert_notes(&read, &["roughness.png is not used: roughness.exr is preferred"]);
}

#[test]
fn maps_in_the_only_folder_within_open_and_several_folders_are_listed() {
    let folder = tempdir().unwrap();
    let within = folder.path().join("textures");
    std::fs::create_dir(&within).unwrap();
    folder_of(NAMES, &within, |_, v| v);
    let read = open(folder.path());
    assert_same(&read, EIGHT_BITS);
    assert_notes(&read, &["in the folder textures within"]);
    std::fs::create_dir(folder.path().join("other")).unwrap();
    assert_refused(folder.path(), &["none, but the folders other, textures", "open one of them"]);
    // Pictures beside it that name no map are previews.
    gray(folder.path(), "preview", 0.5);
    gray(folder.path(), "wall", 0.5);
    let read = open(folder.path());
    assert_same(&read, EIGHT_BITS);
    assert_notes(
        &read,
        &["in the folder textures within", "preview.png is not used", "wall.png is not used"],
    );
    let data_set = tempdir().unwrap();
    for name in ["basecolor", "normal", "roughness"] {
        std::fs::create_dir(data_set.path().join(name)).unwrap();
    }
    assert_refused(data_set.path(), &["one folder per map"]);
}

#[test]
fn the_only_file_of_a_folder_opens_or_is_refused_by_its_format() {
    for (name, bytes, said) in [
        ("Rock_1K.zip", b"PK\x05\x06\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0".as_slice(), "Rock_1K.zip"),
        ("maps.h5", b"\x89HDF\r\n\x1a\n", "HDF5"),
        ("maps.pt", b"PK", "PyTorch"),
    ] {
        let folder = tempdir().unwrap();
        std::fs::write(folder.path().join(name), bytes).unwrap();
        std::fs::write(folder.path().join("README.md"), "how it was made").unwrap();
        assert_refused(folder.path(), &[said]);
    }
    let folder = tempdir().unwrap();
    npz(&folder.path().join("m.npz"));
    assert_same(&open(folder.path()), 1e-6);
}

#[test]
fn spec_of_texture_haven_is_the_level_of_specular_and_asked_about() {
    for (names, expected, is_doubted) in [
        (["x_diff", "x_rough", "x_spec"], 0.04, true),
        (["x_diffuse", "x_roughness", "x_spec"], 0.214, false),
    ] {
        let folder = tempdir().unwrap();
        put(folder.path(), "x_nor_gl", bumps);
        names.iter().for_each(|name| gray(folder.path(), name, 0.5));
        let read = open(folder.path());
        assert_near([read.material.texel(0).specular[0]], [expected]);
        let doubts = read.unsure().any(|a| a.why.to_string().contains("Texture Haven"));
        assert_eq!(doubts, is_doubted, "{names:?}: {:#?}", read.assumptions);
    }
}
