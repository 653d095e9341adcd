//! Real files of many origins, where they are at hand (`../shared/data`): what is detected, against what is known.

use std::path::{Path, PathBuf};

use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::{Albedo, Read, ReadOptions, What, read};
use svbrdf_needs::needs;

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data")
}

fn open(name: &str, options: &ReadOptions) -> Read<f32> {
    read(&data().join(name), options, &Progress::default()).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn chosen(read: &Read<f32>, what: What) -> &str {
    read.assumptions.iter().find(|a| a.what == what).map_or("-", |a| &a.chosen)
}

/// The largest and the mean difference of any value of two materials.
fn difference(a: &Material<f32>, b: &Material<f32>) -> [f64; 2] {
    assert_eq!(a.size(), b.size());
    let (mut worst, mut sum, mut count) = (0.0_f64, 0.0, 0.0);
    let planes = |m: &Material<f32>| {
        let p = m.planes().clone();
        [p.normal.concat(), p.diffuse.concat(), p.specular.concat(), p.roughness].concat()
    };
    for (x, y) in planes(a).into_iter().zip(planes(b)) {
        let difference = f64::from((x - y).abs());
        (worst, sum, count) = (worst.max(difference), sum + difference, count + 1.0);
    }
    [worst, sum / count]
}

const REFERENCE: &str = "derived_packed_cc0/metal049a_4x1_NDRS_linear.png";
/// Nothing in this picture tells that its diffuse alone is encoded: the user has to say so.
const UNTOLD: &str = "derived_packed_cc0/metal049a_4x1_NDRS_diffuse-gamma22.png";

/// A file or folder, what has to be detected of it (order, colour, roughness, y of normals; as SOURCE.txt and the names
/// say), and `same` where it is metal049a in another layout.
const TABLE: &str = "\
ambientcg_Metal049A_1K-JPG - srgb r up
derived_packed_cc0/metal049a_4x1_NDRS_linear.png ndrs linear r up same
derived_packed_cc0/metal049a_4x1_NDRS_diffuse-gamma22.png ndrs gamma2.2 r up same
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

/// The rows of the table: name, what has to be detected, and whether it is the same material.
fn rows() -> impl Iterator<Item = (&'static str, [&'static str; 4], bool)> {
    TABLE.lines().map(|row| {
        let words: Vec<_> = row.split(' ').collect();
        (words[0], [words[1], words[2], words[3], words[4]], words.len() == 6)
    })
}

#[needs(shared)]
#[test]
fn every_layout_of_one_material_is_the_same_material() {
    let reference = open(REFERENCE, &ReadOptions::AUTO);
    for (name, ..) in rows().filter(|(name, _, same)| *same && *name != REFERENCE) {
        let gao = ReadOptions {
            albedo: Some(Albedo::Gamma22),
            specular: Some(Albedo::Linear),
            ..ReadOptions::AUTO
        };
        let options = if name == UNTOLD { gao } else { ReadOptions::AUTO };
        let [worst, mean] = difference(&reference.material, &open(name, &options).material);
        println!("{name}: at most {worst:.5}, on average {mean:.6}");
        // Half a code of the reference and half a code of the other, the other's as steep as gamma 2.2 is at 1.
        assert!(worst <= (0.5 + 0.5 * 2.2 + 0.01) / 255.0 + 0.004, "{name}: {worst}");
    }
}

#[needs(shared)]
#[test]
fn what_is_detected_in_all_of_the_data() {
    let (mut right, mut asked, mut wrong) = (0, 0, Vec::new());
    for (name, known, _) in rows() {
        let read = open(name, &ReadOptions::AUTO);
        let layout = chosen(&read, What::Layout).split(' ').next().unwrap_or("-");
        let others = [What::Albedo, What::Roughness, What::NormalY].map(|what| chosen(&read, what));
        let found = [layout, others[0], others[1], others[2]];
        let unsure: Vec<_> = read.unsure().map(|a| a.what.name()).collect();
        println!("{name}: {}; unsure of: {}", found.join(", "), unsure.join(", "));
        if found == known {
            right += 1
        } else {
            wrong.push(name)
        }
        asked += usize::from(!unsure.is_empty());
    }
    println!("{right} right, {} wrong, {asked} asked about, of {}", wrong.len(), right + wrong.len());
    assert_eq!(wrong, [UNTOLD]);
}

#[needs(shared)]
#[test]
fn every_single_file_opens_or_is_refused_by_its_name() {
    let (mut opened, mut refused, mut folders) = (0, 0, vec![data()]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
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
    println!("{opened} opened, {refused} refused");
    assert!(opened > 50 && refused > 20, "{opened} opened, {refused} refused");
}
