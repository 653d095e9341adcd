//! Sets as a whole: what the names of their files have in common, what is left over, and what files beside the maps tell.

use image::{Rgba, RgbaImage};

use svbrdf_files::read::{Binding, MaterialPath, Preset, Role};

use super::*;

/// The height of the bumps of [`texel`]'s normals, in [0, 1].
fn height(x: usize, y: usize) -> f64 {
    let [u, v] = [x, y].map(|i| i as f64 / BUMPS as f64);
    0.5 + 0.2 * (9.0 * u).sin() * (7.0 * v).cos() + 0.1 * (5.0 * u + 11.0 * v).sin()
}

/// Side of maps with heights: correlations need some texels.
pub const BUMPS: usize = 64;

/// Normals of [`height`] as they are stored, with y up times `sign`.
fn heights(sign: f64) -> image::DynamicImage {
    picture(BUMPS, BUMPS, |x, y| {
        let at = |x: usize, y: usize| height(x.min(BUMPS - 1), y.min(BUMPS - 1));
        let n = [
            -4.0 * (at(x + 1, y) - at(x.saturating_sub(1), y)),
            -4.0 * sign * (at(x, y.saturating_sub(1)) - at(x, y + 1)),
            1.0,
        ];
        let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
        n.map(|c| 0.5 * c / length + 0.5)
    })
}

pub fn put(folder: &Path, name: &str, image: &image::DynamicImage) {
    save(folder, name, image, ImageFormat::Png);
}

pub fn gray(folder: &Path, name: &str, value: f64) {
    put(folder, name, &picture(BUMPS, BUMPS, |_, _| [value; 3]));
}

pub fn grays(pictures: &[(&str, f64)]) -> tempfile::TempDir {
    let folder = tempdir().unwrap();
    pictures.iter().for_each(|(name, value)| gray(folder.path(), name, *value));
    folder
}

/// Base colour and roughness of a set of this stem.
fn colour_and_roughness(stem: &str) -> tempfile::TempDir {
    grays(&[(&format!("{stem}_albedo.png"), 0.5), (&format!("{stem}_roughness.png"), 0.25)])
}

#[test]
fn the_common_name_of_a_set_is_no_word_of_a_map() {
    let folder = colour_and_roughness("metal");
    put(folder.path(), "metal_nmroal.png", &heights(1.0));
    let read = open(folder.path());
    assert!((read.material.texel(9).roughness - 0.25).abs() < EIGHT_BITS, "{:?}", read.material.texel(9));
    assert_notes(&read, &["normal is metal_nmroal.png"]);
    assert!(read.material.planes().normal[0].iter().any(|x| x.abs() > 0.1));
}

#[test]
fn a_normal_map_with_a_word_too_many_is_found_and_other_leftovers_are_listed() {
    let folder = colour_and_roughness("crate3");
    put(folder.path(), "crate3_normal_final.png", &heights(1.0));
    gray(folder.path(), "crate3_roughness_old.png", 0.9);
    gray(folder.path(), "label_specular.png", 0.5);
    let read = open(folder.path());
    assert!((read.material.texel(9).roughness - 0.25).abs() < EIGHT_BITS);
    assert_notes(&read, &["normal is crate3_normal_final.png"]);
    for file in ["crate3_roughness_old.png", "label_specular.png"] {
        assert_notes(&read, &[&format!("{file} is not used: it is not named as the other maps are")]);
    }
}

#[test]
fn heights_decide_where_y_points() {
    for (sign, expected) in [(1.0, "up"), (-1.0, "down")] {
        let folder = colour_and_roughness("floor");
        put(folder.path(), "floor_normal.png", &heights(sign));
        put(folder.path(), "floor_displacement.png", &picture(BUMPS, BUMPS, |x, y| [height(x, y); 3]));
        let read = open(folder.path());
        let y = read.assumptions.iter().find(|a| a.what == What::NormalY).unwrap();
        assert_eq!((y.chosen.as_str(), y.certainty), (expected, Certainty::Likely), "{y}");
        assert!(y.to_string().contains("the slopes of"), "{y}");
        assert!(!notes(&read).contains("floor_displacement.png is not used"), "{}", notes(&read));
        assert!(read.files.iter().any(|file| file.ends_with("floor_displacement.png")), "{:?}", read.files);
    }
}

/// Normals of [`height`] with y up and of fine scratches with y down, which dominate the curl.
fn scratched_bumps() -> image::DynamicImage {
    let bumps = heights(1.0).to_rgb8();
    picture(BUMPS, BUMPS, |x, y| {
        let n = bumps.get_pixel(x as u32, y as u32).0.map(|code| f64::from(code) / 127.5 - 1.0);
        let [u, v] = [x, y].map(|i| 1.5 * i as f64);
        let n = [n[0] / n[2] - 0.45 * u.cos() * v.sin(), n[1] / n[2] - 0.45 * u.sin() * v.cos(), 1.0];
        let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
        n.map(|c| 0.5 * c / length + 0.5)
    })
}

