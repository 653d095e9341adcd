//! A material of a glTF: its textures and factors, and the extensions that are read. `None` where the file declares nothing.

use serde::Deserialize;
use serde_json::{Map, Value};

use crate::read::options::Role;

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct GltfMaterial {
    name: Option<String>,
    pub pbr_metallic_roughness: MetallicRoughness,
    normal_texture: Option<TextureInfo>,
    pub occlusion_texture: Option<Value>,
    pub emissive_factor: [f32; 3],
    pub extensions: Extensions,
}

/// A texture, and how the material uses it.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct TextureInfo {
    pub index: usize,
    #[serde(default)]
    pub tex_coord: u64,
    /// Of x and y of normals.
    scale: Option<f32>,
    #[serde(default)]
    pub extensions: Map<String, Value>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct MetallicRoughness {
    pub base_color_factor: Option<[f32; 4]>,
    base_color_texture: Option<TextureInfo>,
    pub metallic_factor: Option<f32>,
    pub roughness_factor: Option<f32>,
    metallic_roughness_texture: Option<TextureInfo>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Extensions {
    #[serde(rename = "KHR_materials_pbrSpecularGlossiness")]
    pub gloss: Option<SpecularGlossiness>,
    #[serde(rename = "KHR_materials_ior")]
    pub ior: Option<Ior>,
    #[serde(rename = "KHR_materials_specular")]
    pub specular: Option<Specular>,
    #[serde(flatten)]
    pub others: Map<String, Value>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct SpecularGlossiness {
    pub diffuse_factor: Option<[f32; 4]>,
    diffuse_texture: Option<TextureInfo>,
    pub specular_factor: Option<[f32; 3]>,
    pub glossiness_factor: Option<f32>,
    specular_glossiness_texture: Option<TextureInfo>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Ior {
    pub ior: Option<f32>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Specular {
    pub specular_factor: Option<f32>,
    specular_texture: Option<TextureInfo>,
    pub specular_color_factor: Option<[f32; 3]>,
    specular_color_texture: Option<TextureInfo>,
}

impl GltfMaterial {
    pub(super) fn name(&self) -> Option<&str> {
        self.name.as_deref().filter(|name| !name.trim().is_empty())
    }

    /// The scale of x and y of the normals.
    pub(super) fn normal_scale(&self) -> f32 {
        self.normal_texture.as_ref().and_then(|texture| texture.scale).unwrap_or(1.0)
    }

    /// The textures that are read, by their names in glTF, each as another map.
    pub(super) fn textures(&self) -> Vec<(&'static str, Role, &TextureInfo)> {
        let (pbr, specular) = (&self.pbr_metallic_roughness, self.extensions.specular.as_ref());
        let all = match &self.extensions.gloss {
            Some(gloss) => vec![
                ("diffuseTexture", Role::Diffuse, gloss.diffuse_texture.as_ref()),
                ("specularGlossinessTexture", Role::Specular, gloss.specular_glossiness_texture.as_ref()),
            ],
            None => {
                let level = specular.and_then(|one| one.specular_texture.as_ref());
                let colour = specular.and_then(|one| one.specular_color_texture.as_ref());
                vec![
                    ("baseColorTexture", Role::Base, pbr.base_color_texture.as_ref()),
                    ("metallicRoughnessTexture", Role::Roughness, pbr.metallic_roughness_texture.as_ref()),
                    ("specularTexture", Role::SpecularLevel, level),
                    ("specularColorTexture", Role::Specular, colour),
                ]
            }
        };
        let all = all.into_iter().chain([("normalTexture", Role::Normal, self.normal_texture.as_ref())]);
        all.filter_map(|(name, role, info)| Some((name, role, info?))).collect()
    }
}
