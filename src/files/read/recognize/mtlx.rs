//! Surfaces of MaterialX: maps out of the pictures and values of their inputs.

use svbrdf_core::error::Error;

use super::field::{Field, reflectance, separated};
use super::roles::MapsByRole;
use super::scaled_normals::scaled;
use crate::read::decode::pictures::DecodedPicture;
use crate::read::located::mtlx::{Bound, BoundPicture, LocatedMtlx, Obstacle};
use crate::read::located::picture::{LocatedPicture, PictureSource};
use crate::read::located::surface_model::{Input, SurfaceModel, USD_SPECULAR, USE_SPECULAR};
use crate::read::options::{Albedo, NormalY, ReadOptions, Role};
use crate::read::record::{
    Assumption, Certainty, Note, Reason, SpaceKnown, StorageConvention, Subject, What,
};
use crate::read::stored::{Inferred, StoredMap, StoredMaterial};

/// The reflectance of a dielectric of the default refractive index 1.5.
const DEFAULT: f32 = 0.04;

/// The surface `located`, whose inputs lead to `pictures`.
///
/// # Errors
/// [`Error::NotAMaterial`] where an input is computed by other nodes, [`Error::MapSizesDiffer`] where maps that are
/// multiplied have another shape.
pub(super) fn material(
    located: &LocatedMtlx,
    pictures: Vec<DecodedPicture>,
    options: &ReadOptions,
) -> Result<StoredMaterial, Error> {
    let mut maps = MapsByRole::default();
    let albedo = MtlxMaps { located, pictures }.add_to(&mut maps)?;
    let mut found = maps.material(&located.path, located.name.clone(), "", options)?;
    found.add_file(located.path.clone());
    found.inferred.specular = albedo.clone();
    found.inferred.albedo = albedo;
    let why = StorageConvention::MaterialXNormals.into();
    found.inferred.normal_y = Some((NormalY::Up, why, Certainty::Likely));
    let layout =
        Assumption::new(What::Layout, "MaterialX", StorageConvention::ListedTextures, Certainty::Sure);
    found.assumptions.insert(0, layout);
    if !located.not_modelled.is_empty() {
        found.notes.push(Note::NotModelled { features: located.not_modelled.clone() });
    }
    let (names, index) = located.surfaces.clone();
    if names.len() > 1 {
        found.notes.push(Note::Materials { names, index });
    }
    Ok(found)
}

/// A surface while its maps are recognized.
struct MtlxMaps<'a> {
    located: &'a LocatedMtlx,
    pictures: Vec<DecodedPicture>,
}

/// An input that has been read.
struct LoadedInput {
    source: StoredMap,
    /// The colour space that the file declares.
    space: Option<String>,
}

impl LoadedInput {
    /// The colour space; where the file declares none, the usual one of its samples.
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

impl MtlxMaps<'_> {
    /// Adds the maps of the inputs to `maps`; returns the encoding of their colours, where the document declares it.
    fn add_to(&self, maps: &mut MapsByRole) -> Result<Inferred<Albedo>, Error> {
        let SurfaceModel { base, metallic, roughness, normal, .. } = *self.located.model;
        if let Some(normal) = self.load((normal, 0.0), Role::Normal)? {
            maps.add(Role::Normal, normal.source);
        }
        maps.add(Role::Roughness, self.input_or_default(roughness, Role::Roughness)?.source);
        let metallic = self.input_or_default(metallic, Role::Metallic)?;
        let base = self.input_or_default(base, Role::Base)?;
        self.bound(USE_SPECULAR)?;
        if self.located.is_specular_usd() {
            let specular = self.input_or_default(USD_SPECULAR, Role::Specular)?;
            maps.add(Role::Diffuse, self.computed(base.colours(), "diffuseColor"));
            maps.add(Role::Specular, self.computed(specular.colours(), "specularColor"));
            return Ok(self.linear());
        }
        let dielectric = self.dielectric()?;
        let weight =
            self.located.model.weight.map(|weight| self.input_or_default(weight, Role::Base)).transpose()?;
        let weight = weight.map_or(Field::constant(&[1.0]), |weight| weight.numbers());
        if dielectric.is(DEFAULT) && weight.is(1.0) {
            let space = base.space.as_deref().map(colour_space);
            maps.add(Role::Metallic, metallic.source);
            maps.add(Role::Base, base.source);
            return Ok(space);
        }
        let base = base.colours().times(weight)?;
        let [diffuse, specular] = separated(base, metallic.numbers(), dielectric)?;
        maps.add(Role::Diffuse, self.computed(diffuse, "base colour and metallic"));
        maps.add(Role::Specular, self.computed(specular, "specular, its colour and index of refraction"));
        Ok(self.linear())
    }

