//! Options of reading that a user specifies.

use svbrdf_files::read::{Binding, Energy, MaterialPath, NormalEncoding, Workflow};

use super::*;

/// A strip of the maps whose letters are in `order`, each texel encoded by `of`.
fn strip(order: &str, of: impl Fn(usize, [f64; 3], [f64; 3]) -> [f64; 3]) -> DynamicImage {
    let maps: Vec<usize> = order.chars().map(|letter| "NDRS".find(letter).unwrap()).collect();
    picture(maps.len() * SIDE, SIDE, |x, y| {
        let (map, x) = (maps[x / SIDE], x % SIDE);
        let value = texel(map, x, y);
        if map == 0 { value.map(|n| 0.5 * n + 0.5) } else { of(map, value, texel(3, x, y)) }
    })
}

fn saved(image: &DynamicImage) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "a.png", image, ImageFormat::Png);
    (folder, path)
}

#[test]
fn presets_read_what_their_sources_write() {
    // Diffuse of renderers that take d alone: theirs is d (1 - s).
    let plain = |map, value: [f64; 3], s: [f64; 3]| {
        if map == 1 { [0, 1, 2].map(|c| value[c] * (1.0 - s[c])) } else { value }
    };
    type Write = fn(usize, [f64; 3]) -> [f64; 3];
    let table: [(Preset, &str, bool, Write); 7] = [
        (Preset::Deschaintre, "NDRS", false, |_, v| v),
        (Preset::Deschaintre18, "NDRS", false, |_, v| v),
        (Preset::SurfaceNet, "NDRS", false, |_, v| v),
        (Preset::Gao, "NDRS", true, |map, v| if map == 1 { v.map(gamma) } else { v }),
        (Preset::MaterialGan, "DNRS", false, |_, v| v.map(gamma)),
        (Preset::LookAhead, "DNRS", false, |map, v| if map == 2 { v } else { v.map(gamma) }),
        (Preset::MatFusion, "DSRN", true, |map, v| if map == 2 { v } else { v.map(gamma) }),
    ];
    for (preset, order, is_plain, write) in table {
        let (_folder, path) = saved(&strip(order, |map, value, s| {
            write(map, if is_plain { plain(map, value, s) } else { value })
        }));
        let read = open_as(&path, &ReadOptions { preset: Some(preset), ..ReadOptions::AUTO });
        assert_same(&read, 2.5 * EIGHT_BITS);
        assert_eq!(certainty(&read, What::Albedo), Some(Certainty::Given), "{preset}");
    }
}

#[test]
fn presets_give_way_to_what_else_is_said() {
    let (_folder, path) = saved(&strip("NDRS", |_, value, _| value));
    let options = ReadOptions {
        preset: Some(Preset::MaterialGan),
        albedo: Some(Albedo::Linear),
        roughness: Some(Roughness::R),
        ..ReadOptions::AUTO
    };
    assert_same(&open_as(&path, &options), EIGHT_BITS);
}

#[test]
fn rows_can_be_said_to_run_upwards() {
    let upwards = picture(4 * SIDE, SIDE, |x, y| {
        let [r, g, b] = stored(x / SIDE, x % SIDE, SIDE - 1 - y, |v| v);
        // The mirrored surface: what rose upwards falls upwards.
        if x / SIDE == 0 { [r, 1.0 - g, b] } else { [r, g, b] }
    });
    let (_folder, path) = saved(&upwards);
    let read = open_as(&path, &ReadOptions { flip_v: Some(true), ..ReadOptions::AUTO });
    assert_same(&read, EIGHT_BITS);
    assert!(worst(&open(&path).material) > 0.1, "without the option it is another material");
    assert_notes(&read, &["Row 0 is the lowest row, as specified"]);
}

#[test]
fn plain_diffuse_is_divided_by_what_specular_leaves() {
    let (_folder, path) = saved(&strip("NDRS", |_, value, _| value));
    let read = open_as(&path, &ReadOptions { energy: Some(Energy::Unscaled), ..ReadOptions::AUTO });
    for index in [0, 77, 200] {
        let (got, [d, s]) =
            (read.material.texel(index), [1, 3].map(|map| texel(map, index % SIDE, index / SIDE)));
        for c in 0..3 {
            assert!((got.diffuse[c] * (1.0 - got.specular[c]) - d[c]).abs() < EIGHT_BITS, "{got:?}");
            assert!((got.specular[c] - s[c]).abs() < EIGHT_BITS);
        }
    }
    assert_eq!(chosen(&read, What::Energy), "diffuse not scaled by (1 - specular): d / (1 - s) is used");
    // What a diagnosis knows of the storage: it tries the other reading, and not this one again.
    assert!(read.storage().unscaled && !open_as(&path, &ReadOptions::AUTO).storage().unscaled);
}

#[test]
fn tiles_that_are_not_square_open_with_their_grid() {
    let wide = strip("NDRS", |_, value, _| value).crop_imm(0, 0, 4 * SIDE as u32, SIDE as u32 / 2);
    let (_folder, path) = saved(&wide);
    let options = ReadOptions { grid: Some("4x1".parse().unwrap()), ..ReadOptions::AUTO };
    let read = open_as(&path, &options);
    assert_eq!(read.material.size(), [SIDE, SIDE / 2]);
    for index in 0..SIDE * SIDE / 2 {
        let expected = texel(1, index % SIDE, index / SIDE);
        let got = read.material.texel(index).diffuse;
        assert!(got.iter().zip(expected).all(|(a, b)| (a - b).abs() < EIGHT_BITS), "{index}");
    }
    let odd = ReadOptions { grid: Some("5x1".parse().unwrap()), ..ReadOptions::AUTO };
    let message = super::read::<f64>(&path, &odd, &Progress::default()).unwrap_err().to_string();
    assert!(message.contains("5 x 1 tiles") && message.contains("64 x 8"), "{message}");
}

