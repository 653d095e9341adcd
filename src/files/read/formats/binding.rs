//! Bindings: maps that are specified one by one.

use std::path::Path;
use std::str::FromStr;

use svbrdf_core::error::Error as CoreError;

use super::picture;
use crate::disk::open::NamedFile;
use crate::disk::paths::{absolute, relative};
use crate::error::Error;
use crate::read::decode::{self, Layer};
use crate::read::names::listing;
use crate::read::options::Role;
use crate::read::record::Subject;
use crate::read::stored::StoredMap;

/// `normal=FILE`, `roughness=FILE:g` for one channel or layer of the file, or `roughness=0.5` for a constant.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    role: Role,
    source: Source,
}

#[derive(Clone, Debug, PartialEq)]
enum Source {
    /// The part is r, g, b, a, or the name of a layer.
    File { file: NamedFile, part: Option<String> },
    /// The value, or red, green and blue.
    Constant(Vec<f32>),
}

const ROLES: [(&str, Role); 6] = [
    ("normal", Role::Normal),
    ("diffuse", Role::Diffuse),
    ("base", Role::Base),
    ("specular", Role::Specular),
    ("roughness", Role::Roughness),
    ("metallic", Role::Metallic),
];

impl FromStr for Binding {
    type Err = CoreError;

    fn from_str(text: &str) -> Result<Self, CoreError> {
        let (name, file) = text.split_once('=').unwrap_or((text, ""));
        let role = ROLES.into_iter().find(|(known, _)| *known == name).map(|(_, role)| role);
        let (Some(role), false) = (role, file.is_empty()) else {
            return Err(CoreError::unknown_name(
                "map",
                if role.is_some() { text } else { name },
                format!(
                    "{}, each as in normal=FILE, roughness=FILE:g or roughness=0.5",
                    ROLES.map(|(n, _)| n).join(", ")
                ),
            ));
        };
        if let Some(values) = constant(file).filter(|values| values.len() == 1 || role.is_colour()) {
            return Ok(Self { role, source: Source::Constant(values) });
        }
        if file.split(',').all(|number| number.trim().parse::<f32>().is_ok()) && !Path::new(file).exists() {
            let known = "a number from 0 to 1; diffuse, base and specular also three: 0.2,0.1,0.1";
            return Err(CoreError::unknown_name("constant of a map", file, known));
        }
        let (file, part) = match file.rsplit_once(':') {
            Some((file, part)) if !file.is_empty() && !part.contains(['/', '\\']) => {
                (file, Some(part.to_owned()))
            }
            _ => (file, None),
        };
        let (file, part) = (NamedFile::by_user(file), part.filter(|part| part != "rgb"));
        Ok(Self { role, source: Source::File { file, part } })
    }
}

/// Numbers of [0, 1]: one, or three for red, green and blue.
fn constant(text: &str) -> Option<Vec<f32>> {
    let number = |text: &str| text.trim().parse().ok().filter(|value| (0.0..=1.0).contains(value));
    let values: Vec<f32> = text.split(',').map(number).collect::<Option<_>>()?;
    matches!(values.len(), 1 | 3).then_some(values)
}

impl Binding {
    pub(crate) fn role(&self) -> Role {
        self.role
    }

    /// The file; `None` of a constant.
    pub(crate) fn file(&self) -> Option<&NamedFile> {
        match &self.source {
            Source::File { file, .. } => Some(file),
            Source::Constant(_) => None,
        }
    }

    /// Reads its map.
    ///
    /// # Errors
    /// [`Error::BadImage`] where the file has no such part; [`Error::Unreadable`].
    pub(super) fn read(&self) -> Result<(Role, StoredMap), Error> {
        let (role, what) = (self.role, Subject::Map(self.role));
        let (named, part) = match &self.source {
            Source::File { file, part } => (file, part.clone()),
            Source::Constant(values) => return Ok((role, StoredMap::specified(values))),
        };
        let file = named.path().to_owned();
        let Some(part) = part else {
            let raster = decode::one(named, what)?.0.raster;
            return Ok((role, StoredMap { raster, file, part: String::new() }));
        };
        let mut all = decode::whole(named, what)?.layers;
        let channel = ["r", "g", "b", "a"].iter().position(|letter| *letter == part);
        let raster = match (all.iter().position(|layer| layer.name == part), channel, all.as_slice()) {
            (Some(place), ..) => Some(all.swap_remove(place).raster),
            (None, Some(3), [Layer { raster, .. }]) => raster.alpha.clone().map(|alpha| raster.of(alpha)),
            (None, Some(channel), [Layer { raster, .. }]) => {
                raster.channels.get(channel).map(|plane| raster.of(plane.clone()))
            }
            _ => None,
        };
        let names: Vec<_> = all.iter().map(picture::name).collect();
        let raster = raster.ok_or_else(|| Error::BadImage {
            path: file.clone(),
            problem: format!("{what}: expected the part {part}, found {}", listing(&names)),
            remedy: "name a channel (r, g, b, a) that it has, or one of its layers".to_owned(),
        })?;
        Ok((role, StoredMap { raster, file, part }))
    }
    /// The same as the sidecar file `sidecar` has it: the path of the file is relative to its folder.
    ///
    /// # Errors
    /// [`Error::Outside`].
    pub(crate) fn named_by(mut self, sidecar: &Path) -> Result<Self, Error> {
        if let Source::File { file, .. } = &mut self.source {
            *file = NamedFile::within(file.path(), sidecar);
            file.check()?;
        }
        Ok(self)
    }

    /// The name of the map, and `FILE` or `FILE:PART` relative to `folder`, or the constant.
    pub(crate) fn relative_to(&self, folder: &Path) -> (&'static str, String) {
        let name = ROLES.iter().find(|(_, role)| *role == self.role).map_or("", |(name, _)| name);
        let text = match &self.source {
            Source::Constant(values) => values.iter().map(f32::to_string).collect::<Vec<_>>().join(","),
            Source::File { file, part } => {
                let part = part.as_ref().map(|part| format!(":{part}")).unwrap_or_default();
                format!("{}{part}", relative(&absolute(file.path()), &absolute(folder)).display())
            }
        };
        (name, text)
    }
}
