//! The files of a set: one picture for each map, by their names, with what else the folder tells about them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::disk::open::NamedFile;
use crate::read::names::{Label, PICTURES, extension, is_named_within, size, words};
use crate::read::options::{NormalY, Role};
use crate::read::record::{Note, Unused};
use crate::read::stored::Picture;

/// The word of files that are maps by their numbers alone.
pub(crate) const NUMBERED: &str = "0 to 3";

#[derive(Clone, Debug)]
pub(crate) struct LabelledFile {
    pub file: String,
    pub label: Label,
}

impl LabelledFile {
    /// The higher, the better a source for its map.
    pub(crate) fn rank(&self) -> (u8, Option<usize>) {
        let extension = extension(&self.file);
        (self.label.rank(), PICTURES.iter().position(|e| *e == extension))
    }
}

/// A document beside a set that lists pictures of it.
#[derive(Clone, Debug)]
pub(crate) struct ListingDocument {
    pub name: String,
    /// The files of the set that it names.
    pub files: Vec<String>,
    /// Where y of normals points by its format.
    pub normal_y: Option<NormalY>,
}

/// One file for each map.
#[derive(Debug, Default)]
pub(in crate::read) struct Set {
    /// The path that the user gave, for messages.
    pub path: PathBuf,
    pub folder: PathBuf,
    pub name: String,
    pub files: Vec<LabelledFile>,
    /// Other pictures of the normal map, which count where the chosen one is constant.
    pub other_normals: Vec<LabelledFile>,
    /// Pictures whose names name no map.
    pub unlabelled: Vec<String>,
    /// Pictures of maps whose names are not those of the set, but nearly so.
    pub misnamed: Vec<String>,
    /// Pictures of heights, which tell the direction of y.
    pub heights: Vec<String>,
    pub notes: Vec<Note>,
    /// Documents beside them that list them, too.
    pub documents: Vec<ListingDocument>,
    pub listing: String,
    /// Whether a folder of renderings is beside the files, as in the data sets of SurfaceNet.
    pub has_renderings: bool,
}

impl Set {
    /// All pictures, also those that count only where the pixels of others call for them.
    pub(crate) fn all(&self) -> impl Iterator<Item = NamedFile> {
        let labelled = self.files.iter().chain(&self.other_normals).map(|one| &one.file);
        let all = labelled.chain(&self.unlabelled).chain(&self.misnamed).chain(&self.heights);
        all.map(|name| self.file(name))
    }

    /// Sorts out the pictures of the folder that are not those of the set of this `stem`: some may be maps of it all the same.
    /// The others are reported where the `whole` folder was wanted.
    pub(crate) fn leave(&mut self, others: Vec<LabelledFile>, stem: &[String], whole: bool) {
        for LabelledFile { file, label } in others {
            let is_akin = label.stem.starts_with(stem) || stem.starts_with(&label.stem);
            let is_near = is_akin && (whole || !stem.is_empty());
            if label.role == Role::Ignored && (whole || is_near) {
                self.notes.push(Note::Unused { what: file, why: Unused::NotAMap });
            } else if is_near {
                self.misnamed.push(file);
            } else if whole {
                self.notes.push(Note::Unused { what: file, why: Unused::OtherStem });
            }
        }
        if !whole {
            self.unlabelled.retain(|name| stem.is_empty() || is_named_within(name, stem));
        }
    }

    /// A file of the folder, which the folder names.
    pub(crate) fn file(&self, name: &str) -> NamedFile {
        NamedFile::by_file(self.folder.join(name), &self.folder)
    }

    pub(crate) fn pictures(&self) -> Vec<Picture> {
        let picture =
            |LabelledFile { file, label }: &LabelledFile| Picture::of_file(self.file(file), label.role);
        self.files.iter().map(picture).collect()
    }

    /// The word that names the map `role`.
    pub(super) fn word(&self, role: Role) -> Option<&str> {
        self.files.iter().find(|file| file.label.role == role).map(|file| file.label.word.as_str())
    }

    pub(crate) fn path_of(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }
}

/// Longest document in bytes that is searched for names.
const LONGEST: u64 = 4 << 20;

