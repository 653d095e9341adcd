//! Neighbours: pictures of other materials of the same collection, of the same file names in folders beside, or of other
//! stems in the same folder.

use std::path::{Path, PathBuf};

use super::directory::{folders, list};
use crate::disk::open::NamedFile;
use crate::read::names::Label;

/// Most neighbours that are looked at.
const MOST: usize = 4;
/// Longest file of one in bytes: their evidence is not worth waiting long.
const LONGEST: u64 = 16 << 20;

/// Pairs of pictures of neighbours that correspond to `first` and `second` of a material.
pub(in crate::read) fn pairs(first: &Path, second: &Path) -> Vec<[NamedFile; 2]> {
    let is_short = |file: &PathBuf| file.metadata().is_ok_and(|meta| meta.len() <= LONGEST);
    let mut pairs = beside(first, second).unwrap_or_default();
    pairs.extend(within(first, second).unwrap_or_default());
    pairs.retain(|pair| pair.iter().all(is_short));
    pairs.truncate(MOST);
    let named = |file: PathBuf| NamedFile::by_file(file, first.parent().unwrap_or(first));
    pairs.into_iter().map(|pair| pair.map(named)).collect()
}

/// In the folders beside the folder of `first`, under the same names.
fn beside(first: &Path, second: &Path) -> Option<Vec<[PathBuf; 2]>> {
    let folder = first.parent().filter(|folder| second.parent() == Some(folder))?.canonicalize().ok()?;
    let names = [first.file_name()?, second.file_name()?];
    let others = folders(folder.parent()?).ok()?;
    let others = others.iter().map(|name| folder.with_file_name(name)).filter(|other| *other != folder);
    Some(others.map(|other| names.map(|name| other.join(name))).collect())
}

/// In the folder of `first`, of other stems.
fn within(first: &Path, second: &Path) -> Option<Vec<[PathBuf; 2]>> {
    let folder = first.parent().filter(|folder| second.parent() == Some(folder))?;
    let label =
        |file: &Path| Some((Label::of(&file.file_stem()?.to_string_lossy())?, file.extension()?.to_owned()));
    let [own, of_second] = [label(first)?, label(second)?];
    let all: Vec<_> = list(folder, folder, "").ok()?.iter().map(|name| folder.join(name)).collect();
    let all: Vec<_> = all.iter().filter_map(|file| Some((file, label(file)?))).collect();
    let is_alike = |a: &(Label, _), b: &(Label, _)| a.0.word == b.0.word && a.1 == b.1;
    let others = all.iter().filter(|(_, other)| is_alike(other, &own) && other.0.stem != own.0.stem);
    let partner = |stem: &[String]| {
        let is_partner =
            |(_, other): &&(&PathBuf, (Label, _))| is_alike(other, &of_second) && other.0.stem == stem;
        all.iter().find(is_partner).map(|(file, _)| (*file).clone())
    };
    Some(others.filter_map(|(file, other)| Some([(*file).clone(), partner(&other.0.stem)?])).collect())
}
