//! Materials of glTF 2.0, through the `gltf` library: which pictures, beside the file or within it, with which factors.

mod document;
mod features;
mod textures;
mod vertex_colours;

use std::path::Path;

use gltf::{Material, Texture};

use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::located::gltf::{GltfSurface, GltfTextures, LocatedGltf};
use crate::read::located::picture::LocatedPicture;
use crate::read::options::{ReadOptions, Role};
use crate::read::record::Subject;

use document::{GltfDocument, array};
use textures::GltfFile;

/// Locates material number `exemplar` of the file `path`; without one the first that has a texture, else the first.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::Memory`], [`Error::BadImage`], also of a material with a required extension that is not known,
/// [`Error::NotAMaterial`] without a material, [`Error::NoSuchExemplar`].
pub(super) fn locate(path: &Path, options: &ReadOptions) -> Result<LocatedGltf, Error> {
    let bytes = NamedFile::by_user(path).bytes()?;
    let GltfDocument { parsed, declared, blob, reserved: _reserved } =
        document::parse(path, bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes))?;
    let file = GltfFile { path: path.to_owned(), document: parsed, declared, blob };
    let materials: Vec<_> = file.document.materials().collect();
    let declared = array(&file.declared, "materials");
    let index = match options.exemplar {
        Some(_) => options.exemplar_of(materials.len(), path)?,
        None => declared.iter().position(|one| !features::textures(one).is_empty()).unwrap_or(0),
    };
    let (material, declared) =
        materials.get(index).zip(declared.get(index)).ok_or_else(|| Error::NotAMaterial {
            path: path.to_owned(),
            expected: "a material in the glTF".to_owned(),
            found: "none".to_owned(),
            remedy: "export the model with its materials".to_owned(),
        })?;
    if let Some(problem) = features::transforms_differ(declared) {
        return Err(Error::BadImage {
            path: path.to_owned(),
            problem,
            remedy: "bake the maps into one arrangement".to_owned(),
        });
    }
    let all_textures = array(&file.declared, "textures");
    let required: Vec<String> = array(&file.declared, "extensionsRequired")
        .iter()
        .filter_map(|name| name.as_str().map(str::to_owned))
        .collect();
    if let Some(extension) = features::unknown_required(declared, all_textures, &required) {
        return Err(Error::BadImage {
            path: path.to_owned(),
            problem: format!(
                "{}: expected extensions that are read, found {extension}, which the file requires",
                name(path, material)
            ),
            remedy: "export the material as metallic and roughness".to_owned(),
        });
    }
    let mut not_modelled = features::ignored(declared, all_textures);
    if vertex_colours::has(&file, index) {
        not_modelled.push("vertex colours (COLOR_0), which multiply the base colour".to_owned());
    }
    not_modelled.extend(features::unlike_coordinates(declared));
    let (pictures, textures) = pictures(&file, material)?;
    let names =
        materials.iter().map(|material| specified_name(material).unwrap_or("unnamed").to_owned()).collect();
    Ok(LocatedGltf {
        path: path.to_owned(),
        name: name(path, material),
        surface: surface(material),
        pictures,
        textures,
        normal_scale: material.normal_texture().map_or(1.0, |texture| texture.scale()),
        buffers: file.buffers(),
        not_modelled,
        materials: (names, index),
    })
}

/// The name of a material, or else that of its file: materials of several files are compared.
fn name(path: &Path, material: &Material<'_>) -> String {
    let stem = || path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    specified_name(material).map_or_else(stem, str::to_owned)
}

fn specified_name<'a>(material: &Material<'a>) -> Option<&'a str> {
    material.name().filter(|name| !name.trim().is_empty())
}

/// The pictures of a material, and which input each is for.
fn pictures(file: &GltfFile, material: &Material<'_>) -> Result<(Vec<LocatedPicture>, GltfTextures), Error> {
    let mut pictures = Vec::new();
    let mut add = |texture: Option<Texture<'_>>, role| -> Result<Option<usize>, Error> {
        let Some(texture) = texture else { return Ok(None) };
        let subject = Subject::Map(role);
        pictures.push(LocatedPicture { source: file.picture(&texture, subject)?, subject });
        Ok(Some(pictures.len() - 1))
    };
    let normal = add(material.normal_texture().map(|t| t.texture()), Role::Normal)?;
    let textures = if let Some(gloss) = material.pbr_specular_glossiness() {
        let both = gloss.specular_glossiness_texture().map(|t| t.texture());
        GltfTextures {
            normal,
            colour: add(gloss.diffuse_texture().map(|t| t.texture()), Role::Diffuse)?,
            packed: add(both, Role::Specular)?,
            ..GltfTextures::default()
        }
    } else {
        let pbr = material.pbr_metallic_roughness();
        let both = pbr.metallic_roughness_texture().map(|t| t.texture());
        let extension = material.specular();
        let strength = extension.as_ref().and_then(|s| s.specular_texture()).map(|t| t.texture());
        let colour = extension.as_ref().and_then(|s| s.specular_color_texture()).map(|t| t.texture());
        GltfTextures {
            normal,
            colour: add(pbr.base_color_texture().map(|t| t.texture()), Role::Base)?,
            packed: add(both, Role::Roughness)?,
            specular: add(strength, Role::SpecularLevel)?,
            specular_colour: add(colour, Role::Specular)?,
        }
    };
    Ok((pictures, textures))
}

/// The factors of a material.
fn surface(material: &Material<'_>) -> GltfSurface {
    let rgb = |[r, g, b, _]: [f32; 4]| [r, g, b];
    match material.pbr_specular_glossiness() {
        Some(gloss) => GltfSurface::SpecularGlossiness {
            diffuse: rgb(gloss.diffuse_factor()),
            specular: gloss.specular_factor(),
            glossiness: gloss.glossiness_factor(),
        },
        None => {
            let pbr = material.pbr_metallic_roughness();
            GltfSurface::MetallicRoughness {
                base: rgb(pbr.base_color_factor()),
                roughness: pbr.roughness_factor(),
                metallic: pbr.metallic_factor(),
                ior: material.ior(),
                specular: material.specular().map(|s| (s.specular_factor(), s.specular_color_factor())),
            }
        }
    }
}
