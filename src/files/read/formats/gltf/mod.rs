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
use crate::files::read::options::{Albedo, NormalY, ReadOptions, Roughness};
use crate::files::read::stored::{Found, Pictures};
use crate::progress::Progress;
use surface::Surface;
use textures::Scene;

/// Most names of materials that a note lists.
const MOST_LISTED: usize = 12;

/// Reads material number `exemplar` of the file `path`; without one the first that has a texture, else the first.
///
/// # Errors
/// As `read`.
pub fn open(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Found, Error> {
    let bytes = fs::read(path).map_err(|source| Error::unreadable(path, source))?;
    let (document, blob) = document::parse(path, &bytes)?;
    let scene = Scene { path: path.to_owned(), document, blob };
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
    let surface = Surface::load(&scene, material, progress)?;
    let gloss = material.pbr_specular_glossiness().is_some();
    let mut pictures = Pictures::default();
    let is_linear = surface.put(material, &mut pictures)?;
    let mut found = pictures.into_found(path, name(material, index), "", options)?;
    found.files.push(path.to_owned());
    found.files.sort();
    found.files.dedup();
    specify(&mut found, if gloss { Roughness::Gloss } else { Roughness::R }, is_linear);
    found.notes.extend(
        features::ignored(said)
            .map(|ignored| format!("The glTF has {ignored}, which changes the look and is ignored.")),
    );
    if materials.len() > 1 {
        found.notes.push(several(&materials, index));
    }
    Ok(found)
}

fn name(material: &Material<'_>, index: usize) -> String {
    material.name().map_or_else(|| format!("material {index}"), str::to_owned)
}

/// What there is beside material number `index`.
fn several(materials: &[Material<'_>], index: usize) -> String {
    let count = materials.len();
    let names = materials.iter().enumerate().take(MOST_LISTED).map(|(i, m)| format!("{i} {}", name(m, i)));
    let more = if count > MOST_LISTED { format!(" and {} more", count - MOST_LISTED) } else { String::new() };
    let names = names.collect::<Vec<_>>().join(", ");
    format!("The glTF holds {count} materials: {names}{more}. This is number {index}. Another: --exemplar.")
}

/// What the specification of glTF 2.0 says.
fn specify(found: &mut Found, roughness: Roughness, is_linear: bool) {
    let why = || "glTF 2.0 is so by its specification".to_owned();
    let albedo = if is_linear { Albedo::Linear } else { Albedo::Srgb };
    found.hints.albedo = Some((albedo, why(), Certainty::Sure));
    found.hints.specular = found.hints.albedo.clone();
    found.hints.roughness = Some((roughness, why(), Certainty::Sure));
    found.hints.normal_y = Some((NormalY::Up, why(), Certainty::Sure));
    let layout = Assumption::new(What::Layout, "glTF", "the file names its textures", Certainty::Sure);
    found.assumptions.insert(0, layout);
}
