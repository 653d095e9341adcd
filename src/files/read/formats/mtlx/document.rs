//! Documents of MaterialX: a surface, its inputs followed to pictures and values.

use std::path::{Path, PathBuf};

use roxmltree::{Document, Node};

use super::graph::{Bound, BoundPicture, Obstacle, bound};
use super::placement::{input, is_input};
use super::surface_model::{MODELS, SurfaceModel, USD_SPECULAR, USE_SPECULAR};
use crate::disk::open::NamedFile;
use crate::disk::refuse_pointer;
use crate::error::Error;
use crate::read::names::listing;
use crate::read::options::{ReadOptions, Role};
use crate::read::stored::Picture;

/// Most attributes of an element of XML; those of MaterialX have about ten.
const MOST_ATTRIBUTES: usize = 1000;

/// A surface of a MaterialX document, its inputs followed to pictures and values.
#[derive(Debug)]
pub(in crate::read) struct Mtlx {
    pub(super) path: PathBuf,
    /// The name of the surface.
    pub name: String,
    pub(super) model: &'static SurfaceModel,
    /// The inputs that are read, by name.
    pub(super) inputs: Vec<(&'static str, Result<Bound, Obstacle>)>,
    /// The pictures that inputs lead to, each once for every map that it is read as.
    pub(super) pictures: Vec<Picture>,
    /// Inputs that change the look and are not modelled.
    pub(super) not_modelled: Vec<String>,
    /// The names of all surfaces of the document, and which of them this is.
    pub(super) surfaces: (Vec<String>, usize),
}

impl Mtlx {
    /// Locates surface number `exemplar` of the file `path`.
    ///
    /// # Errors
    /// [`Error::Unreadable`], [`Error::BadImage`] where it is no XML, [`Error::NotAMaterial`] without such a surface,
    /// [`Error::NoSuchExemplar`].
    pub(in crate::read) fn locate(path: &Path, options: &ReadOptions) -> Result<Self, Error> {
        let text = NamedFile::by_user(path).text()?;
        refuse_pointer(path, text.as_bytes())?;
        let bad = |problem: String| Error::BadImage {
            path: path.to_owned(),
            problem,
            remedy: "export it again".to_owned(),
        };
        // Exporters write tokens as they are, where XML allows no `<`.
        let text = TOKENS.iter().fold(text, |text, token| text.replace(token, &token.replace('<', "&lt;")));
        if has_many_attributes(&text) {
            return Err(bad(format!(
                "expected at most {MOST_ATTRIBUTES} attributes in an element, found more"
            )));
        }
        let document = Document::parse(&text).map_err(|e| bad(format!("expected MaterialX, found: {e}")))?;
        let surfaces: Vec<_> =
            document.descendants().filter_map(|node| Some((node, model_of(node)?))).collect();
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
        let mut located = Self {
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
                picture.file = only_tile(&picture.file, path)?;
            }
        }
        located.check_placements()?;
        located.pictures = located.pictures(&wanted);
        Ok(located)
    }

    /// Names what is not understood of the nodes of pictures.
    ///
    /// # Errors
    /// [`Error::NotAMaterial`] where pictures are placed differently: then the maps do not lie over one another.
    fn check_placements(&mut self) -> Result<(), Error> {
        let specular_usd = self.is_specular_usd();
        let read = self.inputs.iter().filter(|(name, _)| *name != USD_SPECULAR.0 || specular_usd);
        let pictures: Vec<_> = read
            .filter_map(|(name, bound)| match bound {
                Ok(Bound::Picture(picture)) => Some((name, picture)),
                _ => None,
            })
            .collect();
        let Some((first, others)) = pictures.split_first() else { return Ok(()) };
        if let Some(other) = others.iter().find(|other| other.1.placement != first.1.placement) {
            let named = |(name, picture): &(&&str, &BoundPicture)| {
                let placement = if picture.placement.is_empty() { "none" } else { &picture.placement };
                format!("{placement} for {name}")
            };
            return Err(Error::NotAMaterial {
                path: self.path.clone(),
                expected: "one placement of coordinates for all maps".to_owned(),
                found: format!("{} and {}", named(first), named(other)),
                remedy: "bake the maps into one arrangement".to_owned(),
            });
        }
        let mut unread: Vec<_> = pictures.iter().flat_map(|(_, picture)| picture.unread.clone()).collect();
        unread.dedup();
        self.not_modelled.extend(unread);
        Ok(())
    }

