//! The maps of a material as stored, and what is known about them.

use std::path::{Path, PathBuf};

use super::assumption::{Assumption, Certainty, What};
use super::interpret::transfer::{encoded, linear};
use super::locate::names::Role;
use super::note::{Note, SpecifiedBy, Unused};
use super::options::{Albedo, Energy, NormalY, ReadOptions, Roughness, Workflow};
use super::preset::Preset;
use super::raster::Raster;
use super::reason::Reason;
use super::samples::Samples;
use crate::error::Error;

/// A map as stored.
#[derive(Clone, Debug)]
pub struct StoredMap {
    pub raster: Raster,
    pub file: PathBuf,
    /// Layer, channel or tile within the file, for people; may be empty.
    pub part: String,
}

impl StoredMap {
    /// The note that a workflow does not use this map.
    fn unused(&self, workflow: Workflow) -> Note {
        let part = if self.part.is_empty() { String::new() } else { format!(", {}", self.part) };
        Note::Unused { what: format!("{}{part}", self.file.display()), why: Unused::Workflow(workflow) }
    }

    /// A map of one value that stands in the file `path`.
    pub fn constant(path: &Path, values: &[f32]) -> Self {
        let raster = Raster::constant("value", values);
        Self { raster, file: path.to_owned(), part: "value".to_owned() }
    }

    /// Colours stored as `space` times linear factors, stored likewise.
    pub fn times(self, factor: [f32; 3], space: Albedo) -> Self {
        if factor == [1.0; 3] {
            return self;
        }
        let last = self.raster.channels.len() - 1;
        let times = |c: usize| {
            let plane = &self.raster.channels[last.min(c)];
            Samples::floats(plane.decoded(|v| encoded(linear(v, space) * f64::from(factor[c]), space)))
        };
        let channels = [0, 1, 2].map(times).into();
        Self { raster: Raster { channels, ..self.raster.without_samples() }, ..self }
    }

    /// Takes the samples out, so that they can be dropped; size and names stay.
    pub fn take(&mut self) -> Self {
        let left = self.raster.without_samples();
        Self {
            raster: std::mem::replace(&mut self.raster, left),
            file: self.file.clone(),
            part: self.part.clone(),
        }
    }
}

/// What the files tell about stored values. `None` where they tell nothing.
#[derive(Clone, Debug, Default)]
pub struct Inferences {
    pub albedo: Inferred<Albedo>,
    pub specular: Inferred<Albedo>,
    pub roughness: Inferred<Roughness>,
    pub normal_y: Inferred<NormalY>,
    pub energy: Inferred<Energy>,
}

/// A choice with its reason and certainty, if there is any.
pub type Inferred<T> = Option<(T, Reason, Certainty)>;

/// The maps of a material as stored, and what is known about them.
#[derive(Debug)]
pub struct StoredMaterial {
    pub name: String,
    /// (width, height) of the largest picture, also of one whose map is a constant.
    pub extent: [usize; 2],
    pub normal: Option<StoredMap>,
    /// Diffuse, or the base colour where there is `metallic`.
    pub colour: StoredMap,
    pub specular: Option<StoredMap>,
    /// The reflectance of dielectrics, 1 for 0.08.
    pub level: Option<StoredMap>,
    pub roughness: StoredMap,
    pub metallic: Option<StoredMap>,
    pub inferred: Inferences,
    pub assumptions: Vec<Assumption>,
    /// What else was noticed.
    pub notes: Vec<Note>,
    /// Every file that was read, once.
    pub files: Vec<PathBuf>,
}

/// The pictures of a material by their role.
#[derive(Debug, Default)]
pub struct Pictures {
    all: Vec<(Role, StoredMap)>,
    extent: [usize; 2],
}

impl Pictures {
    pub fn add(&mut self, role: Role, source: StoredMap) {
        self.all.push((role, source));
    }

    /// Records a picture of `size` whose map may be a constant: the material is not smaller.
    pub fn record_size(&mut self, size: [usize; 2]) {
        if size[0] * size[1] > self.extent[0] * self.extent[1] {
            self.extent = size;
        }
    }

    pub fn has(&self, role: Role) -> bool {
        self.all.iter().any(|(r, _)| *r == role)
    }

    /// Replaces the picture of a role; diffuse and base colour replace each other.
    pub fn replace(&mut self, role: Role, source: StoredMap) {
        let colours = [Role::Base, Role::Diffuse];
        self.all.retain(|(r, _)| *r != role && !(colours.contains(r) && colours.contains(&role)));
        self.all.push((role, source));
    }

