//! Materials of files that name their textures: glTF, MTL and MaterialX.

mod declared;
mod extensions;
mod materialx;
pub mod mtl;
mod pictures;

use std::path::Path;

use image::ImageFormat;
use tempfile::{TempDir, tempdir};

use svbrdf_core::progress::Progress;
use svbrdf_files::read::{Certainty, Read, ReadOptions, What, read};

use crate::support::pictures::{SIDE, picture, srgb, stored, texel, write as save};

/// Half a code of 8 bits, decoded.
const BOUND: f64 = 0.006;
const BASE: [f64; 3] = [0.5, 0.4, 0.3];
const NAMES: [&str; 3] = ["base colour.png", "n.png", "orm.png"];

/// A folder with base colour, normals, and occlusion | roughness | metallic.
pub fn textures() -> TempDir {
    let folder = tempdir().unwrap();
    let put = |name: &str, image| save(folder.path(), name, &image, ImageFormat::Png);
    put(NAMES[0], picture(SIDE, SIDE, |_, _| BASE.map(srgb)));
    put(NAMES[1], picture(SIDE, SIDE, |x, y| stored(0, x, y, |v| v)));
    put(NAMES[2], picture(SIDE, SIDE, |x, y| [0.9, texel(2, x, y)[0], 0.0]));
    folder
}

fn open(path: &Path) -> Read<f64> {
    read(path, &ReadOptions::default(), &Progress::default()).unwrap()
}

fn certainty(read: &Read<f64>, what: What) -> Option<Certainty> {
    read.assumptions.iter().find(|a| a.what == what).map(|a| a.certainty)
}

fn refusal(path: &Path) -> String {
    read::<f64>(path, &ReadOptions::default(), &Progress::default()).unwrap_err().to_string()
}

fn says(read: &Read<f64>, part: &str) -> bool {
    read.messages().any(|line| line.contains(part))
}

#[track_caller]
fn assert_near(got: [f64; 3], expected: [f64; 3], within: f64) {
    assert!(got.iter().zip(expected).all(|(a, b)| (a - b).abs() < within), "{got:?}, not {expected:?}");
}

/// Checks the material against [`textures`] with its base colour and roughness times a factor.
#[track_caller]
fn assert_is_of_textures(read: &Read<f64>, factor: f64) {
    assert_eq!(read.material.name(), "wall");
    for index in [0, 77, 200] {
        let got = read.material.texel(index);
        let [normal, roughness] = [0, 2].map(|map| texel(map, index % SIDE, index / SIDE));
        assert!((got.roughness - factor * roughness[0]).abs() < BOUND, "{got:?}");
        assert_near(got.diffuse, BASE.map(|b| factor * b), BOUND);
        assert_near(got.specular, [0.04; 3], BOUND);
        assert_near(got.normal.to_array(), normal, BOUND);
    }
}

/// A glTF of one material; the images are said by `images`, the factors by `factors`, and what else there is by `more`.
fn gltf(images: &[String; 3], factors: &str, more: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "images": [{}],
        "textures": [{{"source": 0}}, {{"source": 1}}, {{"source": 2}}],
        "materials": [{{"name": "wall", "normalTexture": {{"index": 1}}, "pbrMetallicRoughness": {{
            {factors} "baseColorTexture": {{"index": 0}}, "metallicRoughnessTexture": {{"index": 2}}}}}}]{more}}}"#,
        images.join(", ")
    )
}

