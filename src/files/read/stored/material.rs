//! A material as stored: its maps by role, each a picture or a channel of one, and what the files tell about their values.

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::options::transfer::{encoded, linear};
use crate::read::options::{Albedo, NormalEncoding, NormalY, Role, Roughness, Workflow};
use crate::read::raster::{Raster, Samples};
use crate::read::record::{Assumption, Certainty, Note, Reason, Unused, What};

/// Inferences from the files about stored values. `None` where they tell nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Inferences {
    pub albedo: Inferred<Albedo>,
    pub specular: Inferred<Albedo>,
    pub roughness: Inferred<Roughness>,
    pub normal_y: Inferred<NormalY>,
    /// Where three channels are those of a vector.
    pub normal_encoding: Inferred<NormalEncoding>,
}

impl Inferences {
    /// Of a format that states these, with y of normals up.
    pub(crate) fn stated(albedo: Albedo, roughness: Roughness, why: &'static str) -> Self {
        let why = || Reason::stated(why);
        let albedo = Some((albedo, why(), Certainty::Sure));
        Self {
            specular: albedo.clone(),
            albedo,
            roughness: Some((roughness, why(), Certainty::Sure)),
            normal_y: Some((NormalY::Up, why(), Certainty::Sure)),
            normal_encoding: None,
        }
    }
}

/// A choice with its reason and certainty, if there is any.
pub(crate) type Inferred<T> = Option<(T, Reason, Certainty)>;

/// The maps of a material as stored, and what is known about them.
#[derive(Debug)]
pub(crate) struct StoredMaterial {
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
    /// Heights that belong to it.
    pub height: Option<StoredHeight>,
    /// Whether coordinates relate its maps, so that they may have different shapes.
    pub is_mapped: bool,
    pub inferred: Inferences,
    pub assumptions: Vec<Assumption>,
    pub notes: Vec<Note>,
    /// Every file that was read, once.
    pub files: Vec<PathBuf>,
}

impl StoredMaterial {
    pub(crate) fn add_file(&mut self, file: PathBuf) {
        self.files.push(file);
        self.files.sort();
        self.files.dedup();
    }

    /// Notes the features of a document that are not modelled, and which of its materials this is.
    pub(crate) fn note_document(&mut self, not_modelled: Vec<String>, (names, index): (Vec<String>, usize)) {
        if !not_modelled.is_empty() {
            let features = not_modelled.join(", ");
            self.notes.push(Note::Told(format!("These change the look and are not modelled: {features}.")));
        }
        if names.len() > 1 {
            self.notes.push(Note::Materials { names, index });
        }
    }

    /// Records that the heights of `file` tell the direction of y: it is read, and not left unused.
    pub(crate) fn use_heights(&mut self, file: &Path) {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let is_it = |what: &str| what.strip_prefix("The alpha of ").unwrap_or(what) == name;
        self.notes.retain(|note| !matches!(note, Note::Unused { what, .. } if is_it(what)));
        self.add_file(file.to_owned());
    }

    /// Replaces the map of a role; what was inferred of the one before does not concern it.
    pub(crate) fn replace(&mut self, role: Role, source: StoredMap) {
        if !source.is_specified() {
            self.add_file(source.file.clone());
        }
        let encoding = source.of_floats(None);
        match role {
            Role::Normal => self.normal = Some(source),
            Role::Specular => {
                (self.specular, self.metallic, self.inferred.specular) = (Some(source), None, encoding);
            }
            Role::Roughness => (self.roughness, self.inferred.roughness) = (source, None),
            Role::Metallic => (self.metallic, self.specular) = (Some(source), None),
            _ => (self.colour, self.inferred.albedo) = (source, encoding),
        }
    }

    /// Infers of each map of floats that it is stored as it is, by its own samples.
    pub(crate) fn infer_floats(&mut self) {
        let Self { colour, specular, roughness, inferred, .. } = self;
        inferred.albedo = colour.of_floats(inferred.albedo.take());
        if let Some(specular) = specular {
            inferred.specular = specular.of_floats(inferred.specular.take());
        }
        let is_curved = matches!(inferred.roughness, Some((Roughness::Gamma22, ..)));
        if is_curved && roughness.is_of_floats() {
            inferred.roughness = None;
        }
    }

