//! Advice: the options of the command line that help with an error or a note. The library names none.

use svbrdf_core::error::Error as CoreError;
use svbrdf_files::read::{Note, ReadOptions, Subject};
use svbrdf_files::{Error, Guess, OutputProblem};

use super::error::CommandError;

/// The option that helps with an error.
pub fn of_error(error: &CommandError) -> Option<&'static str> {
    let error = match error {
        CommandError::TooLarge { .. } => return Some("give a smaller width to --resize-to"),
        CommandError::Library(error) => error.files()?,
        _ => return None,
    };
    Some(match error {
        Error::Outside { .. } => "--allow-outside allows it",
        Error::Memory { .. } => "--max-memory sets it",
        Error::Core(CoreError::SizesDiffer { .. }) => {
            "--resize-to gt, pred or a width does, and --register compares a part"
        }
        Error::NotFinite { .. } => "--read non-finite=replace puts other numbers in their place",
        Error::NoSuchExemplar { .. } => "--read exemplar=K chooses a material",
        Error::MissingMap { .. } => {
            "info and convert: --map MAP=FILE, FILE:CHANNEL or a constant (roughness=0.5)"
        }
        Error::NotPacked { grid: Some(_), .. } => {
            "specify another grid by --read grid=COLUMNSxROWS, or leave it out"
        }
        Error::NotPacked { grid: None, .. } => {
            "--read order=LETTERS,grid=COLUMNSxROWS specifies the tiles; --read order=d reads the whole picture as diffuse"
        }
        Error::UnsupportedOutput { problem: OutputProblem::Depth, .. } => "leave out --depth",
        _ => return None,
    })
}

/// What was guessed, with the option that specifies it: a line.
pub fn guess(Guess { text, key }: &Guess) -> String {
    let Some(key) = key else { return text.clone() };
    let examples = ReadOptions::examples();
    let values = examples.iter().filter_map(|one| one.strip_prefix(key)?.strip_prefix('='));
    format!("{text}: --read {key}={}", values.collect::<Vec<_>>().join("|"))
}

/// A note with the option that would change what it reports.
pub fn with_option(note: &Note) -> String {
    match note {
        Note::Rows { .. } | Note::Materials { .. } => format!("{note} Another: --read exemplar=K."),
        Note::LinearChunk(Subject::Map(_) | Subject::Material | Subject::Picture, _) => {
            format!("{note} --read albedo=linear uses it.")
        }
        _ => note.to_string(),
    }
}
