//! The pictures of a set while they are put to their roles: what names and pixels together tell.

use std::path::Path;

use super::channels::{Channels, is_constant};
use super::grouping::{self, Named, Set};
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::decode;
use crate::files::read::interpret::detect::normal_score;
use crate::files::read::note::{Note, Subject, Unused};
use crate::files::read::options::Reflectance;
use crate::files::read::pictures::Pictures;
use crate::files::read::raster::Raster;
use crate::files::read::reason::Reason;
use crate::files::read::role::Role;
use crate::files::read::stored::StoredMap;

/// An unlabelled picture is the normal map where this share of its pixels looks like normals.
const NORMAL_ALL_OVER: f64 = 0.95;

pub(crate) fn is_colour(role: Role) -> bool {
    matches!(role, Role::Base | Role::Diffuse | Role::Specular | Role::SpecularGlossiness)
}

/// The pictures of a set so far.
pub(crate) struct Reading<'a> {
    folder: &'a Path,
    /// The words of all the names of the set that have roles.
    files: &'a [Named],
    pub pictures: Pictures,
    pub notes: Vec<Note>,
    pub doubts: Vec<Assumption>,
    /// Whether all colours are floats.
    pub floats: bool,
    /// Whether alpha beside specular is the glossiness.
    pub is_glossy: bool,
}

impl<'a> Reading<'a> {
    pub(crate) fn new(folder: &'a Path, files: &'a [Named]) -> Self {
        let (pictures, notes, doubts) = (Pictures::default(), Vec::new(), Vec::new());
        Self { folder, files, pictures, notes, doubts, floats: true, is_glossy: false }
    }

    fn has_named(&self, is: impl Fn(Role) -> bool) -> bool {
        self.files.iter().any(|file| is(file.label.role))
    }

    fn doubt(&mut self, chosen: &str, why: Reason) {
        self.doubts.push(Assumption::new(What::Layout, chosen, why, Certainty::Unsure));
    }

