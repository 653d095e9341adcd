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

fn notes_of_layout(read: &Read<f64>) -> Vec<String> {
    read.notes.iter().map(ToString::to_string).filter(|note| note.contains("of the shape")).collect()
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
    let read = open(&path);
    assert_eq!(read.material.size(), [1, 1]);
    let texel = read.material.texel(0);
    let expected = [0.6, 0.0, 0.8, 0.1, 0.2, 0.3, 0.04, 0.05, 0.06, 0.5];
    let got = texel.normal.to_array().into_iter().chain(texel.diffuse).chain(texel.specular);
    for (got, expected) in got.chain([texel.roughness]).zip(expected) {
        assert!((got - expected).abs() < 1e-6, "{texel:?}");
    }
    assert_eq!(notes_of_layout(&read), [""; 0]);
}

#[test]
fn an_npz_of_one_row_has_its_channels_last() {
    let folder = tempdir().unwrap();
    let path = archive(
        folder.path(),
        &[
            ("normal", &[1, 2, 3], &[0.0, 0.0, 1.0, 0.6, 0.0, 0.8]),
            ("diffuse", &[1, 2, 3], &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]),
            ("roughness", &[1, 2], &[0.5, 0.6]),
        ],
    );
    let read = open(&path);
    assert_eq!(read.material.size(), [2, 1]);
    let diffuse = read.material.texel(1).diffuse;
    assert!(diffuse.into_iter().zip([0.4, 0.5, 0.6]).all(|(a, b)| (a - b).abs() < 1e-6), "{diffuse:?}");
    assert_eq!(notes_of_layout(&read), [""; 0]);
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
    let read = open(&path);
    assert_eq!(read.material.size(), [4, 4]);
    let diffuse = read.material.texel(5).diffuse;
    assert!(diffuse.into_iter().zip([0.1, 0.2, 0.3]).all(|(a, b)| (a - b).abs() < 1e-6), "{diffuse:?}");
    assert_eq!(notes_of_layout(&read), [""; 0]);
}

#[test]
fn an_array_that_nothing_decides_has_its_channels_last_and_a_note() {
    let folder = tempdir().unwrap();
    let maps: [(&str, [f32; 3]); 3] =
        [("normal", [0.0, 0.0, 1.0]), ("diffuse", [0.1, 0.2, 0.3]), ("roughness", [0.5; 3])];
    for (name, rgb) in maps {
        std::fs::write(folder.path().join(format!("{name}.npy")), npy([1, 1, 3], &rgb)).unwrap();
    }
    let read = open(folder.path());
    assert_eq!(read.material.size(), [1, 1]);
    let diffuse = read.material.texel(0).diffuse;
    assert!(diffuse.into_iter().zip([0.1, 0.2, 0.3]).all(|(a, b)| (a - b).abs() < 1e-6), "{diffuse:?}");
    let notes = notes_of_layout(&read);
    assert_eq!(notes.len(), 3, "{notes:?}");
    assert!(notes[0].contains("(1, 1, 3)") && notes[0].contains("channels could also come first"));
}
