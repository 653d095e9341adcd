//! Binary glTF that is written, by the specification and without the reader.

use std::fs;

use serde_json::Value;
use svbrdf_files::write::SurfaceForm;

use super::surfaces::written;
use super::*;
use crate::support::surfaces::{metallic, specular};

/// The document and the binary part of a glb.
fn parts(path: &Path) -> (Value, Vec<u8>) {
    let bytes = fs::read(path).unwrap();
    let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&bytes[..4], number(4), number(8)), (&b"glTF"[..], 2, bytes.len()));
    let json = &bytes[20..20 + number(12)];
    (serde_json::from_slice(json).unwrap(), bytes[20 + number(12) + 8..].to_vec())
}

fn index(value: &Value) -> usize {
    value.as_u64().unwrap() as usize
}

/// The bytes of a view of the buffer.
fn view<'a>(document: &Value, binary: &'a [u8], number: &Value) -> &'a [u8] {
    let view = &document["bufferViews"][index(number)];
    &binary[index(&view["byteOffset"])..][..index(&view["byteLength"])]
}

/// The pixels of the texture that the material has at this place.
fn texture(document: &Value, binary: &[u8], place: &str) -> image::RgbImage {
    let texture = index(&document["materials"][0].pointer(place).unwrap()["index"]);
    let image = &document["images"][index(&document["textures"][texture]["source"])];
    image::load_from_memory(view(document, binary, &image["bufferView"])).unwrap().into_rgb8()
}

/// sRGB colours, y up, roughness in green, metallic in blue, row 0 on top.
#[test]
fn a_glb_has_what_the_specification_says() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.glb");
    let original = specular([23, 9], 0.3);
    let (surface, _) = written(&original, &path, None);
    let (document, binary) = parts(&path);
    let SurfaceForm::Specular { ior } = surface.form else { panic!("{surface}") };
    assert_eq!(
        document["extensionsUsed"],
        serde_json::json!(["KHR_materials_specular", "KHR_materials_ior"])
    );
    assert_eq!(document["materials"][0]["extensions"]["KHR_materials_ior"]["ior"], ior);
    let reflectance = ((ior - 1.0) / (ior + 1.0)).powi(2);
    assert!((0.3..0.301).contains(&reflectance), "{reflectance}");
    let [base, rough, normal, colour] = [
        "/pbrMetallicRoughness/baseColorTexture",
        "/pbrMetallicRoughness/metallicRoughnessTexture",
        "/normalTexture",
        "/extensions/KHR_materials_specular/specularColorTexture",
    ]
    .map(|place| texture(&document, &binary, place));
    for (x, y) in [(0, 0), (22, 0), (3, 8), (11, 4)] {
        let texel = original.texel(y as usize * 23 + x as usize);
        let code = |value: f64| (255.0 * value).round() as i16;
        let near = |image: &image::RgbImage, channel: usize, value: f64| {
            let got = i16::from(image.get_pixel(x, y).0[channel]);
            assert!((got - code(value)).abs() <= 1, "{x}, {y}, {channel}: {got}, not {}", code(value));
        };
        for c in 0..3 {
            near(&base, c, srgb(texel.diffuse[c].into()));
            near(&normal, c, 0.5 * f64::from(texel.normal.to_array()[c]) + 0.5);
            near(&colour, c, srgb(f64::from(texel.specular[c]) / reflectance));
        }
        near(&rough, 1, texel.roughness.into());
    }
    assert_eq!(document["materials"][0]["pbrMetallicRoughness"]["metallicFactor"], 0.0);
    written(&metallic(), &path, None);
    let (document, binary) = parts(&path);
    assert!(document.get("extensionsUsed").is_none());
    let packed = texture(&document, &binary, "/pbrMetallicRoughness/metallicRoughnessTexture");
    let column = |x: u32| packed.get_pixel(x, 5).0;
    assert_eq!([column(3)[2], column(4)[2], column(8)[2], column(9)[2]], [0, 255, 255, 0]);
    assert_eq!(column(3)[1], (255.0 * texel(2, 3, 5)[0]).round() as u8);
}

#[test]
fn a_glb_has_a_plane_of_the_size_of_the_material_that_faces_the_viewer() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.glb");
    let original = specular([23, 9], 0.3);
    written(&original, &path, None);
    let (document, binary) = parts(&path);
    let primitive = &document["meshes"][0]["primitives"][0];
    let bytes = |accessor: &Value| {
        let accessor = &document["accessors"][index(accessor)];
        view(&document, &binary, &accessor["bufferView"])
    };
    let floats = |name: &str, width: usize| -> Vec<Vec<f32>> {
        let chunks = bytes(&primitive["attributes"][name]).chunks(4);
        let numbers: Vec<f32> = chunks.map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
        numbers.chunks(width).map(<[f32]>::to_vec).collect()
    };
    let half = original.grid().half_extent();
    for (position, coordinate) in floats("POSITION", 3).iter().zip(floats("TEXCOORD_0", 2)) {
        // (0, 0) is the upper left corner of the pictures, x to the right and y up.
        let expected = [half[0] * (2.0 * coordinate[0] - 1.0), half[1] * (1.0 - 2.0 * coordinate[1]), 0.0];
        assert_eq!(*position, expected);
    }
    assert!(floats("NORMAL", 3).iter().all(|normal| *normal == [0.0, 0.0, 1.0]));
    assert!(floats("TANGENT", 4).iter().all(|tangent| *tangent == [1.0, 0.0, 0.0, 1.0]));
    // Counterclockwise, seen from +z: each triangle has a positive area.
    let indices =
        bytes(&primitive["indices"]).chunks(2).map(|b| u16::from_le_bytes(b.try_into().unwrap()).into());
    let indices: Vec<usize> = indices.take(6).collect();
    let positions = floats("POSITION", 3);
    for triangle in indices.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|corner| &positions[triangle[corner]]);
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        assert!((area - 4.0 * half[0] * half[1]).abs() < 1e-5, "{area}");
    }
}
