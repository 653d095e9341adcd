//! Inputs of a surface of MaterialX: their pictures and values, brought to an encoding that is known here.

use super::document::Mtlx;
use super::graph::{Affine, Bound, BoundPicture, Obstacle};
use super::surface_model::SurfaceInput;
use crate::error::Error;
use crate::read::options::transfer::ColourSpace;
use crate::read::options::{Albedo, Role};
use crate::read::raster::Raster;
use crate::read::record::{Certainty, Reason, Subject};
use crate::read::stored::{DecodedPicture, Field, Inferred, StoredMap};

/// Stored normals as nodes decode them: 2 n - 1.
const DECODED_NORMALS: Affine = Affine { scale: [2.0; 3], offset: [-1.0; 3] };

const NO_COLOUR_SPACE: &str =
    "the file declares no colorspace, and MaterialX converts nothing then; colours of 8 bits are mostly sRGB";

/// A surface and its decoded pictures, while its maps are recognized.
pub(super) struct MtlxSurface<'a> {
    pub located: &'a Mtlx,
    pub pictures: &'a [DecodedPicture],
    /// Its colours that have been read.
    pub colours: Vec<LoadedInput>,
}

/// An input that has been read.
pub(super) struct LoadedInput {
    pub source: StoredMap,
    /// How its colours are stored, where the file declares it.
    pub encoding: Inferred<Albedo>,
    /// The colour space some of whose colours Rec. 709 does not have.
    pub clipped: Option<String>,
}

impl LoadedInput {
    /// Numbers that are linear, as the specification or the document states.
    fn linear(source: StoredMap, encoding: Inferred<Albedo>) -> Self {
        Self { source, encoding, clipped: None }
    }

    /// The encoding; where the file declares none, the usual one of its samples.
    fn albedo(&self) -> Albedo {
        match &self.encoding {
            Some((albedo, ..)) => *albedo,
            None if self.source.raster.is_float() => Albedo::Linear,
            None => Albedo::Srgb,
        }
    }

    pub(super) fn colours(&self) -> Field {
        Field::of(&self.source, self.albedo())
    }

    pub(super) fn numbers(&self) -> Field {
        Field::of(&self.source, Albedo::Linear)
    }

    /// A colour has a colour space, a weight has none.
    pub(super) fn factor(&self) -> Field {
        if self.source.raster.channels.len() > 1 { self.colours() } else { self.numbers() }
    }

    /// Whether its colour space is not known.
    pub(super) fn is_doubtful(&self) -> bool {
        matches!(self.encoding, Some((.., Certainty::Unsure)))
    }
}

