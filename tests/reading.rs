//! Reading of materials: which paths open, and which values result.

use std::path::Path;

use glam::DVec3;
use image::{DynamicImage, Rgb, RgbImage};
use tempfile::{TempDir, tempdir};

use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::{Albedo, Read, ReadOptions, read, read_bytes};
use svbrdf_files::samples::generate;

use crate::support::fixtures::{LINEAR, MAPS, SIDE, bytes_at, flat, map, png_bytes, save, save_maps, strip};

fn open(path: &Path) -> Read<f64> {
    read(path, &LINEAR, &Progress::default()).unwrap()
}

/// The texels of the fixtures, exactly: value = byte / 255, in f64.
fn assert_is_the_fixture(material: &Material<f64>) {
    assert_eq!(material.size(), [SIDE as usize; 2]);
    for index in 0..material.width() * material.height() {
        let (x, y) = (index as u32 % SIDE, index as u32 / SIDE);
        let [n, d, r, s] = [0, 1, 2, 3].map(|map| bytes_at(map, x, y).map(|byte| f64::from(byte) / 255.0));
        let texel = material.texel(index);
        assert_eq!(texel.normal, DVec3::from(n.map(|value| 2.0 * value - 1.0)).normalize(), "({x}, {y})");
        assert_eq!(texel.diffuse, d, "({x}, {y})");
        assert_eq!(texel.roughness, r[0], "({x}, {y})");
        assert_eq!(texel.specular, s, "({x}, {y})");
    }
}

/// A folder of fixture maps of which map number `replaced` is `image`.
fn with_map(replaced: usize, image: impl Into<DynamicImage>) -> TempDir {
    let folder = tempdir().unwrap();
    save_maps(folder.path(), "");
    save(folder.path(), &format!("{}.png", MAPS[replaced]), &image.into());
    folder
}

fn has_note(read: &Read<f64>, words: &str) -> bool {
    read.notes.iter().any(|note| note.to_string().contains(words))
}

#[test]
fn a_packed_strip_opens_behind_any_number_of_photos() {
    let folder = tempdir().unwrap();
    for photos in [0, 1, 3] {
        let path = save(folder.path(), "my strip.png", &strip(photos));
        let found = open(&path);
        assert_is_the_fixture(&found.material);
        assert_eq!(found.material.name(), "my strip");
        assert_eq!(found.files, [path]);
        assert_eq!(has_note(&found, "photos"), photos > 0, "{:?}", found.notes);
    }
}

#[test]
fn a_strip_in_memory_is_read_like_one_in_a_file() {
    let found = read_bytes::<f64>("some name", &png_bytes(&strip(1)), &LINEAR).unwrap();
    assert_is_the_fixture(&found.material);
    assert_eq!(found.material.name(), "some name");
    assert!(found.files.is_empty());
}

#[test]
fn a_folder_opens_by_the_words_in_its_file_names() {
    let parent = tempdir().unwrap();
    let folder = parent.path().join("Old Wall");
    std::fs::create_dir(&folder).unwrap();
    for (i, name) in ["Wall_NRM_2K.PNG", "WallAlbedo.png", "wall-rgh.png", "wall spec.png"].iter().enumerate()
    {
        save(&folder, name, &map(i));
    }
    save(&folder, "wall_preview.png", &flat(9, 9, [1, 2, 3]));
    let found = open(&folder);
    assert_is_the_fixture(&found.material);
    assert_eq!(found.material.name(), "Old Wall");
    assert_eq!(found.files.len(), 4);
    assert!(has_note(&found, "The normal map is Wall_NRM_2K.PNG."), "{:?}", found.notes);
}

#[test]
fn sixteen_bits_keep_their_precision() {
    type Rgb16 = image::ImageBuffer<Rgb<u16>, Vec<u16>>;
    let image = Rgb16::from_pixel(SIDE, SIDE, Rgb([12_345, 12_346, 50_000]));
    let folder = with_map(1, image.clone());
    assert_eq!(
        open(folder.path()).material.texel(3).diffuse,
        [12_345.0 / 65_535.0, 12_346.0 / 65_535.0, 50_000.0 / 65_535.0]
    );
    let single = read::<f32>(folder.path(), &LINEAR, &Progress::default()).unwrap();
    assert_eq!(single.material.texel(3).diffuse[0], (12_345.0 / 65_535.0) as f32);

    let normal = open(with_map(0, image).path()).material.texel(0).normal;
    let expected = DVec3::from([12_345.0, 12_346.0, 50_000.0].map(|code| 2.0 * (code / 65_535.0) - 1.0));
    assert_eq!(normal, expected.normalize());
}

#[test]
fn albedo_decodes_diffuse_and_specular_and_nothing_else() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "strip.png", &strip(0));
    let linear = open(&path).material;
    for albedo in Albedo::ALL {
        let options = ReadOptions { albedo: Some(albedo), ..LINEAR };
        let material = read::<f64>(&path, &options, &Progress::default()).unwrap().material;
        let (texel, stored) = (material.texel(6), linear.texel(6));
        let decode = |value: f64| match albedo {
            Albedo::Linear => value,
            Albedo::Srgb if value <= 0.04045 => value / 12.92,
            Albedo::Srgb => ((value + 0.055) / 1.055).powf(2.4),
            Albedo::Gamma22 => value.powf(2.2),
            Albedo::Log => (0.01 * 101_f64.powf(value) - 0.01).clamp(0.0, 1.0),
        };
        assert_eq!(texel.diffuse, stored.diffuse.map(decode), "{albedo}");
        assert_eq!(texel.specular, stored.specular.map(decode), "{albedo}");
        assert_eq!((texel.normal, texel.roughness), (stored.normal, stored.roughness), "{albedo}");
    }
}

#[test]
fn roughness_whose_channels_differ_is_their_mean_and_said_so() {
    let image = RgbImage::from_pixel(SIDE, SIDE, Rgb([30, 60, 81]));
    let found = open(with_map(2, image).path());
    assert_eq!(found.material.texel(0).roughness, 57.0 / 255.0);
    assert!(has_note(&found, "differ by up to 0.2000; their mean is used"), "{:?}", found.notes);
}

#[test]
fn reading_reports_progress_and_stops_when_asked() {
    let folder = tempdir().unwrap();
    save_maps(folder.path(), "");
    let progress = Progress::default();
    read::<f32>(folder.path(), &LINEAR, &progress).unwrap();
    assert_eq!(progress.counts(), (4, 4));
    progress.cancel();
    let result = read::<f32>(folder.path(), &LINEAR, &progress);
    assert!(result.is_err_and(|error| error.is_cancelled()));
}

#[test]
fn the_samples_are_what_their_generator_makes() {
    let truth = generate::ground_truth();
    let made = [
        ("worn_tiles", generate::pack(&truth)),
        ("blurred_normals", generate::pack(&generate::blurred_normals(&truth))),
        ("wrong_roughness", generate::pack(&generate::wrong_roughness(&truth))),
    ];
    for (name, pixels) in made {
        let path =
            Path::new(env!("CARGO_MANIFEST_DIR")).join("src/files/samples").join(name).with_extension("png");
        let committed = image::open(path).unwrap().into_rgb8().into_raw();
        let differing = committed.iter().zip(&pixels).filter(|(a, b)| a != b).count();
        assert_eq!(committed.len(), pixels.len());
        assert_eq!(differing, 0, "{name} differs; run the example make_assets if that is meant");
    }
}
