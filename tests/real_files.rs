//! Files of public repositories and of many origins, where they are at hand (`../shared`): what is read and inferred, against what is known.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;
use svbrdf_files::read::{Binding, Certainty, MaterialPath, Read, ReadOptions, What, read};
use svbrdf_needs::needs;

fn shared(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared").join(name)
}

/// Within 4e-3 or 2.5%, whichever is larger, as the README of the files has it.
fn is_near(value: f64, expected: f64) -> bool {
    (value - expected).abs() <= f64::max(4e-3, 0.025 * expected.abs())
}

/// What differs between a material and the expected means; nothing where it is read right.
fn differences(case: &Value, material: &Material<f32>) -> Vec<String> {
    let mean = |plane: &Vec<f32>| plane.iter().map(|v| f64::from(*v)).sum::<f64>() / plane.len() as f64;
    let planes = material.planes();
    let three = |planes: &[Vec<f32>; 3]| planes.iter().map(mean).collect::<Vec<_>>();
    let means = [
        three(&planes.normal),
        three(&planes.diffuse),
        three(&planes.specular),
        vec![mean(&planes.roughness)],
    ];
    let mut all = Vec::new();
    // A constant material may be read in any size.
    if case["size"] != serde_json::json!([1, 1]) && case["size"] != serde_json::json!(material.size()) {
        all.push(format!("size {:?} for {}", material.size(), case["size"]));
    }
    for (map, got) in ["normal", "diffuse", "specular", "roughness"].into_iter().zip(means) {
        let expected: Vec<f64> = match &case[map] {
            Value::Array(all) => all.iter().filter_map(Value::as_f64).collect(),
            one => one.as_f64().into_iter().collect(),
        };
        assert_eq!(expected.len(), got.len(), "{map}");
        if !got.iter().zip(&expected).all(|(value, expected)| is_near(*value, *expected)) {
            all.push(format!("{map} {got:.4?} for {expected:.4?}"));
        }
    }
    all
}

/// The material of a case, with its options and specified maps.
fn open(case: &Value) -> Result<Read<f32>, Error> {
    let mut words = case["options"].as_array().unwrap().iter().map(|word| word.as_str().unwrap());
    let (mut options, mut bindings): (_, Vec<Binding>) = (ReadOptions::AUTO, Vec::new());
    while let (Some(option), Some(value)) = (words.next(), words.next()) {
        match (option, value.split_once('=')) {
            ("--exemplar", _) => options.exemplar = Some(value.parse().unwrap()),
            ("--normal-y", _) => options.normal_y = Some(value.parse().unwrap()),
            ("--map", Some((map, file))) => {
                bindings.push(format!("{map}={}", shared("real").join(file).display()).parse().unwrap());
            }
            other => panic!("an option that this test does not know: {other:?}"),
        }
    }
    let path = shared("real").join(case["path"].as_str().unwrap());
    MaterialPath::new(&path, &options).bound(&bindings).read(&Progress::default())
}

/// What is wrong with the reading of a case; nothing where it is as expected, or ends in the message that `must` asks for.
fn problems(case: &Value, result: Result<Read<f32>, Error>) -> Vec<String> {
    let must = case["must"].as_str().unwrap_or_default();
    let read = match result {
        Ok(read) => read,
        Err(_) if must.contains("refuse") => return Vec::new(),
        Err(error) => return vec![error.to_string()],
    };
    let doubts = read.unsure().count() > 0;
    match must.split_once("say: ") {
        _ if must == "refuse" => vec!["it must be refused".to_owned()],
        _ if must.contains("doubt") && doubts => Vec::new(),
        Some((_, words)) if !read.notes.iter().any(|note| note.to_string().contains(words)) => {
            vec![format!("no note says {words}")]
        }
        _ => differences(case, &read.material),
    }
}

/// Cases of formats that are not read.
const NOT_READ: [&str; 3] = ["bedrock", "asobo", "urho"];

#[needs(shared)]
fn real_files_are_read_as_their_formats_specify() {
    let cases: Value = serde_json::from_slice(&fs::read(shared("real/expected.json")).unwrap()).unwrap();
    let cases = cases.as_object().unwrap().iter();
    let cases: Vec<_> = cases.filter(|(name, _)| !NOT_READ.iter().any(|kind| name.contains(kind))).collect();
    assert!(cases.len() >= 18, "{} cases", cases.len());
    let mut wrong = Vec::new();
    for (name, case) in cases {
        let problems = problems(case, open(case));
        println!("{name}: {problems:?}");
        if !problems.is_empty() {
            wrong.push(name.as_str());
        }
    }
    assert!(wrong.is_empty(), "not read rightly: {wrong:?}");
}

