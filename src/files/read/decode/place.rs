//! Parts that all decoders share: their results, their refusals, and the limits of pictures.

use std::io::{BufReader, Read, Seek};
use std::path::Path;

use glam::DMat3;
use svbrdf_core::text::quoted;

use crate::disk::memory::{self, Reserved};
use crate::error::Error;
use crate::read::options::Role;
use crate::read::options::transfer::{Chromaticities, to_rec709};
use crate::read::raster::{Raster, Samples};
use crate::read::record::{Note, Subject};

/// Largest side of a map: the largest that material libraries publish.
pub(crate) const MAX_SIDE: usize = 16_384;
/// Largest width of an image: a strip of four of the largest maps. The same upright.
pub(crate) const MAX_WIDTH: usize = 4 * MAX_SIDE;
/// Most bytes that an image may decode to: a strip of the largest size takes 3 GiB in 8-bit RGB.
pub(crate) const MAX_BYTES: u64 = 4 << 30;

/// The most bytes of samples, as [`DecodedFile::check_size`] gets them, that a byte of a file stands for in each format.
pub(crate) mod ratio {
    /// Of zlib: two bits for 258 bytes.
    const DEFLATE: u64 = 1032;
    /// A byte of a palette is 8 texels of 4 bytes.
    pub(crate) const PNG: u64 = 32 * DEFLATE;
    /// LZW of one value: 3838 bytes a code of 12 bits; chroma may be halved. A fax takes less, and has bits, which are refused before.
    pub(crate) const TIFF: u64 = 1 << 13;
    /// One bit a block, of which 4 x 4 are of luma.
    pub(crate) const JPEG: u64 = 1366;
    /// A bit of a palette is 3 bytes.
    pub(crate) const BMP: u64 = 24;
    /// The modes of a block of 16 x 16 texels of 3 bytes take 1.67 bits.
    pub(crate) const LOSSY_WEBP: u64 = 1 << 12;
    /// Runs of 62 texels of 4 bytes; two bytes for 128 texels.
    pub(crate) const QOI: u64 = 248;
    pub(crate) const TGA: u64 = 256;
    /// Two runs of the old kind for a row of 65536 texels of 12 bytes.
    pub(crate) const HDR: u64 = 1 << 16;
    /// A byte of a bitmap is 8 texels.
    pub(crate) const PNM: u64 = 8;
    pub(crate) const PFM: u64 = 1;
    /// Blocks of ASTC: 16 bytes for 144 texels of four floats.
    pub(crate) const DDS: u64 = 144;
    /// Runs within zlib, as blocks of DWA have them, of half, which takes twice as much as float.
    pub(crate) const EXR: u64 = 2 * 64 * DEFLATE;
    /// A value of a byte counts 8.
    pub(crate) const NUMPY: u64 = 8 * DEFLATE;
    /// A plane of one colour takes nothing in WebP without loss and in arithmetic coding, and BMP with runs may end before its picture.
    pub(crate) const NONE: u64 = u64::MAX;
}

/// Bytes that decoders go back in.
pub(crate) trait Bytes: Read + Seek + Send {}

impl<T: Read + Seek + Send> Bytes for T {}

/// The source of every decoder: a file, or a picture within another file that is in memory. One type for both: the libraries
/// are compiled for each type that they read from.
pub(crate) type ByteReader<'a> = BufReader<Box<dyn Bytes + 'a>>;

/// The source of these bytes, from their beginning.
pub(crate) fn reader<'a>(bytes: impl Bytes + 'a) -> ByteReader<'a> {
    BufReader::new(Box::new(bytes))
}

/// The formats that open, for messages.
pub(crate) const FORMATS: &str = "PNG, TIFF, JPEG, TGA, BMP, WebP, PNM, PFM, QOI, DDS, HDR, EXR, npy or npz";

/// One picture of a file: of a layered file a layer, of an archive an array.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Layer {
    /// Empty for the only picture of a file.
    pub name: String,
    pub raster: Raster,
    /// All that is stored, where the picture is another part of the plane.
    pub uncropped: Option<Raster>,
    /// The order and encoding that this program wrote into it.
    pub meaning: Option<String>,
}

#[derive(Debug, Default)]
pub(crate) struct Decoded {
    pub layers: Vec<Layer>,
    /// The number of materials that stand below each other in them, where they are a batch.
    pub batch: Option<usize>,
    pub notes: Vec<Note>,
}

/// The file that is being decoded, and its subject: for messages.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DecodedFile<'a> {
    pub path: &'a Path,
    pub what: Subject,
    pub length: u64,
}

impl<'a> DecodedFile<'a> {
    /// One whose length does not matter.
    pub(super) fn of(path: &'a Path, what: Subject) -> Self {
        Self { path, what, length: u64::MAX }
    }

    pub(super) fn bad(self, problem: impl AsRef<str>, remedy: &str) -> Error {
        Error::BadImage {
            path: self.path.to_owned(),
            problem: match self.what {
                Subject::Material => problem.as_ref().to_owned(),
                map => format!("{map}: {}", problem.as_ref()),
            },
            remedy: remedy.to_owned(),
        }
    }

