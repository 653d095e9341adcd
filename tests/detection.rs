//! How often what is inferred is right: real and made materials of which it is known, each also re-encoded the other way.
//!
//! `cargo test --test main -- detection --ignored --nocapture` prints the tables of docs/formats.md.

use std::path::{Path, PathBuf};

use image::{Rgb, RgbImage};
use tempfile::tempdir;

use svbrdf_core::progress::Progress;
use svbrdf_files::read::{Assumption, Certainty, Read, ReadOptions, What, read};

use crate::support::pictures::{rgb_exr, srgb};

/// Below `../shared`: a folder with the picture of diffuse or base colour, that of specular if there is one, and whether they are
/// display-encoded.
const COLOURS: &str = "\
data/ambientcg_Metal049A_1K-JPG Metal049A_1K-JPG_Color.jpg - encoded
data/polyhaven_arm_wooden_table_02/textures wooden_table_02_diff_1k.jpg - encoded
data/gltf_orm_FlightHelmet_LeatherParts FlightHelmet_Materials_LeatherPartsMat_BaseColor.png - encoded
data/diffmat_style_png16_dxnormal_derived basecolor.png - encoded
data/materialgan_style_folder_derived dif.png spe.png encoded
data/surfacenet_style_folder_derived/metal049a diffuse.png specular.png linear
data/deschaintre_outputs_naming_derived metal049a-outputs-1-.png metal049a-outputs-3-.png linear
data/deschaintre_outputs_naming_derived metal049a-outputs_gammad-1-.png metal049a-outputs_gammad-3-.png encoded
real/matfuse_castle_brick diffuse.png specular.png encoded
real/matfuse_clean_pebbles diffuse.png specular.png encoded
real/matfuse_old_wood_floor diffuse.png specular.png encoded
real/substance_default DefaultMaterial_Base_Color.png - encoded
real/polyhaven_sofa sofa_03_diff_1k.jpg - encoded
real/polyhaven_cabinet painted_wooden_cabinet_02_diff_1k.jpg - encoded
real/materialx/Images wood_color.jpg - encoded";

/// Below `../shared`: a picture of normals, and whether y points up.
const NORMALS: [(&str, bool); 11] = [
    ("data/ambientcg_Metal049A_1K-JPG/Metal049A_1K-JPG_NormalGL.jpg", true),
    ("data/ambientcg_Metal049A_1K-JPG/Metal049A_1K-JPG_NormalDX.jpg", false),
    ("data/diffmat_style_png16_dxnormal_derived/normal.png", false),
    ("data/materialgan_style_folder_derived/nom.png", true),
    ("data/surfacenet_style_folder_derived/metal049a/normal.png", true),
    ("data/deschaintre_outputs_naming_derived/metal049a-outputs-0-.png", true),
    ("data/gltf_orm_FlightHelmet_LeatherParts/FlightHelmet_Materials_LeatherPartsMat_Normal.png", true),
    ("data/polyhaven_arm_wooden_table_02/textures/wooden_table_02_nor_gl_1k.jpg", true),
    ("real/polyhaven_sofa/sofa_03_nor_gl_1k.jpg", true),
    ("real/polyhaven_cabinet/painted_wooden_cabinet_02_nor_gl_1k.jpg", true),
    ("real/substance_default/DefaultMaterial_Normal_DirectX.png", false),
];

/// Answers right and wrong, each by whether it is marked as unsure.
#[derive(Debug, Default, PartialEq)]
struct Table {
    right: usize,
    right_unsure: usize,
    wrong: usize,
    wrong_unsure: usize,
}

impl Table {
    fn count(&mut self, is_right: bool, is_unsure: bool) {
        *match (is_right, is_unsure) {
            (true, false) => &mut self.right,
            (true, true) => &mut self.right_unsure,
            (false, false) => &mut self.wrong,
            (false, true) => &mut self.wrong_unsure,
        } += 1;
    }

    fn row(&self, name: &str) -> String {
        let Self { right, right_unsure, wrong, wrong_unsure } = self;
        format!("| {name} | {right} | {right_unsure} | {wrong_unsure} | {wrong} |")
    }
}

fn shared(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared").join(name)
}

fn load(name: &str) -> RgbImage {
    image::open(shared(name)).unwrap_or_else(|e| panic!("{name}: {e}")).to_rgb8()
}

