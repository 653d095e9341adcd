//! What has been found of a material, still as stored.

use std::path::{Path, PathBuf};

use super::assumption::{Assumption, Certainty, What};
use super::names::Role;
use super::options::{Albedo, NormalY, Roughness};
use super::raster::Raster;
use crate::error::Error;

/// A map as stored.
#[derive(Clone, Debug)]
pub struct Source {
    pub raster: Raster,
    pub file: PathBuf,
    /// Layer, channel or tile within the file, for people; may be empty.
    pub part: String,
}

/// What a convention says about stored values, with why and how surely. `None` where it says nothing.
#[derive(Clone, Debug, Default)]
pub struct Hints {
    pub albedo: Hint<Albedo>,
    pub specular: Hint<Albedo>,
    pub roughness: Hint<Roughness>,
    pub normal_y: Hint<NormalY>,
}

/// A choice, why, and how surely.
pub type Hint<T> = Option<(T, String, Certainty)>;

/// The maps of a material as stored, and what is known about them.
#[derive(Debug)]
pub struct Found {
    pub name: String,
    pub normal: Option<Source>,
    /// Diffuse, or the base colour where there is `metallic`.
    pub colour: Source,
    pub specular: Option<Source>,
    pub roughness: Source,
    pub metallic: Option<Source>,
    pub hints: Hints,
    pub assumptions: Vec<Assumption>,
    /// What the user may want to know, one sentence each.
    pub notes: Vec<String>,
    /// Every file that was read, once.
    pub files: Vec<PathBuf>,
}

/// The pictures of a material by their role.
#[derive(Debug, Default)]
pub struct Pictures {
    all: Vec<(Role, Source)>,
}

impl Pictures {
    pub fn add(&mut self, role: Role, source: Source) {
        self.all.push((role, source));
    }

    pub fn has(&self, role: Role) -> bool {
        self.all.iter().any(|(r, _)| *r == role)
    }

    fn take(&mut self, role: Role) -> Option<Source> {
        let place = self.all.iter().position(|(r, _)| *r == role)?;
        Some(self.all.swap_remove(place).1)
    }

    /// Takes the channel at `channel` of a packed picture as a picture of its own.
    fn channel(&self, role: Role, channel: usize, name: &str) -> Option<Source> {
        let (_, source) = self.all.iter().find(|(r, s)| *r == role && s.raster.channels.len() == 3)?;
        let part = format!(
            "{}{name}",
            if source.part.is_empty() { String::new() } else { format!("{}, ", source.part) }
        );
        Some(Source { raster: source.raster.channel(channel), file: source.file.clone(), part })
    }

    fn roughness(&mut self) -> Option<Source> {
        self.take(Role::Roughness)
            .or_else(|| self.channel(Role::OcclusionRoughnessMetallic, 1, "green"))
            .or_else(|| self.channel(Role::RoughnessMetallicOcclusion, 0, "red"))
    }

    fn metallic(&mut self) -> Option<Source> {
        self.take(Role::Metallic)
            .or_else(|| self.channel(Role::OcclusionRoughnessMetallic, 2, "blue"))
            .or_else(|| self.channel(Role::RoughnessMetallicOcclusion, 1, "green"))
    }

    /// Chooses the workflow and puts the maps in their places; `path` is what the user gave, `listed` what is there.
    ///
    /// # Errors
    /// [`Error::NotAMaterial`] without a colour or without roughness.
    pub fn into_found(mut self, path: &Path, name: String, listed: &str) -> Result<Found, Error> {
        let missing = |role: Role| Error::NotAMaterial {
            path: path.to_owned(),
            expected: format!(
                "one picture for the {} map (named {})",
                role.name(),
                role.words()[..3].join(", ")
            ),
            found: listed.to_owned(),
            remedy: "add or rename the file".to_owned(),
        };
        let mut assumptions = Vec::new();
        let mut files: Vec<_> = self.all.iter().map(|(_, source)| source.file.clone()).collect();
        files.sort();
        files.dedup();
        if let Some((_, source)) = self.all.iter().find(|(r, _)| *r == Role::RoughnessMetallicOcclusion) {
            assumptions.push(Assumption::new(
                What::Layout,
                "red roughness, green metallic, blue occlusion",
                format!("by the name of {}; such packings differ", source.file.display()),
                Certainty::Unsure,
            ));
        }
        let normal = self.take(Role::Normal);
        let roughness = self.roughness();
        let metallic = self.metallic();
        let specular = self.take(Role::Specular);
        let (base, diffuse) = (self.take(Role::Base), self.take(Role::Diffuse));
        let use_metallic = metallic.is_some() && (base.is_some() || specular.is_none());
        let colour = if use_metallic { base.or(diffuse) } else { diffuse.or(base) };
        if normal.is_none() && colour.is_none() && roughness.is_none() {
            return Err(missing(Role::Normal));
        }
        let colour = colour.ok_or_else(|| missing(Role::Diffuse))?;
        let roughness = roughness.ok_or_else(|| missing(Role::Roughness))?;
        let (chosen, why) = match (use_metallic, specular.is_some()) {
            (true, _) => ("metallic", "there is a metallic map: d = b (1 - m), s = 0.04 (1 - m) + b m"),
            (false, true) => ("specular", "there is a specular map"),
            (false, false) => ("specular", "there is neither a specular nor a metallic map"),
        };
        assumptions.push(Assumption::new(What::Workflow, chosen, why, Certainty::Sure));
        Ok(Found {
            name,
            normal,
            colour,
            specular: if use_metallic { None } else { specular },
            roughness,
            metallic: if use_metallic { metallic } else { None },
            hints: Hints::default(),
            assumptions,
            notes: Vec::new(),
            files,
        })
    }
}
