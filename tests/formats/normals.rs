//! Normal maps.

use super::*;

#[test]
fn y_of_normals_is_told_by_names_and_by_curl() {
    for (name, turned) in [("a_NormalGL", false), ("a_nor_dx", true), ("a_normal", false), ("a_normal", true)]
    {
        let folder = tempdir().unwrap();
        folder_of(["x.png", "a_diffuse.png", "a_roughness.png", "a_specular.png"], folder.path(), |_, v| v);
        let image = picture(SIDE, SIDE, |x, y| {
            let [r, g, b] = stored(0, x, y, |v| v);
            [r, if turned { 1.0 - g } else { g }, b]
        });
        save(folder.path(), &format!("{name}.png"), &image, ImageFormat::Png);
        let read = open(folder.path());
        let expected = if turned { NormalY::Down } else { NormalY::Up };
        assert_eq!(chosen(&read, What::NormalY), expected.name(), "{name}: {:#?}", read.assumptions);
        assert_same(&read, EIGHT_BITS);
    }
}

#[test]
fn a_normal_map_of_x_and_y_gets_its_z() {
    for blue in [0.0, 1.0] {
        let folder = tempdir().unwrap();
        folder_of(["x.png", "a_diffuse.png", "a_roughness.png", "a_specular.png"], folder.path(), |_, v| v);
        let image = picture(SIDE, SIDE, |x, y| {
            let [r, g, _] = stored(0, x, y, |v| v);
            [r, g, blue]
        });
        save(folder.path(), "a_normal.png", &image, ImageFormat::Png);
        let read = open(folder.path());
        assert_eq!(chosen(&read, What::NormalEncoding), "xy", "{blue}: {:#?}", read.assumptions);
        assert_same(&read, 2.0 * EIGHT_BITS);
    }
}

#[test]
fn x_in_alpha_and_y_in_green_are_found() {
    let folder = tempdir().unwrap();
    folder_of(["x.png", "a_diffuse.png", "a_roughness.png", "a_specular.png"], folder.path(), |_, v| v);
    let image = image::RgbaImage::from_fn(SIDE as u32, SIDE as u32, |x, y| {
        let [nx, ny, _] = stored(0, x as usize, y as usize, |v| v).map(|v| (255.0 * v).round() as u8);
        [255, ny, ny, nx].into()
    });
    save(folder.path(), "a_normal.png", &image.into(), ImageFormat::Png);
    let read = open(folder.path());
    assert_eq!(chosen(&read, What::NormalEncoding), "ag", "{:#?}", read.assumptions);
    assert_same(&read, 2.0 * EIGHT_BITS);
}
