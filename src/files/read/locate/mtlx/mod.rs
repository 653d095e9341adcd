//! Surfaces of MaterialX (`standard_surface`, `gltf_pbr`, `open_pbr_surface` and `UsdPreviewSurface`): the pictures and
//! values of their inputs.

mod arithmetic;
mod graph;
mod tiles;

use std::path::Path;

use roxmltree::{Document, Node};

use crate::disk::lfs;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::located::mtlx::{Bound, LocatedMtlx};
use crate::read::located::picture::{LocatedPicture, PictureSource};
use crate::read::located::surface_model::{MODELS, SurfaceModel, USD_SPECULAR, USE_SPECULAR};
use crate::read::options::{ReadOptions, Role};
use crate::read::record::Subject;

use graph::{bound, input};

/// Most attributes of an element of XML; those of MaterialX have about ten.
const MOST_ATTRIBUTES: usize = 1000;

/// Locates surface number `exemplar` of the file `path`.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`] where it is no XML, [`Error::NotAMaterial`] without such a surface,
/// [`Error::NoSuchExemplar`].
pub(super) fn locate(path: &Path, options: &ReadOptions) -> Result<LocatedMtlx, Error> {
    let text = NamedFile::by_user(path).text()?;
    lfs::refuse_pointer(path, text.as_bytes())?;
    let bad = |problem: String| Error::BadImage {
        path: path.to_owned(),
        problem,
        remedy: "export it again".to_owned(),
    };
    let text = tiles::escaped(&text);
    if has_many_attributes(&text) {
        return Err(bad(format!("expected at most {MOST_ATTRIBUTES} attributes in an element, found more")));
    }
    let document = Document::parse(&text).map_err(|e| bad(format!("expected MaterialX, found: {e}")))?;
    let surfaces: Vec<_> = document.descendants().filter_map(|node| Some((node, model_of(node)?))).collect();
    let index = options.exemplar_of(surfaces.len(), path)?;
    let &(node, model) = surfaces.get(index).ok_or_else(|| Error::NotAMaterial {
        path: path.to_owned(),
        expected: format!("one of {}", SurfaceModel::names()),
        found: "none of them".to_owned(),
        remedy: "translate the material to one of them".to_owned(),
    })?;
    let wanted = model.inputs();
    let names = wanted.iter().map(|(name, _)| *name).chain([model.ior.0, USE_SPECULAR]);
    let inputs: Vec<_> = names.filter_map(|name| Some((name, bound(node, name).transpose()?))).collect();
    let mut located = LocatedMtlx {
        path: path.to_owned(),
        name: name(&node),
        model,
        inputs,
        pictures: Vec::new(),
        not_modelled: not_modelled(model, node),
        surfaces: (surfaces.iter().map(|(node, _)| name(node)).collect(), index),
    };
    for (_, bound) in &mut located.inputs {
        if let Ok(Bound::Picture(picture)) = bound {
            picture.file = tiles::only(&picture.file, path)?;
        }
    }
    located.pictures = pictures(&located, &wanted);
    Ok(located)
}

/// Whether an element may have more attributes than [`MOST_ATTRIBUTES`]: the parser compares each with each.
fn has_many_attributes(text: &str) -> bool {
    let signs = |element: &str| element.bytes().filter(|byte| *byte == b'=').count();
    text.split('<').any(|element| element.len() > 2 * MOST_ATTRIBUTES && signs(element) > MOST_ATTRIBUTES)
}

/// The model of a node, if it is a surface that is read.
fn model_of(node: Node<'_, '_>) -> Option<&'static SurfaceModel> {
    MODELS.iter().find(|model| node.has_tag_name(model.tag))
}

fn name(node: &Node<'_, '_>) -> String {
    node.attribute("name").unwrap_or("material").to_owned()
}

/// The pictures that the inputs `wanted` of a surface lead to, each once for every map that it is read as.
fn pictures(located: &LocatedMtlx, wanted: &[(&'static str, Role)]) -> Vec<LocatedPicture> {
    let mut all: Vec<(NamedFile, Role)> = Vec::new();
    let specular_usd = located.is_specular_usd();
    for (name, role) in wanted {
        if *name == USD_SPECULAR.0 && !specular_usd {
            continue;
        }
        if let Some(Ok(Bound::Picture(picture))) = located.bound(name) {
            let one = (NamedFile::within(&picture.file, &located.path), *role);
            if !all.contains(&one) {
                all.push(one);
            }
        }
    }
    let located =
        |(file, role)| LocatedPicture { source: PictureSource::File(file), subject: Subject::Map(role) };
    all.into_iter().map(located).collect()
}

/// Inputs of `surface` that change its look and are not modelled.
fn not_modelled(model: &SurfaceModel, surface: Node<'_, '_>) -> Vec<String> {
    let is_on = |(name, off): &&(&str, f32)| {
        let Some(input) = input(surface, name) else { return false };
        let values = input.attribute("value").map(|v| v.split(',').map(|v| v.trim().parse::<f32>()));
        values.is_none_or(|mut values| values.any(|value| value.is_ok_and(|value| value != *off)))
    };
    model.not_modelled.iter().filter(is_on).map(|(name, _)| (*name).to_owned()).collect()
}
