//! One test for each row of the table in `docs/formats.md`: what opens, and that it is the same material.

use std::path::Path;

use image::{DynamicImage, GrayImage, ImageFormat};
use svbrdf::error::Error;
use svbrdf::material::Material;
use svbrdf::material::read::{
    Albedo, Certainty, NonFinite, NormalY, Order, Read, ReadOptions, Roughness, What, read,
};
use svbrdf::material::write::{self, Depth, Kind};
use svbrdf::progress::Progress;
use tempfile::tempdir;

use crate::support::pictures::{
    SIDE, gamma, layered, map_exr, multi_part, npy, npz, packed, picture, srgb, stored, texel, windowed,
    write as save,
};

/// Of 8-bit codes, decoded: half a code of a normal, and of the steepest encoding.
const EIGHT_BITS: f64 = 0.006;
/// Of half floats.
const HALF: f64 = 0.001;

fn open_as(path: &Path, options: &ReadOptions) -> Read<f64> {
    read(path, options, &Progress::default()).unwrap()
}

fn open(path: &Path) -> Read<f64> {
    open_as(path, &ReadOptions::default())
}

fn refusal(path: &Path) -> String {
    read::<f64>(path, &ReadOptions::default(), &Progress::default()).unwrap_err().to_string()
}

fn chosen<T>(read: &Read<T>, what: What) -> &str {
    read.assumptions.iter().find(|a| a.what == what).map_or("", |a| &a.chosen)
}

fn certainty<T>(read: &Read<T>, what: What) -> Option<Certainty> {
    read.assumptions.iter().find(|a| a.what == what).map(|a| a.certainty)
}

/// The worst difference from the material of `texel`.
fn worst(material: &Material<f64>) -> f64 {
    assert_eq!(material.size(), [SIDE; 2]);
    let mut worst = 0.0_f64;
    for index in 0..SIDE * SIDE {
        let [n, d, r, s] = [0, 1, 2, 3].map(|map| texel(map, index % SIDE, index / SIDE));
        let got = material.texel(index);
        let pairs = got.normal.to_array().into_iter().zip(n).chain(got.diffuse.into_iter().zip(d));
        let pairs = pairs.chain(got.specular.into_iter().zip(s)).chain([(got.roughness, r[0])]);
        worst = pairs.map(|(a, b)| (a - b).abs()).fold(worst, f64::max);
    }
    worst
}

#[track_caller]
fn assert_same(read: &Read<f64>, bound: f64) {
    let worst = worst(&read.material);
    assert!(worst <= bound, "off by {worst}; {:#?}", read.assumptions);
}

fn linear(_: char, value: f64) -> f64 {
    value
}

fn colours(letter: char, value: f64) -> f64 {
    if letter == 'R' { value } else { gamma(value) }
}

#[test]
fn every_packed_layout_is_found_by_its_normal_tile() {
    type Encode = fn(char, f64) -> f64;
    let table: [(&str, usize, Encode, &str); 9] = [
        ("NDRS", 4, linear, "ndrs in 4 x 1"),
        ("NDRS", 1, linear, "ndrs in 1 x 4"),
        ("INDRS", 5, linear, "ndrs in 5 x 1"),
        ("IIINDRS", 7, linear, "ndrs in 7 x 1"),
        ("DNRS", 4, |_, v| gamma(v), "dnrs in 4 x 1"),
        ("DSRN", 4, colours, "dsrn in 4 x 1"),
        ("NDSR", 2, |_, v| gamma(v), "ndsr in 2 x 2"),
        ("DSRN", 2, colours, "dsrn in 2 x 2"),
        ("NDRSNDRS", 4, linear, "ndrs in 4 x 2"),
    ];
    let folder = tempdir().unwrap();
    for (order, columns, encode, layout) in table {
        let path = save(folder.path(), "some.png", &packed(order, columns, encode), ImageFormat::Png);
        let read = open(&path);
        assert!(chosen(&read, What::Layout).starts_with(layout), "{order}: {:?}", read.assumptions);
        assert_same(&read, if layout.starts_with("ndrs") { EIGHT_BITS } else { 2.5 * EIGHT_BITS });
    }
}

#[test]
fn a_strip_of_three_has_the_specular_of_dielectrics() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "tex.png", &packed("DNR", 3, |_, v| gamma(v)), ImageFormat::Png);
    let read = open(&path);
    assert!(chosen(&read, What::Layout).starts_with("dnr in 3 x 1"));
    assert_eq!(read.material.texel(7).specular, [0.04; 3]);
    assert_eq!(chosen(&read, What::Missing), "specular 0.04");
}

