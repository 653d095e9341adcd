//! A set of pictures: one file for each map.

use std::path::PathBuf;

use super::picture::{LocatedPicture, PictureSource};
use crate::disk::open::NamedFile;
use crate::read::names::{Label, is_named_within};
use crate::read::options::{NormalY, Role, extensions};
use crate::read::record::{Note, Subject, Unused};

/// The word of files that are maps by their numbers alone.
pub(crate) const NUMBERED: &str = "0 to 3";

/// A file whose name names a map.
#[derive(Clone, Debug)]
pub(crate) struct LabelledFile {
    pub file: String,
    pub label: Label,
}

impl LabelledFile {
    /// The higher, the better a source for its map.
    pub(crate) fn rank(&self) -> (u8, Option<usize>) {
        let extension = extensions::of_name(&self.file);
        (self.label.rank(), extensions::PICTURES.iter().position(|e| *e == extension))
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
pub(crate) struct SetFiles {
    pub files: Vec<LabelledFile>,
    /// Other pictures of the normal map, which count where the chosen one is constant.
    pub other_normals: Vec<LabelledFile>,
    /// Pictures whose names name no map.
    pub unlabelled: Vec<String>,
    /// Pictures of maps whose names are not those of the set, but nearly so.
    pub misnamed: Vec<String>,
    /// Documents beside them that list them, too.
    pub documents: Vec<ListingDocument>,
    /// Pictures of heights, which tell the direction of y.
    pub heights: Vec<String>,
    pub notes: Vec<Note>,
}

impl SetFiles {
    /// The names of all pictures, also of those that count only where the pixels of others call for them.
    pub(crate) fn names(&self) -> impl Iterator<Item = &String> {
        let labelled = self.files.iter().chain(&self.other_normals).map(|one| &one.file);
        labelled.chain(&self.unlabelled).chain(&self.misnamed).chain(&self.heights)
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
}

/// The set of a material, in one folder.
#[derive(Debug)]
pub(crate) struct LocatedSet {
    /// The path that the user gave, for messages.
    pub path: PathBuf,
    pub folder: PathBuf,
    /// The name of the material.
    pub name: String,
    pub files: SetFiles,
    /// The files of the folder, for messages.
    pub listing: String,
    /// Whether a folder of renderings is beside the files, as in the data sets of SurfaceNet.
    pub has_renderings: bool,
}

impl LocatedSet {
    /// A file of the folder, which the folder names.
    pub(crate) fn file(&self, name: &str) -> NamedFile {
        NamedFile::by_file(self.folder.join(name), &self.folder)
    }

    /// The pictures of the chosen files.
    pub(crate) fn pictures(&self) -> impl Iterator<Item = LocatedPicture> + '_ {
        let picture = |LabelledFile { file, label }: &LabelledFile| LocatedPicture {
            source: PictureSource::File(self.file(file)),
            subject: Subject::Map(label.role),
        };
        self.files.files.iter().map(picture)
    }

    /// The path of a file of the folder.
    pub(crate) fn path_of(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }
}