/// The documents among the files `names` of `folder` that name a file of the set.
pub(super) fn documents_beside(
    folder: &Path,
    names: &[String],
    files: &[LabelledFile],
) -> Vec<ListingDocument> {
    let listing = |name: &String| {
        let normal_y = match extension(name).as_str() {
            "gltf" | "mtlx" => Some(NormalY::Up),
            "mtl" => None,
            _ => return None,
        };
        let path = folder.join(name);
        if !path.metadata().is_ok_and(|meta| meta.len() <= LONGEST) {
            return None;
        }
        let bytes = NamedFile::by_file(path, folder).bytes().ok()?;
        let text = String::from_utf8_lossy(&bytes);
        let is_named = |file: &String| text.contains(file);
        let files: Vec<_> = files.iter().map(|file| file.file.clone()).filter(is_named).collect();
        (!files.is_empty()).then(|| ListingDocument { name: name.clone(), files, normal_y })
    };
    names.iter().filter_map(listing).collect()
}

/// Words before that of a map which make it the map of a layer that is not modelled.
const LAYERS: [&str; 11] = [
    "clear",
    "coat",
    "clearcoat",
    "sheen",
    "fuzz",
    "detail",
    "emission",
    "emissive",
    "subsurface",
    "transmission",
    "translucency",
];
/// Words of the parameters of a surface (Arnold, OpenPBR), as in `specular_roughness`, whose map is that of the word after them; but the
/// roughness of `diffuse_roughness` is one that is not modelled.
const PARAMETERS: [&str; 5] = ["base", "specular", "geometry", "geo", DIFFUSE];
const DIFFUSE: &str = "diffuse";

/// Moves the maps of layers and parameters, such as `x_coat_normal` and `x_specular_roughness` beside `x_normal`, to their set.
pub(super) fn add_parameters(groups: &mut BTreeMap<Vec<String>, Vec<LabelledFile>>) {
    let is_one = |word: &str| LAYERS.contains(&word) || PARAMETERS.contains(&word);
    let count = |stem: &[String]| stem.iter().rev().take_while(|word| is_one(word)).count();
    let stems: Vec<_> = groups.keys().filter(|stem| count(stem) > 0).cloned().collect();
    for stem in &stems {
        let set_of = |stem: &'_ Vec<String>| stem[..stem.len() - count(stem)].to_vec();
        let (set, words) = (set_of(stem), &stem[stem.len() - count(stem)..]);
        let roles: Vec<Role> = groups[stem].iter().map(|file| file.label.role).collect();
        // A material may be a coat itself.
        let has = |wanted: &[Role]| wanted.iter().any(|role| roles.contains(role));
        let is_whole = has(&[Role::Normal]) && has(&[Role::Base, Role::Diffuse]) && has(&[Role::Roughness]);
        let is_alone = stems.iter().filter(|other| set_of(other) == set).count() < 2;
        if (is_alone && !groups.contains_key(&set)) || is_whole {
            continue;
        }
        let is_layer = words.iter().any(|word| LAYERS.contains(&word.as_str()));
        let is_diffuse = words.iter().any(|word| word == DIFFUSE);
        let files = groups.remove(stem).unwrap_or_default();
        let of_set = groups.entry(set).or_default();
        for mut file in files {
            let is_there = of_set.iter().any(|one| one.label.role == file.label.role);
            if is_layer || is_there || (is_diffuse && file.label.role == Role::Roughness) {
                file.label.role = Role::Ignored;
            }
            of_set.push(file);
        }
    }
}

/// Makes `x_a` the base colour of the files `x_n` and `x_r` beside it that have none: a letter alone names other maps, too.
pub(super) fn add_letter_a(
    groups: &mut BTreeMap<Vec<String>, Vec<LabelledFile>>,
    unlabelled: &mut Vec<String>,
) {
    unlabelled.retain(|name| {
        let mut stem = words(&Path::new(name).file_stem().unwrap_or_default().to_string_lossy());
        let word = stem.pop().filter(|word| word == "a");
        let Some((files, word)) = groups.get_mut(&stem).zip(word) else { return true };
        let is_colour = |one: &LabelledFile| matches!(one.label.role, Role::Base | Role::Diffuse);
        let are_letters = files.iter().filter(|one| one.label.is_short()).count() > 1;
        if !are_letters || files.iter().any(is_colour) {
            return true;
        }
        let label = Label { role: Role::Base, word, stem, normal_y: None };
        files.push(LabelledFile { file: name.clone(), label });
        false
    });
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
