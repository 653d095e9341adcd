//! Sets of pictures, one for each map: the maps that they hold, by names and pixels together.

use svbrdf_core::error::Error;

use super::hints;
use super::roles::MapsByRole;
use crate::read::decode::{self, pictures::DecodedPicture};
use crate::read::located::set::{LabelledFile, LocatedSet, NUMBERED};
use crate::read::measure::{Channels, NORMAL_AT_LEAST, is_flat, normal_score};
use crate::read::names::is_named_as;
use crate::read::options::{ReadOptions, Reflectance, Role, Workflow};
use crate::read::raster::Raster;
use crate::read::record::{Assumption, Certainty, Note, Reason, SpecifiedBy, Subject, Unused, What};
use crate::read::stored::{StoredMap, StoredMaterial};

/// An unlabelled picture is the normal map where this share of its pixels looks like normals.
const NORMAL_ALL_OVER: f64 = 0.95;

/// The material of the set `located`, whose files hold `pictures`, with the maps `bound`.
///
/// # Errors
/// [`Error::NotAMaterial`] where maps are missing, or several pictures are equally the normal map.
pub(super) fn material(
    located: &LocatedSet,
    pictures: Vec<DecodedPicture>,
    bound: &[(Role, StoredMap)],
    options: &ReadOptions,
) -> Result<StoredMaterial, Error> {
    let mut set = PartialSet::new(located);
    for (file, DecodedPicture { map, notes }) in located.files.files.iter().zip(pictures) {
        let (file, raster, notes) = match set.other_normals(file, &map.raster) {
            Some(other) => other,
            None => (file, map.raster, notes),
        };
        if set.is_contested(file) {
            return Err(two_pictures(located, file, &located.files.other_normals[0]));
        }
        set.notes.extend(notes);
        let is_normal = file.label.role == Role::Normal;
        if file.label.word == NUMBERED && is_normal && normal_score(&raster) < NORMAL_AT_LEAST {
            return Err(numbers_mislead(located, &file.file));
        }
        set.add(file, raster);
    }
    // A caller who specifies a specular map wants it to be used.
    let has_specular = bound.iter().any(|(role, _)| *role == Role::Specular) && options.workflow.is_none();
    let workflow = if has_specular { Some(Workflow::Specular) } else { options.workflow };
    for (role, map) in bound {
        set.notes.push(Note::MapSpecified { map: *role, file: map.file.clone(), by: SpecifiedBy::Caller });
        set.are_floats &= map.raster.is_float() || !is_colour(*role);
        set.maps.replace(*role, map.clone());
    }
    for file in &located.files.unlabelled {
        set.rescue(file);
    }
    let PartialSet { maps, mut notes, are_floats, mut doubts, is_glossy, .. } = set;
    let options = &ReadOptions { workflow, ..*options };
    let mut found = maps.material(&located.path, located.name.clone(), &located.listing, options)?;
    found.assumptions.append(&mut doubts);
    hints::add(&mut found, located, are_floats, is_glossy);
    notes.extend(located.files.notes.iter().cloned());
    notes.append(&mut found.notes);
    Ok(StoredMaterial { notes, ..found })
}

fn is_colour(role: Role) -> bool {
    matches!(role, Role::Base | Role::Diffuse | Role::Specular | Role::SpecularGlossiness)
}

/// Two pictures of normals, neither of which is constant.
fn two_pictures(set: &LocatedSet, one: &LabelledFile, other: &LabelledFile) -> Error {
    let (first, second) = if one.file < other.file { (one, other) } else { (other, one) };
    Error::NotAMaterial {
        path: set.path.clone(),
        expected: "one picture for the normal map".to_owned(),
        found: format!("{} and {}", first.file, second.file),
        remedy: "give the prefix that only the files of this material share, or move one away".to_owned(),
    }
}

fn numbers_mislead(set: &LocatedSet, file: &str) -> Error {
    Error::NotAMaterial {
        path: set.path.clone(),
        expected: "files 0 to 3 to be normal, diffuse, roughness and specular".to_owned(),
        found: format!("{file} without the look of normals"),
        remedy: "name the files by their maps".to_owned(),
    }
}

/// The maps of a set that have been recognized so far.
struct PartialSet<'a> {
    set: &'a LocatedSet,
    maps: MapsByRole,
    notes: Vec<Note>,
    doubts: Vec<Assumption>,
    /// Whether all colours are floats.
    are_floats: bool,
    /// Whether alpha beside specular is the glossiness.
    is_glossy: bool,
}

impl<'a> PartialSet<'a> {
    fn new(set: &'a LocatedSet) -> Self {
        let (maps, notes, doubts) = (MapsByRole::default(), Vec::new(), Vec::new());
        Self { set, maps, notes, doubts, are_floats: true, is_glossy: false }
    }

    fn has_named(&self, is: impl Fn(Role) -> bool) -> bool {
        self.set.files.files.iter().any(|file| is(file.label.role))
    }

    fn doubt(&mut self, chosen: &str, why: Reason) {
        self.doubts.push(Assumption::new(What::Layout, chosen, why, Certainty::Unsure));
    }