#[test]
fn of_several_exemplars_one_is_chosen() {
    let folder = tempdir().unwrap();
    let image = packed("NDRSNDRS", 4, linear).into_rgb8();
    let mut image = image;
    for y in SIDE as u32..2 * SIDE as u32 {
        for x in SIDE as u32..2 * SIDE as u32 {
            image.put_pixel(x, y, [51, 51, 51].into());
        }
    }
    let path = save(folder.path(), "two.png", &image.into(), ImageFormat::Png);
    let second = open_as(&path, &ReadOptions { exemplar: 1, ..ReadOptions::default() });
    assert_same(&open(&path), EIGHT_BITS);
    assert!((second.material.texel(5).diffuse[0] - 0.2).abs() < 1e-12);
    assert!(second.notes.iter().any(|note| note.contains("holds 2 materials")));
}

#[test]
fn the_order_of_tiles_can_be_said() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "a.png", &packed("DNRS", 4, linear), ImageFormat::Png);
    let options = ReadOptions {
        order: Some(Order::Dnrs),
        albedo: Some(Albedo::Linear),
        roughness: Some(Roughness::R),
        ..ReadOptions::default()
    };
    assert_same(&open_as(&path, &options), EIGHT_BITS);
    assert_eq!(certainty(&open_as(&path, &options), What::Layout), Some(Certainty::Given));
}

/// Writes one PNG a map under `names`, in the order normal, diffuse, roughness, specular.
fn folder_of(names: [&str; 4], folder: &Path, encode: impl Fn(usize, f64) -> f64) {
    for (map, name) in names.into_iter().enumerate() {
        let image = picture(SIDE, SIDE, |x, y| stored(map, x, y, |v| encode(map, v)));
        save(folder, name, &image, ImageFormat::Png);
    }
}

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
        (["normal.png", "diffuse.png", "roughness.png", "specular.png"], raw, "linear"),
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
    folder_of(
        ["w_normal.png", "w_diffuse.png", "w_roughness.png", "w_specular.png"],
        folder.path(),
        |_, v| v,
    );
    folder_of(
        ["v_normal.png", "v_diffuse.png", "v_roughness.png", "v_specular.png"],
        folder.path(),
        |_, _| 0.5,
    );
    let read = open(&folder.path().join("w_roughness.png"));
    assert_eq!(read.material.name(), "w");
    assert_same(&read, EIGHT_BITS);
    assert!(refusal(folder.path()).contains("several: v, w"));
}

#[test]
fn metallic_sets_of_every_library_become_diffuse_and_specular() {
    let rough = |x, y| texel(2, x, y)[0];
    let metal = |x: usize, _: usize| if x < SIDE / 2 { 0.0 } else { 1.0 };
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
        let put = |name: &str, image| save(folder.path(), &format!("{name}.png"), &image, ImageFormat::Png);
        put(names[0], picture(SIDE, SIDE, |_, _| base.map(srgb)));
        put(names[1], picture(SIDE, SIDE, |x, y| stored(0, x, y, |v| v)));
        put(names[2], picture(SIDE, SIDE, |x, y| [rough(x, y); 3]));
        put(names[3], picture(SIDE, SIDE, |x, y| [metal(x, y); 3]));
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
        let folder = tempdir().unwrap();
        let put = |name: &str, image| save(folder.path(), &format!("{name}.png"), &image, ImageFormat::Png);
        put("a_BaseColor", picture(SIDE, SIDE, |_, _| [0.5; 3].map(srgb)));
        put("a_Normal", picture(SIDE, SIDE, |x, y| stored(0, x, y, |v| v)));
        put(name, picture(SIDE, SIDE, |x, y| [1.0, texel(2, x, y)[0], 1.0]));
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
fn y_of_normals_is_told_by_names_and_by_curl() {
    for (name, turned) in [("a_NormalGL", false), ("a_nor_dx", true), ("a_normal", false), ("a_normal", true)]
    {
        let folder = tempdir().unwrap();
        folder_of(["x.png", "a_diffuse.png", "a_roughness.png", "a_specular.png"], folder.path(), |_, v| v);
        let image = picture(SIDE, SIDE, |x, y| {
            let [r, g, b] = stored(0, x, y, |v| v);
            [r, if turned { 1.0 - g } else { g }, b]
        });
        save(folder.path(), &format!("{name}.png"), &image, ImageFormat::Png);
        let read = open(folder.path());
        let expected = if turned { NormalY::Down } else { NormalY::Up };
        assert_eq!(chosen(&read, What::NormalY), expected.name(), "{name}: {:#?}", read.assumptions);
        assert_same(&read, EIGHT_BITS);
    }
}

#[test]
fn layered_and_multi_part_exr_open_with_signed_normals() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.exr");
    for write in [|p: &Path| layered(p, false), |p: &Path| layered(p, true), multi_part] {
        write(&path);
        let read = open(&path);
        assert_eq!((chosen(&read, What::NormalCode), chosen(&read, What::Albedo)), ("signed", "linear"));
        assert_same(&read, HALF);
    }
}

