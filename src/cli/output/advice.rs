//! Advice: the options of the command line that help with an error or a note. The library names none.

use svbrdf_core::error::Error as CoreError;
use svbrdf_files::read::{Assumption, Note, Reason, Subject};
use svbrdf_files::{Error, OutputProblem};

use super::error::CommandError;

/// The option that helps with an error.
pub fn of_error(error: &CommandError) -> Option<&'static str> {
    let error = match error {
        CommandError::ReportTooLarge { .. } => {
            return Some("--max-size sets it, and --figure leaves out the findings");
        }
        CommandError::TooLarge { .. } => return Some("give a smaller width to --resize-to"),
        CommandError::Library(error) => error.files()?,
        _ => return None,
    };
    Some(match error {
        Error::Outside { .. } => "--allow-outside allows it",
        Error::Memory { .. } => "--max-memory sets it",
        Error::Guessed { .. } => "specify it by --read, or leave out --strict",
        Error::Core(CoreError::SizesDiffer { .. }) => {
            "--resize-to gt, pred or a width brings materials to one size"
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
        Error::UnsupportedOutput { problem: OutputProblem::NoPreset, .. } => "leave out --like",
        Error::UnsupportedOutput { problem: OutputProblem::FolderPreset, .. } => {
            "--like materialgan or gltf, or no --like, writes a folder"
        }
        _ => return None,
    })
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

/// An assumption with the option that would change it, where its name alone does not tell.
pub fn assumption_with_option(assumption: &Assumption) -> String {
    match assumption.why {
        Reason::MtlFactor { .. } => format!("{assumption}; --map specifies the picture alone"),
        _ => assumption.to_string(),
    }
}
