//! Small arrays, whose shapes do not tell rows and columns from channels.

use std::io::Write as _;

use super::*;

/// An npz of arrays of 32-bit floats.
fn archive(folder: &Path, arrays: &[(&str, &[u64], &[f32])]) -> std::path::PathBuf {
    let path = folder.join("m.npz");
    let mut archive = zip::ZipWriter::new(std::fs::File::create(&path).unwrap());
    for (name, shape, values) in arrays {
        archive.start_file(format!("{name}.npy"), zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(&npy(shape, values)).unwrap();
    }
    archive.finish().unwrap();
    path
}

/// A reading of this size, with a texel of this diffuse, and a note of each array whose layout nothing decides.
#[track_caller]
fn assert_is(
    path: &Path,
    size: [usize; 2],
    (index, diffuse): (usize, [f64; 3]),
    undecided: usize,
) -> Read<f64> {
    let read = open(path);
    assert_eq!(read.material.size(), size);
    assert_near(read.material.texel(index).diffuse, diffuse);
    assert_eq!(notes(&read).matches("channels could also come first").count(), undecided, "{}", notes(&read));
    read
}

#[test]
fn an_npz_of_one_texel_has_its_channels_last_as_its_gray_map_tells() {
    let folder = tempdir().unwrap();
    let path = archive(
        folder.path(),
        &[
            ("normal", &[1, 1, 3], &[0.6, 0.0, 0.8]),
            ("diffuse", &[1, 1, 3], &[0.1, 0.2, 0.3]),
            ("specular", &[1, 1, 3], &[0.04, 0.05, 0.06]),
            ("roughness", &[1, 1, 1], &[0.5]),
        ],
    );
    let texel = assert_is(&path, [1, 1], (0, [0.1, 0.2, 0.3]), 0).material.texel(0);
    let got = [texel.normal.to_array(), texel.specular].concat();
    for (got, expected) in got.into_iter().zip([0.6, 0.0, 0.8, 0.04, 0.05, 0.06]) {
        assert!((got - expected).abs() < 1e-6, "{texel:?}");
    }
}

#[test]
fn an_npz_of_small_planes_has_its_channels_first_where_that_gives_all_maps_one_size() {
    let folder = tempdir().unwrap();
    let plane = |value: f32| vec![value; 16];
    let planes = |rgb: [f32; 3]| rgb.map(plane).concat();
    let path = archive(
        folder.path(),
        &[
            ("normal", &[3, 4, 4], &planes([0.0, 0.0, 1.0])),
            ("diffuse", &[3, 4, 4], &planes([0.1, 0.2, 0.3])),
            ("roughness", &[1, 4, 4], &plane(0.5)),
        ],
    );
    assert_is(&path, [4, 4], (5, [0.1, 0.2, 0.3]), 0);
}

#[test]
fn an_array_that_nothing_decides_has_its_channels_last_and_a_note() {
    let folder = tempdir().unwrap();
    let maps: [(&str, [f32; 3]); 3] =
        [("normal", [0.0, 0.0, 1.0]), ("diffuse", [0.1, 0.2, 0.3]), ("roughness", [0.5; 3])];
    for (name, rgb) in maps {
        std::fs::write(folder.path().join(format!("{name}.npy")), npy([1, 1, 3], &rgb)).unwrap();
    }
    assert_notes(&assert_is(folder.path(), [1, 1], (0, [0.1, 0.2, 0.3]), 3), &["of the shape (1, 1, 3)"]);
}

#[test]
fn arrays_that_are_no_pictures_are_named_and_left_out_and_a_batch_of_one_is_a_picture() {
    let folder = tempdir().unwrap();
    let texels = |rgb: [f32; 3]| rgb.repeat(6);
    let maps: [(&str, &[u64], &[f32]); 4] = [
        ("normal", &[1, 2, 3, 3], &texels([0.0, 0.0, 1.0])),
        ("diffuse", &[2, 3, 3], &texels([0.1, 0.2, 0.3])),
        ("roughness", &[2, 3], &[0.5; 6]),
        ("loss", &[], &[0.25]),
    ];
    let path = archive(folder.path(), &maps);
    assert_notes(
        &assert_is(&path, [3, 2], (5, [0.1, 0.2, 0.3]), 0),
        &["Array loss is not used: it is no picture"],
    );
    let alone = archive(folder.path(), &maps[3..]);
    assert_refused(&alone, &["array loss: expected the shape"]);
}

#[test]
fn integers_of_any_type_are_codes_where_they_fit() {
    let folder = tempdir().unwrap();
    let array = |kind: &str, values: &[i64], size: usize| {
        let header =
            format!("{{'descr': '<{kind}', 'fortran_order': False, 'shape': (1,{},), }}", values.len());
        let values = values.iter().flat_map(|value| value.to_le_bytes()[..size].to_vec());
        let header = format!("{header:117}\n").into_bytes();
        b"\x93NUMPY\x01\x00\x76\x00".iter().copied().chain(header).chain(values).collect::<Vec<u8>>()
    };
    let diffuse =
        archive(folder.path(), &[("diffuse", &[1, 2], &[0.5; 2]), ("specular", &[1, 2], &[0.04; 2])]);
    let of = |kind: &str, values: &[i64], size: usize| {
        let mut archive = zip::ZipWriter::new_append(
            std::fs::File::options().read(true).write(true).open(&diffuse).unwrap(),
        )
        .unwrap();
        archive.start_file("roughness.npy", zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(&array(kind, values, size)).unwrap();
        archive.finish().unwrap();
    };
    for (kind, size, values, expected) in [
        ("i8", 8, [51, 255], Some([0.2, 1.0])),
        ("i4", 4, [0, 1], Some([0.0, 1.0])),
        ("i2", 2, [13_107, 0], Some([0.2, 0.0])),
        ("u4", 4, [65_535, 0], Some([1.0, 0.0])),
        ("i8", 8, [-1, 3], None),
        ("i8", 8, [70_000, 3], None),
    ] {
        archive(folder.path(), &[("diffuse", &[1, 2], &[0.5; 2]), ("specular", &[1, 2], &[0.04; 2])]);
        of(kind, &values, size);
        match expected {
            Some(expected) => {
                let read = open(&diffuse);
                assert_near([0, 1].map(|index| read.material.texel(index).roughness), expected);
            }
            None => assert_refused(&diffuse, &["array roughness", "integers from 0 to 255"]),
        }
    }
}
