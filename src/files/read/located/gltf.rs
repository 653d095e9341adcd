//! A located material of a glTF.

use std::path::PathBuf;

use super::picture::LocatedPicture;
use crate::disk::open::NamedFile;

/// A material of a glTF, its textures located.
#[derive(Debug)]
pub(crate) struct LocatedGltf {
    pub path: PathBuf,
    pub name: String,
    pub surface: GltfSurface,
    /// The pictures of [`GltfTextures`], in any order.
    pub pictures: Vec<LocatedPicture>,
    pub textures: GltfTextures,
    /// The scale of x and y of the normals.
    pub normal_scale: f32,
    /// The files of its buffers: pictures, vertex colours and meshes.
    pub buffers: Vec<NamedFile>,
    /// Features that change the look and are not modelled.
    pub not_modelled: Vec<String>,
    /// The names of all materials of the file, and which of them this is.
    pub materials: (Vec<String>, usize),
}

/// The texture of each input, by its number among the pictures.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct GltfTextures {
    pub normal: Option<usize>,
    /// Base colour or diffuse.
    pub colour: Option<usize>,
    /// Roughness and metallic, or specular and glossiness.
    pub packed: Option<usize>,
    /// The strength of the specular reflection, in alpha.
    pub specular: Option<usize>,
    pub specular_colour: Option<usize>,
}

/// The factors of a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) enum GltfSurface {
    MetallicRoughness {
        base: [f32; 3],
        roughness: f32,
        metallic: f32,
        /// The refractive index, where the file declares one.
        ior: Option<f32>,
        /// Strength and colour of `KHR_materials_specular`, where the file has it.
        specular: Option<(f32, [f32; 3])>,
    },
    /// The extension `KHR_materials_pbrSpecularGlossiness`.
    SpecularGlossiness { diffuse: [f32; 3], specular: [f32; 3], glossiness: f32 },
}
