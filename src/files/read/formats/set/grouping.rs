//! Groups of files by the words that their names share: the maps of one material.

use std::collections::BTreeMap;
use std::path::Path;

use super::files::{
    LabelledFile, NUMBERED, Set, add_letter_a, add_parameters, documents_beside, of_one_size,
};
use crate::error::Error;
use crate::read::names::{
    EXTENSIONS, Label, PICTURES, extension, is_junk, is_named_as, listing, material_name, set_labels, words,
};
use crate::read::options::Role;
use crate::read::record::{Note, Unused};

/// Extensions of pictures that cannot be read. Where nothing else is that map, opening one fails and names it: a map
/// that is there is never replaced by a default.
#[rustfmt::skip]
const UNREAD: [&str; 27] = [
    "psd", "psb", "avif", "jxl", "heic", "heif", "gif", "jp2", "j2k", "jpf", "jpx", "jxr", "wdp", "ktx", "ktx2", "astc", "xcf",
    "kra", "dpx", "cin", "pcx", "sgi", "rgb", "pic", "iff", "ico", "svg",
];
/// Extensions of texts, which describe maps and are none.
const TEXTS: [&str; 12] =
    ["txt", "md", "json", "xml", "yaml", "yml", "csv", "html", "pdf", "tres", "blend", "py"];
type Groups = BTreeMap<Vec<String>, Vec<LabelledFile>>;

