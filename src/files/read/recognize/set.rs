//! Sets of pictures, one for each map: the maps that they hold, by names and pixels together.

use super::hints;
use super::partial_set::{PartialSet, is_colour};
use crate::error::Error;
use crate::read::decode::pictures::DecodedPicture;
use crate::read::located::set::{LabelledFile, LocatedSet, NUMBERED};
use crate::read::measure::{NORMAL_AT_LEAST, dark_metal, normal_score};
use crate::read::options::{ReadOptions, Role, Workflow};
use crate::read::record::{Assumption, Certainty, Note, Reason, SpecifiedBy, Unused, What};
use crate::read::stored::{StoredHeight, StoredMap, StoredMaterial};

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
    for (file, DecodedPicture { map, notes, .. }) in located.files.files.iter().zip(pictures) {
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
        set.add(file, raster)?;
    }
    // A caller who specifies a specular map wants it to be used.
    let has_specular = bound.iter().any(|(role, _)| *role == Role::Specular) && options.workflow.is_none();
    let workflow = if has_specular { Some(Workflow::Specular) } else { options.workflow };
    for (role, map) in bound {
        set.notes.push(Note::MapSpecified { map: *role, file: map.file.clone(), by: SpecifiedBy::Caller });
        set.are_floats &= !is_colour(*role) || (map.raster.is_float() && !map.is_specified());
        set.maps.replace(*role, map.clone());
    }
    let is_bound = |file: &str| is_bound(located, bound, file);
    for file in located.files.unlabelled.iter().filter(|file| !is_bound(file)) {
        set.rescue(file, Unused::Unlabelled);
    }
    for file in located.files.misnamed.iter().filter(|file| !is_bound(file)) {
        set.rescue(file, Unused::OtherStem);
    }
    let PartialSet { maps, mut notes, are_floats, mut doubts, is_glossy, height, .. } = set;
    let options = &ReadOptions { workflow, ..*options };
    let mut found = maps.material(&located.path, located.name.clone(), &located.listing, options)?;
    found.assumptions.append(&mut doubts);
    let packed = found
        .metallic
        .as_ref()
        .filter(|metallic| !metallic.part.is_empty() && metallic.raster.size() != [1, 1]);
    if let Some(median) = packed.and_then(|metallic| dark_metal(&metallic.raster, &found.colour.raster)) {
        let why = Reason::DarkMetal(median);
        found.assumptions.push(Assumption::new(What::Layout, "metallic 1", why, Certainty::Unsure));
    }
    hints::add(&mut found, located, are_floats, is_glossy);
    let file = located.files.heights.first().map(|file| StoredHeight::File(located.file(file)));
    found.height = file.or(height);
    notes.extend(located.files.documents.iter().map(|one| Note::ListedBy { file: one.name.clone() }));
    let is_unused = |note: &&Note| !matches!(note, Note::Unused { what, .. } if is_bound(what));
    notes.extend(located.files.notes.iter().filter(is_unused).cloned());
    notes.append(&mut found.notes);
    Ok(StoredMaterial { notes, ..found })
}

/// Whether a file of the folder is one of the maps `bound`.
fn is_bound(set: &LocatedSet, bound: &[(Role, StoredMap)], file: &str) -> bool {
    let place = set.path_of(file);
    let is_it = |map: &StoredMap| {
        map.file == place
            || map.file.canonicalize().is_ok_and(|one| place.canonicalize().is_ok_and(|p| p == one))
    };
    bound.iter().any(|(_, map)| map.file.file_name() == place.file_name() && is_it(map))
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