/// The picture with every code encoded, or decoded, as sRGB.
fn recoded(picture: &RgbImage, encode: bool) -> RgbImage {
    let decode = |v: f64| if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) };
    let code = |c: u8| {
        let value = f64::from(c) / 255.0;
        (255.0 * if encode { srgb(value) } else { decode(value) }).round() as u8
    };
    RgbImage::from_fn(picture.width(), picture.height(), |x, y| Rgb(picture.get_pixel(x, y).0.map(code)))
}

/// What is inferred of pictures under names that tell nothing else.
fn inferred(pictures: &[(&str, &RgbImage)]) -> Read<f32> {
    let folder = tempdir().unwrap();
    for (name, picture) in pictures {
        picture.save(folder.path().join(name)).unwrap();
    }
    read(folder.path(), &ReadOptions::AUTO, &Progress::default()).unwrap()
}

fn assumption<T>(read: &Read<T>, what: What) -> &Assumption {
    read.assumptions.iter().find(|a| a.what == what).unwrap()
}

/// The tables of colours: by the evidence, and by the median of specular alone, as it was before.
fn colours() -> [Table; 2] {
    let [mut now, mut before] = [Table::default(), Table::default()];
    for row in COLOURS.lines() {
        let [folder, colour, specular, how] = row.split(' ').collect::<Vec<_>>().try_into().unwrap();
        let is_encoded = how == "encoded";
        let load = |name: &str| load(&format!("{folder}/{name}"));
        let colour_picture = load(colour);
        let specular_picture = (specular != "-").then(|| load(specular));
        let gray = RgbImage::from_pixel(colour_picture.width(), colour_picture.height(), Rgb([128; 3]));
        for flip in [false, true] {
            let one = |picture: &RgbImage| if flip { recoded(picture, !is_encoded) } else { picture.clone() };
            let truth = is_encoded != flip;
            let mut pictures = vec![("diffuse.png", one(&colour_picture)), ("roughness.png", gray.clone())];
            pictures.extend(specular_picture.as_ref().map(|picture| ("specular.png", one(picture))));
            let borrowed: Vec<_> = pictures.iter().map(|(name, picture)| (*name, picture)).collect();
            let read = inferred(&borrowed);
            let known = assumption(&read, What::Albedo);
            let (says, unsure) = (known.chosen != "linear", known.certainty == Certainty::Unsure);
            now.count(says == truth, unsure);
            println!(
                "{colour}, re-encoded {flip}: {known}; {}",
                if says == truth { "right" } else { "WRONG" }
            );
            let median = read.maps.iter().find_map(|map| map.specular_median);
            let old = median.map_or((true, false), |median| match median {
                0.03..=0.06 => (false, false),
                0.2..=0.26 => (true, false),
                _ => (true, true),
            });
            before.count(old.0 == truth, old.1);
        }
    }
    [now, before]
}

/// The tables of y of normals: now, and by the bounds of the curl test as they were before.
fn normals() -> [Table; 2] {
    let [mut now, mut before] = [Table::default(), Table::default()];
    for (normal, is_up) in NORMALS {
        let whole = load(normal);
        let gray = RgbImage::from_pixel(whole.width(), whole.height(), Rgb([128; 3]));
        for flip in [false, true] {
            let green = |g: u8| if flip { 255 - g } else { g };
            let picture = RgbImage::from_fn(whole.width(), whole.height(), |x, y| {
                let [r, g, b] = whole.get_pixel(x, y).0;
                Rgb([r, green(g), b])
            });
            let read =
                inferred(&[("normal.png", &picture), ("basecolor.png", &gray), ("roughness.png", &gray)]);
            let known = assumption(&read, What::NormalY);
            let truth = if is_up != flip { "up" } else { "down" };
            println!(
                "{normal}, flipped {flip}: {known}; {}",
                if known.chosen == truth { "right" } else { "WRONG" }
            );
            now.count(known.chosen == truth, known.certainty == Certainty::Unsure);
            let curl = read.maps.iter().find_map(|map| map.curl).unwrap_or(1.0);
            before.count((curl > -0.3) == (truth == "up"), curl < 0.1);
        }
    }
    [now, before]
}

