//! Writing of materials.

use super::*;

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
        write::write(&original.material, &out, kind(&out, depth)).unwrap();
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
            write::write(&read.material, to, kind(to, Some(depth))).unwrap();
        }
        assert!(std::fs::read(&files[0]).unwrap() == std::fs::read(&files[1]).unwrap(), "{depth:?}");
    }
}

#[test]
fn a_folder_that_is_there_is_not_replaced() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "a.png", &packed("NDRS", 4, linear), ImageFormat::Png);
    let read: Read<f32> = read(&path, &ReadOptions::default(), &Progress::default()).unwrap();
    let result = write::write(&read.material, folder.path(), kind(folder.path(), None));
    assert!(matches!(result, Err(Error::Unwritable { .. })));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn codes_of_research_are_written_as_they_are_read() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "a.png", &packed("NDRS", 4, linear), ImageFormat::Png);
    let original: Read<f32> = read(&path, &ReadOptions::default(), &Progress::default()).unwrap();
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
    for (like, out) in [(Preset::Gltf, "x.png"), (Preset::Gao, "x"), (Preset::Gao, "x.exr")] {
        let options = WriteOptions { like: Some(like), ..WriteOptions::default() };
        assert!(
            matches!(FileKind::new(Path::new(out), &options), Err(Error::UnsupportedOutput { .. })),
            "{out}"
        );
    }
    let preview = WriteOptions { preview: true, ..WriteOptions::default() };
    assert!(matches!(FileKind::new(Path::new("x.png"), &preview), Err(Error::UnsupportedOutput { .. })));
    for picture in ["x.jpg", "x.TIF", "x.gltf"] {
        assert!(matches!(
            FileKind::new(Path::new(picture), &WriteOptions::default()),
            Err(Error::UnsupportedOutput { .. })
        ));
    }
    let kind = |path: &str| FileKind::new(Path::new(path), &WriteOptions::default());
    assert!(kind("brick.v2/").is_ok() && kind("brick.v2").is_err(), "a folder ends with a slash");
}

#[test]
fn a_metallic_folder_says_what_metallic_can_say() {
    let folder = tempdir().unwrap();
    let put = |name: &str, at: &dyn Fn(usize, usize) -> [f64; 3]| {
        save(folder.path(), &format!("{name}.png"), &picture(SIDE, SIDE, at), ImageFormat::Png);
    };
    put("normal", &|x, y| stored(0, x, y, |v| v));
    put("basecolor", &|x, _| [srgb(0.1 + 0.05 * x as f64), 0.4, 0.3]);
    put("orm", &|x, y| [1.0, texel(2, x, y)[0], if y < SIDE / 2 { 0.0 } else { 1.0 }]);
    let original: Read<f32> = read(folder.path(), &ReadOptions::AUTO, &Progress::default()).unwrap();
    let out = tempdir().unwrap();
    let out = out.path().join("out");
    let options = WriteOptions { like: Some(Preset::Gltf), depth: Some(Depth::Sixteen), preview: false };
    write::write(&original.material, &out, FileKind::new(&out, &options).unwrap()).unwrap();
    let again: Read<f32> = read(&out, &ReadOptions::AUTO, &Progress::default()).unwrap();
    assert_eq!(chosen(&again, What::Workflow), "metallic");
    for index in 0..SIDE * SIDE {
        let [a, b] = [&original, &again].map(|read| read.material.texel(index));
        let pairs = a.diffuse.into_iter().zip(b.diffuse).chain(a.specular.into_iter().zip(b.specular));
        assert!(pairs.chain([(a.roughness, b.roughness)]).all(|(a, b)| (a - b).abs() < 1e-4), "{a:?}, {b:?}");
    }
}

#[test]
fn a_preview_is_for_other_programs_and_changes_no_map() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "a.png", &packed("NDRS", 4, linear), ImageFormat::Png);
    let original: Read<f32> = read(&path, &ReadOptions::default(), &Progress::default()).unwrap();
    let out = folder.path().join("p.exr");
    let options = WriteOptions { preview: true, depth: Some(Depth::Float), like: None };
    write::write(&original.material, &out, FileKind::new(&out, &options).unwrap()).unwrap();
    let again: Read<f32> = read(&out, &ReadOptions::default(), &Progress::default()).unwrap();
    assert_eq!(again.material.planes(), original.material.planes());
    assert!(again.notes.iter().any(|note| note.to_string().contains("preview")), "{:?}", again.notes);
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