#[test]
fn a_folder_of_float_exr_opens_and_y_alone_is_gray() {
    let folder = tempdir().unwrap();
    for (map, name) in ["normal", "diffuse", "roughness", "specular"].iter().enumerate() {
        map_exr(&folder.path().join(format!("{name}.exr")), map, |_, v| v);
    }
    assert_same(&open(folder.path()), 1e-6);
}

#[test]
fn nan_and_infinity_are_counted_located_and_replaced_only_on_request() {
    let folder = tempdir().unwrap();
    for (map, name) in ["normal", "diffuse", "roughness", "specular"].iter().enumerate() {
        let damage = |i, v| match (map, i) {
            (1, 35) => f32::NAN,
            (1, 50) => f32::INFINITY,
            _ => v,
        };
        map_exr(&folder.path().join(format!("{name}.exr")), map, damage);
    }
    let message = refusal(folder.path());
    for words in
        ["diffuse.exr", "diffuse map, column 3, row 2", "3 NaN and 3 infinite", "--non-finite replace"]
    {
        assert!(message.contains(words), "`{words}` is not in {message}");
    }
    let replaced =
        open_as(folder.path(), &ReadOptions { non_finite: NonFinite::Replace, ..ReadOptions::default() });
    assert_eq!(replaced.material.texel(35).diffuse, [0.0; 3]);
    assert!(replaced.said().any(|line| line.contains("6 samples of the diffuse map")));
}

#[test]
fn values_beyond_one_are_clamped_and_counted() {
    let folder = tempdir().unwrap();
    for (map, name) in ["normal", "diffuse", "roughness", "specular"].iter().enumerate() {
        map_exr(
            &folder.path().join(format!("{name}.exr")),
            map,
            |i, v| if (map, i) == (3, 4) { 2.5 } else { v },
        );
    }
    let read = open(folder.path());
    assert_eq!(read.material.texel(4).specular, [1.0; 3]);
    assert!(read.unsure().any(|a| a.why.contains("3 samples of the specular map") && a.why.contains("2.5")));
}

#[test]
fn data_beside_the_display_window_is_put_in_its_place_and_said() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.exr");
    windowed(&path, (0, 0), SIDE);
    assert_same(&open(&path), HALF);
    windowed(&path, (-7, 3), SIDE);
    let shifted = open(&path);
    assert_same(&shifted, HALF);
    assert!(shifted.notes.iter().any(|note| note.contains("data window beside")), "{:?}", shifted.notes);
    windowed(&path, (2, 1), SIDE + 4);
    let read = open(&path);
    assert_eq!(read.material.size(), [SIDE + 4; 2]);
    let (inside, outside) = (read.material.texel(3 * (SIDE + 4) + 5), read.material.texel(0));
    let expected = texel(1, 3, 2);
    assert!(inside.diffuse.iter().zip(expected).all(|(a, b)| (a - b).abs() < HALF), "{inside:?}");
    assert_eq!((outside.diffuse, outside.normal.to_array()), ([0.0; 3], [0.0, 0.0, 1.0]));
    assert!(read.notes.iter().any(|note| note.contains("16 x 16 of the 20 x 20")), "{:?}", read.notes);
}

#[test]
fn tiff_of_8_and_16_bits_and_floats_opens() {
    let folder = tempdir().unwrap();
    let eight = packed("NDRS", 4, linear);
    let images = [eight.clone(), DynamicImage::from(eight.to_rgb16()), DynamicImage::from(eight.to_rgb32f())];
    for (image, depth) in images.iter().zip(["8-bit", "16-bit", "float"]) {
        let read = open(&save(folder.path(), "a.tif", image, ImageFormat::Tiff));
        assert_eq!(read.maps[0].depth, depth);
        assert_same(&read, EIGHT_BITS);
    }
}

#[test]
fn jpeg_opens_within_its_blocks() {
    let folder = tempdir().unwrap();
    let read = open(&save(folder.path(), "a.jpg", &packed("NDRS", 4, linear), ImageFormat::Jpeg));
    assert_same(&read, 0.2);
}

#[test]
fn radiance_hdr_opens_as_linear_floats() {
    let folder = tempdir().unwrap();
    let image = DynamicImage::from(packed("NDRS", 4, linear).to_rgb32f());
    let read = open(&save(folder.path(), "a.hdr", &image, ImageFormat::Hdr));
    assert_eq!((chosen(&read, What::Albedo), read.maps[0].depth), ("linear", "float"));
    assert_same(&read, 0.02);
}

