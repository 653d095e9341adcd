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
    put_exrs(folder.path(), |_, _, v| v);
    assert_same(&open(folder.path()), 1e-6);
}

#[test]
fn nan_and_infinity_are_counted_located_and_replaced_only_on_request() {
    let folder = tempdir().unwrap();
    put_exrs(folder.path(), |map, i, v| match (map, i) {
        (1, 35) => f32::NAN,
        (1, 50) => f32::INFINITY,
        _ => v,
    });
    assert_refused(
        folder.path(),
        &["diffuse.exr", "diffuse map, column 3, row 2", "3 NaN and 3 infinite", "correct the map"],
    );
    let options = ReadOptions { non_finite: Some(NonFinite::Replace), ..ReadOptions::AUTO };
    let replaced = open_as(folder.path(), &options);
    assert_eq!(replaced.material.texel(35).diffuse, [0.0; 3]);
    assert_notes(&replaced, &["6 samples of the diffuse map"]);
}

#[test]
fn values_beyond_one_are_clamped_and_counted() {
    let folder = tempdir().unwrap();
    put_exrs(folder.path(), |map, i, v| if (map, i) == (3, 4) { 2.5 } else { v });
    let read = open(folder.path());
    assert_eq!(read.material.texel(4).specular, [1.0; 3]);
    let mut whys = read.unsure().map(|a| a.why.to_string());
    assert!(whys.any(|why| why.contains("3 samples of the specular map") && why.contains("2.5")));
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
    assert_notes(&shifted, &["data window beside"]);
    windowed(&path, (2, 1), SIDE + 4);
    let read = open(&path);
    assert_eq!(read.material.size(), [SIDE + 4; 2]);
    let (inside, outside) = (read.material.texel(3 * (SIDE + 4) + 5), read.material.texel(0));
    let expected = texel(1, 3, 2);
    assert!(inside.diffuse.iter().zip(expected).all(|(a, b)| (a - b).abs() < HALF), "{inside:?}");
    assert_eq!((outside.diffuse, outside.normal.to_array()), ([0.0; 3], [0.0, 0.0, 1.0]));
    assert_notes(&read, &["16 x 16 of the 20 x 20"]);
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
fn tiff_of_32_bit_integers_is_encoded_as_others_are_and_pages_after_the_first_are_said() {
    use tiff::encoder::{TiffEncoder, colortype};
    let folder = grays(&[("roughness", 0.5)]);
    put(folder.path(), "normal_gl", bumps);
    let colours: Vec<u32> = (0..SIDE * SIDE)
        .flat_map(|_| [0.5, 0.4, 0.3].map(|v| (srgb(v) * f64::from(u32::MAX)) as u32))
        .collect();
    for pages in [1, 2] {
        let file = std::fs::File::create(folder.path().join("basecolor.tif")).unwrap();
        let mut tiff = TiffEncoder::new(file).unwrap();
        for _ in 0..pages {
            tiff.write_image::<colortype::RGB32>(SIDE as u32, SIDE as u32, &colours).unwrap();
        }
        let read = open(folder.path());
        assert_near(read.material.texel(9).diffuse, [0.5, 0.4, 0.3]);
        assert_eq!(chosen(&read, What::Albedo), "srgb");
        assert_eq!(notes(&read).contains("several pages or frames"), pages > 1, "{}", notes(&read));
    }
}

#[test]
fn tiff_of_other_samples_and_compressions_is_refused_by_name() {
    use tiff::encoder::{TiffEncoder, colortype};
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.tif");
    let file = std::fs::File::create(&path).unwrap();
    TiffEncoder::new(file).unwrap().write_image::<colortype::GrayI16>(4, 4, &[7; 16]).unwrap();
    assert_refused(&path, &["signed integers of 16 bits"]);
    let mut bytes = std::fs::read(&path).unwrap();
    // The entry of the compression: tag 259, a short, one value.
    let entry = [3_u8, 1, 3, 0, 1, 0, 0, 0];
    let at = bytes.windows(entry.len()).position(|window| window == entry).unwrap() + entry.len();
    for (code, name) in [(34_925_u16, "LZMA"), (34_712, "JPEG 2000"), (50_000, "ZSTD")] {
        bytes[at..at + 2].copy_from_slice(&code.to_le_bytes());
        std::fs::write(&path, &bytes).unwrap();
        assert_refused(&path, &[name, "LZW"]);
    }
}

/// Worst difference of the diffuse, specular and roughness of a strip N D R S, read as linear, from its pixels.
fn worst_from_pixels(material: &Material<f64>, strip: &image::RgbImage) -> f64 {
    let side = SIDE as u32;
    let code =
        |tile: u32, x: u32, y: u32| strip.get_pixel(tile * side + x, y).0.map(|c| f64::from(c) / 255.0);
    let mut worst = 0.0_f64;
    for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
        let texel = material.texel((y * side + x) as usize);
        let roughness = code(2, x, y).iter().sum::<f64>() / 3.0;
        let pairs =
            texel.diffuse.into_iter().zip(code(1, x, y)).chain(texel.specular.into_iter().zip(code(3, x, y)));
        worst = pairs.chain([(texel.roughness, roughness)]).map(|(a, b)| (a - b).abs()).fold(worst, f64::max);
    }
    worst
}

/// A JPEG is what its decoder makes of it: the values of the codes, to rounding. What encoding loses is not ours.
#[test]
fn jpeg_opens_as_the_codes_that_are_decoded_from_it() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "a.jpg", &packed("NDRS", 4, linear), ImageFormat::Jpeg);
    let read = open_as(&path, &ReadOptions { albedo: Some(Albedo::Linear), ..ReadOptions::AUTO });
    let mut codes = image::open(&path).unwrap().to_rgb8();
    assert!(worst_from_pixels(&read.material, &codes) < 1e-12);
    // A planted fault: one code off by one.
    codes.get_pixel_mut(SIDE as u32, 0).0[1] ^= 1;
    assert!(worst_from_pixels(&read.material, &codes) > 1e-3);
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
