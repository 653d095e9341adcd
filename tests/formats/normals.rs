//! Normal maps.

use super::*;

/// A folder of the other maps, with the normals of `image`.
fn with_normals(name: &str, image: &DynamicImage) -> (tempfile::TempDir, Read<f64>) {
    let folder = tempdir().unwrap();
    folder_of(["x.png", "a_diffuse.png", "a_roughness.png", "a_specular.png"], folder.path(), |_, v| v);
    save(folder.path(), &format!("{name}.png"), image, ImageFormat::Png);
    let read = open(folder.path());
    (folder, read)
}

#[test]
fn y_of_normals_is_told_by_names_and_by_curl() {
    for (name, is_turned) in
        [("a_NormalGL", false), ("a_nor_dx", true), ("a_normal", false), ("a_normal", true)]
    {
        let (_folder, read) =
            with_normals(name, &picture(SIDE, SIDE, if is_turned { turned } else { bumps }));
        let expected = if is_turned { NormalY::Down } else { NormalY::Up };
        assert_eq!(chosen(&read, What::NormalY), expected.name(), "{name}: {:#?}", read.assumptions);
        assert_same(&read, EIGHT_BITS);
    }
}

#[test]
fn a_normal_map_of_x_and_y_gets_its_z() {
    for blue in [0.0, 1.0] {
        let image = picture(SIDE, SIDE, |x, y| [bumps(x, y)[0], bumps(x, y)[1], blue]);
        let (_folder, read) = with_normals("a_normal", &image);
        assert_eq!(chosen(&read, What::NormalEncoding), "xy", "{blue}: {:#?}", read.assumptions);
        assert_same(&read, 2.0 * EIGHT_BITS);
    }
}

#[test]
fn x_in_alpha_and_y_in_green_are_found() {
    let image = image::RgbaImage::from_fn(SIDE as u32, SIDE as u32, |x, y| {
        let [nx, ny, _] = bumps(x as usize, y as usize).map(|v| (255.0 * v).round() as u8);
        [255, ny, ny, nx].into()
    });
    let (_folder, read) = with_normals("a_normal", &image.into());
    assert_eq!(chosen(&read, What::NormalEncoding), "ag", "{:#?}", read.assumptions);
    assert_same(&read, 2.0 * EIGHT_BITS);
}

#[test]
fn normals_of_8_bits_that_are_no_unit_vectors_are_asked_about() {
    for (of, dark, is_doubted) in
        [(1.0, 0, false), (1.0, SIDE / 2, false), (0.6, 0, true), (0.6, SIDE / 2, true)]
    {
        let at = |x: usize, y: usize| bumps(x, y).map(|v| 0.5 + of * (v - 0.5));
        let image = picture(SIDE, SIDE, |x, y| if y < dark { [0.0; 3] } else { at(x, y) });
        let (_folder, read) = with_normals("a_normal", &image);
        assert_eq!(chosen(&read, What::NormalEncoding), "unsigned");
        let doubts = certainty(&read, What::NormalEncoding) == Some(Certainty::Unsure);
        assert_eq!(doubts, is_doubted, "{of}: {:#?}", read.assumptions);
    }
}
