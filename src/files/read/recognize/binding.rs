//! Maps that are specified one by one: a picture, or one of its channels or layers.

use std::path::PathBuf;

use super::layers;
use crate::error::Error;
use crate::read::decode::Layer;
use crate::read::decode::pictures::DecodedBinding;
use crate::read::located::binding::{BoundSource, LocatedBinding};
use crate::read::names::listing;
use crate::read::options::Role;
use crate::read::record::Subject;
use crate::read::stored::StoredMap;

/// The map of a binding out of its decoded file.
///
/// # Errors
/// [`Error::BadImage`] where the file has no such part.
pub(crate) fn recognized(
    binding: &LocatedBinding,
    decoded: DecodedBinding,
) -> Result<(Role, StoredMap), Error> {
    let file = match &binding.source {
        BoundSource::File { file, .. } => file.path().to_owned(),
        BoundSource::Constant(_) => PathBuf::new(),
    };
    let (mut all, part) = match decoded {
        DecodedBinding::Constant(values) => return Ok((binding.role, StoredMap::specified(&values))),
        DecodedBinding::Whole(raster) => {
            return Ok((binding.role, StoredMap { raster, file, part: String::new() }));
        }
        DecodedBinding::Parts(layers, part) => (layers, part),
    };
    let channel = ["r", "g", "b", "a"].iter().position(|letter| *letter == part);
    let raster = match (all.iter().position(|layer| layer.name == part), channel) {
        (Some(place), _) => Some(all.swap_remove(place).raster),
        (None, Some(3)) if all.len() == 1 => {
            all.pop().and_then(|Layer { raster, .. }| Some(raster.of(raster.alpha.clone()?)))
        }
        (None, Some(channel)) if all.len() == 1 => {
            all.pop().and_then(|Layer { raster, .. }| Some(raster.of(raster.channels.get(channel)?.clone())))
        }
        _ => None,
    };
    let names: Vec<_> = all.iter().map(layers::name).collect();
    let what = Subject::Map(binding.role);
    let raster = raster.ok_or_else(|| Error::BadImage {
        path: file.clone(),
        problem: format!("{what}: expected the part {part}, found {}", listing(&names)),
        remedy: "name a channel (r, g, b, a) that it has, or one of its layers".to_owned(),
    })?;
    Ok((binding.role, StoredMap { raster, file, part }))
}