#[test]
fn gltf_with_files_beside_it_opens() {
    let folder = textures();
    let path = folder.path().join("a.gltf");
    let images = ["base%20colour.png", "n.png", "orm.png"].map(|uri| format!(r#"{{"uri": "{uri}"}}"#));
    let factors = r#""roughnessFactor": 0.5, "baseColorFactor": [0.5, 0.5, 0.5, 1],"#;
    for (factors, factor) in [("", 1.0), (factors, 0.5)] {
        std::fs::write(&path, gltf(&images, factors, "")).unwrap();
        let read = open(&path);
        assert_is_of_textures(&read, factor);
        assert_eq!(certainty(&read, What::NormalY), Some(Certainty::Sure));
        assert_eq!(read.files.len(), 4);
    }
}

/// A glb of one material with its pictures in it.
pub fn glb(folder: &Path) -> Vec<u8> {
    let (mut binary, mut views) = (Vec::new(), Vec::new());
    for name in NAMES {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        views.push(format!(
            r#"{{"buffer": 0, "byteOffset": {}, "byteLength": {}}}"#,
            binary.len(),
            bytes.len()
        ));
        binary.extend(bytes);
    }
    binary.resize(binary.len().next_multiple_of(4), 0);
    let buffer = format!(r#""buffers": [{{"byteLength": {}}}]"#, binary.len());
    let more = format!(r#", "bufferViews": [{}], {buffer}"#, views.join(", "));
    let images = [0, 1, 2].map(|i| format!(r#"{{"bufferView": {i}, "mimeType": "image/png"}}"#));
    let mut json = gltf(&images, "", &more).into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let word = |n: usize| (n as u32).to_le_bytes();
    let total = word(28 + json.len() + binary.len());
    let header = [b"glTF".as_slice(), &word(2), &total].concat();
    [
        header,
        word(json.len()).to_vec(),
        b"JSON".to_vec(),
        json,
        word(binary.len()).to_vec(),
        b"BIN\0".to_vec(),
        binary,
    ]
    .concat()
}

#[test]
fn glb_with_pictures_in_it_opens() {
    let folder = textures();
    let path = folder.path().join("a.glb");
    std::fs::write(&path, glb(folder.path())).unwrap();
    assert_is_of_textures(&open(&path), 1.0);
}

pub const STANDARD_SURFACE: &str = r#"<materialx version="1.38">
  <nodegraph name="graph">
    <image name="base" type="color3"><input name="file" value="base colour.png" colorspace="srgb_texture"/></image>
    <image name="orm" type="vector3"><input name="file" value="orm.png"/></image>
    <extract name="rough" type="float"><input name="in" nodename="orm"/><input name="index" value="1"/></extract>
    <image name="n" type="vector3"><input name="file" value="n.png"/></image>
    <normalmap name="bumps" type="vector3"><input name="in" nodename="n"/></normalmap>
    <output name="colour" nodename="base"/><output name="roughness" nodename="rough"/>
    <output name="normal" nodename="bumps"/>
  </nodegraph>
  <standard_surface name="wall" type="surfaceshader">
    <input name="base_color" nodegraph="graph" output="colour"/>
    <input name="specular_roughness" nodegraph="graph" output="roughness"/>
    <input name="metalness" value="0"/>
    <input name="normal" nodegraph="graph" output="normal"/>
  </standard_surface>
</materialx>"#;

pub const GLTF_PBR: &str = r#"<materialx version="1.38" colorspace="lin_rec709" fileprefix="./">
  <image name="base" type="color3" colorspace="srgb_texture"><input name="file" value="base colour.png"/></image>
  <image name="orm" type="vector3"><input name="file" value="orm.png"/></image>
  <separate3 name="parts" type="multioutput"><input name="in" nodename="orm"/></separate3>
  <image name="n" type="vector3"><input name="file" value="n.png"/></image>
  <gltf_pbr name="wall" type="surfaceshader">
    <input name="base_color" nodename="base"/><input name="normal" nodename="n"/>
    <input name="roughness" nodename="parts" output="outg"/>
    <input name="metallic" nodename="parts" output="outb"/>
  </gltf_pbr>
</materialx>"#;

#[test]
fn materialx_surfaces_open_through_graphs_and_channels() {
    for text in [STANDARD_SURFACE, GLTF_PBR] {
        let folder = textures();
        let path = folder.path().join("a.mtlx");
        std::fs::write(&path, text).unwrap();
        let read = open(&path);
        assert_is_of_textures(&read, 1.0);
        assert_eq!(certainty(&read, What::Albedo), Some(Certainty::Sure));
    }
}

/// A glTF that names the files of [`textures`].
pub fn gltf_text() -> Vec<u8> {
    gltf(&NAMES.map(|uri| format!(r#"{{"uri": "{uri}"}}"#)), "", "").into_bytes()
}

#[test]
fn gltf_of_specular_and_glossiness_opens() {
    let folder = textures();
    let put = |name: &str, pixel: fn(usize, usize) -> [f64; 4]| {
        let image = image::RgbaImage::from_fn(SIDE as u32, SIDE as u32, |x, y| {
            pixel(x as usize, y as usize).map(|v| (255.0 * v).round() as u8).into()
        });
        save(folder.path(), name, &image.into(), ImageFormat::Png);
    };
    put("sg.png", |x, y| [srgb(0.04), srgb(0.04), srgb(0.04), 1.0 - texel(2, x, y)[0]]);
    let path = folder.path().join("a.gltf");
    let text = |factors: &str| {
        format!(
            r#"{{"asset": {{"version": "2.0"}}, "extensionsUsed": ["KHR_materials_pbrSpecularGlossiness"],
            "images": [{{"uri": "base%20colour.png"}}, {{"uri": "n.png"}}, {{"uri": "sg.png"}}],
            "textures": [{{"source": 0}}, {{"source": 1}}, {{"source": 2}}],
            "materials": [{{"name": "wall", "normalTexture": {{"index": 1}}, "extensions": {{
                "KHR_materials_pbrSpecularGlossiness": {{{factors} "diffuseTexture": {{"index": 0}},
                "specularGlossinessTexture": {{"index": 2}}}}}}}}]}}"#
        )
    };
    std::fs::write(&path, text("")).unwrap();
    let read = open(&path);
    assert_is_of_textures(&read, 1.0);
    assert_eq!(certainty(&read, What::Roughness), Some(Certainty::Sure));
    let factors =
        r#""diffuseFactor": [0.5, 0.5, 0.5, 1], "glossinessFactor": 0.5, "specularFactor": [0.5, 0.5, 0.5],"#;
    std::fs::write(&path, text(factors)).unwrap();
    let scaled = open(&path);
    for index in [0, 77, 200] {
        let [a, b] = [&read, &scaled].map(|read| read.material.texel(index));
        assert!((b.diffuse[0] - 0.5 * a.diffuse[0]).abs() < BOUND, "{b:?}");
        assert!((b.specular[0] - 0.02).abs() < BOUND, "{b:?}");
        assert!(((1.0 - b.roughness) - 0.5 * (1.0 - a.roughness)).abs() < BOUND, "{b:?}");
    }
}