    fn computed(&self, field: Field, part: &str) -> StoredMap {
        field.into_map(&self.located.path, part)
    }

    /// The encoding of colours that are computed.
    fn linear(&self) -> Inferred<Albedo> {
        Some((Albedo::Linear, StorageConvention::MaterialXSurface.into(), Certainty::Sure))
    }

    /// The reflectance of the dielectric at normal incidence.
    fn dielectric(&self) -> Result<Field, Error> {
        let ior = match self.bound(self.located.model.ior.0)? {
            Some(Bound::Values { values, .. }) => values.first().copied().unwrap_or(self.located.model.ior.1),
            Some(Bound::Picture(_)) => {
                return Err(self.refused(self.located.model.ior.0, "a value", "a picture".to_owned()));
            }
            None => self.located.model.ior.1,
        };
        self.located.model.specular.iter().try_fold(
            Field::constant(&[reflectance(ior)]),
            |product, &factor| {
                let factor = self.input_or_default(factor, Role::Specular)?;
                // A colour has a colour space, a weight has none.
                let field =
                    if factor.source.raster.channels.len() > 1 { factor.colours() } else { factor.numbers() };
                product.times(field)
            },
        )
    }

    fn refused(&self, name: &str, expected: &str, found: String) -> Error {
        Error::NotAMaterial {
            path: self.located.path.clone(),
            expected: format!("{expected} for {name}"),
            found,
            remedy: "bake it into a picture".to_owned(),
        }
    }

    fn bound(&self, name: &str) -> Result<Option<&Bound>, Error> {
        self.located.bound(name).map(Result::as_ref).transpose().map_err(|obstacle| {
            let found = match obstacle {
                Obstacle::Procedural(node) => format!("the procedural node {node}"),
                Obstacle::Nowhere(input) => format!("a connection of {input} that leads nowhere"),
            };
            self.refused(name, "a picture or a value", found)
        })
    }

    /// The input, or its default by the specification.
    fn input_or_default(&self, input: Input, role: Role) -> Result<LoadedInput, Error> {
        let usual = || LoadedInput {
            source: StoredMap::constant(&self.located.path, &[input.1]),
            space: Some("lin_rec709".to_owned()),
        };
        Ok(self.load(input, role)?.unwrap_or_else(usual))
    }

    fn load(&self, (name, _): Input, role: Role) -> Result<Option<LoadedInput>, Error> {
        Ok(match self.bound(name)? {
            None => None,
            Some(Bound::Values { .. }) if role == Role::Normal => None,
            Some(Bound::Values { values, space }) => {
                let space = space.clone().or_else(|| Some("lin_rec709".to_owned()));
                Some(LoadedInput { source: StoredMap::constant(&self.located.path, values), space })
            }
            Some(Bound::Picture(BoundPicture { file, space, channel, scale })) => {
                let whole = self.picture(file, role)?;
                let raster = channel.map_or(whole.raster.clone(), |c| whole.raster.channel(c));
                let source = StoredMap { raster, ..whole.clone() };
                let source = if role == Role::Normal { scaled(source, (*scale).into()) } else { source };
                Some(LoadedInput { source, space: space.clone() })
            }
        })
    }

    /// The decoded picture of a file that is read as this map.
    fn picture(&self, file: &str, role: Role) -> Result<&StoredMap, Error> {
        let path = self.located.path_of(file);
        let is_it = |(one, _): &(&LocatedPicture, _)| {
            matches!(&one.source, PictureSource::File(file) if file.path() == path)
                && one.subject == Subject::Map(role)
        };
        let found = self.located.pictures.iter().zip(&self.pictures).find(is_it);
        let missing = || Error::Internal(format!("{} was not located", path.display()));
        found.map(|(_, picture)| &picture.map).ok_or_else(missing)
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
