//! EXR as renderers and compositing programs write it: passes, channels, windows, primaries and alpha.

use exr::meta::attribute::Chromaticities;
use exr::prelude::{AnyChannel, FlatSamples, ImageAttributes, IntegerBounds, Vec2};

use super::*;
use crate::support::pictures::{channel, exr, exr_of, plane};

/// The channels of map number `map` under these names.
fn named(map: usize, names: &[&str]) -> Vec<AnyChannel<FlatSamples>> {
    names.iter().enumerate().map(|(c, name)| channel(name, FlatSamples::F32(plane(map, c)))).collect()
}

/// A material of these layers and their channels, of another layer number 4.
fn layers(path: &Path, names: &[(&str, usize, &[&str])]) {
    let all = names.iter().flat_map(|(layer, map, channels)| {
        let names: Vec<_> = channels.iter().map(|channel| format!("{layer}.{channel}")).collect();
        named(*map, &names.iter().map(String::as_str).collect::<Vec<_>>())
    });
    exr(path, vec![(None, all.collect())]);
}

#[test]
fn passes_of_renderers_are_the_maps_that_they_hold() {
    let (rgb, xyz, x): (&[&str], &[&str], &[&str]) = (&["R", "G", "B"], &["X", "Y", "Z"], &["X"]);
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.exr");
    for [diffuse, specular, normal, roughness, light, depth] in [
        ["DiffCol", "GlossCol", "Normal", "Roughness", "DiffDir", "Depth"]
            .map(|name| format!("ViewLayer.{name}")),
        ["Diffuse Color", "Glossy Color", "Normal", "Roughness", "Glossy Indirect", "Combined"]
            .map(|name| format!("View Layer.{name}")),
        ["diffuse_albedo", "specular_albedo", "N", "roughness", "diffuse_direct", "Z"].map(str::to_owned),
    ] {
        layers(
            &path,
            &[
                (&diffuse, 1, rgb),
                (&specular, 3, rgb),
                (&normal, 0, xyz),
                (&roughness, 2, x),
                (&light, 2, rgb),
                (&depth, 2, x),
            ],
        );
        assert_same(&open(&path), HALF);
    }
}

#[test]
fn of_a_layer_of_rgb_and_xyz_the_normals_are_xyz_and_others_are_said() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.exr");
    let (rgb, xyz): (&[&str], &[&str]) = (&["R", "G", "B"], &["X", "Y", "Z"]);
    layers(
        &path,
        &[
            ("normal", 0, xyz),
            ("normal", 2, rgb),
            ("diffuse", 1, rgb),
            ("diffuse", 2, &["Z"]),
            ("specular", 3, rgb),
            ("roughness", 2, &["Y"]),
        ],
    );
    let read = open(&path);
    assert_same(&read, HALF);
    assert_notes(
        &read,
        &["Channel R, G, B of layer normal is not used", "Channel Z of layer diffuse is not used"],
    );
}

#[test]
fn a_colour_of_two_channels_is_refused() {
    let folder = tempdir().unwrap();
    put_exrs(folder.path(), |_, _, v| v);
    let path = folder.path().join("diffuse.exr");
    exr(&path, vec![(None, named(1, &["R", "G"]))]);
    assert_refused(folder.path(), &["diffuse.exr", "one of two channels"]);
}

#[test]
fn a_second_layer_beside_the_rgb_of_a_map_is_not_used_and_said() {
    let folder = tempdir().unwrap();
    put_exrs(folder.path(), |_, _, v| v);
    let more = named(2, &["mask.R", "mask.G", "mask.B"]);
    exr(
        &folder.path().join("diffuse.exr"),
        vec![(None, named(1, &["R", "G", "B"]).into_iter().chain(more).collect())],
    );
    let read = open(folder.path());
    assert_same(&read, HALF);
    assert_notes(&read, &["Layer mask is not used"]);
}

