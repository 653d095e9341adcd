//! Writing of glTF and MaterialX: what is written opens again as the same material, and the note tells what was lost.

use std::fs;
use std::path::PathBuf;

use svbrdf_core::material::Planes;
use svbrdf_files::write::{Surface, SurfaceForm};

use super::*;
use crate::support::surfaces::{cases, metallic, specular, steps};

pub(super) fn written(material: &Material<f32>, path: &Path, depth: Option<Depth>) -> (Surface, Read<f32>) {
    let surface = write::write(material, path, kind(path, depth)).unwrap().unwrap();
    (surface, read(path, &ReadOptions::default(), &Progress::default()).unwrap())
}

const FORMS: [(&str, Option<Depth>); 6] = [
    ("a.glb", None),
    ("b.glb", Some(Depth::Sixteen)),
    ("c.mtlx", None),
    ("d.mtlx", Some(Depth::Sixteen)),
    ("e.mtlx", Some(Depth::Half)),
    ("f.mtlx", Some(Depth::Float)),
];

/// Mean and largest difference of all samples.
fn change(a: &[Vec<f32>; 3], b: &[Vec<f32>; 3]) -> (f64, f64) {
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    let all: Vec<f64> = pairs.map(|(a, b)| f64::from((a - b).abs())).collect();
    (all.iter().sum::<f64>() / all.len() as f64, all.iter().copied().fold(0.0, f64::max))
}

#[test]
fn what_is_written_for_other_programs_opens_again_within_one_step_of_8_bits_and_its_note_tells_what_was_lost()
{
    for (case, original, is_metallic) in cases() {
        let folder = tempdir().unwrap();
        for (name, depth) in FORMS {
            let (surface, again) = written(&original, &folder.path().join(name), depth);
            assert_eq!(surface.form == SurfaceForm::Metallic, is_metallic, "{case}, {name}: {surface}");
            let off = steps(&original, &again.material);
            assert!(off <= 1.0, "{case}, {name}: off by {off} steps; {surface}");
            assert!(
                again.unsure().count() == 0 && again.notes.is_empty(),
                "{case}, {name}: {}",
                notes(&again)
            );
            let [before, after] = [original.planes(), again.material.planes()];
            for (told, (mean, largest)) in [
                (surface.changes.diffuse, change(&before.diffuse, &after.diffuse)),
                (surface.changes.specular, change(&before.specular, &after.specular)),
            ] {
                // The reader computes in f32.
                let is_same = (told.mean - mean).abs() < 1e-6 && (told.largest - largest).abs() < 1e-6;
                assert!(is_same, "{case}, {name}: {told}, found {largest} (mean {mean})");
            }
            assert_eq!(surface.rejected.is_some(), !is_metallic);
            if let Some(rejected) = surface.rejected {
                assert!(rejected.steps > 1.0, "{case}, {name}: {surface}");
                let mean = |changes: &write::SurfaceChanges| changes.diffuse.mean + changes.specular.mean;
                assert!(mean(&rejected) > mean(&surface.changes), "{case}, {name}: {surface}");
            }
        }
    }
    let folder = tempdir().unwrap();
    let out = folder.path().join("folder");
    let options = WriteOptions { like: Some(Preset::Gltf), ..WriteOptions::default() };
    let original = specular([SIDE, SIDE], 0.3);
    let surface = write::write(&original, &out, FileKind::new(&out, &options).unwrap()).unwrap().unwrap();
    assert!(surface.form == SurfaceForm::Metallic && surface.changes.specular.largest > 0.1, "{surface}");
}