#[test]
fn heights_settle_a_name_that_the_curl_contradicts() {
    let folder = colour_and_roughness("floor");
    put(folder.path(), "floor_normal_gl.png", &scratched_bumps());
    let is_doubted = |read: &Read<f64>| read.unsure().any(|a| a.what == What::NormalY);
    assert!(is_doubted(&open(folder.path())));
    put(folder.path(), "floor_height.png", &picture(BUMPS, BUMPS, |x, y| [height(x, y); 3]));
    let settled = open(folder.path());
    assert_eq!(chosen(&settled, What::NormalY), "up");
    assert!(!is_doubted(&settled), "{:#?}", settled.assumptions);
    // Heights that contradict the name, too, leave it in doubt.
    put(folder.path(), "floor_normal_gl.png", &heights(-1.0));
    let doubted = open(folder.path());
    assert_eq!(chosen(&doubted, What::NormalY), "up");
    assert!(is_doubted(&doubted) && notes(&doubted).contains("the slopes of"), "{:#?}", doubted.assumptions);
}

#[test]
fn a_normal_and_a_roughness_word_together_mean_roughness_in_alpha() {
    let folder = grays(&[("soil_alb_ht.png", 0.5)]);
    let normals = heights(1.0).to_rgb8();
    let packed = RgbaImage::from_fn(BUMPS as u32, BUMPS as u32, |x, y| {
        let [r, g, b] = normals.get_pixel(x, y).0;
        Rgba([r, g, b, 102])
    });
    put(folder.path(), "soil_nrm_rgh.png", &packed.into());
    let read = open(folder.path());
    assert!((read.material.texel(9).roughness - 0.4).abs() < EIGHT_BITS, "{:?}", read.material.texel(9));
    assert!(read.material.planes().normal[0].iter().any(|x| x.abs() > 0.1));
    put(folder.path(), "soil_nrm_rgh.png", &heights(1.0));
    assert_refused(folder.path(), &["roughness in alpha", "no alpha"]);
}

#[test]
fn heights_in_the_alpha_of_a_colour_decide_y_too() {
    let folder = tempdir().unwrap();
    let with_height = RgbaImage::from_fn(BUMPS as u32, BUMPS as u32, |x, y| {
        Rgba([128, 128, 128, (255.0 * height(x as usize, y as usize)) as u8])
    });
    put(folder.path(), "soil_albedo_height.png", &with_height.into());
    gray(folder.path(), "soil_roughness.png", 0.5);
    put(folder.path(), "soil_normal.png", &heights(-1.0));
    let read = open(folder.path());
    assert_eq!(chosen(&read, What::NormalY), "down");
    assert_eq!(read.unsure().count(), 0, "{:#?}", read.assumptions);
    assert!(!notes(&read).contains("alpha"), "{}", notes(&read));
    // Where a name states y, nothing asks for the heights.
    std::fs::rename(folder.path().join("soil_normal.png"), folder.path().join("soil_normal_dx.png")).unwrap();
    let named = open(folder.path());
    assert_notes(&named, &["The alpha of soil_albedo_height.png is not used"]);
}

#[test]
fn one_file_of_an_incomplete_set_says_what_is_missing() {
    let folder = tempdir().unwrap();
    put(folder.path(), "shield_Normal.png", &heights(1.0));
    gray(folder.path(), "shield_AlbedoTransparency.png", 0.5);
    let refused = refusal(&folder.path().join("shield_Normal.png"));
    assert!(refused.contains("the roughness map") && !refused.contains("strip"), "{refused}");
    assert!(refused.contains("Smoothness (as the other files), roughness, rough"), "{refused}");
    let smooth = RgbaImage::from_pixel(BUMPS as u32, BUMPS as u32, Rgba([0, 0, 0, 204]));
    put(folder.path(), "shield_MetallicSmoothness.png", &smooth.into());
    for file in ["shield_Normal.png", "shield_AlbedoTransparency.png"] {
        let read = open(&folder.path().join(file));
        assert!((read.material.texel(3).roughness - 0.2).abs() < EIGHT_BITS, "{:?}", read.material.texel(3));
        assert!(!notes(&read).contains("alpha is ignored"), "{}", notes(&read));
    }
}

#[test]
fn a_map_may_be_specified_as_a_constant_and_its_file_is_not_called_unused() {
    let folder = grays(&[("lid_albedo.png", 0.5), ("Properties.png", 0.3)]);
    let read = |text: &str| {
        let bindings: Vec<Binding> = vec![text.parse().unwrap()];
        MaterialPath::new(folder.path(), &ReadOptions::AUTO)
            .bound(&bindings)
            .read::<f64>(&Progress::default())
            .unwrap()
    };
    let constant = read("roughness=0.5");
    assert!((constant.material.texel(9).roughness - 0.5).abs() < 1e-6);
    assert_notes(&constant, &["The roughness map is 0.5, as specified"]);
    assert!(constant.files.iter().all(|file| file.is_file()), "{:?}", constant.files);
    let file = format!("roughness={}:r", folder.path().join("Properties.png").display());
    let of_file = read(&file);
    assert!((of_file.material.texel(9).roughness - 0.3).abs() < EIGHT_BITS);
    assert!(!notes(&of_file).contains("is not used"), "{}", notes(&of_file));
    for wrong in ["roughness=1,1,1", "normal=0.5,0.5,1"] {
        let refused = wrong.parse::<Binding>().unwrap_err().to_string();
        assert!(refused.contains("unknown constant"), "{wrong}: {refused}");
    }
}

