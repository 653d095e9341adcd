//! Statements: options of reading, and the materials that they are for.

use std::fmt;
use std::str::FromStr;

use svbrdf_core::text::quoted;
use svbrdf_files::Error;
use svbrdf_files::read::ReadOptions;

/// The materials that a statement is for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Whose {
    All,
    GroundTruth,
    Predictions,
    /// The material or method of this name.
    Named(String),
}

/// The value of `--read`: `[WHOSE:]KEY=VALUE,...`, where WHOSE is gt, pred or a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    pub whose: Whose,
    pub options: ReadOptions,
}

impl Statement {
    /// The value of `--preset`: `[WHOSE:]PRESET`.
    pub fn of_preset(text: &str) -> Result<Self, Error> {
        let (whose, preset) = Whose::before(text);
        Ok(Self { whose, options: ReadOptions { preset: Some(preset.parse()?), ..ReadOptions::AUTO } })
    }
}

impl Whose {
    /// Whether this is the material or method of this name.
    pub fn is_named(&self, name: &str) -> bool {
        matches!(self, Self::Named(own) if own == name)
    }

    /// The materials that `text` is for, and the rest of it. Options contain no colon, and names may.
    fn before(text: &str) -> (Self, &str) {
        match text.rsplit_once(':') {
            None => (Self::All, text),
            Some(("gt", rest)) => (Self::GroundTruth, rest),
            Some(("pred", rest)) => (Self::Predictions, rest),
            Some((name, rest)) => (Self::Named(name.to_owned()), rest),
        }
    }
}

impl FromStr for Statement {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let (whose, options) = Whose::before(text);
        Ok(Self { whose, options: options.parse()? })
    }
}

/// The option as it is typed, quoted for a shell: `--read gt:albedo=srgb`.
impl fmt::Display for Statement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let prefix = match &self.whose {
            Whose::All => "",
            Whose::GroundTruth => "gt:",
            Whose::Predictions => "pred:",
            Whose::Named(name) => &format!("{name}:"),
        };
        write!(f, "--read {}", quoted(format!("{prefix}{}", self.options.words())))
    }
}