#[test]
fn numpy_arrays_and_archives_open() {
    let folder = tempdir().unwrap();
    npz(&folder.path().join("m.npz"));
    assert_same(&open(&folder.path().join("m.npz")), 1e-6);
    let values: Vec<f32> = (0..4 * SIDE * SIDE)
        .flat_map(|i| stored(i % (4 * SIDE) / SIDE, i % SIDE, i / (4 * SIDE), |v| v).map(|v| v as f32))
        .collect();
    let strip = folder.path().join("strip.npy");
    std::fs::write(&strip, npy([SIDE as u64, 4 * SIDE as u64, 3], &values)).unwrap();
    assert_same(&open(&strip), 1e-6);
}

#[test]
fn maps_of_differing_sizes_are_resampled_to_the_largest_and_said() {
    let folder = tempdir().unwrap();
    folder_of(["normal.png", "diffuse.png", "roughness.png", "specular.png"], folder.path(), |_, v| v);
    let half = GrayImage::from_pixel(SIDE as u32 / 2, SIDE as u32 / 2, [102].into());
    save(folder.path(), "roughness.png", &half.into(), ImageFormat::Png);
    let read = open(folder.path());
    assert_eq!(read.material.size(), [SIDE; 2]);
    assert!(read.material.planes().roughness.iter().all(|r| (r - 0.4).abs() < 1e-9));
    assert!(read.said().any(|line| line.contains("roughness from 8 x 8")));
}

#[test]
fn a_normal_map_of_x_and_y_gets_its_z() {
    for blue in [0.0, 1.0] {
        let folder = tempdir().unwrap();
        folder_of(["x.png", "a_diffuse.png", "a_roughness.png", "a_specular.png"], folder.path(), |_, v| v);
        let image = picture(SIDE, SIDE, |x, y| {
            let [r, g, _] = stored(0, x, y, |v| v);
            [r, g, blue]
        });
        save(folder.path(), "a_normal.png", &image, ImageFormat::Png);
        let read = open(folder.path());
        assert_eq!(chosen(&read, What::NormalCode), "x and y, z rebuilt", "{blue}: {:#?}", read.assumptions);
        assert_same(&read, 2.0 * EIGHT_BITS);
    }
}

#[test]
fn what_is_written_is_read_back() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "a.png", &packed("NDRS", 4, linear), ImageFormat::Png);
    let original: Read<f32> = read(&path, &ReadOptions::default(), &Progress::default()).unwrap();
    let table = [
        ("h.exr", None, HALF),
        ("f.exr", Some(Depth::Float), 0.0),
        ("p.png", None, 0.005),
        ("q.png", Some(Depth::Sixteen), 3e-5),
        ("folder", Some(Depth::Sixteen), 1e-4),
    ];
    for (name, depth, bound) in table {
        let out = folder.path().join(name);
        write::write(&original.material, &out, Kind::new(&out, depth).unwrap()).unwrap();
        let again: Read<f32> = read(&out, &ReadOptions::default(), &Progress::default()).unwrap();
        let mut worst = 0.0_f32;
        for index in 0..SIDE * SIDE {
            let [a, b] = [&original, &again].map(|r| r.material.texel(index));
            let pairs = a.normal.to_array().into_iter().zip(b.normal.to_array());
            let pairs = pairs
                .chain(a.diffuse.into_iter().zip(b.diffuse))
                .chain(a.specular.into_iter().zip(b.specular));
            worst =
                pairs.chain([(a.roughness, b.roughness)]).map(|(a, b)| (a - b).abs()).fold(worst, f32::max);
        }
        assert!(worst <= bound as f32, "{name}: off by {worst}");
    }
}

#[test]
fn a_native_exr_that_is_read_and_written_again_is_the_same_file() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "a.png", &packed("NDRS", 4, linear), ImageFormat::Png);
    for depth in [Depth::Half, Depth::Float] {
        let files = ["one.exr", "two.exr"].map(|name| folder.path().join(name));
        for (from, to) in [(&path, &files[0]), (&files[0], &files[1])] {
            let read: Read<f32> = read(from, &ReadOptions::default(), &Progress::default()).unwrap();
            write::write(&read.material, to, Kind::new(to, Some(depth)).unwrap()).unwrap();
        }
        assert!(std::fs::read(&files[0]).unwrap() == std::fs::read(&files[1]).unwrap(), "{depth:?}");
    }
}

#[test]
fn a_folder_that_is_there_is_not_replaced() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "a.png", &packed("NDRS", 4, linear), ImageFormat::Png);
    let read: Read<f32> = read(&path, &ReadOptions::default(), &Progress::default()).unwrap();
    let kind = Kind::new(folder.path(), None).unwrap();
    let result = write::write(&read.material, folder.path(), kind);
    assert!(matches!(result, Err(Error::Unwritable { .. })));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}
