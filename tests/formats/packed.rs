//! Packed images.

use super::*;

#[test]
fn every_packed_layout_is_found_by_its_normal_tile() {
    type Encode = fn(char, f64) -> f64;
    let table: [(&str, usize, Encode, &str); 10] = [
        ("NDRS", 4, linear, "ndrs in 4 x 1"),
        ("NDRS", 1, linear, "ndrs in 1 x 4"),
        ("INDRS", 5, linear, "ndrs in 5 x 1"),
        ("IIINDRS", 7, linear, "ndrs in 7 x 1"),
        ("DNRS", 4, |_, v| gamma(v), "dnrs in 4 x 1"),
        ("DSRN", 4, colours, "dsrn in 4 x 1"),
        ("NDSR", 2, |_, v| gamma(v), "ndsr in 2 x 2"),
        ("DSRN", 2, colours, "dsrn in 2 x 2"),
        ("NDRSNDRS", 4, linear, "ndrs in 4 x 2"),
        ("INDRSINDRS", 5, linear, "ndrs in 5 x 2"),
    ];
    let folder = tempdir().unwrap();
    for (order, columns, encode, layout) in table {
        let path = save(folder.path(), "some.png", &packed(order, columns, encode), ImageFormat::Png);
        let read = open(&path);
        assert!(chosen(&read, What::Layout).starts_with(layout), "{order}: {:?}", read.assumptions);
        assert_same(&read, if layout.starts_with("ndrs") { EIGHT_BITS } else { 2.5 * EIGHT_BITS });
    }
}

#[test]
fn a_strip_of_three_has_the_specular_of_dielectrics() {
    let folder = tempdir().unwrap();
    let path = save(folder.path(), "tex.png", &packed("DNR", 3, |_, v| gamma(v)), ImageFormat::Png);
    let read = open(&path);
    assert!(chosen(&read, What::Layout).starts_with("dnr in 3 x 1"));
    assert_eq!(read.material.texel(7).specular, [0.04; 3]);
    assert_eq!(chosen(&read, What::Missing), "specular 0.04");
}

#[test]
fn of_several_exemplars_one_is_chosen() {
    let folder = tempdir().unwrap();
    let mut image = packed("NDRSNDRS", 4, linear).into_rgb8();
    for y in SIDE as u32..2 * SIDE as u32 {
        for x in SIDE as u32..2 * SIDE as u32 {
            image.put_pixel(x, y, [51, 51, 51].into());
        }
    }
    let path = save(folder.path(), "two.png", &image.into(), ImageFormat::Png);
    let second = open_as(&path, &ReadOptions { exemplar: Some(1), ..ReadOptions::default() });
    assert_same(&open(&path), EIGHT_BITS);
    assert!((second.material.texel(5).diffuse[0] - 0.2).abs() < 1e-12);
    assert_notes(&second, &["holds 2 materials"]);
    let third = ReadOptions { exemplar: Some(2), ..ReadOptions::default() };
    let refused = read::<f64>(&path, &third, &Progress::default()).unwrap_err().to_string();
    assert!(refused.contains("an exemplar from 0 to 1"), "{refused}");
}

#[test]
fn a_strip_without_normals_is_of_base_colour_by_its_name_only() {
    let folder = tempdir().unwrap();
    // Photo, base colour, roughness, metallic.
    let image = picture(4 * SIDE, SIDE, |x, y| match x / SIDE {
        0 => [0.9, 0.1, 0.3],
        1 => [0.5, 0.4, 0.3].map(srgb),
        2 => texel(2, x % SIDE, y),
        _ => [0.0; 3],
    });
    let named = save(folder.path(), "wood_svbrdf.png", &image, ImageFormat::Png);
    let read = open(&named);
    assert!(chosen(&read, What::Layout).starts_with("ibrm in 4 x 1"), "{:#?}", read.assumptions);
    assert_eq!(certainty(&read, What::Layout), Some(Certainty::Unsure));
    let got = read.material.texel(77);
    assert_near([got.diffuse[0], got.roughness], [0.5, texel(2, 77 % SIDE, 77 / SIDE)[0]]);
    assert_eq!(got.specular, [0.04; 3]);
    let other = open(&save(folder.path(), "wood.png", &image, ImageFormat::Png));
    assert!(chosen(&other, What::Layout).starts_with("ndrs in 4 x 1"), "{:#?}", other.assumptions);
    assert_eq!(certainty(&other, What::Layout), Some(Certainty::Unsure));
}

#[test]
fn a_wide_map_of_normals_is_no_strip() {
    let folder = tempdir().unwrap();
    assert_refused(&put_strip(folder.path(), "wide", "NNNN"), &["found 64 x 16 pixels"]);
}

#[test]
fn a_folder_of_one_packed_picture_is_its_material_and_of_several_it_lists_them() {
    let folder = tempdir().unwrap();
    put_strip(folder.path(), "brick", "NDRS");
    let read = open(folder.path());
    assert_same(&read, EIGHT_BITS);
    assert_eq!(read.material.name(), "brick");
    put_strip(folder.path(), "wood", "NDRS");
    assert_refused(folder.path(), &["name no map: brick.png, wood.png; open one of them"]);
}

#[test]
fn one_picture_of_normals_with_flat_and_steep_parts_is_no_stack_of_strips() {
    let folder = tempdir().unwrap();
    // Of 4 x 4 parts those on the diagonal are unit vectors: in row 0 the first looks like the normals of a strip.
    let image = picture(4 * SIDE, 4 * SIDE, |x, y| {
        let unit = stored(0, x % SIDE, y % SIDE, |v| v);
        if x / SIDE == y / SIDE { unit } else { unit.map(|v| 0.5 + 0.7 * (v - 0.5)) }
    });
    assert_refused(&save(folder.path(), "photo.png", &image, ImageFormat::Png), &["found 64 x 64 pixels"]);
    // With the normals of every row in one column it is one.
    let read = open(&put_strip(folder.path(), "stack", "NDRSNDRSNDRSNDRS"));
    assert!(chosen(&read, What::Layout).starts_with("ndrs in 4 x 4"), "{:?}", read.assumptions);
}

#[test]
fn a_picture_alone_whose_name_names_no_map_is_refused_with_what_is_missing() {
    let folder = tempdir().unwrap();
    save(folder.path(), "rock.jpg", &picture(24, 16, |_, _| [0.5, 0.4, 0.3]), ImageFormat::Jpeg);
    std::fs::write(folder.path().join("rock.jpg.import"), "[remap]\n").unwrap();
    std::fs::write(folder.path().join("rock.tres"), "[gd_resource type=\"StandardMaterial3D\"]\n").unwrap();
    assert_refused(
        folder.path(),
        &["rock.jpg, whose name names no map", "roughness", "basecolor", "rock.tres"],
    );
    assert!(!refusal(folder.path()).contains(".import"));
    assert_refused(&folder.path().join("rock.tres"), &["a resource of Godot"]);
}
