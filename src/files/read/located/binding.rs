//! Bindings: maps that are specified one by one.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use svbrdf_core::error::Error;

use crate::open::NamedFile;
use crate::paths::{absolute, relative};
use crate::read::options::Role;

/// A binding with its file.
#[derive(Debug)]
pub(crate) struct LocatedBinding {
    pub role: Role,
    pub file: NamedFile,
    /// r, g, b, a, or the name of a layer; `None` for the only picture of the file.
    pub part: Option<String>,
}

/// `normal=FILE`, or `roughness=FILE:g` for one channel or layer of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    role: Role,
    file: PathBuf,
    /// r, g, b, a, or the name of a layer.
    part: Option<String>,
}

/// The maps that can be specified.
const ROLES: [(&str, Role); 6] = [
    ("normal", Role::Normal),
    ("diffuse", Role::Diffuse),
    ("base", Role::Base),
    ("specular", Role::Specular),
    ("roughness", Role::Roughness),
    ("metallic", Role::Metallic),
];

impl FromStr for Binding {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let (name, file) = text.split_once('=').unwrap_or((text, ""));
        let role = ROLES.into_iter().find(|(known, _)| *known == name).map(|(_, role)| role);
        let (Some(role), false) = (role, file.is_empty()) else {
            return Err(Error::UnknownName {
                what: "map",
                found: text.to_owned(),
                known: format!(
                    "{}, each as in normal=FILE or roughness=FILE:g",
                    ROLES.map(|(n, _)| n).join(", ")
                ),
            });
        };
        let (file, part) = match file.rsplit_once(':') {
            Some((file, part)) if !file.is_empty() && !part.contains(['/', '\\']) => {
                (file, Some(part.to_owned()))
            }
            _ => (file, None),
        };
        Ok(Self { role, file: file.into(), part: part.filter(|part| part != "rgb") })
    }
}

impl Binding {
    pub(crate) fn role(&self) -> Role {
        self.role
    }

    /// r, g, b, a, or the name of a layer.
    pub(crate) fn part(&self) -> Option<&str> {
        self.part.as_deref()
    }

    pub(crate) fn file(&self) -> &Path {
        &self.file
    }

    /// The same as the sidecar file `sidecar` has it: the path of the file is relative to its folder.
    ///
    /// # Errors
    /// [`Error::Outside`].
    pub(crate) fn named_by(self, sidecar: &Path) -> Result<Self, Error> {
        let file = NamedFile::within(&self.file, sidecar);
        file.check()?;
        Ok(Self { file: file.path().to_owned(), ..self })
    }

    /// The name of the map, and `FILE` or `FILE:PART` relative to `folder`.
    pub(crate) fn relative_to(&self, folder: &Path) -> (&'static str, String) {
        let file = relative(&absolute(&self.file), &absolute(folder));
        let file = file.display();
        let name = ROLES.iter().find(|(_, role)| *role == self.role).map_or("", |(name, _)| name);
        let part = self.part.as_ref().map(|part| format!(":{part}")).unwrap_or_default();
        (name, format!("{file}{part}"))
    }
}
