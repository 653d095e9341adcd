//! The pictures that a file lists, decoded at once before they are asked for.

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::error::Error;
use crate::files::read::decode::decode_one;
use crate::files::read::note::{Note, Subject};
use crate::files::read::raster::Raster;
use crate::progress::Progress;

/// A picture and what it is expected to be.
type Wanted = (PathBuf, Subject);

/// Pictures that have been decoded. One that cannot be is decoded again when it is asked for, to say why.
pub(crate) struct Ahead(Vec<(Wanted, (Raster, Vec<Note>))>);

impl Ahead {
    /// Decodes the `wanted` pictures; each is one step of `progress`.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(crate) fn of(mut wanted: Vec<Wanted>, progress: &Progress) -> Result<Self, Error> {
        let mut seen: Vec<Wanted> = Vec::new();
        wanted.retain(|one| {
            let is_new = !seen.contains(one);
            seen.extend(is_new.then(|| one.clone()));
            is_new
        });
        progress.begin(wanted.len() as u64);
        let decode = |(path, what): Wanted| {
            let decoded = decode_one(&path, what).ok();
            progress.step()?;
            Ok(decoded.map(|decoded| ((path, what), decoded)))
        };
        let all: Vec<_> = wanted.into_par_iter().map(decode).collect::<Result<_, Error>>()?;
        Ok(Self(all.into_iter().flatten().collect()))
    }

    /// The only picture of the file `path`.
    ///
    /// # Errors
    /// As [`decode_one`].
    pub(crate) fn picture(&self, path: &Path, what: Subject) -> Result<(Raster, Vec<Note>), Error> {
        let is_it = |((file, subject), _): &&(Wanted, _)| file == path && *subject == what;
        match self.0.iter().find(is_it) {
            Some((_, decoded)) => Ok(decoded.clone()),
            None => decode_one(path, what),
        }
    }
}
