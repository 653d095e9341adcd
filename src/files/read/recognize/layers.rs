//! Files of named layers: EXR with layers or parts, npz with named arrays.

use std::path::Path;

use super::roles::MapsByRole;
use crate::error::Error;
use crate::read::decode::Layer;
use crate::read::names::{Label, listing};
use crate::read::options::{Albedo, NormalY, ReadOptions, Role, Roughness};
use crate::read::record::{Assumption, Certainty, Note, StorageConvention, Unused, What};
use crate::read::stored::{StoredMap, StoredMaterial};

/// Whether the name of a layer names a map.
pub(crate) fn is_named(layer: &Layer) -> bool {
    Label::of(&layer.name).is_some()
}

/// The name of a layer, for messages.
pub(crate) fn name(layer: &Layer) -> String {
    if layer.name.is_empty() { "one without a name".to_owned() } else { format!("`{}`", layer.name) }
}

fn unused(layer: &str) -> Note {
    Note::Unused { what: format!("Layer {layer}"), why: Unused::NotAMap }
}

/// The maps among `layers`, by their names; others are reported as not used.
///
/// # Errors
/// [`Error::NotAMaterial`] where maps are missing, or one is there twice.
pub(super) fn material(
    path: &Path,
    layers: Vec<Layer>,
    native: bool,
    options: &ReadOptions,
) -> Result<StoredMaterial, Error> {
    let names: Vec<String> = layers.iter().map(name).collect();
    let listed = format!("the layers {}", listing(&names));
    let mut maps = MapsByRole::default();
    let mut notes = Vec::new();
    let mut floats = true;
    for Layer { name, raster, .. } in layers {
        match Label::of(&name) {
            Some(label) if label.role == Role::Ignored => notes.push(unused(&name)),
            Some(label) if maps.has(label.role) => {
                return Err(Error::NotAMaterial {
                    path: path.to_owned(),
                    expected: format!("one layer for the {} map", label.role.name()),
                    found: listed,
                    remedy: "rename the layers that are none".to_owned(),
                });
            }
            Some(label) => {
                floats &= raster.is_float();
                maps.add(
                    label.role,
                    StoredMap { raster, file: path.to_owned(), part: format!("layer {name}") },
                );
            }
            None if name.is_empty() => notes.push(Note::Preview),
            None => notes.push(unused(&name)),
        }
    }
    let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let mut found = maps.material(path, name, &listed, options)?;
    let layout = Assumption::new(What::Layout, "layers", StorageConvention::LayerNames, Certainty::Sure);
    found.assumptions.insert(0, layout);
    notes.append(&mut found.notes);
    found.notes = notes;
    if floats {
        let (why, certainty) = if native {
            (StorageConvention::Native, Certainty::Sure)
        } else {
            (StorageConvention::Floats, Certainty::Likely)
        };
        found.inferred.albedo = Some((Albedo::Linear, why.into(), certainty));
        found.inferred.specular = found.inferred.albedo.clone();
        found.inferred.roughness = Some((Roughness::R, why.into(), certainty));
        found.inferred.normal_y = native.then(|| (NormalY::Up, why.into(), certainty));
    }
    Ok(found)
}