#[test]
fn any_order_can_be_said() {
    let (_folder, path) = saved(&strip("RSND", |_, value, _| value));
    let options = ReadOptions {
        order: Some("rsnd".parse().unwrap()),
        albedo: Some(Albedo::Linear),
        ..ReadOptions::AUTO
    };
    assert_same(&open_as(&path, &options), EIGHT_BITS);
    for wrong in ["nndr", "nds", "nxrs", "", "iiiindrs"] {
        assert!(wrong.parse::<Order>().is_err(), "{wrong}");
    }
    let saved = serde_json::to_string(&options).unwrap();
    assert_eq!(serde_json::from_str::<ReadOptions>(&saved).unwrap(), options, "{saved}");
}

#[test]
fn the_workflow_and_the_reflectance_of_dielectrics_can_be_said() {
    let folder = tempdir().unwrap();
    for (name, value) in
        [("diffuse", srgb(0.5)), ("metallic", 0.5), ("roughness", 0.5), ("specular", srgb(0.25))]
    {
        gray(folder.path(), name, value);
    }
    let options = |workflow| ReadOptions {
        workflow: Some(workflow),
        dielectric: Some("0.08".parse().unwrap()),
        albedo: Some(Albedo::Srgb),
        ..ReadOptions::AUTO
    };
    for (workflow, expected) in [(Workflow::Specular, [0.5, 0.25]), (Workflow::Metallic, [0.25, 0.04 + 0.25])]
    {
        let got = open_as(folder.path(), &options(workflow)).material.texel(0);
        assert_near([got.diffuse[0], got.specular[0]], expected);
    }
}

#[test]
fn the_code_of_normals_can_be_said() {
    let (_folder, path) = saved(&strip("NDRS", |_, value, _| value));
    let options = ReadOptions { normal_encoding: Some(NormalEncoding::Xy), ..ReadOptions::AUTO };
    let read = open_as(&path, &options);
    assert_eq!(certainty(&read, What::NormalEncoding), Some(Certainty::Given));
    assert_same(&read, 2.0 * EIGHT_BITS);
    let signed = ReadOptions { normal_encoding: Some(NormalEncoding::Signed), ..ReadOptions::AUTO };
    assert!(worst(&open_as(&path, &signed).material) > 0.1);
}

fn bound(path: &Path, bindings: &[String]) -> Result<Read<f64>, Error> {
    let bindings: Vec<Binding> = bindings.iter().map(|text| text.parse()).collect::<Result<_, _>>()?;
    MaterialPath::new(path, &ReadOptions::AUTO).bound(&bindings).read(&Progress::default())
}

#[test]
fn maps_can_be_named_one_by_one() {
    let folder = tempdir().unwrap();
    folder_of(["one.png", "two.png", "three.png", "four.png"], folder.path(), |_, v| v);
    let packed = picture(SIDE, SIDE, |x, y| [0.9, texel(2, x, y)[0], 0.1]);
    save(folder.path(), "packed.png", &packed, ImageFormat::Png);
    layered(&folder.path().join("layers.exr"), false);
    let all = |roughness: &str| {
        let maps = [
            ("normal", "one.png"),
            ("diffuse", "two.png"),
            ("roughness", roughness),
            ("specular", "four.png"),
        ];
        maps.map(|(map, file)| format!("{map}={}/{file}", folder.path().display()))
    };
    for roughness in ["three.png", "packed.png:g", "layers.exr:roughness"] {
        assert_same(&bound(folder.path(), &all(roughness)).unwrap(), EIGHT_BITS);
    }
    let message = |roughness| bound(folder.path(), &all(roughness)).unwrap_err().to_string();
    assert!(message("packed.png:a").contains("expected the part a"), "{}", message("packed.png:a"));
    assert!(message("layers.exr:rough").contains("`roughness`"), "{}", message("layers.exr:rough"));
    assert!(message("none.png").contains("none.png"));
    for wrong in ["normal", "bumps=a.png", "normal="] {
        assert!(wrong.parse::<Binding>().is_err(), "{wrong}");
    }
}

#[test]
fn named_maps_of_specular_and_diffuse_take_the_place_of_a_metallic_workflow() {
    let folder = grays(&[("basecolor", 0.1), ("orm", 1.0)]);
    let [d, s] =
        [("one", 0.5), ("two", 0.25)].map(|(name, value)| put(folder.path(), name, |_, _| [srgb(value); 3]));
    let bindings = [format!("diffuse={}", d.display()), format!("specular={}", s.display())];
    for (bindings, expected) in [(&bindings[..], [0.5, 0.25]), (&bindings[..1], [0.0, 0.5])] {
        let got = bound(folder.path(), bindings).unwrap().material.texel(0);
        assert_near([got.diffuse[0], got.specular[0]], expected);
    }
}

#[test]
fn a_named_map_takes_the_place_of_one_in_a_strip_and_in_a_folder() {
    let folder = tempdir().unwrap();
    let other = put(folder.path(), "other", |_, _| [0.2; 3]);
    let binding = [format!("roughness={}", other.display())];
    let strip = put_strip(folder.path(), "a", "NDRS");
    let maps = tempdir().unwrap();
    folder_of(NAMES, maps.path(), |_, v| v);
    for path in [strip.as_path(), maps.path()] {
        let read = bound(path, &binding).unwrap();
        assert!(read.material.planes().roughness.iter().all(|r| (r - 0.2).abs() < 1e-9), "{:?}", read.files);
        assert_notes(&read, &["as specified"]);
        assert!(read.files.contains(&other));
    }
}
