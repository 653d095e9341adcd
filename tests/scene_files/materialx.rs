//! MaterialX surfaces: values by their specifications, factors, procedural inputs, what is not modelled.

use svbrdf_core::model::brdf::Texel;

use super::*;

fn document(surface: &str, inputs: &str) -> String {
    format!(
        r#"<materialx version="1.39" colorspace="lin_rec709">
          <noise2d name="noise" type="color3"/>
          <multiply name="product" type="color3"><input name="in1" nodename="base"/><input name="in2" nodename="base"/></multiply>
          <image name="base" type="color3" colorspace="srgb_texture"><input name="file" value="base colour.png"/></image>
          <{surface} name="wall" type="surfaceshader">{inputs}</{surface}>
        </materialx>"#
    )
}

fn value(name: &str, value: &str) -> String {
    format!(r#"<input name="{name}" value="{value}"/>"#)
}

fn read_of(surface: &str, inputs: &str) -> Result<Read<f64>, String> {
    let folder = textures();
    let path = folder.path().join("a.mtlx");
    std::fs::write(&path, document(surface, inputs)).unwrap();
    read(&path, &ReadOptions::default(), &Progress::default()).map_err(|error| error.to_string())
}

fn texel_of(surface: &str, inputs: &str) -> Texel<f64> {
    read_of(surface, inputs).unwrap().material.texel(0)
}

#[track_caller]
fn assert_is(texel: Texel<f64>, diffuse: [f64; 3], specular: [f64; 3], roughness: f64) {
    assert_near(texel.diffuse, diffuse, 1e-5);
    assert_near(texel.specular, specular, 1e-5);
    assert!((texel.roughness - roughness).abs() < 1e-5, "{texel:?}");
}

#[test]
fn what_a_surface_does_not_say_has_the_value_of_its_specification() {
    assert_is(texel_of("standard_surface", ""), [0.8; 3], [0.04; 3], 0.2);
    assert_is(texel_of("gltf_pbr", ""), [0.0; 3], [1.0; 3], 1.0);
    assert_is(texel_of("open_pbr_surface", ""), [0.8; 3], [0.04; 3], 0.3);
    assert_is(texel_of("UsdPreviewSurface", ""), [0.18; 3], [0.04; 3], 0.5);
}

#[test]
fn specular_its_colour_and_index_of_refraction_count() {
    let inputs = value("specular", "0.4") + &value("specular_color", "1, 0.5, 0");
    assert_is(texel_of("standard_surface", &inputs), [0.8; 3], [0.016, 0.008, 0.0], 0.2);
    assert_is(texel_of("standard_surface", &value("specular_IOR", "2")), [0.8; 3], [1.0 / 9.0; 3], 0.2);
    assert_is(texel_of("open_pbr_surface", &value("specular_weight", "0.5")), [0.8; 3], [0.02; 3], 0.3);
    assert_is(texel_of("open_pbr_surface", &value("base_weight", "0.5")), [0.4; 3], [0.04; 3], 0.3);
    let inputs = value("useSpecularWorkflow", "1") + &value("specularColor", "0.1, 0.2, 0.3");
    assert_is(texel_of("UsdPreviewSurface", &inputs), [0.18; 3], [0.1, 0.2, 0.3], 0.5);
}

#[test]
fn a_picture_counts_beside_specular() {
    let inputs = r#"<input name="base_color" nodename="base"/>"#.to_owned() + &value("specular", "0.5");
    let read = read_of("standard_surface", &inputs).unwrap();
    let texel = read.material.texel(77);
    assert_near(texel.diffuse, BASE, BOUND);
    assert_near(texel.specular, [0.02; 3], 1e-6);
}

#[test]
fn a_procedural_input_is_refused_and_not_replaced() {
    for (node, kind) in [("noise", "noise2d"), ("product", "multiply")] {
        let input = format!(r#"<input name="base_color" nodename="{node}"/>"#);
        let refused = read_of("standard_surface", &input).unwrap_err();
        assert!(refused.contains(kind) && refused.contains("base_color"), "{refused}");
    }
}

#[test]
fn what_is_not_modelled_is_named_where_it_is_on() {
    for (coat, is_said) in [("0.1", true), ("0", false)] {
        assert_eq!(says(&read_of("standard_surface", &value("coat", coat)).unwrap(), "coat"), is_said);
    }
}