#[test]
fn a_pointer_of_git_lfs_says_what_to_run() {
    let folder = tempdir().unwrap();
    let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12345\n";
    for name in ["a.png", "a.gltf", "a.mtlx", "a.mtl", "a.texture_set.json", "a.exr"] {
        let path = folder.path().join(name);
        std::fs::write(&path, pointer).unwrap();
        assert_refused(&path, &["git lfs pull"]);
    }
}

#[test]
fn a_material_of_an_engine_says_what_to_open_instead() {
    let folder = tempdir().unwrap();
    for (name, text) in [
        ("lid.vmat", "Layer0\n{\n\tTextureColor \"materials/lid_color.tga\"\n}\n"),
        ("lid.tres", "[gd_resource]\n[ext_resource path=\"res://materials/lid_color.tga\"]\n"),
        ("lid.usda", "#usda 1.0\n asset inputs:file = @materials/lid_color.tga@\n"),
        ("lid.xml", "<material><texture unit=\"diffuse\" name=\"materials/lid_color.tga\"/></material>"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        assert_refused(&path, &["materials/lid_color.tga", "open the folder"]);
    }
    for (name, kind) in [
        ("lid.safetensors", "safetensors"),
        ("lid.pt", "PyTorch"),
        ("lid.sbsar", "Substance"),
        ("lid.mdl", "MDL"),
        ("lid.axf", "AxF"),
        ("lid.pbrt", "pbrt"),
        ("lid.usdz", "USD"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, b"PK\x03\x04").unwrap();
        assert_refused(&path, &[kind]);
    }
    for (text, kind) in
        [("MATLAB 5.0 MAT-file", "found a file of MATLAB;"), ("%YAML 1.1", "found a material of Unity;")]
    {
        let path = folder.path().join("lid.mat");
        std::fs::write(&path, text).unwrap();
        assert_refused(&path, &[kind]);
    }
}

#[test]
fn presets_of_networks_read_what_their_codes_write() {
    let metallic = ["basecolor.png", "normal.png", "roughness.png"];
    let open_as =
        |folder: &Path, preset| open_as(folder, &ReadOptions { preset: Some(preset), ..ReadOptions::AUTO });
    for (preset, metal) in [
        (Preset::Chord, "metalness.png"),
        (Preset::StableMaterials, "metallic.png"),
        (Preset::MatE, "metallic.png"),
    ] {
        let folder = tempdir().unwrap();
        gray(folder.path(), metallic[0], 0.5);
        // The pixels say the opposite.
        put(folder.path(), metallic[1], &heights(-1.0));
        gray(folder.path(), metallic[2], 0.25);
        gray(folder.path(), metal, 0.2);
        gray(folder.path(), "height.png", 0.2);
        let read = open_as(folder.path(), preset);
        let texel = read.material.texel(9);
        assert!((texel.diffuse[0] - 0.8 * 0.214).abs() < 0.005, "{preset}: {texel:?}");
        assert!((texel.roughness - 0.25).abs() < EIGHT_BITS, "{preset}: {texel:?}");
        assert_eq!((chosen(&read, What::NormalY), read.unsure().count()), ("up", 0), "{preset}");
    }
    let folder = grays(&[("0_albedo.png", 0.5)]);
    put(folder.path(), "0_normals.png", &heights(1.0));
    gray(folder.path(), "0_roughness.png", 0.25);
    let read = open_as(folder.path(), Preset::MaterialPalette);
    // Its renderer does not scale diffuse by 1 - 0.04.
    let expected = (128.0_f64 / 255.0).powf(2.2) / 0.96;
    assert!((read.material.texel(9).diffuse[0] - expected).abs() < 1e-4, "{:?}", read.material.texel(9));
    assert_eq!(read.maps.iter().filter(|map| map.map == Role::Roughness).count(), 1);
}

#[test]
fn a_document_beside_the_pictures_is_named_and_its_format_defines_y() {
    let folder = colour_and_roughness("lid");
    let slight = picture(BUMPS, BUMPS, |x, _| [0.5 + 0.05 * (x % 2) as f64, 0.5, 1.0]);
    put(folder.path(), "lid_normal.png", &slight);
    let text = r#"{"images": [{"uri": "lid_normal.png"}]}"#;
    std::fs::write(folder.path().join("scene.gltf"), text).unwrap();
    std::fs::write(folder.path().join("other.mtlx"), "<materialx/>").unwrap();
    let read = open(folder.path());
    assert_notes(&read, &["scene.gltf lists these pictures"]);
    assert!(!notes(&read).contains("other.mtlx"), "{}", notes(&read));
    let y = read.assumptions.iter().find(|a| a.what == What::NormalY).unwrap();
    assert_eq!((y.chosen.as_str(), y.certainty), ("up", Certainty::Likely), "{y}");
    assert!(y.to_string().contains("scene.gltf"), "{y}");
}
