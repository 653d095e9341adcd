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

/// A surface with these pictures, which the document names as an exporter does: with tiles, and green turned around by nodes.
fn tiled(tile: &str, more: &str) -> String {
    format!(
        r#"<materialx version="1.39" colorspace="lin_rec709">
          <image name="base" type="color3"><input name="file" type="filename" colorspace="srgb_tx" value="base.{tile}.png"/></image>
          <image name="n" type="vector3"><input name="file" type="filename" value="turned.png"/></image>
          <extract name="r" type="float"><input name="in" nodename="n"/><input name="index" value="0"/></extract>
          <extract name="g" type="float"><input name="in" nodename="n"/><input name="index" value="1"/></extract>
          <extract name="b" type="float"><input name="in" nodename="n"/><input name="index" value="2"/></extract>
          <invert name="i" type="float"><input name="in" nodename="g"/></invert>
          <combine3 name="c" type="vector3"><input name="in1" nodename="r"/><input name="in2" nodename="i"/><input name="in3" nodename="b"/></combine3>
          <normalmap name="nm" type="vector3"><input name="in" nodename="c"/></normalmap>
          <image name="orm" type="vector3"><input name="file" type="filename" value="orm.png"/></image>
          <extract name="rough" type="float"><input name="in" nodename="orm"/><input name="index" value="1"/></extract>{more}
          <open_pbr_surface name="wall" type="surfaceshader"><input name="base_color" nodename="base"/>
            <input name="specular_roughness" nodename="rough"/><input name="geometry_normal" nodename="nm"/></open_pbr_surface>
        </materialx>"#
    )
}

#[test]
fn the_only_tile_of_a_picture_and_normals_whose_green_is_turned_by_nodes_open() {
    for (tile, file) in
        [("<UDIM>", "base.1001.png"), ("<UVTILE>", "base.u1_v1.png"), ("&lt;UDIM&gt;", "base.1012.png")]
    {
        let folder = textures();
        let turned = picture(SIDE, SIDE, |x, y| {
            let [r, g, b] = stored(0, x, y, |v| v);
            [r, 1.0 - g, b]
        });
        save(folder.path(), "turned.png", &turned, ImageFormat::Png);
        std::fs::copy(folder.path().join("base colour.png"), folder.path().join(file)).unwrap();
        let path = folder.path().join("a.mtlx");
        std::fs::write(&path, tiled(tile, "")).unwrap();
        assert_is_of_textures(&open(&path), 1.0);
        std::fs::copy(folder.path().join(file), folder.path().join("base.1002.png")).unwrap();
        std::fs::copy(folder.path().join(file), folder.path().join("base.u2_v1.png")).unwrap();
        let refused = refusal(&path);
        assert!(refused.contains("one tile of base.") && refused.contains(file), "{refused}");
    }
}

#[test]
fn a_picture_of_another_token_is_missing_by_its_name() {
    let folder = textures();
    let path = folder.path().join("a.mtlx");
    save(folder.path(), "turned.png", &picture(SIDE, SIDE, |_, _| [0.5, 0.5, 1.0]), ImageFormat::Png);
    std::fs::write(&path, tiled("<frame>", "")).unwrap();
    let refused = refusal(&path);
    assert!(refused.contains("base.<frame>.png") && !refused.contains("XML"), "{refused}");
}

#[test]
fn channels_of_two_pictures_are_no_normals() {
    let folder = textures();
    let path = folder.path().join("a.mtlx");
    let text = tiled("1001", "")
        .replace(r#"<input name="in1" nodename="r"/>"#, r#"<input name="in1" nodename="rough"/>"#);
    std::fs::write(&path, text).unwrap();
    std::fs::copy(folder.path().join("base colour.png"), folder.path().join("base.1001.png")).unwrap();
    save(folder.path(), "turned.png", &picture(SIDE, SIDE, |_, _| [0.5, 0.5, 1.0]), ImageFormat::Png);
    let refused = refusal(&path);
    assert!(refused.contains("c (combine3)"), "{refused}");
}

#[test]
fn a_colour_without_a_colour_space_is_not_converted_and_asked_about() {
    let folder = textures();
    let path = folder.path().join("a.mtlx");
    let text = |space: &str| {
        document(
            "gltf_pbr",
            r#"<input name="base_color" nodename="base"/><input name="metallic" value="0"/>"#,
        )
        .replace(r#" colorspace="lin_rec709""#, "")
        .replace(r#" colorspace="srgb_texture""#, space)
    };
    std::fs::write(&path, text("")).unwrap();
    let read = open(&path);
    assert_near(read.material.texel(3).diffuse, BASE.map(srgb), BOUND);
    assert_eq!(certainty(&read, What::Albedo), Some(Certainty::Unsure), "{:#?}", read.assumptions);
    std::fs::write(&path, text(r#" colorspace="srgb_tx""#)).unwrap();
    assert_near(open(&path).material.texel(3).diffuse, BASE, BOUND);
}
