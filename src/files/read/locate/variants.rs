//! Variants of the maps of a set in one folder: of several sizes, and of layers such as a coat.

use std::collections::{BTreeMap, BTreeSet};

use crate::read::located::set::LabelledFile;
use crate::read::names::size;
use crate::read::options::Role;
use crate::read::record::{Note, Unused};

/// Words before that of a map which make it the map of a layer that is not modelled.
const LAYERS: [&str; 6] = ["clear", "coat", "clearcoat", "sheen", "fuzz", "detail"];

/// Moves the maps of layers, such as `x_coat_normal` beside `x_normal`, to their set: they are none of its maps.
pub(super) fn add_layers(groups: &mut BTreeMap<Vec<String>, Vec<LabelledFile>>) {
    let set_of = |stem: &[String]| {
        let count = stem.iter().rev().take_while(|word| LAYERS.contains(&word.as_str())).count();
        (count > 0 && count < stem.len()).then(|| stem[..stem.len() - count].to_vec())
    };
    let stems: Vec<_> = groups.keys().filter_map(|stem| Some((stem.clone(), set_of(stem)?))).collect();
    for (stem, set) in stems {
        let roles: Vec<Role> = groups[&stem].iter().map(|file| file.label.role).collect();
        // A material may be a coat itself.
        let has = |wanted: &[Role]| wanted.iter().any(|role| roles.contains(role));
        let is_whole = has(&[Role::Normal]) && has(&[Role::Base, Role::Diffuse]) && has(&[Role::Roughness]);
        if groups.contains_key(&set) && !is_whole {
            let files = groups.remove(&stem).unwrap_or_default();
            let of_set = groups.entry(set).or_default();
            of_set.extend(files.into_iter().map(|mut file| {
                file.label.role = Role::Ignored;
                file
            }));
        }
    }
}

/// The files of one size, where some maps are there in several: the size of the file `named`, else the largest that is `complete`.
pub(super) fn of_one_size(
    files: Vec<LabelledFile>,
    named: Option<&str>,
    complete: impl Fn(&[LabelledFile]) -> bool,
    notes: &mut Vec<Note>,
) -> Vec<LabelledFile> {
    let sizes: BTreeSet<u32> = files.iter().filter_map(|file| size(&file.file)).collect();
    let is_of = |file: &LabelledFile, wanted: u32| size(&file.file).is_none_or(|own| own == wanted);
    let is_complete = |wanted: &u32| {
        let of_size: Vec<_> = files.iter().filter(|file| is_of(file, *wanted)).cloned().collect();
        complete(&of_size)
    };
    let own = named.and_then(size);
    let Some(chosen) = own.or_else(|| sizes.into_iter().rev().find(is_complete)) else { return files };
    let better = |file: &LabelledFile| {
        let role = file.label.role;
        files
            .iter()
            .find(|one| one.label.role == role && role != Role::Ignored && size(&one.file) == Some(chosen))
    };
    let dropped =
        |file: &LabelledFile| better(file).filter(|_| !is_of(file, chosen)).map(|one| one.file.clone());
    let all: Vec<_> = files.iter().map(|file| (file.clone(), dropped(file))).collect();
    let mut kept = Vec::new();
    for (file, better) in all {
        match better {
            Some(to) => notes.push(Note::Unused { what: file.file, why: Unused::Inferior { to } }),
            None => kept.push(file),
        }
    }
    kept
}
