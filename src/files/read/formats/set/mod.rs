//! Sets of pictures, one for each map: the maps that they hold, by names and pixels together, and how files of such names store their
//! values.

mod files;
mod grouping;
mod maps;

use svbrdf_core::progress::Progress;

use crate::error::Error;
use crate::read::options::{Albedo, NormalY, ReadOptions, Role, Roughness, Workflow};
use crate::read::raster::measure::{NORMAL_AT_LEAST, normal_score};
use crate::read::record::{Assumption, Certainty, Ground, Note, Reason, Unused, What};
use crate::read::stored::{
    DecodedPicture, Inferences, Inferred, StoredHeight, StoredMap, StoredMaterial, decoded, written_albedo,
};

pub(super) use files::Set;
use files::{LabelledFile, NUMBERED};
pub(super) use grouping::{Wanted, choose, is_beside, is_complete, is_picture, is_shared_with};
use maps::PartialSet;

impl Set {
    /// Reads its maps, with the maps `bound`; each picture is one step of `progress`. Pictures that are needed only where the pixels of
    /// others are not those of their map are not decoded otherwise.
    ///
    /// # Errors
    /// [`Error::NotAMaterial`] where maps are missing, or several pictures are equally the normal map; those of its pictures.
    pub(in crate::read) fn read(
        &self,
        bound: &[(Role, StoredMap)],
        options: &ReadOptions,
        progress: &Progress,
    ) -> Result<StoredMaterial, Error> {
        let mut set = PartialSet::new(self);
        let mut written = Vec::new();
        for (file, DecodedPicture { map, notes, meaning, .. }) in
            self.files.iter().zip(decoded(&self.pictures(), progress)?)
        {
            let meaning = meaning.as_deref().and_then(written_albedo);
            written.extend(meaning.map(|albedo| (file.label.role, albedo)));
            let (file, raster, notes) = match set.other_normals(file, &map.raster) {
                Some(other) => other,
                None => (file, map.raster, notes),
            };
            if set.is_contested(file) {
                return Err(grouping::two_pictures(&self.path, file, &self.other_normals[0]));
            }
            set.notes.extend(notes);
            let is_normal = file.label.role == Role::Normal;
            if file.label.word == NUMBERED && is_normal && normal_score(&raster) < NORMAL_AT_LEAST {
                return Err(numbers_mislead(self, &file.file));
            }
            set.add(file, raster)?;
        }
        // A caller who specifies a specular map wants it to be used.
        let has_specular =
            bound.iter().any(|(role, _)| *role == Role::Specular) && options.workflow.is_none();
        let workflow = if has_specular { Some(Workflow::Specular) } else { options.workflow };
        for (role, map) in bound {
            set.notes.push(Note::MapSpecified { map: *role, file: map.file.clone() });
            set.maps.replace(*role, map.clone());
        }
        set.rescue_bump();
        let is_bound = |file: &str| is_bound(self, bound, file);
        let unlabelled = self.unlabelled.iter().map(|file| (file, Unused::Unlabelled));
        let misnamed = self.misnamed.iter().map(|file| (file, Unused::OtherStem));
        for (file, unused) in unlabelled.chain(misnamed).filter(|(file, _)| !is_bound(file)) {
            set.rescue(file, unused);
        }
        let PartialSet { maps, mut notes, mut doubts, is_glossy, height, normal_bump, .. } = set;
        let options = &ReadOptions { workflow, ..*options };
        let mut found = maps.material(&self.path, self.name.clone(), &self.listing, options)?;
        found.assumptions.append(&mut doubts);
        doubt_filled_metallic(&mut found);
        add_hints(&mut found, self, is_glossy);
        let is_own = |role: Role| bound.iter().all(|(other, _)| *other != role);
        written
            .iter()
            .filter(|one| is_own(one.0))
            .for_each(|(role, albedo)| found.specify(*albedo, &[*role]));
        let heights = self.heights.iter().find(|file| Some(*file) != normal_bump);
        let file = heights.map(|file| StoredHeight::File(self.file(file)));
        found.height = file.or(height);
        notes.extend(self.documents.iter().map(|one| {
            Note::Told(format!("{} lists these pictures: open it to read them as it specifies.", one.name))
        }));
        let is_used = |what: &String| is_bound(what) || Some(what) == normal_bump;
        let is_unused = |note: &&Note| !matches!(note, Note::Unused { what, .. } if is_used(what));
        notes.extend(self.notes.iter().filter(is_unused).cloned());
        notes.append(&mut found.notes);
        Ok(StoredMaterial { notes, ..found })
    }
}

const MATERIALGAN: Reason =
    Reason::fixed(Ground::Code, "MaterialGAN and its successors use these names and this encoding");
const FILLED: &str = "metallic is 1 everywhere, and programs also fill an unused channel so: where the surface is no metal, specify metallic=0";

/// Doubts a channel of metallic that is 1 everywhere: programs fill it so where a factor beside the picture tells it.
fn doubt_filled_metallic(found: &mut StoredMaterial) {
    let is_filled = |metallic: &StoredMap| {
        let is_packed = !metallic.part.is_empty() && metallic.raster.size() != [1, 1];
        is_packed && metallic.raster.channels[0].is_all(1.0)
    };
    if found.metallic.as_ref().is_some_and(is_filled) {
        let why = Reason::measured(FILLED);
        found.assumptions.push(Assumption::new(What::Layout, "metallic 1", why, Certainty::Unsure));
    }
}

