//! Errors of files: materials, renderings, scenes, sessions and captures that cannot be read or written.

use std::io;
use std::path::{Path, PathBuf};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;

/// The error of every fallible operation of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file or folder cannot be opened or read.
    #[error("cannot read {}: {source}; check that the path is right and readable", path.display())]
    Unreadable { path: PathBuf, source: io::Error },

    /// A file is there, but is not an image that can be decoded.
    #[error("cannot decode {}: {problem}; {remedy}", path.display())]
    BadImage { path: PathBuf, problem: String, remedy: String },

    /// What was read is not the four maps of a material.
    #[error("{} is not a material: expected {expected}, found {found}; {remedy}", path.display())]
    NotAMaterial { path: PathBuf, expected: String, found: String, remedy: String },

    /// A folder or a table that is no data set.
    #[error("{} is not a data set: expected {expected}, found {found}; {remedy}", path.display())]
    NotADataSet { path: PathBuf, expected: String, found: String, remedy: &'static str },

    /// A map that a material needs is not among what was read.
    #[error("{} is not a material: expected one picture for the {map} map (named after one of {examples}), found {found}; \
        add or rename the file, specify the map, or open a packed picture by itself", path.display())]
    MissingMap { path: PathBuf, map: &'static str, examples: String, found: String },

    /// A packed image was expected, and the picture cannot be divided into one.
    #[error("{} is not a material: expected {}, found {} x {} pixels; give a packed image, or a folder or prefix of one \
        file per map", path.display(), expected_tiles(*grid), size[0], size[1])]
    NotPacked {
        path: PathBuf,
        size: [usize; 2],
        /// Columns and rows of tiles, where they were specified.
        grid: Option<[usize; 2]>,
    },

    /// A file holds fewer materials than were counted on.
    #[error("{} holds {count} materials: expected an exemplar from 0 to {}, found {exemplar}; count from 0",
        path.display(), count.saturating_sub(1))]
    NoSuchExemplar { path: PathBuf, count: usize, exemplar: usize },

    /// A sidecar file cannot be understood.
    #[error("{} does not specify how a material is read: {problem}; expected an object such as \
        {{\"albedo\": \"srgb\", \"maps\": {{\"roughness\": \"orm.png:g\"}}}}, of the keys {keys}", path.display())]
    BadSidecar { path: PathBuf, problem: String, keys: String },

    /// Something had to be guessed where the user wants no guesses.
    #[error("{} is ambiguous: {}; specify what is unsure, or allow guesses", path.display(), texts(guesses))]
    Guessed { path: PathBuf, guesses: Vec<Guess> },

    /// A crop of a figure reaches beyond the materials.
    #[error("the crop {} reaches beyond the material: expected columns 0 to {} and rows 0 to {} of {} x {} texels, found \
        columns {} to {} and rows {} to {}; move it, or make it smaller", crop.map(|n| n.to_string()).join(","),
        size[0].saturating_sub(1), size[1].saturating_sub(1), size[0], size[1],
        crop[0], last(crop[0], crop[2]), crop[1], last(crop[1], crop[3]))]
    CropOutside {
        /// Left, top, width and height.
        crop: [usize; 4],
        size: [usize; 2],
    },

    /// The columns of a figure have no room beside the names of its rows.
    #[error(
        "{columns} columns with texts of {text_pt} pt do not fit into {width_mm} mm: expected at least {least:.0} mm; make the \
        figure wider, its text smaller or its names shorter"
    )]
    FigureTooNarrow { width_mm: f64, columns: usize, text_pt: f64, least: f64 },

    /// The rows of a figure have no room in its height.
    #[error(
        "a figure of {rows} rows with texts of {text_pt} pt cannot be {height_mm} mm high: expected at least {least:.0} mm; give it more \
        height, fewer materials or smaller text"
    )]
    FigureTooHigh { height_mm: f64, rows: usize, text_pt: f64, least: f64 },

    /// A page that programs refuse to open.
    #[error("a PDF page of {:.0} x {:.0} mm is too large: expected at most {most:.0} mm; show fewer materials or methods, or \
        write SVG or PNG", millimetres[0], millimetres[1])]
    PageTooLarge { millimetres: [f64; 2], most: f64 },

    /// Maps of one material have different shapes.
    #[error("sizes differ: {first} is {} x {}, {second} is {} x {}; resize them so that the maps of a material have \
        one shape", first_size[0], first_size[1], second_size[0], second_size[1])]
    MapSizesDiffer { first: String, first_size: [usize; 2], second: String, second_size: [usize; 2] },

    /// Samples of a map are NaN or infinite.
    #[error("{}: {map} map, column {column}, row {row}: expected finite numbers, found {value}, one of {nans} NaN and \
        {infinities} infinite samples; correct the map", path.display())]
    NotFinite {
        path: PathBuf,
        map: &'static str,
        column: usize,
        row: usize,
        value: f32,
        nans: usize,
        infinities: usize,
    },

    /// A scene file is not one, or one of its scenes cannot be rendered.
    #[error("{} is not a usable scene file: {problem}; expected \
        {{\"scenes\": [{{\"kind\": \"near\" or \"distant\", \"view\": [x, y, z], \"light\": [x, y, z]}}, ...]}}, \
        finite, light and view above the plane", path.display())]
    BadScene { path: PathBuf, problem: String },

    /// A file whose text is no convention.
    #[error("{}: {problem}", path.display())]
    BadConvention { path: PathBuf, problem: String },

    /// A file of arrays that is none, or that lacks what is needed.
    #[error("{} cannot be used: {problem}", path.display())]
    BadArrays { path: PathBuf, problem: String },

    /// A capture cannot be used: a folder of photographs with their lights and views.
    #[error("{} is not a usable capture: {problem}; expected capture.json, or render.json of MaterialGAN, or the \
        folder of one", path.display())]
    BadCapture { path: PathBuf, problem: String },

    /// Two values of one option.
    #[error("{option} is specified twice; leave out one")]
    SpecifiedTwice { option: String },

    /// A session file that cannot be used.
    #[error("the session {} cannot be opened: {problem}; save it again from the window", path.display())]
    BadSession { path: PathBuf, problem: String },

    /// A session names a built-in material that does not exist.
    #[error("there is no built-in material {number}: expected a number from 0 to {}; correct the session file", count - 1)]
    NoSuchBuiltIn { number: usize, count: usize },

    /// More than one scene file, where the scenes of a loss come from one.
    #[error("expected one scene file, found {} and {}; give one of them", first.display(), second.display())]
    SeveralSceneFiles { first: PathBuf, second: PathBuf },

    /// A kind of file that a material cannot be written to in this way.
    #[error("{} {problem}", path.display())]
    UnsupportedOutput { path: PathBuf, problem: OutputProblem },

    /// A defect of this program.
    #[error("internal error: {0}; report it with what you did")]
    Internal(String),

    /// A result cannot be written.
    #[error("cannot write {}: {source}; {remedy}", path.display())]
    Unwritable { path: PathBuf, source: io::Error, remedy: &'static str },

    /// A file names another by an absolute path.
    #[error("{} names {} by an absolute path: only files by relative paths are read; use a relative path, or allow files \
        outside, if you trust it", by.display(), path.display())]
    Outside { path: PathBuf, by: PathBuf },

    /// Something other than a regular file stands where one is expected.
    #[error("cannot read {}: expected a regular file, found {found}; name a file", path.display())]
    NotAFile { path: PathBuf, found: &'static str },

    /// Something takes more memory than the limit leaves.
    #[error("{what} takes {} of memory, more than the limit of {} leaves; use smaller files, or raise the limit",
        size(*bytes), size(*limit))]
    Memory { what: String, bytes: u64, limit: u64 },

    /// The system does not give as much memory as something takes.
    #[error("{what} takes {} of memory, which the system does not give now; use smaller files, or raise its limit",
        size(*bytes))]
    NoMemory { what: String, bytes: u64 },

    /// A result would replace a file that it is made from.
    #[error("cannot write {}: it is the file {}, which the result is made from; name another file",
        path.display(), input.display())]
    ReplacesInput { path: PathBuf, input: PathBuf },

    /// Of a computation.
    #[error(transparent)]
    Core(#[from] CoreError),
}