/// The file or all files of a material that are wanted of a folder.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Wanted<'a> {
    /// The one material whose files these are.
    All,
    /// The material of this name, or else the one whose files these are: all that begin with the name.
    Named(&'a str),
    /// The material that this file belongs to.
    SetOf(&'a str),
}

/// Chooses the files of one material among the files `names` of `folder`.
///
/// Where all materials are `wanted`, exactly one of them must be complete, counting the roles that are `bound` already. The set is named
/// after `path`, which the user gave, or after the words that its files share.
///
/// # Errors
/// [`Error::NotAMaterial`] where there are several materials, or two files for a map.
pub(crate) fn choose(
    path: &Path,
    folder: &Path,
    names: &[String],
    wanted: Wanted<'_>,
    bound: &[Role],
) -> Result<Set, Error> {
    let mut set = Set {
        path: path.to_owned(),
        folder: folder.to_owned(),
        listing: listing(names),
        has_renderings: folder.join("render").is_dir(),
        ..Set::default()
    };
    let stem = add_files(&mut set, names, wanted, bound)?;
    set.documents = documents_beside(folder, names, &set.files);
    set.name = match wanted {
        Wanted::All => material_name(path, ""),
        Wanted::Named(prefix) => material_name(path, prefix),
        Wanted::SetOf(_) if stem.is_empty() => material_name(folder, ""),
        Wanted::SetOf(_) => stem.join(" "),
    };
    Ok(set)
}

/// Adds the files of the set; returns the words that their names have in common.
fn add_files(
    set: &mut Set,
    names: &[String],
    wanted: Wanted<'_>,
    bound: &[Role],
) -> Result<Vec<String>, Error> {
    let (mut groups, mut foreign) = (Groups::new(), Vec::new());
    for (name, label) in names.iter().zip(set_labels(names)) {
        match label {
            Some(label) if is_picture(name) || (is_unread(name) && label.role != Role::Ignored) => {
                groups.entry(label.stem.clone()).or_default().push(LabelledFile { file: name.clone(), label })
            }
            None if is_picture(name) => set.unlabelled.push(name.clone()),
            Some(label) if is_foreign(name) && label.role != Role::Ignored => foreign.push((name, label)),
            _ => (),
        }
    }
    share(&mut groups);
    add_parameters(&mut groups);
    add_letter_a(&mut groups, &mut set.unlabelled);
    // A short word counts beside other maps, or beside a picture that has the name of the set.
    let has_colour = |stem: &[String]| set.unlabelled.iter().any(|name| is_named_as(name, stem));
    let stems: Vec<_> = groups.keys().cloned().collect();
    let has_company = |stem: &[String]| {
        stems.iter().any(|one| !one.is_empty() && one.len() < stem.len() && stem.starts_with(one))
    };
    let counts = |stem: &[String], files: &[LabelledFile]| {
        files.len() > 1 || !files[0].label.is_short() || has_colour(stem) || has_company(stem)
    };
    let (mut groups, lone): (Groups, Groups) = groups.into_iter().partition(|(s, files)| counts(s, files));
    let mut complete = complete(&groups, bound);
    if complete.is_empty() {
        let numbered = numbered(&set.unlabelled);
        complete = numbered.keys().cloned().collect();
        set.unlabelled.retain(|name| !numbered.values().flatten().any(|n| n.file == *name));
        groups.extend(numbered);
    }
    let stem = match wanted {
        Wanted::SetOf(file) => Some(stem_of(file, &groups, &lone)),
        Wanted::Named(name) => Some(words(name)).filter(|stem| match complete.is_empty() {
            true => groups.contains_key(stem),
            false => complete.contains(stem),
        }),
        Wanted::All => None,
    };
    let (stem, files) = match (stem, complete.as_slice()) {
        (Some(stem), _) => (stem.clone(), groups.remove(&stem).unwrap_or_default()),
        (None, [only]) => (only.clone(), groups.remove(only).unwrap_or_default()),
        (None, []) => (Vec::new(), std::mem::take(&mut groups).into_values().flatten().collect()),
        (None, several) => return Err(several_materials(&set.path, several)),
    };
    let named = if let Wanted::SetOf(file) = wanted { Some(file) } else { None };
    let files = of_one_size(files, named, |files| is_complete(files, bound), &mut set.notes);
    set.heights = files.iter().filter(|file| file.label.is_height()).map(|file| file.file.clone()).collect();
    (set.files, set.other_normals) = best(&set.path, files, bound, &mut set.notes)?;
    let foreign = foreign.into_iter().filter(|(_, label)| label.stem == stem);
    set.notes.extend(foreign.map(|(name, _)| Note::Unused { what: name.clone(), why: Unused::Format }));
    let others = groups.into_iter().filter(|(stem, _)| !complete.contains(stem)).chain(lone);
    set.leave(others.flat_map(|(_, files)| files).collect(), &stem, !matches!(wanted, Wanted::SetOf(_)));
    Ok(stem)
}

fn several_materials(path: &Path, stems: &[Vec<String>]) -> Error {
    let found = stems.iter().map(|stem| stem.join("_")).collect::<Vec<_>>();
    Error::NotAMaterial {
        path: path.to_owned(),
        expected: "the maps of one material".to_owned(),
        found: format!("several: {}", listing(&found)),
        remedy: "give the prefix that only the files of one material share".to_owned(),
    }
}

/// The stems of the groups that are a material with what is `bound` already.
fn complete(groups: &Groups, bound: &[Role]) -> Vec<Vec<String>> {
    groups.iter().filter(|(_, files)| is_complete(files, bound)).map(|(stem, _)| stem.clone()).collect()
}

/// The stem of the set that a file belongs to: that of its label, else the longest that its name begins with.
fn stem_of(file: &str, groups: &Groups, lone: &Groups) -> Vec<String> {
    let is_of = |(_, files): &(&Vec<String>, &Vec<LabelledFile>)| files.iter().any(|one| one.file == file);
    if let Some((stem, _)) = groups.iter().chain(lone).find(is_of) {
        return stem.clone();
    }
    let words = words(&Path::new(file).file_stem().unwrap_or_default().to_string_lossy());
    let stems = groups.keys().filter(|stem| !stem.is_empty() && words.starts_with(stem));
    stems.max_by_key(|stem| stem.len()).cloned().unwrap_or_default()
}

/// Whether a file of this name counts as a picture.
pub(crate) fn is_picture(name: &str) -> bool {
    PICTURES.contains(&extension(name).as_str())
}

/// Whether a file of this name is a picture that cannot be read.
fn is_unread(name: &str) -> bool {
    UNREAD.contains(&extension(name).as_str())
}

/// Whether a file of this name is none that holds maps, but a text or what programs leave beside pictures.
pub(crate) fn is_beside(name: &str) -> bool {
    TEXTS.contains(&extension(name).as_str()) || is_junk(name)
}

/// Whether a file of this name is no picture that is known, and none of the files that go with pictures.
fn is_foreign(name: &str) -> bool {
    let is_known = EXTENSIONS.contains(&extension(name).as_str());
    !is_picture(name) && !is_unread(name) && !is_beside(name) && !is_known
}

/// Whether the files with what is `bound` already have a colour and roughness.
pub(crate) fn is_complete(files: &[LabelledFile], bound: &[Role]) -> bool {
    let has = |is: fn(Role) -> bool| files.iter().map(|f| f.label.role).chain(bound.iter().copied()).any(is);
    has(|role| matches!(role, Role::Base | Role::Diffuse)) && has(Role::has_roughness)
}

/// The stem of what the file shares with others, as in `bishop_shared_metallic`; `None` for others.
fn shared(stem: &[String]) -> Option<&[String]> {
    stem.split_last()
        .filter(|(last, before)| *last == "shared" && !before.is_empty())
        .map(|(_, before)| before)
}

/// Whether `name` is a map that a material shares whose file names begin with `prefix`.
pub(crate) fn is_shared_with(name: &str, prefix: &str) -> bool {
    let stem = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
    let label = Label::of(&stem).filter(|_| is_picture(name));
    label.is_some_and(|l| shared(&l.stem).is_some_and(|stem| words(prefix).starts_with(stem)))
}

/// Adds the maps of a stem `PREFIX shared` to every stem that begins with the prefix and has no such map.
fn share(groups: &mut Groups) {
    let stems: Vec<_> = groups.keys().filter(|stem| shared(stem).is_some()).cloned().collect();
    for stem in stems {
        let prefix = &stem[..stem.len() - 1];
        let heirs = |other: &Vec<String>| other.starts_with(prefix) && *other != stem;
        if !groups.keys().any(heirs) {
            continue;
        }
        let files = groups.remove(&stem).unwrap_or_default();
        for (_, heir) in groups.iter_mut().filter(|(other, _)| other.starts_with(prefix)) {
            for file in &files {
                if heir.iter().all(|own| own.label.role != file.label.role) {
                    heir.push(file.clone());
                }
            }
        }
    }
}

/// Files `NAME_0` to `NAME_3` and no more: the networks of Deschaintre et al. 2020 write normal, diffuse, roughness
/// and specular so.
fn numbered(names: &[String]) -> Groups {
    const ROLES: [Role; 4] = [Role::Normal, Role::Diffuse, Role::Roughness, Role::Specular];
    let mut groups: BTreeMap<Vec<String>, Vec<(usize, String)>> = BTreeMap::new();
    for name in names {
        let mut stem = words(&Path::new(name).file_stem().unwrap_or_default().to_string_lossy());
        if let Some(number) = stem.pop().and_then(|word| word.parse().ok()) {
            groups.entry(stem).or_default().push((number, name.clone()));
        }
    }
    let whole = |(stem, mut files): (Vec<String>, Vec<(usize, String)>)| {
        files.sort();
        let numbers: Vec<usize> = files.iter().map(|(number, _)| *number).collect();
        let named = |(role, (_, file)): (Role, (usize, String))| {
            let label = Label { role, word: NUMBERED.to_owned(), stem: stem.clone(), normal_y: None };
            LabelledFile { file, label }
        };
        (numbers == [0, 1, 2, 3]).then(|| (stem.clone(), ROLES.into_iter().zip(files).map(named).collect()))
    };
    groups.into_iter().filter_map(whole).collect()
}

/// One file a map: the better of two, with a note; an error where neither is. And the other pictures of normals.
fn best(
    path: &Path,
    mut files: Vec<LabelledFile>,
    bound: &[Role],
    notes: &mut Vec<Note>,
) -> Result<(Vec<LabelledFile>, Vec<LabelledFile>), Error> {
    files.sort_by_key(LabelledFile::rank);
    let (mut chosen, mut normals): (Vec<LabelledFile>, Vec<LabelledFile>) = (Vec::new(), Vec::new());
    for file in files.into_iter().rev() {
        if file.label.role == Role::Ignored || bound.contains(&file.label.role) {
            notes.push(Note::Unused { what: file.file, why: Unused::NotAMap });
            continue;
        }
        match chosen.iter().find(|c| c.label.role == file.label.role) {
            None => chosen.push(file),
            Some(better) if better.rank() > file.rank() => {
                let why = Unused::Inferior { to: better.file.clone() };
                notes.push(Note::Unused { what: file.file.clone(), why });
                if file.label.role == Role::Normal {
                    normals.push(file);
                }
            }
            // One of them may be constant.
            Some(_) if file.label.role == Role::Normal && normals.is_empty() => normals.push(file),
            Some(equal) => {
                return Err(two_pictures(path, &file, equal));
            }
        }
    }
    Ok((chosen, normals))
}

/// The refusal of two files that are equally the picture of one map.
pub(super) fn two_pictures(path: &Path, one: &LabelledFile, other: &LabelledFile) -> Error {
    let (first, second) = if one.file < other.file { (one, other) } else { (other, one) };
    Error::NotAMaterial {
        path: path.to_owned(),
        expected: format!("one picture for the {} map", one.label.role.name()),
        found: format!("{} and {}", first.file, second.file),
        remedy: "give the prefix that only the files of this material share, or move one away".to_owned(),
    }
}
