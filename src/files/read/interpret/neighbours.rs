//! Evidence of neighbours: the pixels of other materials of the same collection.
//!
//! They are pictures of the same file names in folders beside, or of other stems in the same folder. They are decoded only where the
//! pixels of the material itself leave its colours open: a collection stores all its materials in one way.

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use sha2::{Digest as _, Sha256};

use super::evidence::{MOST_OF_NEIGHBOURS, measured};
use crate::disk::open::{NamedFile, hexadecimal};
use crate::disk::stamp::Stamp;
use crate::error::Error;
use crate::read::decode;
use crate::read::names::{Label, folders, list};
use crate::read::record::{Evidence, Subject};

/// Most neighbours that are looked at.
const MOST: usize = 4;
/// Longest file of one in bytes: their evidence is not worth waiting long.
const LONGEST: u64 = 16 << 20;

/// The neighbours that the reading of a material looked at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Neighbours {
    /// The pictures of diffuse and specular whose neighbours they are.
    maps: [PathBuf; 2],
    pairs: Vec<[NamedFile; 2]>,
    /// Of the files of the pairs.
    stamps: Vec<Option<Stamp>>,
}

impl Neighbours {
    /// The neighbours as they are now.
    pub fn of(maps: [PathBuf; 2]) -> Self {
        let pairs = pairs(&maps[0], &maps[1]);
        let stamps = pairs.iter().flatten().map(|file| Stamp::of(file.path())).collect();
        Self { maps, pairs, stamps }
    }

    pub fn maps(&self) -> &[PathBuf; 2] {
        &self.maps
    }

    /// The SHA-256 of their content, in hexadecimal.
    ///
    /// # Errors
    /// [`Error::Unreadable`].
    pub fn digest(&self) -> Result<String, Error> {
        let mut hash = Sha256::new();
        for file in self.pairs.iter().flatten() {
            hash.update(file.digest()?);
        }
        Ok(hexadecimal(hash))
    }

    /// The evidence of their pixels.
    pub(super) fn evidence(&self) -> Option<Evidence> {
        let decoded = |file: &NamedFile| Some(decode::one(file, Subject::Picture).ok()?.0.raster);
        let decoded = self.pairs.par_iter().filter_map(|[a, b]| Some([decoded(a)?, decoded(b)?]));
        let pairs: Vec<_> = decoded.collect();
        let of_pair = |[d, s]: &[_; 2]| measured(d, s).iter().map(|one| one.log_odds()).sum::<f64>();
        let log_odds = 0.5 * pairs.iter().map(of_pair).sum::<f64>();
        let log_odds = log_odds.clamp(-MOST_OF_NEIGHBOURS, MOST_OF_NEIGHBOURS);
        (log_odds != 0.0).then_some(Evidence::Neighbours { count: pairs.len(), log_odds })
    }
}

/// Pairs of pictures of neighbours that correspond to `first` and `second` of a material.
fn pairs(first: &Path, second: &Path) -> Vec<[NamedFile; 2]> {
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
