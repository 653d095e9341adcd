//! One picture of a material: where its bytes are, and what it is expected to be.

use std::path::PathBuf;

use crate::open::NamedFile;
use crate::read::record::Subject;

/// A picture that has not been decoded.
#[derive(Clone, Debug)]
pub(crate) struct LocatedPicture {
    pub source: PictureSource,
    pub subject: Subject,
}

/// The place of the bytes of a picture.
#[derive(Clone, Debug)]
pub(crate) enum PictureSource {
    File(NamedFile),
    /// Bytes within the file of this path.
    Embedded {
        within: PathBuf,
        bytes: Vec<u8>,
    },
}
