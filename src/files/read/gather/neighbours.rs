//! Evidence of neighbours: the pixels of other materials of the same collection.
//!
//! They are located and decoded here, as those of the material itself were before, and only where its own pixels leave
//! its colours open: a collection stores all its materials in one way.

use std::path::PathBuf;

use rayon::prelude::*;
use sha2::{Digest as _, Sha256};

use super::colours::measured;
use super::log_odds::MOST_OF_NEIGHBOURS;
use crate::disk::open::{NamedFile, hexadecimal};
use crate::disk::stamp::Stamp;
use crate::error::Error;
use crate::read::decode;
use crate::read::locate::neighbours;
use crate::read::record::{Evidence, Subject};

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
        let pairs = neighbours::pairs(&maps[0], &maps[1]);
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
