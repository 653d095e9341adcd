//! A set of pictures while its maps are recognized, by names and pixels together.

use std::borrow::Cow;

use super::files::{LabelledFile, Set};
use crate::error::Error;
use crate::read::decode;
use crate::read::names::{Label, is_named_as};
use crate::read::options::{Albedo, Reflectance, Role};
use crate::read::raster::Raster;
use crate::read::raster::measure::{Channels, is_flat, normal_score};
use crate::read::record::{Assumption, Certainty, Note, Reason, Subject, Unused, What};
use crate::read::stored::{CHANNELS, Field, MapsByRole, StoredHeight, StoredMap};

/// An unlabelled picture is the normal map where this share of its pixels looks like normals.
const NORMAL_ALL_OVER: f64 = 0.95;

/// The maps of a set that have been recognized so far.
pub(super) struct PartialSet<'a> {
    set: &'a Set,
    pub(super) maps: MapsByRole,
    pub(super) notes: Vec<Note>,
    pub(super) doubts: Vec<Assumption>,
    /// Whether alpha beside specular is the glossiness.
    pub(super) is_glossy: bool,
    /// The heights beside a map, in its alpha.
    pub(super) height: Option<StoredHeight>,
    /// The file that is named after heights and is the normal map.
    pub(super) normal_bump: Option<&'a String>,
}

impl<'a> PartialSet<'a> {
    pub(super) fn new(set: &'a Set) -> Self {
        let (maps, notes, doubts) = (MapsByRole::default(), Vec::new(), Vec::new());
        Self { set, maps, notes, doubts, is_glossy: false, height: None, normal_bump: None }
    }

    fn has_named(&self, is: impl Fn(Role) -> bool) -> bool {
        self.set.files.iter().any(|file| is(file.label.role))
    }

    fn doubt(&mut self, chosen: &str, why: impl Into<Cow<'static, str>>) {
        let why = Reason::measured(why);
        self.doubts.push(Assumption::new(What::Layout, chosen, why, Certainty::Unsure));
    }

