//! Errors of computations: one variant per cause. The text says where, what was expected, what was found and what to do.
//!
//! No text names an option of the command line or a control of the window: each of them adds its own advice. That holds for the errors
//! of the other crates, too; each of them passes those of the crates below it on.

/// The error of every fallible operation of this crate, and of graphics adapters.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A name that is none of the known ones.
    #[error("unknown {what} `{found}`; use {}{known}", if known.contains(", ") { "one of: " } else { "" })]
    UnknownName { what: &'static str, found: String, known: String },

    /// The text of a convention that is none.
    #[error("not a convention: {problem}; begin with the text of a named one")]
    BadConvention { problem: String },

    /// A convention whose renderer or norm something does not have.
    #[error(
        "{what} does not have the renderer or the norm of the convention {convention}; choose another convention"
    )]
    NotComputed { what: &'static str, convention: &'static str },

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

    /// Planes that are not those of a material: no texels, or planes of another length.
    #[error("{whose} is not a material: expected {expected}, found {found}; {remedy}")]
    BadPlanes { whose: String, expected: String, found: String, remedy: &'static str },

    /// A value lies outside its range.
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

    /// A scene given by hand cannot be rendered.
    #[error("the scene cannot be rendered: {problem}; move it above the plane, within 1e9 of the origin")]
    UnusableScene { problem: String },

    /// A loss over no scenes, or over too many.
    #[error(
        "a loss needs at least one scene and at most {most}, found {count}; ask for another number of near-field or \
        distant scenes"
    )]
    SceneCount { count: usize, most: usize },

    /// A way of sampling scenes whose number is left open.
    #[error(
        "without a number of scenes the loss is known to +-1%, over Sobol scenes with 32 random texels each, not with {found}; \
        specify the number of near-field or distant scenes, too"
    )]
    NoSceneCount { found: String },

    /// An option that is not used beside others.
    #[error("{option} is not used: {reason}; leave out {option}")]
    UnusedOption {
        /// Its name in Python; on the command line with hyphens in place of underscores.
        option: &'static str,
        reason: &'static str,
    },

    /// There is no graphics adapter, or none that can do what is asked.
    #[error("no usable graphics adapter: {problem}; {remedy}")]
    NoAdapter { problem: String, remedy: &'static str },

    /// The graphics adapter or its driver refused or failed.
    #[error("the graphics adapter failed: {problem}; {remedy}")]
    Gpu { problem: String, remedy: &'static str },

    /// The caller cancelled the work.
    #[error("cancelled")]
    Cancelled,
}

impl Error {
    /// [`Error::UnknownName`]: `found` is no name of a `what`; `known` lists the names.
    pub fn unknown_name(what: &'static str, found: impl Into<String>, known: impl Into<String>) -> Self {
        Self::UnknownName { what, found: found.into(), known: known.into() }
    }
}