    fn take(&mut self, role: Role) -> Option<StoredMap> {
        let place = self.all.iter().position(|(r, _)| *r == role)?;
        Some(self.all.swap_remove(place).1)
    }

    /// Roughness (0) or metallic (1) out of a picture that holds both.
    fn packed(&self, which: usize) -> Option<StoredMap> {
        self.all.iter().find_map(|(role, source)| {
            let channel = role.packing()?[which];
            let raster = match channel {
                // Alpha that is 1 everywhere is not kept.
                3 => source
                    .raster
                    .alpha
                    .clone()
                    .map_or_else(|| Raster::constant("alpha", &[1.0]), |alpha| source.raster.of(alpha)),
                _ => source.raster.of(source.raster.channels.get(channel)?.clone()),
            };
            let name = ["red", "green", "blue", "alpha"][channel];
            let before = if source.part.is_empty() { String::new() } else { format!("{}, ", source.part) };
            Some(StoredMap { raster, file: source.file.clone(), part: before + name })
        })
    }

    fn roughness(&mut self) -> Option<StoredMap> {
        self.take(Role::Roughness).or_else(|| self.packed(0))
    }

    fn metallic(&mut self) -> Option<StoredMap> {
        self.take(Role::Metallic).or_else(|| self.packed(1))
    }

    /// Assumptions about pictures whose channels their names do not define for sure.
    fn doubts_of_packing(&self) -> Vec<Assumption> {
        let mut assumptions = Vec::new();
        let doubtful = [Role::RoughnessMetallicOcclusion, Role::MetallicRoughnessOcclusion];
        if let Some((role, source)) = self.all.iter().find(|(role, _)| doubtful.contains(role)) {
            let chosen = if *role == doubtful[0] {
                "red roughness, green metallic, blue occlusion"
            } else {
                "red metallic, green roughness, blue occlusion"
            };
            let why = Reason::PackingName { file: source.file.clone() };
            assumptions.push(Assumption::new(What::Layout, chosen, why, Certainty::Unsure));
        }
        if let Some((_, source)) =
            self.all.iter().find(|(r, s)| *r == Role::MetallicSmoothness && s.raster.alpha.is_none())
            && !self.has(Role::Roughness)
        {
            let why = Reason::OpaqueSmoothness { file: source.file.clone() };
            assumptions.push(Assumption::new(What::Layout, "smoothness 1", why, Certainty::Unsure));
        }
        assumptions
    }

    /// Chooses the workflow and puts the maps in their places; `path` is what the user gave, `listed` what is there.
    ///
    /// # Errors
    /// [`Error::NotAMaterial`] without a colour or without roughness.
    pub fn assemble(
        mut self,
        path: &Path,
        name: String,
        listed: &str,
        options: &ReadOptions,
    ) -> Result<StoredMaterial, Error> {
        let missing = |role: Role| Error::NotAMaterial {
            path: path.to_owned(),
            expected: format!(
                "one picture for the {} map (named after one of {})",
                role.name(),
                role.examples()
            ),
            found: listed.to_owned(),
            remedy: "add or rename the file, or open a packed one by itself".to_owned(),
        };
        let mut assumptions = self.doubts_of_packing();
        let mut files: Vec<_> = self.all.iter().map(|(_, source)| source.file.clone()).collect();
        files.sort();
        files.dedup();
        let normal = self.take(Role::Normal);
        let is_packed = !self.has(Role::Metallic);
        let roughness = self.roughness();
        let metallic = self.metallic();
        let (specular, level) = (self.take(Role::Specular), self.take(Role::SpecularLevel));
        let (base, diffuse) = (self.take(Role::Base), self.take(Role::Diffuse));
        let use_metallic = match options.workflow {
            Some(workflow) => workflow == Workflow::Metallic && metallic.is_some(),
            // A packed picture holds metallic on purpose; a lone metallic map may have come along with specular.
            None => metallic.is_some() && (base.is_some() || specular.is_none() || is_packed),
        };
        let is_ambiguous = metallic.is_some() && specular.is_some() && base.is_none();
        let (first, second) = if use_metallic { (base, diffuse) } else { (diffuse, base) };
        let (colour, mut unused) = if first.is_some() { (first, vec![second]) } else { (second, Vec::new()) };
        let no_specular = use_metallic || options.workflow == Some(Workflow::Metallic);
        let (specular, other) = if no_specular { (None, specular) } else { (specular, None) };
        let (level, coloured) = if specular.is_some() { (None, level) } else { (level, None) };
        let (metallic, plain) = if use_metallic { (metallic, None) } else { (None, metallic) };
        unused.extend([other, coloured, plain]);
        if normal.is_none() && colour.is_none() && roughness.is_none() {
            return Err(missing(Role::Normal));
        }
        let colour = colour.ok_or_else(|| missing(Role::Diffuse))?;
        let roughness = roughness.ok_or_else(|| missing(Role::Roughness))?;
        let chosen = if use_metallic { Workflow::Metallic } else { Workflow::Specular };
        assumptions.push(workflow(chosen, specular.is_some(), is_ambiguous, options));
        Ok(StoredMaterial {
            name,
            extent: self.extent,
            normal,
            colour,
            specular,
            level,
            roughness,
            metallic,
            inferred: Inferences::default(),
            assumptions,
            notes: unused.into_iter().flatten().map(|source| source.unused(chosen)).collect(),
            files,
        })
    }
}