/// A guess in reading a material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Guess {
    /// What was guessed, and why.
    pub text: String,
    /// The key of the option that specifies it, where there is one.
    pub key: Option<&'static str>,
}

fn texts(guesses: &[Guess]) -> String {
    guesses.iter().map(|guess| guess.text.as_str()).collect::<Vec<_>>().join("; ")
}

/// Why a material cannot be written to a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OutputProblem {
    #[error(
        "cannot be written: expected an .exr, .png or .glb file, or a folder, which exists, ends with / or has no extension"
    )]
    Kind,
    #[error("cannot have that depth; EXR has half and float, every other form 8 and 16")]
    Depth,
}

/// A number of bytes in GiB or MiB.
fn size(bytes: u64) -> String {
    match bytes {
        0..0x4000_0000 => format!("{} MiB", bytes.div_ceil(1 << 20)),
        _ => format!("{:.1} GiB", bytes as f64 / (1u64 << 30) as f64),
    }
}

/// The last of `count` columns or rows.
fn last(first: usize, count: usize) -> usize {
    first.saturating_add(count.saturating_sub(1))
}

/// What a packed image has to be.
fn expected_tiles(grid: Option<[usize; 2]>) -> String {
    match grid {
        Some([columns, rows]) => format!("a packed image of {columns} x {rows} tiles with room for the order"),
        None => "a packed strip of square tiles (any photos, then normal | diffuse | roughness | specular, 4 or more \
            times as wide as high), or another grid in which one tile looks like normals"
            .to_owned(),
    }
}

impl Error {
    /// [`Error::Unreadable`] for `path`.
    pub fn unreadable(path: &Path, source: io::Error) -> Self {
        Self::Unreadable { path: path.to_owned(), source }
    }

    /// [`Error::Unwritable`] for `path`, unless the writer has stopped since `progress` was cancelled.
    pub(crate) fn unwritten(
        path: &Path,
        source: io::Error,
        remedy: &'static str,
        progress: &Progress,
    ) -> Self {
        match progress.is_cancelled() {
            true => CoreError::Cancelled.into(),
            false => Self::Unwritable { path: path.to_owned(), source, remedy },
        }
    }

    /// The error of a computation, where it is one.
    pub fn core(&self) -> Option<&CoreError> {
        match self {
            Self::Core(error) => Some(error),
            _ => None,
        }
    }

    /// Whether the caller cancelled the work.
    pub fn is_cancelled(&self) -> bool {
        matches!(self, Self::Core(CoreError::Cancelled))
    }
}