#[test]
fn a_mean_that_is_off_by_more_than_the_tolerance_is_seen() {
    assert!(is_near(0.5, 0.512) && !is_near(0.5, 0.52) && is_near(0.0, 0.004) && !is_near(0.0, 0.005));
}

/// A file or folder of ../shared/data, what has to be detected of it (order, colour, roughness, y of normals; as SOURCE.txt and the names
/// say), and `same` where it is metal049a in another layout.
const DATA: &str = "\
derived_packed_cc0/metal049a_4x1_NDRS_linear.png ndrs linear r up same
ambientcg_Metal049A_1K-JPG - srgb r up
derived_packed_cc0/metal049a_1x4_vertical_NDRS_linear.png ndrs linear r up same
derived_packed_cc0/metal049a_2x2_DSRN_DSgamma22_matfusion_grid.png dsrn gamma2.2 r up same
derived_packed_cc0/metal049a_2x2_NDSR_tflsguoyu_tex.png ndsr gamma2.2 gamma2.2 up same
derived_packed_cc0/metal049a_4x1_DNRS_DRSgamma22_materialgan.png dnrs gamma2.2 gamma2.2 up same
derived_packed_cc0/metal049a_4x1_DSRN_DSgamma22_matfusion.png dsrn gamma2.2 r up same
derived_packed_cc0/metal049a_5x1_INDRS_linear.png ndrs linear r up same
derived_packed_cc0/metal049a_6x1_2inputs_NDRS_linear.png ndrs linear r up same
derived_packed_cc0/two_exemplars_4x2_NDRS_linear_example.png ndrs linear r up same
deschaintre2020_crane1_example/crane1_example.png ndrs linear r up
deschaintre_outputs_naming_derived - gamma2.2 r up same
diffmat_style_png16_dxnormal_derived - gamma2.2 r down same
directx_Metal049A_NormalDX_only - srgb r down
exr_float_svbrdf_uncertainty_plane - linear r -
exr_half_layered_derived/metal049a_svbrdf_multipart.exr layers linear r up same
exr_half_layered_derived/metal049a_svbrdf_singlepart_signed_normals.exr layers linear r up same
gltf_orm_FlightHelmet_LeatherParts - srgb r up
materialgan_style_folder_derived - gamma2.2 gamma2.2 up same
materialgan_style_folder_derived/tex.png ndsr gamma2.2 gamma2.2 up same
polyhaven_arm_wooden_table_02/textures - srgb r up
surfacenet_style_folder_derived/metal049a - linear r up same
pitfalls_png_derived/svbrdf.npz layers linear r up same";

/// The largest difference of any value of two materials.
fn difference(a: &Material<f32>, b: &Material<f32>) -> f64 {
    assert_eq!(a.size(), b.size());
    let values = |m: &Material<f32>| {
        let p = m.planes().clone();
        [p.normal.concat(), p.diffuse.concat(), p.specular.concat(), p.roughness].concat()
    };
    values(a).into_iter().zip(values(b)).map(|(x, y)| f64::from((x - y).abs())).fold(0.0, f64::max)
}

#[needs(shared)]
fn what_is_detected_in_all_of_the_data_and_every_layout_of_a_material_is_the_same() {
    let mut reference = None;
    for row in DATA.lines() {
        let words: Vec<_> = row.split(' ').collect();
        let path = shared("data").join(words[0]);
        let read: Read<f32> = read(&path, &ReadOptions::AUTO, &Progress::default()).unwrap();
        let chosen = |what| read.assumptions.iter().find(|a| a.what == what).map_or("-", |a| &a.chosen);
        let layout = chosen(What::Layout).split(' ').next().unwrap();
        let found = [layout, chosen(What::Albedo), chosen(What::Roughness), chosen(What::NormalY)];
        assert_eq!(found, words[1..5], "{}: {:#?}", words[0], read.assumptions);
        if words.len() == 6 {
            let worst = difference(reference.get_or_insert_with(|| read.material.clone()), &read.material);
            // Half a code of the reference and half a code of the other, the other's as steep as gamma 2.2 is at 1.
            assert!(worst <= (0.5 + 0.5 * 2.2 + 0.01) / 255.0 + 0.004, "{}: {worst}", words[0]);
        }
    }
}

