//! Digests of the files that a ranking is of, by which anyone can tell whether theirs are the same.

use std::collections::BTreeMap;

use svbrdf_core::parallel;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::{MaterialPath, ReadOptions};

use super::record::Case;
use crate::error::Error;

/// Hexadecimal digits of a digest.
const DIGITS: usize = 16;

/// The beginning of the SHA-256 of the files of each material, by `ground truth, wood` and `ours, wood`. A material that cannot be located has
/// none.
///
/// # Errors
/// [`Cancelled`](Error::is_cancelled).
pub fn digests(cases: &[Case], progress: &Progress) -> Result<BTreeMap<String, String>, Error> {
    let of = |index: usize| {
        if progress.is_cancelled() {
            return Err(Error::from(svbrdf_core::error::Error::Cancelled));
        }
        let case = &cases[index];
        let truth = ("ground truth".to_owned(), &case.ground_truth);
        let predictions = case.candidates.iter().map(|one| match one.sample {
            0 => (one.method.clone(), &one.path),
            sample => (format!("{} {sample}", one.method), &one.path),
        });
        let digest = |(whose, path): (String, &std::path::PathBuf)| {
            let found = MaterialPath::new(path, &ReadOptions::AUTO).dependencies().ok()?;
            Some((format!("{whose}, {}", case.material), found.sha256.get(..DIGITS)?.to_owned()))
        };
        Ok::<_, Error>([truth].into_iter().chain(predictions).filter_map(digest).collect::<Vec<_>>())
    };
    Ok(parallel::try_map(cases.len(), of)?.into_iter().flatten().collect())
}
