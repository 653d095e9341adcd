//! Formats of pictures.

use super::*;

#[test]
fn layered_and_multi_part_exr_open_with_signed_normals() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.exr");
    for write in [|p: &Path| layered(p, false), |p: &Path| layered(p, true), multi_part] {
        write(&path);
        let read = open(&path);
        assert_eq!((chosen(&read, What::NormalEncoding), chosen(&read, What::Albedo)), ("signed", "linear"));
        assert_same(&read, HALF);
    }
}

#[test]
fn a_folder_of_float_exr_opens_and_y_alone_is_gray() {
    let folder = tempdir().unwrap();
    for (map, name) in ["normal", "diffuse", "roughness", "specular"].iter().enumerate() {
        map_exr(&folder.path().join(format!("{name}.exr")), map, |_, v| v);
    }
    assert_same(&open(folder.path()), 1e-6);
}

#[test]
fn nan_and_infinity_are_counted_located_and_replaced_only_on_request() {
    let folder = tempdir().unwrap();
    for (map, name) in ["normal", "diffuse", "roughness", "specular"].iter().enumerate() {
        let damage = |i, v| match (map, i) {
            (1, 35) => f32::NAN,
            (1, 50) => f32::INFINITY,
            _ => v,
        };
        map_exr(&folder.path().join(format!("{name}.exr")), map, damage);
    }
    let message = refusal(folder.path());
    for words in
        ["diffuse.exr", "diffuse map, column 3, row 2", "3 NaN and 3 infinite", "--non-finite replace"]
    {
        assert!(message.contains(words), "`{words}` is not in {message}");
    }
    let replaced = open_as(
        folder.path(),
        &ReadOptions { non_finite: Some(NonFinite::Replace), ..ReadOptions::default() },
    );
    assert_eq!(replaced.material.texel(35).diffuse, [0.0; 3]);
    assert!(replaced.messages().any(|line| line.contains("6 samples of the diffuse map")));
}

#[test]
fn values_beyond_one_are_clamped_and_counted() {
    let folder = tempdir().unwrap();
    for (map, name) in ["normal", "diffuse", "roughness", "specular"].iter().enumerate() {
        map_exr(
            &folder.path().join(format!("{name}.exr")),
            map,
            |i, v| if (map, i) == (3, 4) { 2.5 } else { v },
        );
    }
    let read = open(folder.path());
    assert_eq!(read.material.texel(4).specular, [1.0; 3]);
    assert!(read.unsure().any(|a| a.why.to_string().contains("3 samples of the specular map") && a.why.to_string().contains("2.5")));
}

#[test]
fn data_beside_the_display_window_is_put_in_its_place_and_said() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.exr");
    windowed(&path, (0, 0), SIDE);
    assert_same(&open(&path), HALF);
    windowed(&path, (-7, 3), SIDE);
    let shifted = open(&path);
    assert_same(&shifted, HALF);
    assert!(shifted.notes.iter().any(|note| note.to_string().contains("data window beside")), "{:?}", shifted.notes);
    windowed(&path, (2, 1), SIDE + 4);
    let read = open(&path);
    assert_eq!(read.material.size(), [SIDE + 4; 2]);
    let (inside, outside) = (read.material.texel(3 * (SIDE + 4) + 5), read.material.texel(0));
    let expected = texel(1, 3, 2);
    assert!(inside.diffuse.iter().zip(expected).all(|(a, b)| (a - b).abs() < HALF), "{inside:?}");
    assert_eq!((outside.diffuse, outside.normal.to_array()), ([0.0; 3], [0.0, 0.0, 1.0]));
    assert!(read.notes.iter().any(|note| note.to_string().contains("16 x 16 of the 20 x 20")), "{:?}", read.notes);
}

#[test]
fn tiff_of_8_and_16_bits_and_floats_opens() {
    let folder = tempdir().unwrap();
    let eight = packed("NDRS", 4, linear);
    let images = [eight.clone(), DynamicImage::from(eight.to_rgb16()), DynamicImage::from(eight.to_rgb32f())];
    for (image, depth) in images.iter().zip(["8-bit", "16-bit", "float"]) {
        let read = open(&save(folder.path(), "a.tif", image, ImageFormat::Tiff));
        assert_eq!(read.maps[0].depth, depth);
        assert_same(&read, EIGHT_BITS);
    }
}

#[test]
fn jpeg_opens_within_its_blocks() {
    let folder = tempdir().unwrap();
    let read = open(&save(folder.path(), "a.jpg", &packed("NDRS", 4, linear), ImageFormat::Jpeg));
    assert_same(&read, 0.2);
}

#[test]
fn radiance_hdr_opens_as_linear_floats() {
    let folder = tempdir().unwrap();
    let image = DynamicImage::from(packed("NDRS", 4, linear).to_rgb32f());
    let read = open(&save(folder.path(), "a.hdr", &image, ImageFormat::Hdr));
    assert_eq!((chosen(&read, What::Albedo), read.maps[0].depth), ("linear", "float"));
    assert_same(&read, 0.02);
}

#[test]
fn numpy_arrays_and_archives_open() {
    let folder = tempdir().unwrap();
    npz(&folder.path().join("m.npz"));
    assert_same(&open(&folder.path().join("m.npz")), 1e-6);
    let values: Vec<f32> = (0..4 * SIDE * SIDE)
        .flat_map(|i| stored(i % (4 * SIDE) / SIDE, i % SIDE, i / (4 * SIDE), |v| v).map(|v| v as f32))
        .collect();
    let strip = folder.path().join("strip.npy");
    std::fs::write(&strip, npy([SIDE as u64, 4 * SIDE as u64, 3], &values)).unwrap();
    assert_same(&open(&strip), 1e-6);
}

#[test]
fn rows_and_columns_of_tiff_are_turned_as_its_tag_says() {
    use image::metadata::Orientation;
    let folder = tempdir().unwrap();
    let seen = packed("NDRS", 4, linear);
    for tag in 1..=8_u16 {
        let inverse = Orientation::from_exif([1, 2, 3, 4, 5, 8, 7, 6][usize::from(tag) - 1]).unwrap();
        let mut stored = seen.clone();
        stored.apply_orientation(inverse);
        let path = folder.path().join("a.tif");
        let mut encoder = tiff::encoder::TiffEncoder::new(std::fs::File::create(&path).unwrap()).unwrap();
        let (width, height) = (stored.width(), stored.height());
        let mut image = encoder.new_image::<tiff::encoder::colortype::RGB8>(width, height).unwrap();
        image.encoder().write_tag(tiff::tags::Tag::Orientation, tag).unwrap();
        image.write_data(stored.as_bytes()).unwrap();
        assert_same(&open(&path), EIGHT_BITS);
    }
}
