//! Stored maps: what files hold of a material, by the roles of its maps, and the choice among them that a workflow makes.

mod field;
mod material;
mod picture;

use std::path::Path;

pub(super) use field::{Field, reflectance, separated};
pub(super) use material::{Inferences, Inferred, StoredHeight, StoredMap, StoredMaterial};
pub(super) use picture::{DecodedPicture, Picture, PictureSource, decoded, notice};

use crate::error::Error;
use crate::read::options::transfer::written;
use crate::read::options::{Albedo, NormalY, Preset, ReadOptions, Role, Roughness, Workflow};
use crate::read::record::{Assumption, Certainty, Reason, What};

pub(crate) const CHANNELS: [&str; 4] = ["red", "green", "blue", "alpha"];

/// The maps of a material that have been recognized, by role.
#[derive(Debug, Default)]
pub(crate) struct MapsByRole {
    all: Vec<(Role, StoredMap)>,
    extent: [usize; 2],
}

impl MapsByRole {
    pub(crate) fn add(&mut self, role: Role, source: StoredMap) {
        self.all.push((role, source));
    }

    /// Records a picture of `size` whose map may be a constant: the material is not smaller.
    pub(crate) fn record_size(&mut self, size: [usize; 2]) {
        if size[0] * size[1] > self.extent[0] * self.extent[1] {
            self.extent = size;
        }
    }

    pub(crate) fn has(&self, role: Role) -> bool {
        self.all.iter().any(|(r, _)| *r == role)
    }

    /// Replaces the picture of a role; diffuse and base colour replace each other.
    pub(crate) fn replace(&mut self, role: Role, source: StoredMap) {
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
            // A gray picture has no other channels.
            if channel < 3 && channel >= source.raster.channels.len() {
                return None;
            }
            let (raster, name) = (source.raster.channel_or_alpha(channel), CHANNELS[channel]);
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
            let file = source.file.display();
            let why = Reason::measured(format!("{file} is named so; packings of this name differ"));
            assumptions.push(Assumption::new(What::Layout, chosen, why, Certainty::Unsure));
        }
        if let Some((_, source)) =
            self.all.iter().find(|(r, s)| *r == Role::MetallicSmoothness && s.raster.alpha.is_none())
            && !self.has(Role::Roughness)
        {
            let file = source.file.display();
            let why = Reason::measured(format!("{file} has no alpha, which holds smoothness"));
            assumptions.push(Assumption::new(What::Layout, "smoothness 1", why, Certainty::Unsure));
        }
        assumptions
    }

    /// Chooses the workflow, and the maps that it uses; `path` is the one that the user gave, `listed` the files for messages.
    ///
    /// # Errors
    /// [`Error::NotAMaterial`] without a colour or without roughness.
    pub(crate) fn material(
        mut self,
        path: &Path,
        name: String,
        listed: &str,
        options: &ReadOptions,
    ) -> Result<StoredMaterial, Error> {
        let missing = |role: Role| Error::MissingMap {
            path: path.to_owned(),
            map: role.name(),
            examples: role.examples(),
            found: if listed.is_empty() { "none".to_owned() } else { listed.to_owned() },
        };
        let mut assumptions = self.doubts_of_packing();
        let mut files: Vec<_> = self
            .all
            .iter()
            .map(|(_, source)| source)
            .filter(|map| !map.is_specified())
            .map(|map| map.file.clone())
            .collect();
        files.sort();
        files.dedup();
        let normal = self.take(Role::Normal);
        let is_packed = !self.has(Role::Metallic);
        let (roughness, metallic) = (self.roughness(), self.metallic());
        let [has_base, has_specular] = [Role::Base, Role::Specular].map(|role| self.has(role));
        let use_metallic = metallic.is_some()
            && match options.workflow {
                Some(workflow) => workflow == Workflow::Metallic,
                // A packed picture holds metallic on purpose; a lone metallic map may have come along with specular.
                None => has_base || !has_specular || is_packed,
            };
        let is_ambiguous = metallic.is_some() && has_specular && !has_base;
        let chosen = if use_metallic { Workflow::Metallic } else { Workflow::Specular };
        let colours = if use_metallic { [Role::Base, Role::Diffuse] } else { [Role::Diffuse, Role::Base] };
        let colour = colours.into_iter().find_map(|role| self.take(role));
        let uses_specular = !use_metallic && options.workflow != Some(Workflow::Metallic);
        let specular = if uses_specular { self.take(Role::Specular) } else { None };
        let level = if specular.is_none() { self.take(Role::SpecularLevel) } else { None };
        let (metallic, lone) = if use_metallic { (metallic, None) } else { (None, metallic) };
        let left = [Role::Base, Role::Diffuse, Role::Specular, Role::SpecularLevel];
        let unused = left.into_iter().filter_map(|role| self.take(role)).chain(lone);
        let notes = unused.map(|source| source.unused(chosen)).collect();
        if normal.is_none() && colour.is_none() && roughness.is_none() {
            return Err(missing(Role::Normal));
        }
        let colour = colour.ok_or_else(|| missing(colours[0]))?;
        let roughness = roughness.ok_or_else(|| missing(Role::Roughness))?;
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
            height: None,
            is_mapped: false,
            inferred: Inferences::default(),
            assumptions,
            notes,
            files,
        })
    }
}

/// The assumption about the workflow that was `chosen`.
fn workflow(chosen: Workflow, has_specular: bool, is_ambiguous: bool, options: &ReadOptions) -> Assumption {
    let why = match (chosen, has_specular) {
        (Workflow::Metallic, _) if options.preset == Some(Preset::MatFusion) => {
            "there is a metallic map: d = b (1 - m), s = f + b m as in MatFusion"
        }
        (Workflow::Metallic, _) => "there is a metallic map: d = b (1 - m), s = f (1 - m) + b m",
        (Workflow::Specular, true) => "there is a specular map",
        (Workflow::Specular, false) => "there is neither a specular nor a metallic map",
    };
    let (why, certainty) = match options.workflow {
        Some(given) if given == chosen => return Assumption::given(What::Workflow, given),
        Some(given) => {
            let why = Reason::stated("as specified, but there is no metallic map");
            return Assumption::new(What::Workflow, given, why, Certainty::Given);
        }
        None if is_ambiguous => {
            (Reason::measured("there are both a specular and a metallic map"), Certainty::Unsure)
        }
        None => (Reason::stated(why), Certainty::Sure),
    };
    Assumption::new(What::Workflow, chosen, why, certainty)
}

/// How colours are stored by the text that this program wrote into a picture.
pub(crate) fn written_albedo(text: &str) -> Option<Albedo> {
    [Albedo::Linear, Albedo::Srgb].into_iter().find(|albedo| text == written(*albedo))
}

impl StoredMaterial {
    /// Takes the encoding of these maps, whose colours are stored as `albedo`, from what their files state.
    pub(crate) fn specify(&mut self, albedo: Albedo, roles: &[Role]) {
        fn sure<T>(value: T) -> Inferred<T> {
            Some((value, Reason::NATIVE_TEXT, Certainty::Sure))
        }
        for role in roles {
            match role {
                Role::Diffuse => self.inferred.albedo = sure(albedo),
                Role::Specular => self.inferred.specular = sure(albedo),
                Role::Roughness => self.inferred.roughness = sure(Roughness::R),
                Role::Normal => self.inferred.normal_y = sure(NormalY::Up),
                _ => (),
            }
        }
    }
}