/// Below `../shared`: a picture of roughness, and whether it is gray; others are occlusion, roughness and metallic.
const ROUGHNESS: &str = "\
data/ambientcg_Metal049A_1K-JPG/Metal049A_1K-JPG_Roughness.jpg gray
data/surfacenet_style_folder_derived/metal049a/roughness.png gray
data/materialgan_style_folder_derived/rgh.png gray
data/diffmat_style_png16_dxnormal_derived/roughness.png gray
real/matfuse_castle_brick/roughness.png gray
real/matfuse_clean_pebbles/roughness.png gray
real/matfuse_old_wood_floor/roughness.png gray
real/substance_default/DefaultMaterial_Roughness.png gray
real/polyhaven_sofa/sofa_03_rough_1k.jpg gray
real/materialx/Images/wood_roughness.jpg gray
data/polyhaven_arm_wooden_table_02/textures/wooden_table_02_arm_1k.jpg packed
real/polyhaven_cabinet/painted_wooden_cabinet_02_arm_1k.jpg packed
real/gltf_orm_two_uvmaps/ORM.png packed
data/gltf_orm_FlightHelmet_LeatherParts/FlightHelmet_Materials_LeatherPartsMat_OcclusionRoughMetal.png packed";

/// The tables of packed channels under the name of roughness: now, and where all are taken as gray.
fn channels() -> [Table; 2] {
    let [mut now, mut before] = [Table::default(), Table::default()];
    for (roughness, how) in ROUGHNESS.lines().filter_map(|row| row.split_once(' ')) {
        let is_gray = how == "gray";
        let picture = load(roughness);
        let flat = RgbImage::from_pixel(picture.width(), picture.height(), Rgb([128; 3]));
        let read = inferred(&[("roughness.png", &picture), ("basecolor.png", &flat)]);
        let taken_apart = read.assumptions.iter().find(|a| a.what == What::Layout);
        println!("{roughness}: {}", taken_apart.map_or_else(|| "gray".to_owned(), ToString::to_string));
        now.count(taken_apart.is_none() == is_gray, taken_apart.is_some());
        before.count(is_gray, false);
    }
    [now, before]
}

/// The tables of signed and unsigned normals in floats, a component of each -0.02 by a filter: now, and by the least
/// component, as it was before.
fn encodings() -> [Table; 2] {
    let [mut now, mut before] = [Table::default(), Table::default()];
    for (normal, _) in NORMALS {
        let whole = image::imageops::thumbnail(&load(normal), 256, 256);
        for is_signed in [false, true] {
            let value = |code: u8| {
                let value = f32::from(code) / 255.0;
                if is_signed { 2.0 * value - 1.0 } else { value }
            };
            let mut floats =
                image::Rgb32FImage::from_fn(256, 256, |x, y| Rgb(whole.get_pixel(x, y).0.map(value)));
            floats.get_pixel_mut(7, 7).0[0] = -0.02;
            let folder = tempdir().unwrap();
            rgb_exr(&folder.path().join("normal.exr"), &floats);
            for name in ["basecolor.png", "roughness.png"] {
                RgbImage::from_pixel(256, 256, Rgb([128; 3])).save(folder.path().join(name)).unwrap();
            }
            let read: Read<f32> = read(folder.path(), &ReadOptions::AUTO, &Progress::default()).unwrap();
            let known = assumption(&read, What::NormalEncoding);
            let is_right = (known.chosen == "signed") == is_signed;
            println!("{normal}, signed {is_signed}: {known}; {}", if is_right { "right" } else { "WRONG" });
            now.count(is_right, known.certainty == Certainty::Unsure);
            before.count(is_signed, false);
        }
    }
    [now, before]
}

#[test]
#[ignore = "prints the tables of docs/formats.md, and takes long"]
fn the_tables_of_what_is_inferred() {
    let [now, before] = colours();
    println!("| detector | right | right, unsure | wrong, unsure | wrong |\n|---|---|---|---|---|");
    println!("{}", before.row("encoding of colours, by the median of specular"));
    println!("{}", now.row("encoding of colours, by all evidence"));
    for (name, tables) in [
        ("y of normals, as before", normals()),
        ("packed channels, all taken as gray", channels()),
        ("signed normals in floats, by the least component", encodings()),
    ] {
        let [now, before] = tables;
        println!("{}\n{}", before.row(name), now.row("the same, now"));
    }
}

#[test]
fn an_answer_is_counted_in_its_place() {
    let mut table = Table::default();
    for (right, unsure) in [(true, false), (false, true), (false, false), (false, false)] {
        table.count(right, unsure);
    }
    assert_eq!(table.row("x"), "| x | 1 | 0 | 1 | 2 |");
}