/// Whether a file of the folder is one of the maps `bound`.
fn is_bound(set: &Set, bound: &[(Role, StoredMap)], file: &str) -> bool {
    let place = set.path_of(file);
    let is_it = |map: &StoredMap| {
        map.file == place
            || map.file.canonicalize().is_ok_and(|one| place.canonicalize().is_ok_and(|p| p == one))
    };
    bound.iter().any(|(_, map)| map.file.file_name() == place.file_name() && is_it(map))
}

fn numbers_mislead(set: &Set, file: &str) -> Error {
    Error::NotAMaterial {
        path: set.path.clone(),
        expected: "files 0 to 3 to be normal, diffuse, roughness and specular".to_owned(),
        found: format!("{file} without the look of normals"),
        remedy: "name the files by their maps".to_owned(),
    }
}

/// Adds the hints of the names of `set` to its material, whose specular `is_glossy` in alpha.
fn add_hints(found: &mut StoredMaterial, set: &Set, is_glossy: bool) {
    found.inferred = inferred(set);
    found.infer_floats();
    if is_diffmat(&set.files, found) {
        let why = || Reason::measured("DiffMat writes these names and depths, with y down by default");
        found.inferred.albedo = Some((Albedo::Gamma22, why(), Certainty::Likely));
        found.inferred.normal_y = Some((NormalY::Down, why(), Certainty::Unsure));
    }
    if is_glossy {
        let why = || Reason::stated("glTF defines it for specular and glossiness");
        found.inferred.albedo = Some((Albedo::Srgb, why(), Certainty::Sure));
        found.inferred.specular = found.inferred.albedo.clone();
        found.inferred.roughness = Some((Roughness::Gloss, why(), Certainty::Sure));
    }
}

/// The direction of y by the format of a document beside the set that lists its normal map.
fn listed_y(set: &Set) -> Inferred<NormalY> {
    let normal = set.files.iter().find(|file| file.label.role == Role::Normal)?;
    let document = set.documents.iter().find(|one| one.files.contains(&normal.file))?;
    let why = Reason::measured(format!("{} lists the map, and its format defines it", document.name));
    Some((document.normal_y?, why, Certainty::Likely))
}

/// Whether the files look as DiffMat writes them: whole names, colour in 8 bits, gray in 16.
fn is_diffmat(files: &[LabelledFile], found: &StoredMaterial) -> bool {
    let plain = ["basecolor", "normal", "roughness", "metallic"];
    let deep = |source: &StoredMap| source.raster.depth == "16-bit" && source.raster.channels.len() == 1;
    files.iter().all(|f| f.label.stem.is_empty() && plain.contains(&f.label.word.as_str()))
        && found.colour.raster.depth == "8-bit"
        && deep(&found.roughness)
        && found.metallic.as_ref().is_some_and(deep)
}

fn inferred(set: &Set) -> Inferences {
    let files = &set.files;
    let named = |f: &LabelledFile| {
        Some((f.label.roughness()?, Reason::stated(format!("{} is named so", f.file)), Certainty::Sure))
    };
    let roughness = files.iter().find_map(named);
    let named = |f: &LabelledFile| {
        let y = f.label.normal_y?;
        let name = if y == NormalY::Up { "OpenGL" } else { "DirectX" };
        Some((y, Reason::stated(format!("{} is named {name}", f.file)), Certainty::Sure))
    };
    let normal_y = files.iter().find_map(named).or_else(|| listed_y(set));
    let mut inferred = Inferences { roughness, normal_y, ..Inferences::default() };
    if set.word(Role::Normal) == Some("nom") && set.word(Role::Roughness) == Some("rgh") {
        let why = || MATERIALGAN;
        inferred.roughness = Some((Roughness::Gamma22, why(), Certainty::Likely));
        inferred.albedo = Some((Albedo::Gamma22, why(), Certainty::Likely));
        inferred.specular = inferred.albedo.clone();
        return inferred;
    }
    inferred.albedo = by_word(set, set.word(Role::Diffuse).or(set.word(Role::Base)));
    inferred.specular = by_word(set, set.word(Role::Specular));
    inferred
}

/// The encoding of a colour by the word that names it.
fn by_word(set: &Set, word: Option<&str>) -> Inferred<Albedo> {
    let word = word?;
    Some(if word == NUMBERED {
        let why = "the results of Deschaintre et al. 2020 are numbered in this way";
        (Albedo::Gamma22, Reason::fixed(Ground::Code, why), Certainty::Unsure)
    } else if word.contains("gammad") {
        (Albedo::Gamma22, Reason::stated("the names contain gammad"), Certainty::Sure)
    } else if word.starts_with("outputs") || word.starts_with("targets") {
        let why = "the networks of Deschaintre et al. write these names, linear";
        (Albedo::Linear, Reason::fixed(Ground::Deschaintre, why), Certainty::Likely)
    } else if set.word(Role::Specular) == Some("specular") && set.has_renderings {
        let why = "the data sets of SurfaceNet look like this, and are linear";
        (Albedo::Linear, Reason::fixed(Ground::Code, why), Certainty::Likely)
    } else {
        return None;
    })
}