impl MtlxSurface<'_> {
    pub(super) fn refused(&self, name: &str, expected: &str, found: String) -> Error {
        Error::NotAMaterial {
            path: self.located.path.clone(),
            expected: format!("{expected} for {name}"),
            found,
            remedy: "bake it into a picture".to_owned(),
        }
    }

    pub(super) fn bound(&self, name: &str) -> Result<Option<&Bound>, Error> {
        self.located.bound(name).map(Result::as_ref).transpose().map_err(|obstacle| match obstacle {
            Obstacle::Procedural(node) => {
                self.refused(name, "a picture or a value", format!("the procedural node {node}"))
            }
            Obstacle::Nowhere(input) => {
                let found = format!("a connection of {input} that leads nowhere");
                self.refused(name, "a picture or a value", found)
            }
            Obstacle::Space(space) => {
                let found = format!("a normal map of {space} space");
                self.refused(name, "normals of tangent space", found)
            }
        })
    }

    /// The input, or its default by the specification.
    pub(super) fn input_or_default(&self, input: SurfaceInput, role: Role) -> Result<LoadedInput, Error> {
        let usual = || {
            let source = StoredMap::constant(&self.located.path, &[input.1]);
            LoadedInput::linear(source, encoding("lin_rec709"))
        };
        Ok(self.load(input.0, role)?.unwrap_or_else(usual))
    }

    /// The input, where the document declares it; of normals only pictures.
    pub(super) fn load(&self, name: &str, role: Role) -> Result<Option<LoadedInput>, Error> {
        Ok(match self.bound(name)? {
            None => None,
            Some(Bound::Values { .. }) if role == Role::Normal => None,
            Some(Bound::Values { values, space }) => {
                let source = StoredMap::constant(&self.located.path, values);
                Some(in_rec709(source, Some(space.as_deref().unwrap_or("lin_rec709"))))
            }
            Some(Bound::Picture(picture)) if role == Role::Normal => Some(self.normals(name, picture)?),
            Some(Bound::Picture(picture)) => Some(self.map(picture, role)?),
        })
    }

    fn normals(&self, name: &str, picture: &BoundPicture) -> Result<LoadedInput, Error> {
        let Affine { scale, offset } = picture.affine;
        let is_as_stored = picture.affine == Affine::default() || picture.affine == DECODED_NORMALS;
        // 1 - c turns the component around.
        let is_turned = (0..3).all(|c| [(1.0, 0.0), (-1.0, 1.0)].contains(&(scale[c], offset[c])));
        if picture.channel.is_some() || !(is_as_stored || is_turned) {
            let found = "a product or a sum of one".to_owned();
            return Err(self.refused(name, "a normal map", found));
        }
        let mut source = self.picture(&picture.file, Role::Normal)?.clone();
        if !is_as_stored {
            source =
                Field::of(&source, Albedo::Linear).affine(scale, offset).into_map(&source.file, "computed");
        }
        let source = source.scaled_normals(picture.scale.into());
        Ok(LoadedInput::linear(source, None))
    }

    fn map(&self, picture: &BoundPicture, role: Role) -> Result<LoadedInput, Error> {
        let whole = self.picture(&picture.file, role)?;
        let raster = picture.channel.map_or(whole.raster.clone(), |c| whole.raster.channel(c));
        // The document declares colour spaces, not the picture.
        let raster = Raster { to_rec709: None, ..raster };
        let (source, space) = (StoredMap { raster, ..whole.clone() }, picture.space.as_deref());
        let stored = match picture.is_colour && matches!(role, Role::Base | Role::Specular) {
            true => in_rec709(source, space),
            // A colour space does not concern numbers.
            false => LoadedInput::linear(source, space.and_then(encoding)),
        };
        let Affine { scale, offset } = picture.affine;
        if picture.affine == Affine::default() {
            return Ok(stored);
        }
        let field = if picture.is_colour { stored.factor() } else { stored.numbers() };
        let source = field.affine(scale, offset).into_map(&stored.source.file, "computed");
        let encoding = stored.encoding.filter(|(.., certainty)| *certainty == Certainty::Unsure);
        Ok(LoadedInput {
            source,
            encoding: encoding.or(self::encoding("lin_rec709")),
            clipped: stored.clipped,
        })
    }

    /// The decoded picture of a file that is read as this map.
    fn picture(&self, file: &str, role: Role) -> Result<&StoredMap, Error> {
        let path = self.located.path_of(file);
        let is_it = |one: &&DecodedPicture| one.map.file == path && one.subject == Subject::Map(role);
        let missing = || Error::Internal(format!("{} was not located", path.display()));
        self.pictures.iter().find(is_it).map(|picture| &picture.map).ok_or_else(missing)
    }
}

/// A map stored in `space`; linear with the primaries of Rec. 709 where that space is none of the usual encodings.
fn in_rec709(source: StoredMap, space: Option<&str>) -> LoadedInput {
    let Some(name) = space else {
        let is_undeclared = source.raster.channels.len() > 1 && !source.raster.is_float();
        let linear = (Albedo::Linear, Reason::measured(NO_COLOUR_SPACE), Certainty::Unsure);
        return LoadedInput::linear(source, is_undeclared.then_some(linear));
    };
    let encoding = encoding(name);
    match ColourSpace::of_name(name) {
        Some(space) if space.albedo().is_none() && source.raster.channels.len() > 2 => {
            let (field, is_clipped) = Field::converted(&source, space);
            let source = field.into_map(&source.file, &source.part);
            LoadedInput { source, encoding, clipped: is_clipped.then(|| name.to_owned()) }
        }
        _ => LoadedInput::linear(source, encoding),
    }
}

/// How colours of this colour space are stored once they are [brought to Rec. 709](in_rec709).
fn encoding(name: &str) -> Inferred<Albedo> {
    let space = ColourSpace::of_name(name);
    let is_known = space.is_some();
    let certainty = if is_known { Certainty::Sure } else { Certainty::Unsure };
    let albedo = space.and_then(|space| space.albedo()).unwrap_or(Albedo::Linear);
    let why = match is_known {
        true => Reason::stated(format!("the file declares {name}")),
        false => Reason::measured(format!("the file declares {name}, which is not known here")),
    };
    Some((albedo, why, certainty))
}
