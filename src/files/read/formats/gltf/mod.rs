//! Materials of glTF 2.0, through the `gltf` library: files beside it, pictures within it, factors, extensions.

mod document;
mod features;
mod surface;
mod textures;

use std::fs;
use std::path::Path;

use gltf::Material;

use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::note::Note;
use crate::files::read::options::{Albedo, NormalY, ReadOptions, Roughness};
use crate::files::read::pictures::Pictures;
use crate::files::read::storage_convention::StorageConvention;
use crate::files::read::stored::StoredMaterial;
use crate::progress::Progress;
use surface::GltfSurface;
use textures::GltfFile;

/// Reads material number `exemplar` of the file `path`; without one the first that has a texture, else the first.
///
/// # Errors
/// As `read`.
pub(crate) fn open(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<StoredMaterial, Error> {
    let bytes = fs::read(path).map_err(|source| Error::unreadable(path, source))?;
    let (document, blob) = document::parse(path, &bytes)?;
    let scene = GltfFile { path: path.to_owned(), document, blob };
    let materials: Vec<_> = scene.document.materials().collect();
    let said = &scene.document.as_json().materials;
    let index = match options.exemplar {
        Some(_) => options.exemplar_of(materials.len(), path)?,
        None => said.iter().position(|said| !features::textures(said).is_empty()).unwrap_or(0),
    };
    let (material, said) = materials.get(index).zip(said.get(index)).ok_or_else(|| Error::NotAMaterial {
        path: path.to_owned(),
        expected: "a material in the glTF".to_owned(),
        found: "none".to_owned(),
        remedy: "export the model with its materials".to_owned(),
    })?;
    if let Some(problem) = features::transforms_differ(said) {
        return Err(Error::BadImage {
            path: path.to_owned(),
            problem,
            remedy: "bake the maps into one arrangement".to_owned(),
        });
    }
    let surface = GltfSurface::load(&scene, material, progress)?;
    let gloss = material.pbr_specular_glossiness().is_some();
    let mut pictures = Pictures::default();
    let is_linear = surface.put(material, &mut pictures)?;
    let mut found = pictures.assemble(path, name(material, index), "", options)?;
    found.files.push(path.to_owned());
    found.files.sort();
    found.files.dedup();
    specify(&mut found, if gloss { Roughness::Gloss } else { Roughness::R }, is_linear);
    let features: Vec<String> = features::ignored(said).collect();
    if !features.is_empty() {
        found.notes.push(Note::NotModelled { features });
    }
    if materials.len() > 1 {
        let names = materials.iter().enumerate().map(|(i, material)| name(material, i)).collect();
        found.notes.push(Note::Materials { names, index });
    }
    Ok(found)
}

fn name(material: &Material<'_>, index: usize) -> String {
    material.name().map_or_else(|| format!("material {index}"), str::to_owned)
}

/// What the specification of glTF 2.0 says.
fn specify(found: &mut StoredMaterial, roughness: Roughness, is_linear: bool) {
    let why = || StorageConvention::Gltf.into();
    let albedo = if is_linear { Albedo::Linear } else { Albedo::Srgb };
    found.inferred.albedo = Some((albedo, why(), Certainty::Sure));
    found.inferred.specular = found.inferred.albedo.clone();
    found.inferred.roughness = Some((roughness, why(), Certainty::Sure));
    found.inferred.normal_y = Some((NormalY::Up, why(), Certainty::Sure));
    let layout = Assumption::new(What::Layout, "glTF", StorageConvention::ListedTextures, Certainty::Sure);
    found.assumptions.insert(0, layout);
}