    /// Another picture of the normals in place of a constant one, decoded for it.
    fn other_normals(
        &mut self,
        file: &LabelledFile,
        raster: &Raster,
    ) -> Option<(&'a LabelledFile, Raster, Vec<Note>)> {
        let others = &self.set.files.other_normals;
        let other = others.first().filter(|_| file.label.role == Role::Normal && is_flat(raster))?;
        let (raster, notes) = self.decoded(&other.file, Subject::Map(Role::Normal))?;
        if is_flat(&raster) {
            return None;
        }
        let why = Unused::Constant { other: other.file.clone() };
        self.notes.push(Note::Unused { what: file.file.clone(), why });
        Some((other, raster, notes))
    }

    /// Whether another picture of the normals is as good by its name, and not constant.
    fn is_contested(&self, file: &LabelledFile) -> bool {
        let others = &self.set.files.other_normals;
        let is_equal = |other: &&LabelledFile| other.rank() == file.rank() && other.file != file.file;
        let is_chosen = file.label.role == Role::Normal && !others.iter().any(|n| n.file == file.file);
        let other = others.iter().find(is_equal).filter(|_| is_chosen);
        let decoded = other.and_then(|other| self.decoded(&other.file, Subject::Map(Role::Normal)));
        decoded.is_some_and(|(raster, _)| !is_flat(&raster))
    }

    /// The picture of a file that only the pixels of others call for.
    fn decoded(&self, file: &str, subject: Subject) -> Option<(Raster, Vec<Note>)> {
        decode::one(&self.set.file(file), subject).ok()
    }

    /// Adds the picture of the file `named`.
    fn add(&mut self, named: &LabelledFile, mut raster: Raster) {
        let LabelledFile { file, label } = named;
        self.notes.push(Note::MapFile { map: label.role, file: file.clone() });
        self.are_floats &= raster.is_float() || !is_colour(label.role);
        if label.word == "ps" && self.set.files.files.iter().any(|f| f.label.word == "axay") {
            raster = raster.scaled(&[Reflectance::DIELECTRIC.value() as f32]);
            self.notes.push(Note::SpecularFactor { file: file.clone() });
        }
        let source = StoredMap { raster, file: self.set.path_of(file), part: String::new() };
        match label.role {
            Role::SpecularGlossiness => self.add_glossy(source),
            // The two widths of a roughness are in red and green.
            Role::Roughness if label.word == "axay" => self.maps.add(label.role, source),
            Role::Roughness | Role::Metallic => self.add_gray(label.role, source),
            role => self.maps.add(role, source),
        }
    }

    /// Specular in red, green and blue, glossiness in alpha.
    fn add_glossy(&mut self, mut source: StoredMap) {
        let gloss = source.raster.alpha.take();
        if !self.has_named(|role| role == Role::Roughness) {
            // Alpha that is 1 everywhere is not stored.
            let raster =
                gloss.map_or_else(|| Raster::constant("alpha", &[1.0]), |gloss| source.raster.of(gloss));
            let gloss = StoredMap { raster, file: source.file.clone(), part: "alpha".to_owned() };
            self.maps.add(Role::Roughness, gloss);
            self.is_glossy = true;
        }
        self.maps.add(Role::Specular, source);
    }

    /// A picture that is named after a gray map, and may hold others.
    fn add_gray(&mut self, role: Role, source: StoredMap) {
        let file = source.file.clone();
        let channels = Channels::of(&source.raster);
        if channels != Channels::Gray && normal_score(&source.raster) > NORMAL_ALL_OVER {
            self.doubt(role.name(), Reason::LooksLikeNormals { map: role, file });
            return self.maps.add(role, source);
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
        let Some(chosen) = chosen else { return self.maps.add(role, source) };
        let why = Reason::PackedChannels { map: role, file };
        self.doubt(&format!("{} in {}", role.name(), chosen.part), why.clone());
        self.maps.add(role, chosen);
        if let Some((other, source)) = other {
            self.doubt(&format!("{} in {}", other.name(), source.part), why);
            self.maps.add(other, source);
        }
    }

    /// Uses a picture whose name names no map where the set lacks normals and it looks like them, or where the set lacks
    /// a colour and it has the name of the set.
    fn rescue(&mut self, file: &str) {
        let set = self.set;
        let map = |raster| StoredMap { raster, file: set.path_of(file), part: String::new() };
        let decoded = |this: &Self| this.decoded(file, Subject::Picture).map(|(raster, _)| raster);
        if !self.maps.has(Role::Normal)
            && let Some(raster) = decoded(self).filter(|raster| normal_score(raster) > NORMAL_ALL_OVER)
        {
            self.maps.add(Role::Normal, map(raster));
            return self.doubt(&format!("normal is {file}"), Reason::NormalPixels);
        }
        let is_of_set = set.files.files.iter().any(|named| is_named_as(file, &named.label.stem));
        let has_colour = self.maps.has(Role::Base) || self.maps.has(Role::Diffuse);
        if is_of_set
            && !has_colour
            && let Some(raster) = decoded(self)
        {
            self.are_floats &= raster.is_float();
            self.maps.add(Role::Base, map(raster));
            let why = Reason::NameOfSet { file: file.to_owned() };
            return self.doubt(&format!("base colour is {file}"), why);
        }
        self.notes.push(Note::Unused { what: file.to_owned(), why: Unused::Unlabelled });
    }
}
