//! Evidence of neighbours: the pixels of other materials of the same collection.
//!
//! They are located and decoded here, as those of the material itself were before, and only where its own pixels leave
//! its colours open: a collection stores all its materials in one way.

use std::path::Path;

use rayon::prelude::*;

use super::colours::measured;
use super::log_odds::MOST_OF_NEIGHBOURS;
use crate::open::NamedFile;
use crate::read::decode;
use crate::read::locate::neighbours;
use crate::read::record::{Evidence, Subject};

/// The evidence of the neighbours of the material with these pictures of diffuse and specular.
pub(super) fn evidence(diffuse: &Path, specular: &Path) -> Option<Evidence> {
    let decoded = |file: &NamedFile| Some(decode::one(file, Subject::Picture).ok()?.0);
    let pairs = neighbours::pairs(diffuse, specular);
    let pairs: Vec<_> = pairs.par_iter().filter_map(|[a, b]| Some([decoded(a)?, decoded(b)?])).collect();
    let of_pairs = pairs.iter().map(|[d, s]| measured(d, s).iter().map(|one| one.log_odds()).sum::<f64>());
    let log_odds = 0.5 * of_pairs.sum::<f64>();
    let log_odds = log_odds.clamp(-MOST_OF_NEIGHBOURS, MOST_OF_NEIGHBOURS);
    (log_odds != 0.0).then_some(Evidence::Neighbours { count: pairs.len(), log_odds })
}