/// The assumption about the workflow that was `chosen`.
fn workflow(chosen: Workflow, has_specular: bool, is_ambiguous: bool, options: &ReadOptions) -> Assumption {
    let why = match (chosen, has_specular) {
        (Workflow::Metallic, _) => {
            Reason::MetallicMap { matfusion: options.preset == Some(Preset::MatFusion) }
        }
        (Workflow::Specular, true) => Reason::SpecularMap,
        (Workflow::Specular, false) => Reason::NeitherMap,
    };
    match options.workflow {
        Some(given) if given == chosen => Assumption::given(What::Workflow, given),
        Some(given) => {
            let why = Reason::NoMetallicMap(SpecifiedBy::Caller);
            Assumption::new(What::Workflow, given, why, Certainty::Given)
        }
        None if is_ambiguous => {
            Assumption::new(What::Workflow, chosen, Reason::BothWorkflows, Certainty::Unsure)
        }
        None => Assumption::new(What::Workflow, chosen, why, Certainty::Sure),
    }
}

impl StoredMaterial {
    /// Replaces the map of a role.
    pub fn replace(&mut self, role: Role, source: StoredMap) {
        self.files.push(source.file.clone());
        self.files.sort();
        self.files.dedup();
        match role {
            Role::Normal => self.normal = Some(source),
            Role::Specular => (self.specular, self.metallic) = (Some(source), None),
            Role::Roughness => self.roughness = source,
            Role::Metallic => (self.metallic, self.specular) = (Some(source), None),
            _ => self.colour = source,
        }
    }

    /// Every map with its role.
    pub fn sources(&self) -> Vec<(Role, &StoredMap)> {
        let colour = if self.metallic.is_some() { Role::Base } else { Role::Diffuse };
        let optional = [
            (Role::Normal, &self.normal),
            (Role::Specular, &self.specular),
            (Role::SpecularLevel, &self.level),
            (Role::Metallic, &self.metallic),
        ];
        let always = [(colour, &self.colour), (Role::Roughness, &self.roughness)];
        let there = optional.into_iter().filter_map(|(role, source)| source.as_ref().map(|s| (role, s)));
        there.chain(always).collect()
    }

    /// The size of the largest map; records where others are smaller.
    ///
    /// # Errors
    /// [`Error::MapSizesDiffer`] where maps have another shape.
    pub fn common_size(&mut self) -> Result<[usize; 2], Error> {
        let all: Vec<_> = self
            .sources()
            .into_iter()
            .map(|(role, s)| (format!("{} map {}", role.name(), s.file.display()), role, s.raster.size()))
            .collect();
        let Some((largest_whose, _, largest)) = all.iter().max_by_key(|(.., size)| size[0] * size[1]) else {
            return Ok([0; 2]);
        };
        let [width, height] = larger(*largest, self.extent);
        let mut smaller = Vec::new();
        for (whose, role, size) in &all {
            // A single value has every shape.
            if *size == [1, 1] {
                continue;
            }
            if size[0] * height != size[1] * width {
                return Err(Error::MapSizesDiffer {
                    first: largest_whose.clone(),
                    first_size: *largest,
                    second: whose.clone(),
                    second_size: *size,
                });
            }
            if *size != [width, height] {
                smaller.push((*role, *size));
            }
        }
        if !smaller.is_empty() {
            let chosen = format!("{width} x {height}");
            let why = Reason::SmallerMaps(smaller);
            self.assumptions.push(Assumption::new(What::Size, chosen, why, Certainty::Likely));
        }
        Ok([width, height])
    }
}

/// The larger of the `size` of maps and the `extent` of a picture that is none of them, where both have one shape. A
/// single value has every shape.
fn larger(size: [usize; 2], extent: [usize; 2]) -> [usize; 2] {
    let is_shaped_so = size == [1, 1] || size[0] * extent[1] == size[1] * extent[0];
    if is_shaped_so && extent[0] > size[0] { extent } else { size }
}