#[test]
fn the_comparison_sees_every_convention_that_can_be_taken_wrongly() {
    let original = specular([SIDE, SIDE], 0.3);
    let changed = |change: &dyn Fn(&mut Planes<f32>)| {
        let mut planes = original.planes().clone();
        change(&mut planes);
        let changed = Material::new("changed", SIDE, SIDE, planes).unwrap();
        steps(&original, &changed)
    };
    assert_eq!(changed(&|_| {}), 0.0);
    let each = |plane: &mut Vec<f32>, of: &dyn Fn(f32) -> f32| plane.iter_mut().for_each(|v| *v = of(*v));
    for (what, off) in [
        ("y down", changed(&|planes| each(&mut planes.normal[1], &|y| -y))),
        ("alpha for r", changed(&|planes| each(&mut planes.roughness, &|r| r * r))),
        ("gloss for r", changed(&|planes| each(&mut planes.roughness, &|r| 1.0 - r))),
        ("linear for sRGB", changed(&|planes| each(&mut planes.diffuse[2], &|d| srgb(d.into()) as f32))),
        ("red for blue", changed(&|planes| planes.specular.swap(0, 2))),
        ("rows upside down", changed(&|planes| planes.roughness.reverse())),
        ("1.1 steps", changed(&|planes| each(&mut planes.roughness, &|r| r - 1.1 / 255.0))),
    ] {
        assert!(off > 1.0, "{what}: {off}");
    }
}

/// The pictures of a document of MaterialX, without the reader.
#[test]
fn a_document_of_materialx_has_pictures_by_relative_names_beside_it() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("wet & dry <1>.mtlx");
    let original = specular([23, 9], 0.3);
    let (surface, again) = written(&original, &path, None);
    let text = fs::read_to_string(&path).unwrap();
    let SurfaceForm::Specular { ior } = surface.form else { panic!("{surface}") };
    for part in [
        "value=\"wet &amp; dry &lt;1&gt;_textures/base_color.png\" colorspace=\"srgb_texture\"".to_owned(),
        "<open_pbr_surface name=\"_1_brick____mortar_\"".to_owned(),
        format!("name=\"specular_ior\" type=\"float\" value=\"{ior}\""),
        "<materialx version=\"1.39\" colorspace=\"lin_rec709\">".to_owned(),
    ] {
        assert!(text.contains(&part), "{part} is missing in\n{text}");
    }
    assert!(!text.contains(folder.path().to_str().unwrap()), "{text}");
    let open = |name: &str| {
        image::open(folder.path().join("wet & dry <1>_textures").join(name)).unwrap().into_rgb8()
    };
    let reflectance = ((ior - 1.0) / (ior + 1.0)).powi(2);
    let [base, weight, tint, rough, normal] =
        ["base_color", "specular_weight", "specular_color", "roughness", "normal"]
            .map(|n| open(&format!("{n}.png")));
    let decoded = |code: u8| {
        let v = f64::from(code) / 255.0;
        if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
    };
    for (x, y) in [(0, 0), (22, 8), (3, 8), (11, 4)] {
        let texel = original.texel(y as usize * 23 + x as usize);
        let at = |image: &image::RgbImage, c: usize| image.get_pixel(x, y).0[c];
        for c in 0..3 {
            let specular = reflectance * f64::from(at(&weight, c)) / 255.0 * decoded(at(&tint, c));
            assert!(
                (specular - f64::from(texel.specular[c])).abs() < 0.003,
                "{x}, {y}: {specular}, {texel:?}"
            );
            assert!((decoded(at(&base, c)) - f64::from(texel.diffuse[c])).abs() < 0.005, "{x}, {y}");
            let n = 2.0 * f64::from(at(&normal, c)) / 255.0 - 1.0;
            assert!((n - f64::from(texel.normal.to_array()[c])).abs() < 0.005, "{x}, {y}: {n}");
        }
        assert!((f64::from(at(&rough, 1)) / 255.0 - f64::from(texel.roughness)).abs() < 0.003);
    }
    let files: Vec<&PathBuf> = again.files.iter().collect();
    assert!(files.len() == 6, "{files:?}");
}