#[needs(shared)]
fn every_single_file_opens_or_is_refused_by_its_name() {
    let (mut opened, mut refused, mut folders) = (0, 0, vec![shared("data")]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            match read::<f32>(&path, &ReadOptions::AUTO, &Progress::default()) {
                Ok(_) => opened += 1,
                Err(error) => {
                    let (message, name) =
                        (error.to_string(), path.file_name().unwrap().to_string_lossy().into_owned());
                    assert!(message.contains(&name) && message.len() > name.len() + 40, "{message}");
                    refused += 1;
                }
            }
        }
    }
    assert!(opened > 50 && refused > 20, "{opened} opened, {refused} refused");
}

/// Below `../shared`: a folder with the picture of diffuse or base colour, that of specular if there is one, and whether they are linear.
const COLOURS: &str = "\
data/ambientcg_Metal049A_1K-JPG Metal049A_1K-JPG_Color.jpg - encoded
data/gltf_orm_FlightHelmet_LeatherParts FlightHelmet_Materials_LeatherPartsMat_BaseColor.png - encoded
data/surfacenet_style_folder_derived/metal049a diffuse.png specular.png linear
data/deschaintre_outputs_naming_derived metal049a-outputs_gammad-1-.png metal049a-outputs_gammad-3-.png encoded
real/matfuse_castle_brick diffuse.png specular.png encoded
real/matfuse_clean_pebbles diffuse.png specular.png encoded
real/matfuse_old_wood_floor diffuse.png specular.png encoded
real/substance_default DefaultMaterial_Base_Color.png - encoded";

/// The same of normals, and whether y points up.
const NORMALS: &str = "\
data/ambientcg_Metal049A_1K-JPG/Metal049A_1K-JPG_NormalGL.jpg up
data/diffmat_style_png16_dxnormal_derived/normal.png down
data/gltf_orm_FlightHelmet_LeatherParts/FlightHelmet_Materials_LeatherPartsMat_Normal.png up
data/polyhaven_arm_wooden_table_02/textures/wooden_table_02_nor_gl_1k.jpg up
real/substance_default/DefaultMaterial_Normal_DirectX.png down";

/// What is inferred of copies of these pictures under names that tell nothing else: the choice, and whether it is sure.
fn inferred(pictures: &[(&str, PathBuf)], what: What) -> (String, bool) {
    let folder = tempfile::tempdir().unwrap();
    for (name, from) in pictures {
        let image = image::open(from).unwrap().to_rgb8();
        image.save(folder.path().join(name)).unwrap();
        if !folder.path().join("roughness.png").exists() {
            let gray = image::RgbImage::from_pixel(image.width(), image.height(), image::Rgb([128; 3]));
            gray.save(folder.path().join("roughness.png")).unwrap();
            if *name == "normal.png" {
                gray.save(folder.path().join("basecolor.png")).unwrap();
            }
        }
    }
    let read: Read<f32> = read(folder.path(), &ReadOptions::AUTO, &Progress::default()).unwrap();
    let known = read.assumptions.iter().find(|a| a.what == what).unwrap();
    (known.chosen.clone(), known.certainty != Certainty::Unsure)
}

#[needs(shared)]
fn what_pixels_tell_is_right_or_doubted() {
    for row in COLOURS.lines() {
        let [folder, colour, specular, how] = row.split(' ').collect::<Vec<_>>().try_into().unwrap();
        let mut pictures = vec![("diffuse.png", shared(folder).join(colour))];
        pictures.extend((specular != "-").then(|| ("specular.png", shared(folder).join(specular))));
        let (chosen, is_sure) = inferred(&pictures, What::Albedo);
        assert!((chosen == "linear") == (how == "linear") || !is_sure, "{colour}: {chosen}");
    }
    for (normal, y) in NORMALS.lines().filter_map(|row| row.split_once(' ')) {
        let (chosen, is_sure) = inferred(&[("normal.png", shared(normal))], What::NormalY);
        assert!(chosen == y || !is_sure, "{normal}: {chosen}");
    }
}
