//! Hints of names: how the files of a set with such names store their values.

use crate::read::located::set::{LabelledFile, LocatedSet, NUMBERED};
use crate::read::options::{Albedo, NormalY, Role, Roughness};
use crate::read::record::{Certainty, Reason, StorageConvention};
use crate::read::stored::{Inferences, Inferred, StoredMap, StoredMaterial};

/// Adds the hints of the names of `set` to its material, whose colours `are_floats` and whose specular `is_glossy` in
/// alpha.
pub(super) fn add(found: &mut StoredMaterial, set: &LocatedSet, are_floats: bool, is_glossy: bool) {
    found.inferred = inferred(set, are_floats);
    if is_diffmat(&set.files.files, found) {
        let why = || StorageConvention::DiffMatNames.into();
        found.inferred.albedo = Some((Albedo::Gamma22, why(), Certainty::Likely));
        found.inferred.normal_y = Some((NormalY::Down, why(), Certainty::Unsure));
    }
    if is_glossy {
        let why = || StorageConvention::SpecularGlossiness.into();
        found.inferred.albedo = Some((Albedo::Srgb, why(), Certainty::Sure));
        found.inferred.specular = found.inferred.albedo.clone();
        found.inferred.roughness = Some((Roughness::Gloss, why(), Certainty::Sure));
    }
}

/// The direction of y by the format of a document beside the set that lists its normal map.
fn listed_y(set: &LocatedSet) -> Inferred<NormalY> {
    let normal = set.files.files.iter().find(|file| file.label.role == Role::Normal)?;
    let document = set.files.documents.iter().find(|one| one.files.contains(&normal.file))?;
    let why = Reason::ListedNormals { document: document.name.clone() };
    Some((document.normal_y?, why, Certainty::Likely))
}

/// Whether the files look as DiffMat writes them: whole names, colour in 8 bits, gray in 16.
fn is_diffmat(files: &[LabelledFile], found: &StoredMaterial) -> bool {
    let plain = ["basecolor", "normal", "roughness", "metallic"];
    let deep = |source: &StoredMap| source.raster.depth == "16-bit" && source.raster.channels.len() == 1;
    files.iter().all(|f| f.label.stem.is_empty() && plain.contains(&f.label.word.as_str()))
        && found.colour.raster.depth == "8-bit"
        && deep(&found.roughness)
        && found.metallic.as_ref().is_some_and(deep)
}

/// The inferences of the names about values.
fn inferred(set: &LocatedSet, are_floats: bool) -> Inferences {
    let files = &set.files.files;
    let word = |role: Role| files.iter().find(|f| f.label.role == role).map(|f| f.label.word.as_str());
    let named = |f: &LabelledFile| {
        f.label.roughness().map(|r| (r, Reason::FileName { file: f.file.clone() }, Certainty::Sure))
    };
    let roughness = files.iter().find_map(named);
    let normal_y = files.iter().find_map(|f| f.label.normal_y.map(|y| (f, y)));
    let normal_y =
        normal_y.map(|(f, y)| (y, Reason::NormalName { file: f.file.clone(), y }, Certainty::Sure));
    let normal_y = normal_y.or_else(|| listed_y(set));
    let mut inferred = Inferences { roughness, normal_y, ..Inferences::default() };
    if are_floats {
        inferred.albedo = Some((Albedo::Linear, StorageConvention::Floats.into(), Certainty::Likely));
        inferred.specular = inferred.albedo.clone();
        return inferred;
    }
    let colour = word(Role::Diffuse).or(word(Role::Base)).unwrap_or_default();
    let choice = if word(Role::Normal) == Some("nom") && word(Role::Roughness) == Some("rgh") {
        let why = StorageConvention::MaterialGanNames;
        inferred.roughness = Some((Roughness::Gamma22, why.into(), Certainty::Likely));
        Some((Albedo::Gamma22, why, Certainty::Likely))
    } else if colour == NUMBERED {
        Some((Albedo::Gamma22, StorageConvention::NumberedResults, Certainty::Unsure))
    } else if colour.contains("gammad") {
        Some((Albedo::Gamma22, StorageConvention::GammadNames, Certainty::Sure))
    } else if colour.starts_with("outputs") || colour.starts_with("targets") {
        Some((Albedo::Linear, StorageConvention::DeschaintreNames, Certainty::Likely))
    } else if word(Role::Specular) == Some("specular") && set.has_renderings {
        Some((Albedo::Linear, StorageConvention::SurfaceNetFolder, Certainty::Likely))
    } else {
        None
    };
    inferred.albedo = choice.map(|(albedo, why, certainty)| (albedo, why.into(), certainty));
    inferred.specular = inferred.albedo.clone();
    inferred
}
