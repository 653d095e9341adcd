//! MaterialX: the pictures and values of the surfaces `standard_surface`, `gltf_pbr`, `open_pbr_surface` and
//! `UsdPreviewSurface`.

mod graph;
mod model;

use std::fs;
use std::path::{Path, PathBuf};

use roxmltree::{Document, Node};

use super::ahead::Ahead;
use super::principled::{Field, reflectance, separated};
use super::scaled_normals::scaled;
use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::locate::names::Role;
use crate::files::read::note::{Note, Subject};
use crate::files::read::options::{Albedo, NormalY, ReadOptions};
use crate::files::read::pictures::Pictures;
use crate::files::read::reason::{Reason, SpaceKnown};
use crate::files::read::storage_convention::StorageConvention;
use crate::files::read::stored::{Inferred, StoredMap, StoredMaterial};
use crate::progress::Progress;
use graph::{Bound, Obstacle, bound};
use model::{Input, SurfaceModel, USD_SPECULAR};

/// The reflectance of a dielectric of the usual refractive index 1.5.
const USUAL: f32 = 0.04;

/// Reads surface number `exemplar` of the file `path`.
///
/// # Errors
/// As `read`.
pub(crate) fn open(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<StoredMaterial, Error> {
    let text = fs::read_to_string(path).map_err(|source| Error::unreadable(path, source))?;
    let document = Document::parse(&text).map_err(|e| Error::BadImage {
        path: path.to_owned(),
        problem: format!("expected MaterialX, found: {e}"),
        remedy: "export it again".to_owned(),
    })?;
    let surfaces: Vec<_> =
        document.descendants().filter_map(|node| Some((node, SurfaceModel::of(node)?))).collect();
    let index = options.exemplar_of(surfaces.len(), path)?;
    let &(node, model) = surfaces.get(index).ok_or_else(|| Error::NotAMaterial {
        path: path.to_owned(),
        expected: format!("one of {}", SurfaceModel::names()),
        found: "none of them".to_owned(),
        remedy: "translate the material to one of them".to_owned(),
    })?;
    let files = listed(path, node, model);
    let surface = MtlxSurface { path, node, model, ahead: Ahead::of(files, progress)? };
    let mut pictures = Pictures::default();
    let albedo = surface.put(&mut pictures)?;
    let name = node.attribute("name").unwrap_or("material").to_owned();
    let mut found = pictures.assemble(path, name, "", options)?;
    found.files.push(path.to_owned());
    found.files.sort();
    found.files.dedup();
    found.inferred.specular = albedo.clone();
    found.inferred.albedo = albedo;
    let why = StorageConvention::MaterialXNormals.into();
    found.inferred.normal_y = Some((NormalY::Up, why, Certainty::Likely));
    let layout =
        Assumption::new(What::Layout, "MaterialX", StorageConvention::ListedTextures, Certainty::Sure);
    found.assumptions.insert(0, layout);
    let features = model.ignored(node);
    if !features.is_empty() {
        found.notes.push(Note::NotModelled { features });
    }
    if surfaces.len() > 1 {
        let name = |(node, _): &(Node<'_, '_>, _)| node.attribute("name").unwrap_or("material").to_owned();
        found.notes.push(Note::Materials { names: surfaces.iter().map(name).collect(), index });
    }
    Ok(found)
}

/// The pictures that the inputs of a surface lead to, and what they are expected to be.
fn listed(path: &Path, node: Node<'_, '_>, model: &SurfaceModel) -> Vec<(PathBuf, Subject)> {
    let roles = [
        (model.normal, Role::Normal),
        (model.roughness.0, Role::Roughness),
        (model.metallic.0, Role::Metallic),
        (model.base.0, Role::Base),
    ];
    let weight = model.weight.map(|(name, _)| (name, Role::Base));
    let specular = model.specular.iter().map(|(name, _)| (*name, Role::Specular));
    let picture = |(name, role)| match bound(node, name) {
        Ok(Some(Bound::File { file, .. })) => Some((resolved(path, &file), Subject::Map(role))),
        _ => None,
    };
    roles.into_iter().chain(weight).chain(specular).filter_map(picture).collect()
}

/// The surface that is read.
struct MtlxSurface<'a, 'd> {
    path: &'a Path,
    node: Node<'a, 'd>,
    model: &'static SurfaceModel,
    ahead: Ahead,
}

/// An input that has been read.
struct LoadedInput {
    source: StoredMap,
    /// The colour space that the file says.
    space: Option<String>,
}

impl LoadedInput {
    /// The colour space: where the file says none, that which its samples have by custom.
    fn albedo(&self) -> Albedo {
        match &self.space {
            Some(space) => colour_space(space).0,
            None if self.source.raster.is_float() => Albedo::Linear,
            None => Albedo::Srgb,
        }
    }

    fn colours(&self) -> Field {
        Field::of(&self.source, self.albedo())
    }

    fn numbers(&self) -> Field {
        Field::of(&self.source, Albedo::Linear)
    }
}

impl MtlxSurface<'_, '_> {
    /// Reads the inputs; returns what is said about colours.
    fn put(&self, pictures: &mut Pictures) -> Result<Inferred<Albedo>, Error> {
        let SurfaceModel { base, metallic, roughness, normal, .. } = *self.model;
        if let Some(normal) = self.load((normal, 0.0), Role::Normal)? {
            pictures.add(Role::Normal, normal.source);
        }
        pictures.add(Role::Roughness, self.said(roughness, Role::Roughness)?.source);
        let metallic = self.said(metallic, Role::Metallic)?;
        let base = self.said(base, Role::Base)?;
        if self.is_specular_usd()? {
            let specular = self.said(USD_SPECULAR, Role::Specular)?;
            pictures.add(Role::Diffuse, self.computed(base.colours(), "diffuseColor"));
            pictures.add(Role::Specular, self.computed(specular.colours(), "specularColor"));
            return Ok(self.linear());
        }
        let dielectric = self.dielectric()?;
        let weight = self.model.weight.map(|weight| self.said(weight, Role::Base)).transpose()?;
        let weight = weight.map_or(Field::constant(&[1.0]), |weight| weight.numbers());
        if dielectric.is(USUAL) && weight.is(1.0) {
            let space = base.space.as_deref().map(colour_space);
            pictures.add(Role::Metallic, metallic.source);
            pictures.add(Role::Base, base.source);
            return Ok(space);
        }
        let base = base.colours().times(weight)?;
        let [diffuse, specular] = separated(base, metallic.numbers(), dielectric)?;
        pictures.add(Role::Diffuse, self.computed(diffuse, "base colour and metallic"));
        pictures.add(Role::Specular, self.computed(specular, "specular, its colour and index of refraction"));
        Ok(self.linear())
    }

    fn computed(&self, field: Field, part: &str) -> StoredMap {
        field.into_source(self.path, part)
    }

    /// What is said of colours that are computed.
    fn linear(&self) -> Inferred<Albedo> {
        Some((Albedo::Linear, StorageConvention::MaterialXSurface.into(), Certainty::Sure))
    }

    fn is_specular_usd(&self) -> Result<bool, Error> {
        let said = self.bound("useSpecularWorkflow")?;
        Ok(matches!(said, Some(Bound::Values { values, .. }) if values.first().is_some_and(|v| *v != 0.0)))
    }

    /// What the dielectric reflects at normal incidence.
    fn dielectric(&self) -> Result<Field, Error> {
        let ior = match self.bound(self.model.ior.0)? {
            Some(Bound::Values { values, .. }) => values.first().copied().unwrap_or(self.model.ior.1),
            Some(Bound::File { .. }) => {
                return Err(self.refused(self.model.ior.0, "a value", "a picture".to_owned()));
            }
            None => self.model.ior.1,
        };
        self.model.specular.iter().try_fold(Field::constant(&[reflectance(ior)]), |product, &factor| {
            let factor = self.said(factor, Role::Specular)?;
            // A colour has a colour space, a weight has none.
            let field =
                if factor.source.raster.channels.len() > 1 { factor.colours() } else { factor.numbers() };
            product.times(field)
        })
    }

    fn refused(&self, name: &str, expected: &str, found: String) -> Error {
        Error::NotAMaterial {
            path: self.path.to_owned(),
            expected: format!("{expected} for {name}"),
            found,
            remedy: "bake it into a picture".to_owned(),
        }
    }

    fn bound(&self, name: &str) -> Result<Option<Bound>, Error> {
        bound(self.node, name).map_err(|obstacle| {
            let found = match obstacle {
                Obstacle::Procedural(node) => format!("the procedural node {node}"),
                Obstacle::Nowhere(input) => format!("a connection of {input} that leads nowhere"),
            };
            self.refused(name, "a picture or a value", found)
        })
    }

    /// The input, or its value by the specification.
    fn said(&self, input: Input, role: Role) -> Result<LoadedInput, Error> {
        let usual = || LoadedInput {
            source: StoredMap::constant(self.path, &[input.1]),
            space: Some("lin_rec709".to_owned()),
        };
        Ok(self.load(input, role)?.unwrap_or_else(usual))
    }

    fn load(&self, (name, _): Input, role: Role) -> Result<Option<LoadedInput>, Error> {
        Ok(match self.bound(name)? {
            None => None,
            Some(Bound::Values { .. }) if role == Role::Normal => None,
            Some(Bound::Values { values, space }) => {
                let space = space.or_else(|| Some("lin_rec709".to_owned()));
                Some(LoadedInput { source: StoredMap::constant(self.path, &values), space })
            }
            Some(Bound::File { file, space, channel, scale }) => {
                let file = resolved(self.path, &file);
                let whole = self.ahead.picture(&file, Subject::Map(role))?.0;
                let raster = channel.map_or(whole.clone(), |c| whole.channel(c));
                let source = StoredMap { raster, file, part: String::new() };
                let source = if role == Role::Normal { scaled(source, scale.into()) } else { source };
                Some(LoadedInput { source, space })
            }
        })
    }
}

fn colour_space(space: &str) -> (Albedo, Reason, Certainty) {
    let (albedo, known, certainty) = match space {
        "srgb_texture" | "srgb" | "srgb_rec709_scene" => (Albedo::Srgb, SpaceKnown::Exactly, Certainty::Sure),
        "lin_rec709" | "lin_rec709_scene" | "none" | "raw" => {
            (Albedo::Linear, SpaceKnown::Exactly, Certainty::Sure)
        }
        "gamma22" | "g22_rec709" | "g22_rec709_scene" => {
            (Albedo::Gamma22, SpaceKnown::Exactly, Certainty::Sure)
        }
        "gamma18" | "gamma24" => (Albedo::Gamma22, SpaceKnown::Nearly, Certainty::Unsure),
        _ => (Albedo::Linear, SpaceKnown::Unknown, Certainty::Unsure),
    };
    (albedo, Reason::ColourSpace { space: space.to_owned(), known }, certainty)
}

/// A file beside the document, or a path of its own.
fn resolved(path: &Path, file: &str) -> PathBuf {
    let prefix = path.parent().unwrap_or(Path::new(""));
    prefix.join(file)
}
