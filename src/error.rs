//! What can go wrong: one variant per cause. Each says where, what was expected, what was found and what to do.

use std::io;
use std::path::{Path, PathBuf};

use crate::text::percent;

/// The error of every fallible operation of this crate. Its text is complete: it ends with what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file or folder cannot be opened or read.
    #[error("cannot read {}: {source}; check that the path is right and readable", path.display())]
    Unreadable { path: PathBuf, source: io::Error },

    /// A file is there, but is not an image that can be decoded.
    #[error("{} is not a readable image: {problem}; {remedy}", path.display())]
    BadImage { path: PathBuf, problem: String, remedy: String },

    /// What was read is not the four maps of a material.
    #[error("{} is not a material: expected {expected}, found {found}; {remedy}", path.display())]
    NotAMaterial { path: PathBuf, expected: String, found: String, remedy: String },

    /// What is kept with a material cannot be understood.
    #[error("{} does not say how a material is read: {problem}; expected an object such as \
        {{\"albedo\": \"srgb\", \"maps\": {{\"roughness\": \"orm.png:g\"}}}}, of the keys {keys}", path.display())]
    BadKept { path: PathBuf, problem: String, keys: String },

    /// Something had to be guessed where the user wants no guesses.
    #[error("{} is ambiguous: {guesses}; say how it is meant, or leave out --strict", path.display())]
    Guessed { path: PathBuf, guesses: String },

    /// Two things that must have the same size do not.
    #[error("sizes differ: {first} is {} x {}, {second} is {} x {}; {remedy}",
        first_size[0], first_size[1], second_size[0], second_size[1])]
    SizesDiffer {
        first: String,
        first_size: [usize; 2],
        second: String,
        second_size: [usize; 2],
        remedy: &'static str,
    },

    /// A value lies where none may.
    #[error(
        "{whose}: {map} map, column {column}, row {row}: expected {expected}, found {found}; correct the map"
    )]
    OutOfRange {
        whose: String,
        map: &'static str,
        column: usize,
        row: usize,
        expected: &'static str,
        found: String,
    },

    /// A scene file is not one, or one of its scenes cannot be rendered.
    #[error("{} is not a usable scene file: {problem}; expected \
        {{\"scenes\": [{{\"kind\": \"near\" or \"distant\", \"view\": [x, y, z], \"light\": [x, y, z]}}, ...]}}, \
        finite, light and view above the plane", path.display())]
    BadScene { path: PathBuf, problem: String },

    /// A scene given by hand cannot be rendered.
    #[error("the scene cannot be rendered: {problem}; move it above the plane, within 1e9 of the origin")]
    UnusableScene { problem: String },

    /// A name that is none of the known ones.
    #[error("unknown {what} `{found}`; use one of: {known}")]
    UnknownName { what: &'static str, found: String, known: String },

    /// A loss over no scenes, or over too many.
    #[error(
        "a loss needs at least one scene and at most {most}, found {count}; ask for another number of near-field or \
        distant scenes"
    )]
    SceneCount { count: usize, most: usize },

    /// A value of an option or a combination of options that makes no sense.
    #[error("{0}")]
    Usage(String),

    /// The materials of a study do not differ.
    #[error(
        "the two materials look the same in every scene, so that there is no error to study; \
        give a prediction that differs from the ground truth"
    )]
    NothingToStudy,

    /// A material would be resized to more than fits.
    #[error("the materials cannot be resized to {width} x {height} texels: expected at most {max_side} x {max_side} \
        and {} GiB a material, found {} GiB; give a smaller width to --resize-to",
        max_bytes >> 30, bytes.div_ceil(1 << 30))]
    TooLarge { width: usize, height: usize, bytes: usize, max_side: usize, max_bytes: usize },

    /// An accuracy that was asked for needs more scenes than are drawn.
    #[error("{prediction} is known to +-{}, not to the +-{} that was asked for: {scenes} scenes, the most there are, \
        are not enough; ask for less, or go by the interval", percent(*reached), percent(*target))]
    Inaccurate { prediction: String, reached: f64, target: f64, scenes: usize },

    /// A result cannot be written.
    #[error("cannot write {}: {source}; {remedy}", path.display())]
    Unwritable { path: PathBuf, source: io::Error, remedy: &'static str },

    /// No graphics adapter can do what is asked.
    #[error("no usable graphics adapter: {problem}; {remedy}")]
    NoAdapter { problem: String, remedy: &'static str },

    /// The graphics adapter or its driver refused or failed.
    #[error("the graphics adapter failed: {problem}; {remedy}")]
    Gpu { problem: String, remedy: &'static str },

    /// No window can be opened.
    #[error("cannot open a window: {problem}; {remedy}")]
    NoWindow { problem: String, remedy: &'static str },

    /// The caller cancelled the work.
    #[error("cancelled")]
    Cancelled,
}

impl Error {
    /// [`Error::Unreadable`] for `path`.
    pub fn unreadable(path: &Path, source: io::Error) -> Self {
        Self::Unreadable { path: path.to_owned(), source }
    }
}
