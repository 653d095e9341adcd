//! Damaged files that name textures, and sidecar files.

use super::*;
use crate::scene_files::{GLTF_PBR, STANDARD_SURFACE, glb, gltf_text, mtl};

const OPEN_PBR: &str = r#"<materialx version="1.39" colorspace="lin_rec709">
  <image name="base" type="color3" colorspace="srgb_texture"><input name="file" value="base colour.png"/></image>
  <open_pbr_surface name="wall" type="surfaceshader"><input name="base_color" nodename="base"/>
    <input name="base_weight" value="0.9"/><input name="specular_weight" value="0.5"/>
    <input name="specular_color" value="1, 0.5, 0.2"/><input name="specular_ior" value="1.4"/>
    <input name="coat_weight" value="0.2"/></open_pbr_surface>
</materialx>"#;

const USD: &str = r#"<materialx version="1.39"><UsdPreviewSurface name="wall" type="surfaceshader">
    <input name="useSpecularWorkflow" value="1"/><input name="specularColor" value="0.1, 0.2, 0.3"/>
    <input name="diffuseColor" value="0.5, 0.4, 0.3"/><input name="roughness" value="0.4"/></UsdPreviewSurface>
</materialx>"#;

const GLTF_OF_EXTENSIONS: &str = r#"{"asset": {"version": "2.0"},
  "extensionsUsed": ["KHR_materials_specular", "KHR_materials_ior", "KHR_texture_transform"],
  "images": [{"uri": "base%20colour.png"}, {"uri": "n.png"}],
  "textures": [{"source": 0}, {"source": 1}, {"extensions": {"EXT_texture_webp": {"source": 0}}}],
  "materials": [{"name": "wall", "normalTexture": {"index": 1, "scale": 0.5,
      "extensions": {"KHR_texture_transform": {"scale": [2, 2], "offset": [0.5, 0], "rotation": 0.1}}},
    "pbrMetallicRoughness": {"metallicFactor": 0.1, "baseColorTexture": {"index": 2,
      "extensions": {"KHR_texture_transform": {"scale": [2, 2], "offset": [0.5, 0], "rotation": 0.1}}}},
    "extensions": {"KHR_materials_ior": {"ior": 1.4}, "KHR_materials_clearcoat": {"clearcoatFactor": 0.5},
      "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 0.5, 2]}}}]}"#;

const GLTF_OF_GLOSS: &str = r#"{"asset": {"version": "2.0"}, "images": [{"uri": "base%20colour.png"}],
  "textures": [{"source": 0}], "materials": [{"extensions": {"KHR_materials_pbrSpecularGlossiness": {
    "diffuseTexture": {"index": 0}, "specularGlossinessTexture": {"index": 0}, "glossinessFactor": 0.5,
    "specularFactor": [1, 0.9, 0.8]}}}]}"#;

pub const SIDECAR: &str = r#"{"albedo": "srgb", "dielectric-f0": 0.05, "grid": "4x1", "order": "ndrs", "flip-v": true,
    "exemplar": 0, "maps": {"roughness": "n.png:g"}, "preset": "gao"}"#;

/// The extension and the text of files that name textures.
pub fn listings() -> Vec<(&'static str, Vec<u8>)> {
    let (folder, _) = mtl::wall("");
    let mtlx = [GLTF_PBR, STANDARD_SURFACE, OPEN_PBR, USD].map(|text| ("mtlx", text.as_bytes().to_vec()));
    let gltf = [GLTF_OF_EXTENSIONS, GLTF_OF_GLOSS].map(|text| ("gltf", text.as_bytes().to_vec()));
    let others = [("gltf", gltf_text()), ("glb", glb(folder.path())), ("mtl", mtl::PBR.as_bytes().to_vec())];
    others.into_iter().chain(mtlx).chain(gltf).collect()
}

/// Tries damaged copies of a file in a folder.
fn try_file(path: &Path, whole: &[u8], options: &ReadOptions, is_expected: fn(&Error) -> bool) {
    let open = |bytes: &[u8]| {
        std::fs::write(path, bytes).unwrap();
        read(path, options, &Progress::default())
    };
    try_all(&path.display().to_string(), whole, damaged, open, is_expected);
}

#[test]
fn damaged_files_that_name_textures_never_panic() {
    let (folder, _) = mtl::wall("");
    for (number, (extension, whole)) in listings().into_iter().enumerate() {
        try_file(&folder.path().join(format!("damaged{number}.{extension}")), &whole, &OPTIONS, of_listing);
    }
}

#[test]
fn damaged_sidecar_files_never_panic() {
    let folder = tempdir().unwrap();
    let image = packed("NDRS", 4, |_, v| v);
    image.save_with_format(folder.path().join("damaged.png"), ImageFormat::Png).unwrap();
    packed("R", 1, |_, v| v).save_with_format(folder.path().join("n.png"), ImageFormat::Png).unwrap();
    let path = folder.path().join("damaged.svbrdf.json");
    try_file(&path, SIDECAR.as_bytes(), &ReadOptions::AUTO, of_sidecar);
}
