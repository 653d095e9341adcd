//! One picture of a material: where its bytes are, and what it is expected to be.

use std::fmt;
use std::path::PathBuf;

use crate::disk::open::NamedFile;
use crate::read::record::Subject;

/// A picture that has not been decoded.
#[derive(Clone, Debug)]
pub(crate) struct LocatedPicture {
    pub source: PictureSource,
    pub subject: Subject,
}

/// The place of the bytes of a picture.
#[derive(Clone)]
pub(crate) enum PictureSource {
    File(NamedFile),
    /// Bytes within the file of this path.
    Embedded {
        within: PathBuf,
        bytes: Vec<u8>,
    },
}

/// Without the bytes: there may be millions.
impl fmt::Debug for PictureSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(file) => f.debug_tuple("File").field(file).finish(),
            Self::Embedded { within, .. } => f.debug_tuple("Embedded").field(within).finish(),
        }
    }
}