    /// An error of a library that decodes `format`.
    pub(super) fn invalid(self, format: &str, found: impl std::fmt::Display) -> Error {
        let remedy = "copy it again, or save it with a program that opens it";
        self.bad(format!("expected a valid {format}, found: {found}"), remedy)
    }

    /// The remedy for a file that other programs read: the command that makes a PNG of it.
    pub(super) fn to_png(self) -> String {
        let [file, png] = [self.path, &self.path.with_extension("png")].map(quoted);
        format!("convert it, and use the PNG in its place: magick {file} {png}")
    }

    /// The picture of 1 to 4 channels: the last of 2 or 4 is alpha, but of 2 in a map of normals y.
    pub(super) fn raster(self, size: [usize; 2], depth: &'static str, channels: Vec<Samples>) -> Raster {
        let [width, height] = size;
        let is_normal = self.what == Subject::Map(Role::Normal);
        if is_normal && channels.len() == 2 && !channels[1].is_all(1.0) {
            return Raster { width, height, depth, channels, alpha: None, to_rec709: None };
        }
        Raster::with_alpha(width, height, depth, channels)
    }

    /// The matrix from primaries that the file declares to those of Rec. 709, where they are others; noted where there is none.
    pub(super) fn to_rec709(self, declared: Chromaticities, notes: &mut Vec<Note>) -> Option<DMat3> {
        /// Matrices that differ from the identity by less are those of rounded chromaticities.
        const SAME: f64 = 1e-3;
        let matrix = to_rec709(declared);
        if matrix.is_none() && !self.is_data() {
            notes.push(Note::Primaries);
        }
        matrix.filter(|matrix| !matrix.abs_diff_eq(DMat3::IDENTITY, SAME))
    }

    /// Whether the picture is known to hold data, for which colour spaces mean nothing.
    pub(super) fn is_data(self) -> bool {
        match self.what {
            Subject::Map(role) => {
                role.packing().is_some()
                    || matches!(role, Role::Normal | Role::NormalRoughness | Role::Roughness | Role::Metallic)
            }
            _ => false,
        }
    }

    /// Whether the picture is one of a camera, whose orientation counts, and not one of texels.
    pub(super) fn is_photograph(self) -> bool {
        self.what == Subject::Photograph
    }

    pub(super) fn truncated(self) -> Error {
        self.bad("expected the whole image, found the end of the file within it", "copy the file again")
    }

    /// Refuses sizes before anything is allocated, and puts the memory aside: `bytes` is what all samples take, of which a byte of
    /// the file stands for `ratio` at most.
    pub(super) fn check_size(
        self,
        [width, height]: [u64; 2],
        bytes: u64,
        ratio: u64,
    ) -> Result<Reserved, Error> {
        if width == 0 || height == 0 {
            return Err(
                self.bad(format!("expected at least one pixel, found {width} x {height}"), "save it again")
            );
        }
        let (long, short) = (width.max(height), width.min(height));
        if long > MAX_WIDTH as u64 || short > MAX_SIDE as u64 || bytes > MAX_BYTES {
            let problem = format!(
                "expected at most {MAX_WIDTH} x {MAX_SIDE} pixels and {} GiB, found {width} x {height}",
                MAX_BYTES >> 30
            );
            return Err(self.bad(problem, "scale it down"));
        }
        let least = bytes / ratio;
        if least > self.length {
            let problem = format!(
                "expected at least {least} bytes for {width} x {height} pixels, found {}",
                self.length
            );
            return Err(self.bad(problem, "copy the file again"));
        }
        self.reserve(bytes)
    }

    /// Metadata of the file that is ignored: an orientation as in Exif, 1 for none, and a colour profile.
    pub(super) fn metadata_notes(self, orientation: u8, profile: Option<&[u8]>) -> Vec<Note> {
        let mut notes = Vec::new();
        let what = self.what;
        if orientation != 1 && !self.is_photograph() {
            let ignored = "has an EXIF orientation, which is ignored: rows are read as stored";
            notes.push(Note::Told(format!("The {what} {ignored}.")));
        }
        if profile.filter(|_| !self.is_data()).is_some_and(|profile| !is_srgb(profile)) {
            notes.push(Note::Profile(what));
        }
        notes
    }

    /// Puts memory aside while the file is decoded.
    ///
    /// # Errors
    /// [`Error::Memory`].
    pub(super) fn reserve(self, bytes: u64) -> Result<Reserved, Error> {
        memory::reserve(bytes, || format!("{}: {}", self.path.display(), self.what))
    }
}

/// Whether an ICC profile calls itself sRGB, in ASCII or UTF-16.
fn is_srgb(profile: &[u8]) -> bool {
    let contains = |name: &[u8]| profile.windows(name.len()).any(|bytes| bytes == name);
    contains(b"sRGB") || contains(b"s\0R\0G\0B")
}

pub(crate) fn alone(layer: impl Into<Layer>) -> Decoded {
    Decoded { layers: vec![layer.into()], ..Decoded::default() }
}

impl From<Raster> for Layer {
    fn from(raster: Raster) -> Self {
        Self { name: String::new(), raster, uncropped: None, meaning: None }
    }
}