    /// Another picture of the normals in place of a constant one.
    pub(crate) fn other_normals<'b>(
        &mut self,
        set: &'b Set,
        named: &Named,
        raster: &Raster,
    ) -> Option<(&'b Named, Raster, Vec<Note>)> {
        let other = set.normals.first().filter(|_| named.label.role == Role::Normal && is_flat(raster))?;
        let (raster, notes) =
            decode::decode_one(&self.folder.join(&other.file), Subject::Map(Role::Normal)).ok()?;
        if is_flat(&raster) {
            return None;
        }
        let why = Unused::Constant { other: other.file.clone() };
        self.notes.push(Note::Unused { what: named.file.clone(), why });
        Some((other, raster, notes))
    }

    /// Whether another picture of the normals is as good by its name, and not constant.
    pub(crate) fn is_contested(&self, set: &Set, named: &Named) -> bool {
        let is_equal = |other: &&Named| other.rank() == named.rank() && other.file != named.file;
        let is_normal = named.label.role == Role::Normal && !set.normals.iter().any(|n| n.file == named.file);
        let other = set.normals.iter().find(is_equal).filter(|_| is_normal);
        other.is_some_and(|other| {
            let decoded = decode::decode_one(&self.folder.join(&other.file), Subject::Map(Role::Normal));
            decoded.is_ok_and(|(raster, _)| !is_flat(&raster))
        })
    }

    /// Adds the picture that the file `named` holds.
    pub(crate) fn add(&mut self, named: &Named, mut raster: Raster) {
        let Named { file, label } = named;
        self.notes.push(Note::MapFile { map: label.role, file: file.clone() });
        self.floats &= raster.is_float() || !is_colour(label.role);
        if label.word == "ps" && self.files.iter().any(|f| f.label.word == "axay") {
            raster = raster.scaled(&[Reflectance::DIELECTRIC.value() as f32]);
            self.notes.push(Note::SpecularFactor { file: file.clone() });
        }
        let source = StoredMap { raster, file: self.folder.join(file), part: String::new() };
        match label.role {
            Role::SpecularGlossiness => self.add_glossy(source),
            // The two widths of a roughness are in red and green.
            Role::Roughness if label.word == "axay" => self.pictures.add(label.role, source),
            Role::Roughness | Role::Metallic => self.add_gray(label.role, source),
            role => self.pictures.add(role, source),
        }
    }

    /// Specular in red, green and blue, glossiness in alpha.
    fn add_glossy(&mut self, mut source: StoredMap) {
        let gloss = source.raster.alpha.take();
        if !self.has_named(|role| role == Role::Roughness) {
            // Alpha that is 1 everywhere is not kept.
            let raster =
                gloss.map_or_else(|| Raster::constant("alpha", &[1.0]), |gloss| source.raster.of(gloss));
            let gloss = StoredMap { raster, file: source.file.clone(), part: "alpha".to_owned() };
            self.pictures.add(Role::Roughness, gloss);
            self.is_glossy = true;
        }
        self.pictures.add(Role::Specular, source);
    }

    /// A picture that is named after a gray map, and may hold others.
    fn add_gray(&mut self, role: Role, source: StoredMap) {
        let file = source.file.clone();
        let channels = Channels::of(&source.raster);
        if channels != Channels::Gray && normal_score(&source.raster) > NORMAL_ALL_OVER {
            self.doubt(role.name(), Reason::LooksLikeNormals { map: role, file });
            return self.pictures.add(role, source);
        }
        let part = |channel: usize, part: &str| {
            let raster = source.raster.channel(channel);
            StoredMap { raster, file: source.file.clone(), part: part.to_owned() }
        };
        let lacks = |other: Role| !self.has_named(|role| role == other || role.packing().is_some());
        let (chosen, other) = match (channels, role) {
            (Channels::RoughnessMetallic, Role::Roughness) => {
                let metallic = lacks(Role::Metallic).then(|| (Role::Metallic, part(2, "blue")));
                (Some(part(1, "green")), metallic)
            }
            (Channels::RoughnessMetallic, _) => {
                let roughness = lacks(Role::Roughness).then(|| (Role::Roughness, part(1, "green")));
                (Some(part(2, "blue")), roughness)
            }
            (Channels::Roughness, Role::Roughness) => (Some(part(1, "green")), None),
            (Channels::Metallic, Role::Metallic) => (Some(part(2, "blue")), None),
            _ => (None, None),
        };
        let Some(chosen) = chosen else { return self.pictures.add(role, source) };
        let why = Reason::PackedChannels { map: role, file };
        self.doubt(&format!("{} in {}", role.name(), chosen.part), why.clone());
        self.pictures.add(role, chosen);
        if let Some((other, source)) = other {
            self.doubt(&format!("{} in {}", other.name(), source.part), why);
            self.pictures.add(other, source);
        }
    }

    /// Uses a picture whose name names no map where the set lacks normals and it looks like them, or where the set lacks
    /// a colour and it has the name of the set.
    pub(crate) fn rescue(&mut self, file: &str) {
        let decoded =
            || decode::decode_one(&self.folder.join(file), Subject::Picture).ok().map(|(raster, _)| raster);
        let of = |raster| StoredMap { raster, file: self.folder.join(file), part: String::new() };
        if !self.pictures.has(Role::Normal)
            && let Some(raster) = decoded().filter(|raster| normal_score(raster) > NORMAL_ALL_OVER)
        {
            self.pictures.add(Role::Normal, of(raster));
            return self.doubt(&format!("normal is {file}"), Reason::NormalPixels);
        }
        let is_set = self.files.iter().any(|named| grouping::is_named_as(file, &named.label.stem));
        let has_colour = self.pictures.has(Role::Base) || self.pictures.has(Role::Diffuse);
        if is_set
            && !has_colour
            && let Some(raster) = decoded()
        {
            self.floats &= raster.is_float();
            self.pictures.add(Role::Base, of(raster));
            return self
                .doubt(&format!("base colour is {file}"), Reason::NameOfSet { file: file.to_owned() });
        }
        self.notes.push(Note::Unused { what: file.to_owned(), why: Unused::Unlabelled });
    }
}

fn is_flat(raster: &Raster) -> bool {
    (0..3).all(|channel| is_constant(raster, channel))
}