    /// What input `name` is bound to; `None` where the document does not declare it.
    pub(super) fn bound(&self, name: &str) -> Option<&Result<Bound, Obstacle>> {
        self.inputs.iter().find(|(input, _)| *input == name).map(|(_, bound)| bound)
    }

    /// Whether the surface is a `UsdPreviewSurface` in its specular workflow.
    pub(super) fn is_specular_usd(&self) -> bool {
        let declared = self.bound(USE_SPECULAR);
        matches!(declared, Some(Ok(Bound::Values { values, .. })) if values.first().is_some_and(|v| *v != 0.0))
    }

    /// The path of a file that the document names, relative to the document or absolute.
    pub(super) fn path_of(&self, file: &str) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(file)
    }

    /// Every file that may be decoded.
    pub(in crate::read) fn files(&self) -> Vec<NamedFile> {
        self.pictures.iter().filter_map(|picture| picture.file().cloned()).collect()
    }

    /// The pictures that the inputs `wanted` lead to, each once for every map that it is read as.
    fn pictures(&self, wanted: &[(&'static str, Role)]) -> Vec<Picture> {
        let mut all: Vec<(NamedFile, Role)> = Vec::new();
        let specular_usd = self.is_specular_usd();
        for (name, role) in wanted.iter().filter(|(name, _)| *name != USD_SPECULAR.0 || specular_usd) {
            if let Some(Ok(Bound::Picture(picture))) = self.bound(name) {
                let one = (NamedFile::within(&picture.file, &self.path), *role);
                if !all.contains(&one) {
                    all.push(one);
                }
            }
        }
        all.into_iter().map(|(file, role)| Picture::of_file(file, role)).collect()
    }
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

/// Inputs of `surface` that change its look and are not modelled.
fn not_modelled(model: &SurfaceModel, surface: Node<'_, '_>) -> Vec<String> {
    let is_on = |(name, off): &&(&str, f32)| {
        let Some(input) = input(surface, name) else { return false };
        let values = input.attribute("value").map(|v| v.split(',').map(|v| v.trim().parse::<f32>()));
        values.is_none_or(|mut values| values.any(|value| value.is_ok_and(|value| value != *off)))
    };
    let names = surface.children().filter(is_input).filter_map(|input| input.attribute("name"));
    // Parameters of a lobe matter only with its weight.
    let is_of =
        |name: &str, (known, _): &(&str, f32)| name.starts_with(known.split('_').next().unwrap_or_default());
    let is_known = |name: &&str| {
        model.inputs().iter().any(|(known, _)| known == name)
            || [model.ior.0, USE_SPECULAR].contains(name)
            || model.not_modelled.iter().any(|one| is_of(name, one))
    };
    let unknown = names.filter(|name| !is_known(name) && (is_on(&&(*name, 0.0)) && is_on(&&(*name, 1.0))));
    let known = model.not_modelled.iter().filter(is_on).map(|(name, _)| *name);
    known.chain(unknown).map(str::to_owned).collect()
}

/// The token of the number of a tile, of UDIM and by column and row.
const TOKENS: [&str; 2] = ["<UDIM>", "<UVTILE>"];
/// Tiles that are looked for: ten rows of ten.
const MOST_TILES: usize = 100;

/// The file `name` that the document `by` names, of the only tile that is there.
///
/// # Errors
/// [`Error::NotAMaterial`] of several tiles.
fn only_tile(name: &str, by: &Path) -> Result<String, Error> {
    if !TOKENS.iter().any(|token| name.contains(token)) {
        return Ok(name.to_owned());
    }
    let tile = |number: usize| {
        let place = format!("u{}_v{}", number % 10 + 1, number / 10 + 1);
        name.replace(TOKENS[0], &(1001 + number).to_string()).replace(TOKENS[1], &place)
    };
    let mut there: Vec<_> =
        (0..MOST_TILES).map(tile).filter(|file| NamedFile::within(file, by).exists()).collect();
    if there.len() > 1 {
        return Err(Error::NotAMaterial {
            path: by.to_owned(),
            expected: format!("one tile of {name}"),
            found: listing(&there),
            remedy: "write the name of one of them into the document".to_owned(),
        });
    }
    Ok(there.pop().unwrap_or_else(|| tile(0)))
}
