//! Materials as they are written: what opens again as the same material, binary glTF by its specification, and sidecar files.

mod glb;

use std::fs;
use std::path::Path;

use tempfile::tempdir;

use svbrdf_core::material::{Material, Planes};
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;
use svbrdf_files::read::{Binding, Read, ReadOptions, Sidecar, read, read_bytes};
use svbrdf_files::write::{self, Depth, FileKind};

use crate::materials::formula::{Place, values};

/// Normals, diffuse, specular and roughness by formulas.
fn material(size: [usize; 2], formulas: [&str; 4]) -> Material<f32> {
    let [width, height] = size;
    let place = |i: usize| Place { x: i % width, y: i / width, size };
    let plane = |formula: &str, c: usize| -> Vec<f32> {
        let value = |i| values(formula, place(i));
        (0..width * height).map(value).map(|all| all[c.min(all.len() - 1)] as f32).collect()
    };
    let three = |formula: &str| [0, 1, 2].map(|c| plane(formula, c));
    let [normal, diffuse, specular, roughness] = formulas;
    let planes = Planes {
        normal: three(normal),
        diffuse: three(diffuse),
        specular: three(specular),
        roughness: plane(roughness, 0),
    };
    Material::new("1 brick & \"mortar\"", width, height, planes).unwrap()
}

fn same() -> Material<f32> {
    material([16, 16], ["N", "d", "s", "r"])
}

fn open(path: &Path) -> Read<f32> {
    read(path, &ReadOptions::AUTO, &Progress::default()).unwrap()
}

fn kind(path: &Path, depth: Option<Depth>) -> FileKind {
    FileKind::new(path, depth).unwrap()
}

/// The largest difference of two materials.
fn off(a: &Material<f32>, b: &Material<f32>) -> f32 {
    let values = |material: &Material<f32>| {
        let planes = material.planes().clone();
        [planes.normal.concat(), planes.diffuse.concat(), planes.specular.concat(), planes.roughness].concat()
    };
    assert_eq!(a.size(), b.size());
    values(a).into_iter().zip(values(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

#[test]
fn what_is_written_is_read_back() {
    let folder = tempdir().unwrap();
    let original = same();
    for (name, depth, bound) in [
        ("h.exr", None, 0.001),
        ("f.exr", Some(Depth::Float), 1e-7),
        ("p.png", None, 0.005),
        ("q.png", Some(Depth::Sixteen), 3e-5),
        ("folder", Some(Depth::Sixteen), 1e-4),
    ] {
        let out = folder.path().join(name);
        write::write(&original, &out, kind(&out, depth)).unwrap();
        // By what the file states, or its names.
        let again = open(&out);
        let worst = off(&original, &again.material);
        assert!(worst <= bound && again.unsure().count() == 0, "{name}: off by {worst}");
    }
}

#[test]
fn a_native_exr_that_is_read_and_written_again_is_the_same_file() {
    let folder = tempdir().unwrap();
    let [one, two] = ["one.exr", "two.exr"].map(|name| folder.path().join(name));
    for depth in [Depth::Half, Depth::Float] {
        write::write(&same(), &one, kind(&one, Some(depth))).unwrap();
        write::write(&open(&one).material, &two, kind(&two, Some(depth))).unwrap();
        assert!(fs::read(&one).unwrap() == fs::read(&two).unwrap(), "{depth:?}");
    }
}

#[test]
fn forms_have_their_depths() {
    let new = |name: &str, depth| FileKind::new(Path::new(name), depth);
    assert_eq!(new("a.GLB", None).unwrap(), FileKind::Glb { sixteen: false });
    assert!(new("brick.v2/", None).is_ok(), "a folder ends with a slash");
    for (name, depth) in [("brick.v2", None), ("a.glb", Some(Depth::Half)), ("a.gltf", None)] {
        let refused = new(name, depth);
        assert!(matches!(refused, Err(Error::UnsupportedOutput { .. })), "{name}: {refused:?}");
    }
}

#[test]
fn everything_that_can_be_specified_can_be_saved() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.png");
    write::write(&same(), &path, kind(&path, None)).unwrap();
    let options = "albedo=linear,dielectric-f0=0.05,energy=unscaled,exemplar=1,flip-v=true,grid=4x1,non-finite=replace,\
        normal-encoding=xy,normal-y=down,order=ndrs,preset=gao,roughness=gloss,specular-albedo=gamma2.2,workflow=specular";
    let binding: Binding = format!("normal={}:r", folder.path().join("a b.png").display()).parse().unwrap();
    let given = Sidecar::default().overridden_by(&options.parse().unwrap(), &[binding]);
    let place = given.save(&path, &Progress::default()).unwrap();
    let written = fs::read_to_string(&place).unwrap();
    for line in
        [r#""dielectric-f0": 0.05"#, r#""grid": "4x1""#, r#""normal": "a b.png:r""#, r#""flip-v": true"#]
    {
        assert!(written.contains(line), "{line} is missing in {written}");
    }
    let loaded = Sidecar::load(&path).unwrap();
    assert_eq!(loaded.options, given.options);
    loaded.save(&path, &Progress::default()).unwrap();
    assert_eq!(fs::read_to_string(&place).unwrap(), written);
}

#[test]
fn reading_reports_progress_stops_when_asked_and_takes_pictures_in_memory() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("maps");
    write::write(&same(), &path, kind(&path, None)).unwrap();
    let progress = Progress::default();
    read::<f32>(&path, &ReadOptions::AUTO, &progress).unwrap();
    assert_eq!(progress.counts(), (4, 4));
    progress.cancel();
    let stopped = read::<f32>(&path, &ReadOptions::AUTO, &progress);
    assert!(stopped.is_err_and(|error| error.is_cancelled()));
    assert!(
        write::write_watched(
            &same(),
            &folder.path().join("a.glb"),
            FileKind::Glb { sixteen: false },
            &progress
        )
        .is_err()
    );
    let strip = folder.path().join("a.png");
    write::write(&same(), &strip, kind(&strip, None)).unwrap();
    let bytes = fs::read(&strip).unwrap();
    let found = read_bytes::<f32>("some name", &bytes, &ReadOptions::AUTO).unwrap();
    assert!(found.material.name() == "some name" && found.files.is_empty());
    assert_eq!(found.material.planes(), open(&strip).material.planes());
}
