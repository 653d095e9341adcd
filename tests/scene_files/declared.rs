//! Declarations of scene files beside their textures: extensions, vertex colours, conventions, colour spaces, computed inputs.

use super::extensions::{IMAGES, PLAIN, THREE, document, put};
use super::*;

/// The glTF of [`PLAIN`] with `more` in its material and `rest` in the file.
fn plain(more: &str, rest: &str) -> String {
    let material = PLAIN.replacen(r#""name": "wall""#, &format!(r#""name": "wall"{more}"#), 1);
    document(&IMAGES, THREE, &material, rest)
}

#[test]
fn an_unknown_extension_is_named_and_refused_where_it_is_required() {
    let folder = textures();
    let more = r#", "extensions": {"ACME_paint": {"index": 1}}"#;
    let read = open(&put(&folder, &plain(more, "")));
    assert_is_of_textures(&read, 1.0);
    assert!(says(&read, "ACME_paint"), "{:?}", read.notes);
    let refused = refusal(&put(&folder, &plain(more, r#", "extensionsRequired": ["ACME_paint"]"#)));
    assert!(refused.contains("ACME_paint") && refused.contains("wall"), "{refused}");
    // One that the material does not use is no reason to refuse it.
    let unused = plain("", r#", "extensionsRequired": ["ACME_paint"]"#);
    assert!(!says(&open(&put(&folder, &unused)), "ACME_paint"));
}

#[test]
fn a_procedural_texture_emission_and_occlusion_are_named() {
    let folder = textures();
    let more = r#", "emissiveFactor": [0, 0.5, 0], "occlusionTexture": {"index": 2}"#;
    let text = plain(more, "").replace(
        r#"{"index": 0}"#,
        r#"{"index": 0, "extensions": {"KHR_texture_procedurals": {"index": 0}}}"#,
    );
    let read = open(&put(&folder, &text));
    for part in ["a procedural texture", "emissiveFactor", "occlusionTexture"] {
        assert!(says(&read, part), "{part}: {:?}", read.notes);
    }
    let off = open(&put(&folder, &plain(r#", "emissiveFactor": [0, 0, 0]"#, "")));
    assert!(!says(&off, "emission"), "{:?}", off.notes);
}

#[test]
fn vertex_colours_are_named_unless_they_are_white() {
    let folder = textures();
    let says_so = |bytes: &[u8], kind: u32, bounds: &str, material: usize| {
        std::fs::write(folder.path().join("colours.bin"), bytes).unwrap();
        let rest = format!(
            r#", "meshes": [{{"primitives": [{{"attributes": {{"COLOR_0": 0}}, "material": {material}}}]}}],
            "accessors": [{{"componentType": {kind}, "type": "VEC4", "count": 2, "normalized": true,
            "bufferView": 0{bounds}}}], "bufferViews": [{{"buffer": 0, "byteLength": {length}}}],
            "buffers": [{{"byteLength": {length}, "uri": "colours.bin"}}]"#,
            length = bytes.len()
        );
        says(&open(&put(&folder, &plain("", &rest))), "vertex colours (COLOR_0)")
    };
    let floats = |values: [f32; 8]| values.map(f32::to_le_bytes).concat();
    let bounds = r#", "min": [1, 1, 1, 0], "max": [1, 1, 1, 1]"#;
    let table: [(&[u8], u32, &str, usize, bool); 8] = [
        (&[255; 8], 5121, "", 0, false),
        // Alpha is no colour.
        (&[255, 255, 255, 9, 255, 255, 255, 9], 5121, "", 0, false),
        (&[255, 255, 255, 255, 255, 254, 255, 255], 5121, "", 0, true),
        (&floats([1.0; 8]), 5126, "", 0, false),
        (&floats([1.0, 1.0, 1.0, 1.0, 0.5, 1.0, 1.0, 1.0]), 5126, "", 0, true),
        // Bounds tell where they are given, and another material's colours nothing.
        (&[], 5126, bounds, 0, false),
        (&[0; 8], 5121, "", 1, false),
        // Cut off: nothing shows that they are white.
        (&[255; 4], 5121, "", 0, true),
    ];
    for (bytes, kind, bounds, material, expected) in table {
        assert_eq!(says_so(bytes, kind, bounds, material), expected, "{bytes:?}");
    }
}

#[test]
fn the_convention_of_a_flight_simulator_is_y_down() {
    let folder = textures();
    let convention = r#"{"version": "2.0", "extensions": {"ASOBO_normal_map_convention":
        {"tangent_space_convention": "DirectX"}}}"#;
    let up = open(&put(&folder, &plain("", "")));
    let down = open(&put(&folder, &plain("", "").replace(r#"{"version": "2.0"}"#, convention)));
    let [a, b] = [&up, &down].map(|read| read.material.texel(77).normal.to_array());
    assert!((a[1] + b[1]).abs() < 1e-6 && a[1].abs() > 0.01, "{a:?}, {b:?}");
    assert!(says(&down, "ASOBO_normal_map_convention"), "{:#?}", down.assumptions);
}

#[test]
fn maps_of_another_shape_are_resampled_since_coordinates_relate_them() {
    let folder = textures();
    save(folder.path(), "n.png", &picture(2 * SIDE, SIDE, |_, _| [0.5, 0.5, 1.0]), ImageFormat::Png);
    let read = open(&put(&folder, &plain("", "")));
    assert_eq!(read.material.size(), [2 * SIDE, SIDE]);
    assert!(read.material.texel(77).diffuse.iter().zip(BASE).all(|(a, b)| (a - b).abs() < BOUND));
}

/// The texel of a surface of MaterialX with these inputs, in a document of `space` with these other nodes.
fn mtlx(space: &str, nodes: &str, surface: &str, inputs: &str) -> Result<Read<f64>, String> {
    let folder = textures();
    save(folder.path(), "gray.png", &picture(SIDE, SIDE, |_, _| [0.4; 3]), ImageFormat::Png);
    let path = folder.path().join("a.mtlx");
    let text = format!(
        r#"<materialx version="1.39" colorspace="{space}">
          <image name="base" type="color3"><input name="file" type="filename" value="base colour.png" colorspace="srgb_texture"/></image>
          <image name="n" type="vector3"><input name="file" type="filename" value="n.png"/></image>
          {nodes}<{surface} name="wall" type="surfaceshader">{inputs}</{surface}></materialx>"#
    );
    std::fs::write(&path, text).unwrap();
    read(&path, &ReadOptions::default(), &Progress::default()).map_err(|error| error.to_string())
}

#[test]
fn colours_of_other_primaries_are_brought_to_rec_709() {
    let inputs = r#"<input name="base_color" type="color3" value="0.2, 0.5, 0.3"/>"#;
    let diffuse = |space: &str| {
        let read =
            mtlx(space, "", "gltf_pbr", &(inputs.to_owned() + r#"<input name="metallic" value="0"/>"#))
                .unwrap();
        assert_eq!(read.unsure().count(), 0, "{:#?}", read.assumptions);
        read.material.texel(0).diffuse
    };
    // AP1: 1.70508 0.2 - 0.62423 0.5 - 0.08085 0.3 = 0.00464, and so on.
    assert_near(diffuse("acescg"), [0.004_64, 0.540_66, 0.277_49], 1e-4);
    assert_near(diffuse("lin_ap1"), [0.004_64, 0.540_66, 0.277_49], 1e-4);
    assert_near(diffuse("lin_displayp3"), [0.132_52, 0.512_62, 0.286_24], 1e-4);
    assert_near(diffuse("lin_rec709"), [0.2, 0.5, 0.3], 1e-6);
    // Pictures, too, and where a factor is computed.
    let nodes = r#"<image name="wide" type="color3"><input name="file" type="filename" value="base colour.png" colorspace="lin_ap1"/></image>"#;
    let inputs = r#"<input name="base_color" type="color3" nodename="wide"/><input name="base_weight" type="float" value="0.5"/>"#;
    let read = mtlx("lin_rec709", nodes, "open_pbr_surface", inputs).unwrap();
    let [r, g, b] = BASE.map(srgb);
    let red = 1.705_08 * r - 0.624_23 * g - 0.080_85 * b;
    assert!((read.material.texel(77).diffuse[0] - 0.5 * red).abs() < BOUND, "{:?}", read.material.texel(77));
}

#[test]
fn a_colour_space_does_not_concern_roughness() {
    let nodes =
        r#"<image name="rough" type="float"><input name="file" type="filename" value="gray.png"/></image>"#;
    let inputs = r#"<input name="specular_roughness" type="float" nodename="rough"/>
        <input name="base_weight" type="float" nodename="rough"/>"#;
    let texel = mtlx("adobergb", nodes, "open_pbr_surface", inputs).unwrap().material.texel(77);
    assert!((texel.roughness - 0.4).abs() < 1e-6, "{texel:?}");
    assert_near(texel.diffuse, [0.32; 3], 1e-5);
}

#[test]
fn colours_that_rec_709_does_not_have_are_clipped_and_a_space_that_is_not_known_is_doubted() {
    let inputs = r#"<input name="base_color" type="color3" value="0.1, 0.9, 0.1"/><input name="specular_ior" type="float" value="1.6"/>"#;
    let wide = mtlx("acescg", "", "open_pbr_surface", inputs).unwrap();
    assert_eq!(wide.material.texel(0).diffuse[0], 0.0);
    assert!(says(&wide, "some of the colours in acescg"), "{:?}", wide.notes);
    let unknown = mtlx("scanner", "", "open_pbr_surface", inputs).unwrap();
    // The computed path keeps the doubt.
    assert_eq!(certainty(&unknown, What::Albedo), Some(Certainty::Unsure));
}

#[test]
fn normals_of_object_space_are_refused() {
    let nodes = |space: &str| {
        format!(
            r#"<normalmap name="m" type="vector3"><input name="in" type="vector3" nodename="n"/>
            <input name="space" type="string" value="{space}"/></normalmap>"#
        )
    };
    let inputs = r#"<input name="normal" type="vector3" nodename="m"/>"#;
    let refused = mtlx("lin_rec709", &nodes("object"), "standard_surface", inputs).unwrap_err();
    assert!(refused.contains("object space") && refused.contains("normal"), "{refused}");
    assert!(mtlx("lin_rec709", &nodes("tangent"), "standard_surface", inputs).is_ok());
}

#[test]
fn transmission_takes_from_diffuse_and_subsurface_counts_as_diffuse() {
    let value = |name: &str, value: &str| format!(r#"<input name="{name}" value="{value}"/>"#);
    let diffuse = |surface: &str, inputs: &str| {
        mtlx("lin_rec709", "", surface, inputs).unwrap().material.texel(0).diffuse
    };
    assert_near(diffuse("standard_surface", &value("transmission", "0.75")), [0.2; 3], 1e-6);
    assert_near(diffuse("open_pbr_surface", &value("transmission_weight", "1")), [0.0; 3], 1e-6);
    let skin = value("subsurface", "0.25") + &value("subsurface_color", "1, 0.4, 0.2");
    assert_near(diffuse("standard_surface", &skin), [0.85, 0.7, 0.65], 1e-6);
    let both = skin + &value("transmission", "0.5") + &value("metalness", "0.5");
    assert_near(diffuse("standard_surface", &both), [0.2125, 0.175, 0.1625], 1e-6);
}

#[test]
fn affine_functions_of_one_picture_are_evaluated() {
    let node = |kind: &str, inputs: &str| format!(r#"<{kind} name="f" type="color3">{inputs}</{kind}>"#);
    let picture = |name: &str| format!(r#"<input name="{name}" type="color3" nodename="base"/>"#);
    let value = |name: &str, value: &str| format!(r#"<input name="{name}" type="color3" value="{value}"/>"#);
    let diffuse = |nodes: &str| {
        let inputs =
            r#"<input name="base_color" type="color3" nodename="f"/><input name="metallic" value="0"/>"#;
        mtlx("lin_rec709", nodes, "gltf_pbr", inputs).unwrap().material.texel(77).diffuse
    };
    for (kind, inputs, expected) in [
        ("multiply", picture("in1") + &value("in2", "0.5, 1, 0"), [0.25, 0.4, 0.0]),
        ("add", value("in1", "0.1, 0.2, 0.9") + &picture("in2"), [0.6, 0.6, 1.0]),
        ("subtract", picture("in1") + &value("in2", "0.1, 0.1, 0.1"), [0.4, 0.3, 0.2]),
        ("invert", picture("in"), [0.5, 0.6, 0.7]),
    ] {
        assert_near(diffuse(&node(kind, &inputs)), expected, BOUND);
    }
    let amount = r#"<input name="mix" type="float" value="0.25"/>"#;
    let mix = node("mix", &(picture("fg") + &value("bg", "1, 0, 0.2") + amount));
    assert_near(diffuse(&mix), [0.875, 0.1, 0.225], BOUND);
    // A mask between two constants.
    let mask =
        r#"<image name="orm" type="vector3"><input name="file" type="filename" value="orm.png"/></image>"#
            .to_owned()
            + r#"<extract name="mask" type="float"><input name="in" type="vector3" nodename="orm"/><input name="index" type="integer" value="0"/></extract>"#;
    let by_mask = value("fg", "1, 0, 0.5")
        + &value("bg", "0, 1, 0.5")
        + r#"<input name="mix" type="float" nodename="mask"/>"#;
    assert_near(diffuse(&(mask + &node("mix", &by_mask))), [0.9, 0.1, 0.5], BOUND);
}

#[test]
fn a_graph_of_many_paths_ends_soon() {
    let mut nodes =
        r#"<multiply name="m0" type="color3"><input name="in1" type="color3" value="1, 1, 1"/></multiply>"#
            .to_owned();
    for i in 1..60 {
        let before = format!(r#"type="color3" nodename="m{}"/>"#, i - 1);
        nodes += &format!(
            r#"<mix name="m{i}" type="color3"><input name="fg" {before}<input name="bg" {before}<input name="mix" {before}</mix>"#
        );
    }
    let inputs = r#"<input name="base_color" type="color3" nodename="m59"/>"#;
    assert!(mtlx("lin_rec709", &nodes, "gltf_pbr", inputs).is_err());
}

#[test]
fn an_mtl_of_constants_opens_as_one_texel() {
    let folder = textures();
    let path = folder.path().join("a.mtl");
    std::fs::write(&path, "newmtl wall\nKd 0.5 0.4 0.3\nPr 0.25\nPm 0\n").unwrap();
    let read = open(&path);
    assert_eq!(read.material.size(), [1, 1]);
    let texel = read.material.texel(0);
    assert_near(texel.diffuse, BASE, 1e-5);
    assert!((texel.roughness - 0.25).abs() < 1e-6, "{texel:?}");
}