#[test]
fn a_display_window_that_no_other_map_has_does_not_crop() {
    let folder = tempdir().unwrap();
    put_exrs(folder.path(), |_, _, v| v);
    let window = IntegerBounds::new((2, 2), (SIDE - 4, SIDE - 4));
    let cropped = |names: &[&str]| {
        for name in names {
            let map = NAMES.iter().position(|one| one.starts_with(name)).unwrap();
            let names: &[&str] = if map == 2 { &["Y"] } else { &["R", "G", "B"] };
            let attributes = ImageAttributes::new(window);
            exr_of(&folder.path().join(format!("{name}.exr")), attributes, vec![(None, named(map, names))]);
        }
    };
    cropped(&["diffuse"]);
    let read = open(folder.path());
    assert_same(&read, HALF);
    assert_notes(&read, &["data window beside its display window; the data is used as it is"]);
    cropped(&["normal", "roughness", "specular"]);
    assert_eq!(open(folder.path()).material.size(), [SIDE - 4; 2]);
}

/// A set whose diffuse map has these chromaticities.
fn put_diffuse_of(folder: &Path, [red, green, blue, white]: [[f32; 2]; 4]) {
    let of = |[x, y]: [f32; 2]| Vec2(x, y);
    let mut attributes = ImageAttributes::new(IntegerBounds::from_dimensions((SIDE, SIDE)));
    attributes.chromaticities =
        Some(Chromaticities { red: of(red), green: of(green), blue: of(blue), white: of(white) });
    exr_of(&folder.join("diffuse.exr"), attributes, vec![(None, named(1, &["R", "G", "B"]))]);
}

#[test]
fn colours_of_other_primaries_are_converted_and_white_stays_white() {
    let folder = tempdir().unwrap();
    put_exrs(folder.path(), |_, _, v| v);
    let plain = open(folder.path());
    put_diffuse_of(folder.path(), [[0.713, 0.293], [0.165, 0.83], [0.128, 0.044], [0.32168, 0.33767]]);
    let read = open(folder.path());
    // ACEScg to linear sRGB by Bradford, as public shaders have it.
    let matrix =
        [[1.70505, -0.62179, -0.08326], [-0.13026, 1.14080, -0.01055], [-0.02400, -0.12897, 1.15297]];
    for index in 0..SIDE * SIDE {
        let (stored, found) = (plain.material.texel(index).diffuse, read.material.texel(index));
        let row = |row: [f64; 3]| row.iter().zip(stored).map(|(a, b)| a * b).sum::<f64>().clamp(0.0, 1.0);
        for (found, expected) in found.diffuse.into_iter().zip(matrix.map(row)) {
            assert!((found - expected).abs() < 3e-4, "{found}, not {expected}");
        }
        assert_eq!(found.specular, plain.material.texel(index).specular);
    }
    assert!(read.unsure().all(|a| a.what != What::Albedo), "{:#?}", read.assumptions);
    assert_notes(&read, &["The diffuse map is converted from the primaries that its file declares"]);
    put_diffuse_of(folder.path(), [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.3127, 0.329]]);
    assert_eq!(open(folder.path()).material.texel(3).diffuse, plain.material.texel(3).diffuse);
}

#[test]
fn primaries_that_enclose_no_white_and_colours_with_alpha_are_asked_about() {
    let folder = tempdir().unwrap();
    put_exrs(folder.path(), |_, _, v| v);
    assert!(!open(folder.path()).unsure().any(|a| a.what == What::Albedo), "floats are linear");
    put_diffuse_of(folder.path(), [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3], [0.3127, 0.329]]);
    let read = open(folder.path());
    assert!(
        read.unsure().any(|a| a.what == What::Albedo && a.to_string().contains("primaries")),
        "{:#?}",
        read.assumptions
    );
    let alpha = channel("A", FlatSamples::F32((0..SIDE * SIDE).map(|i| (i % 2) as f32).collect()));
    let colours = named(1, &["R", "G", "B"]).into_iter().chain([alpha]);
    exr(&folder.path().join("diffuse.exr"), vec![(None, colours.collect())]);
    let read = open(folder.path());
    assert!(
        read.unsure().any(|a| a.what == What::Values && a.to_string().contains("alpha")),
        "{:#?}",
        read.assumptions
    );
}