    pub(crate) fn sources(&self) -> Vec<(Role, &StoredMap)> {
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
    /// [`Error::MapSizesDiffer`] where maps have another shape, and no coordinates relate them.
    pub(crate) fn common_size(&mut self) -> Result<[usize; 2], Error> {
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
            // A level of half the size, and so on, is rounded.
            if (size[0] * height).abs_diff(size[1] * width) >= width.max(height) && !self.is_mapped {
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
            let one = |(map, [w, h]): &(Role, [usize; 2])| format!("{} from {w} x {h}", map.name());
            let smaller = smaller.iter().map(one).collect::<Vec<_>>().join(", ");
            let why = Reason::measured(format!("the largest map has it; resampled bilinearly: {smaller}"));
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

/// The part of a map that is specified as a value.
const SPECIFIED: &str = "a constant";

/// The heights of a material, which tell the direction of y in its normals.
#[derive(Clone, Debug)]
pub(crate) enum StoredHeight {
    /// A file, decoded only where names leave the direction open.
    File(NamedFile),
    Picture {
        raster: Raster,
        file: PathBuf,
    },
}

#[derive(Clone, Debug)]
pub(crate) struct StoredMap {
    pub raster: Raster,
    pub file: PathBuf,
    /// Layer, channel or tile within the file, for people; may be empty.
    pub part: String,
}

impl StoredMap {
    /// The note that a workflow does not use this map.
    pub(crate) fn unused(&self, workflow: Workflow) -> Note {
        let part = if self.part.is_empty() { String::new() } else { format!(", {}", self.part) };
        Note::Unused { what: format!("{}{part}", self.file.display()), why: Unused::Workflow(workflow) }
    }

    /// A map that is specified as these values; they stand where other maps have a file.
    pub(crate) fn specified(values: &[f32]) -> Self {
        let text = values.iter().map(f32::to_string).collect::<Vec<_>>().join(",");
        Self { raster: Raster::constant("value", values), file: text.into(), part: SPECIFIED.to_owned() }
    }

    /// Whether a file holds it in floats.
    fn is_of_floats(&self) -> bool {
        self.raster.is_float() && !self.is_specified()
    }

    /// The encoding of its colours: of floats linear, unsure where what else is `known` differs.
    fn of_floats(&self, known: Inferred<Albedo>) -> Inferred<Albedo> {
        if !self.is_of_floats() {
            return known;
        }
        Some(match known {
            Some((Albedo::Linear, ..)) | None => (Albedo::Linear, Reason::FLOATS, Certainty::Likely),
            Some((_, why, _)) => (Albedo::Linear, Reason::FLOATS.contradicted(&why), Certainty::Unsure),
        })
    }

    /// Whether it is specified as a value, and in no file.
    pub(crate) fn is_specified(&self) -> bool {
        self.part == SPECIFIED
    }

    /// A map of one value that stands in the file `path`.
    pub(crate) fn constant(path: &Path, values: &[f32]) -> Self {
        let raster = Raster::constant("value", values);
        Self { raster, file: path.to_owned(), part: "value".to_owned() }
    }

    /// Colours stored as `space` times linear factors, stored likewise.
    pub(crate) fn times(self, factor: [f32; 3], space: Albedo) -> Self {
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

    /// Normals stored as (n + 1) / 2 with x and y times `scale`, of length 1 again, stored likewise as floats.
    pub(crate) fn scaled_normals(self, scale: f64) -> Self {
        if scale == 1.0 || self.raster.channels.len() < 3 {
            return self;
        }
        let raster = &self.raster;
        let texel = |index: usize| {
            let [x, y, z] = raster.rgb(index).map(|c| 2.0 * c - 1.0);
            let n = [scale * x, scale * y, z];
            let length = n.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
            n.map(|x| (0.5 * x / length + 0.5) as f32)
        };
        let texels: Vec<[f32; 3]> = (0..raster.width * raster.height).into_par_iter().map(texel).collect();
        let channels = Samples::interleaved(texels.into_flattened(), 3);
        Self { raster: Raster { channels, alpha: None, ..raster.without_samples() }, ..self }
    }

    /// Takes the samples out, so that they can be dropped; size and names stay.
    pub(crate) fn take(&mut self) -> Self {
        let left = self.raster.without_samples();
        Self {
            raster: std::mem::replace(&mut self.raster, left),
            file: self.file.clone(),
            part: self.part.clone(),
        }
    }
}
