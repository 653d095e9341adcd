//! Writing of materials.

use super::*;

fn single(path: &Path) -> Read<f32> {
    read(path, &ReadOptions::AUTO, &Progress::default()).unwrap()
}

/// The largest difference of two materials.
fn off(a: &Read<f32>, b: &Read<f32>) -> f32 {
    let values = |read: &Read<f32>| {
        let planes = read.material.planes().clone();
        [planes.normal.concat(), planes.diffuse.concat(), planes.specular.concat(), planes.roughness].concat()
    };
    values(a).into_iter().zip(values(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

#[test]
fn what_is_written_is_read_back() {
    let folder = tempdir().unwrap();
    let original = single(&put_strip(folder.path(), "a", "NDRS"));
    let table = [
        ("h.exr", None, HALF),
        ("f.exr", Some(Depth::Float), 0.0),
        ("p.png", None, 0.005),
        ("q.png", Some(Depth::Sixteen), 3e-5),
        ("folder", Some(Depth::Sixteen), 1e-4),
    ];
    for (name, depth, bound) in table {
        let out = folder.path().join(name);
        write::write(&original.material, &out, kind(&out, depth)).unwrap();
        let worst = off(&original, &single(&out));
        assert!(worst <= bound as f32, "{name}: off by {worst}");
    }
}

#[test]
fn a_native_exr_that_is_read_and_written_again_is_the_same_file() {
    let folder = tempdir().unwrap();
    let path = put_strip(folder.path(), "a", "NDRS");
    for depth in [Depth::Half, Depth::Float] {
        let files = ["one.exr", "two.exr"].map(|name| folder.path().join(name));
        for (from, to) in [(&path, &files[0]), (&files[0], &files[1])] {
            write::write(&single(from).material, to, kind(to, Some(depth))).unwrap();
        }
        assert!(std::fs::read(&files[0]).unwrap() == std::fs::read(&files[1]).unwrap(), "{depth:?}");
    }
}

#[test]
fn codes_of_research_are_written_as_they_are_read() {
    let folder = tempdir().unwrap();
    let original = single(&put_strip(folder.path(), "a", "NDRS"));
    for (like, out, layout) in [
        (Preset::Deschaintre, "d.png", "ndrs"),
        (Preset::Gao, "g.png", "ndrs"),
        (Preset::MaterialGan, "m.png", "dnrs"),
        (Preset::LookAhead, "l.png", "dnrs"),
        (Preset::MatFusion, "f.png", "dsrn"),
        (Preset::MaterialGan, "materialgan", ""),
    ] {
        let out = folder.path().join(out);
        let options = WriteOptions { like: Some(like), depth: Some(Depth::Sixteen), preview: false };
        write::write(&original.material, &out, FileKind::new(&out, &options).unwrap()).unwrap();
        let read = open_as(&out, &ReadOptions { preset: Some(like), ..ReadOptions::AUTO });
        assert!(chosen(&read, What::Layout).starts_with(layout), "{like}: {:#?}", read.assumptions);
        assert_same(&read, EIGHT_BITS);
        // Without a preset, by what the file says or its names.
        assert_same(&open(&out), EIGHT_BITS);
    }
    let kind = |path: &str| FileKind::new(Path::new(path), &WriteOptions::default());
    assert!(kind("brick.v2/").is_ok() && kind("brick.v2").is_err(), "a folder ends with a slash");
}

#[test]
fn a_metallic_folder_says_what_metallic_can_say() {
    let folder = tempdir().unwrap();
    put(folder.path(), "normal", bumps);
    put(folder.path(), "basecolor", |x, _| [srgb(0.1 + 0.05 * x as f64), 0.4, 0.3]);
    put(folder.path(), "orm", |x, y| [1.0, texel(2, x, y)[0], if y < SIDE / 2 { 0.0 } else { 1.0 }]);
    let original = single(folder.path());
    let out = tempdir().unwrap();
    let out = out.path().join("out");
    let options = WriteOptions { like: Some(Preset::Gltf), depth: Some(Depth::Sixteen), preview: false };
    write::write(&original.material, &out, FileKind::new(&out, &options).unwrap()).unwrap();
    let again = single(&out);
    assert_eq!(chosen(&again, What::Workflow), "metallic");
    assert!(off(&original, &again) < 1e-4, "{}", off(&original, &again));
}

#[test]
fn a_preview_is_for_other_programs_and_changes_no_map() {
    let folder = tempdir().unwrap();
    let original = single(&put_strip(folder.path(), "a", "NDRS"));
    let out = folder.path().join("p.exr");
    let options = WriteOptions { preview: true, depth: Some(Depth::Float), like: None };
    write::write(&original.material, &out, FileKind::new(&out, &options).unwrap()).unwrap();
    let again = single(&out);
    assert_eq!(again.material.planes(), original.material.planes());
    assert_notes(&again, &["preview"]);
    let shown = exr::prelude::read_first_rgba_layer_from_file(
        &out,
        |size, _| vec![[0.0_f32; 3]; size.area()],
        |pixels: &mut Vec<[f32; 3]>, at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.y() * SIDE + at.x()] = [r, g, b];
        },
    );
    let pixels = shown.unwrap().layer_data.channel_data.pixels;
    assert!(pixels.iter().flatten().all(|v| v.is_finite() && *v > 0.0), "{pixels:?}");
}