    /// Another picture of the normals in place of a constant one, decoded for it.
    pub(super) fn other_normals(
        &mut self,
        file: &LabelledFile,
        raster: &Raster,
    ) -> Option<(&'a LabelledFile, Raster, Vec<Note>)> {
        let others = &self.set.other_normals;
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
    pub(super) fn is_contested(&self, file: &LabelledFile) -> bool {
        let others = &self.set.other_normals;
        let is_equal = |other: &&LabelledFile| other.rank() == file.rank() && other.file != file.file;
        let is_chosen = file.label.role == Role::Normal && !others.iter().any(|n| n.file == file.file);
        let other = others.iter().find(is_equal).filter(|_| is_chosen);
        let decoded = other.and_then(|other| self.decoded(&other.file, Subject::Map(Role::Normal)));
        decoded.is_some_and(|(raster, _)| !is_flat(&raster))
    }

    /// The picture of a file that only the pixels of others call for.
    fn decoded(&self, file: &str, subject: Subject) -> Option<(Raster, Vec<Note>)> {
        let (layer, notes) = decode::one(&self.set.file(file), subject).ok()?;
        Some((layer.raster, notes))
    }

    /// Adds the picture of the file `named`.
    ///
    /// # Errors
    /// [`Error::NotAMaterial`] where a picture of normals and roughness has no alpha.
    pub(super) fn add(&mut self, named: &LabelledFile, mut raster: Raster) -> Result<(), Error> {
        let LabelledFile { file, label } = named;
        if label.is_over_heights()
            && let Some(heights) = raster.alpha.take()
        {
            self.notes.push(Note::Unused { what: format!("The alpha of {file}"), why: Unused::NotAMap });
            let raster = raster.of(heights);
            self.height = Some(StoredHeight::Picture { raster, file: self.set.path_of(file) });
        }
        let role = self.role_of(label);
        self.notes.push(Note::MapFile { map: role, file: file.clone() });
        if label.word == "ps" && self.set.files.iter().any(|f| f.label.word == "axay") {
            raster = raster.scaled(&[Reflectance::DIELECTRIC.value() as f32]);
            let told = format!("{file} is read as a factor on 0.04, as OpenSVBRDF writes it.");
            self.notes.push(Note::Told(told));
        }
        let source = StoredMap { raster, file: self.set.path_of(file), part: String::new() };
        match role {
            Role::SpecularGlossiness => self.add_glossy(source),
            Role::NormalRoughness => return self.add_normal_and_roughness(source),
            // The two widths of a roughness are in red and green.
            Role::Roughness if label.word == "axay" => self.maps.add(role, source),
            Role::Roughness | Role::Metallic => self.add_gray(role, source),
            role => self.maps.add(role, source),
        }
        Ok(())
    }

    /// The map that a label means in this set: `spec` of Texture Haven, beside `diff` and `rough`, scales 0.08.
    fn role_of(&mut self, label: &Label) -> Role {
        let has = |word: &str| self.set.files.iter().any(|file| file.label.word == word);
        if label.word != "spec" || !(has("diff") && has("rough")) {
            return label.role;
        }
        let why = "Texture Haven names the level of specular so, beside diff and rough; F0 is named so, too";
        self.doubt("specular is its level", why);
        Role::SpecularLevel
    }

    /// Normals in red, green and blue, roughness in alpha.
    fn add_normal_and_roughness(&mut self, mut source: StoredMap) -> Result<(), Error> {
        let has_roughness = self.has_named(|role| role == Role::Roughness || role.packing().is_some());
        match source.raster.alpha.take() {
            Some(alpha) if !has_roughness => {
                let raster = source.raster.of(alpha);
                let roughness = StoredMap { raster, file: source.file.clone(), part: "alpha".to_owned() };
                self.maps.add(Role::Roughness, roughness);
            }
            None if !has_roughness => {
                return Err(Error::NotAMaterial {
                    path: source.file,
                    expected: "normals in red, green and blue and roughness in alpha, by its name".to_owned(),
                    found: "no alpha, or one that is 1 everywhere".to_owned(),
                    remedy: "specify the normal map and the roughness map, each by its file and channel"
                        .to_owned(),
                });
            }
            _ => (),
        }
        if !self.has_named(|role| role == Role::Normal) {
            self.maps.add(Role::Normal, source);
        }
        Ok(())
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

    /// Metallic in red, smoothness in alpha, as Unity has it.
    fn add_smooth(&mut self, source: StoredMap) {
        let part = |channel: usize| StoredMap {
            raster: source.raster.channel_or_alpha(channel),
            file: source.file.clone(),
            part: CHANNELS[channel].to_owned(),
        };
        let roughness = Field::of(&part(3), Albedo::Linear).complement();
        self.maps.add(Role::Roughness, roughness.into_map(&source.file, "1 - alpha"));
        self.maps.add(Role::Metallic, part(0));
        let why = format!(
            "{} has an alpha that varies, as Unity stores smoothness, and no other file is the roughness",
            source.file.display()
        );
        self.doubt("metallic in red, roughness in 1 - alpha", why);
    }

    /// A picture that is named after a gray map, and may hold others.
    fn add_gray(&mut self, role: Role, source: StoredMap) {
        let lacks = |other: Role| !self.has_named(|role| role == other || role.packing().is_some());
        if role == Role::Metallic && source.raster.alpha.is_some() && lacks(Role::Roughness) {
            return self.add_smooth(source);
        }
        let channels = Channels::of(&source.raster);
        if channels != Channels::Gray && normal_score(&source.raster) > NORMAL_ALL_OVER {
            let (file, map) = (source.file.display(), role.name());
            self.doubt(map, format!("{file} looks like normals although it is named after the {map} map"));
            return self.maps.add(role, source);
        }
        let part = |channel: usize, part: &str| {
            let raster = source.raster.channel(channel);
            StoredMap { raster, file: source.file.clone(), part: part.to_owned() }
        };
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
        let why = format!(
            "the channels of {} differ although it is named after the {} map",
            chosen.file.display(),
            role.name()
        );
        self.doubt(&format!("{} in {}", role.name(), chosen.part), why.clone());
        self.maps.add(role, chosen);
        if let Some((other, source)) = other {
            self.doubt(&format!("{} in {}", other.name(), source.part), why);
            self.maps.add(other, source);
        }
    }

    /// Uses a picture as the normal map where the set lacks one and it looks like normals; returns whether it does.
    fn is_normal_map(&mut self, file: &str) -> bool {
        if self.maps.has(Role::Normal) {
            return false;
        }
        let decoded = self.decoded(file, Subject::Picture).map(|(raster, _)| raster);
        let Some(raster) = decoded.filter(|raster| normal_score(raster) > NORMAL_ALL_OVER) else {
            return false;
        };
        let map = StoredMap { raster, file: self.set.path_of(file), part: String::new() };
        self.maps.add(Role::Normal, map);
        let why = "nearly all of its pixels look like normals, and no other file is named as the normal map";
        self.doubt(&format!("normal is {file}"), why);
        true
    }

    /// Uses a picture that is named after heights as the normal map where it looks like that.
    pub(super) fn rescue_bump(&mut self) {
        let set = self.set;
        if let Some(bump) = set.heights.iter().find(|file| self.is_normal_map(file)) {
            self.normal_bump = Some(bump);
        }
    }

    /// Uses a picture whose name names no map where the set lacks normals and it looks like them, or where the set lacks
    /// a colour and it has the name of the set; notes that it is `unused` otherwise.
    pub(super) fn rescue(&mut self, file: &str, unused: Unused) {
        let set = self.set;
        let map = |raster| StoredMap { raster, file: set.path_of(file), part: String::new() };
        let decoded = |this: &Self| this.decoded(file, Subject::Picture).map(|(raster, _)| raster);
        if self.is_normal_map(file) {
            return;
        }
        let is_of_set = set.files.iter().any(|named| is_named_as(file, &named.label.stem));
        let has_colour = self.maps.has(Role::Base) || self.maps.has(Role::Diffuse);
        if is_of_set
            && !has_colour
            && let Some(raster) = decoded(self)
        {
            self.maps.add(Role::Base, map(raster));
            let why = format!("{file} has the name of the set, and no other file is its colour");
            return self.doubt(&format!("base colour is {file}"), why);
        }
        self.notes.push(Note::Unused { what: file.to_owned(), why: unused });
    }
}