#[test]
fn a_document_appears_after_its_pictures_or_not_at_all() {
    let folder = tempdir().unwrap();
    let original = metallic();
    let of = |name: &str| folder.path().join(name);
    let entries = || {
        let names =
            fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<_> = names.collect();
        names.sort();
        names
    };
    let kind = FileKind::Mtlx { depth: Depth::Eight };
    // Cancelled: nothing.
    let progress = Progress::default();
    progress.cancel();
    let cancelled = write::write_watched(&original, &of("a.mtlx"), kind, &progress);
    assert!(matches!(&cancelled, Err(error) if error.is_cancelled()), "{cancelled:?}");
    assert_eq!(entries(), Vec::<String>::new());
    // A folder in the place of the document: its pictures do not stay alone.
    fs::create_dir(of("b.mtlx")).unwrap();
    let refused = write::write(&original, &of("b.mtlx"), kind).unwrap_err().to_string();
    assert!(refused.contains("it is a folder"), "{refused}");
    assert_eq!(entries(), ["b.mtlx"]);
    // A folder of pictures that is there stays, and so does its document.
    fs::create_dir(of("c_textures")).unwrap();
    fs::write(of("c_textures/mine.png"), "mine").unwrap();
    fs::write(of("c.mtlx"), "old").unwrap();
    let refused = write::write(&original, &of("c.mtlx"), kind).unwrap_err().to_string();
    assert!(refused.contains("c_textures") && refused.contains("name another"), "{refused}");
    assert_eq!(fs::read_to_string(of("c.mtlx")).unwrap(), "old");
    assert_eq!(fs::read_dir(of("c_textures")).unwrap().count(), 1);
    assert_eq!(entries(), ["b.mtlx", "c.mtlx", "c_textures"]);
    // A document alone is replaced.
    fs::write(of("d.mtlx"), "old").unwrap();
    write::write(&original, &of("d.mtlx"), kind).unwrap();
    assert!(fs::read_to_string(of("d.mtlx")).unwrap().contains("open_pbr_surface"));
    assert!(write::write(&original, &of("none/e.mtlx"), kind).is_err());
    #[cfg(unix)]
    {
        // A document that cannot be written: its pictures do not stay alone.
        std::os::unix::fs::symlink("f.mtlx", of("f.mtlx")).unwrap();
        assert!(write::write(&original, &of("f.mtlx"), kind).is_err());
        assert!(!of("f_textures").exists());
        use std::os::unix::ffi::OsStringExt as _;
        let name = std::ffi::OsString::from_vec(b"\xff.mtlx".to_vec());
        let refused = write::write(&original, &folder.path().join(name), kind).unwrap_err().to_string();
        assert!(refused.contains("Unicode"), "{refused}");
    }
    assert!(entries().iter().all(|name| !name.starts_with(".svbrdf-")), "{:?}", entries());
}

#[test]
fn forms_have_their_depths_and_presets() {
    let new = |name: &str, depth, like, preview| {
        FileKind::new(Path::new(name), &WriteOptions { depth, like, preview })
    };
    assert_eq!(new("a.GLB", None, None, false).unwrap(), FileKind::Glb { sixteen: false });
    assert_eq!(new("a.mtlx", Some(Depth::Half), None, false).unwrap(), FileKind::Mtlx { depth: Depth::Half });
    for (name, depth, like, preview) in [
        ("a.glb", Some(Depth::Half), None, false),
        ("a.glb", None, Some(Preset::Gltf), false),
        ("a.mtlx", None, Some(Preset::Gao), false),
        ("a.glb", None, None, true),
        ("a.mtlx", None, None, true),
        ("a.gltf", None, None, false),
        ("a.TIF", None, None, false),
        ("a.png", None, Some(Preset::Gltf), false),
        ("a.png", None, None, true),
        ("a", None, Some(Preset::Gao), false),
        ("a.exr", None, Some(Preset::Gao), false),
    ] {
        let refused = new(name, depth, like, preview);
        assert!(matches!(refused, Err(Error::UnsupportedOutput { .. })), "{name}: {refused:?}");
    }
}
