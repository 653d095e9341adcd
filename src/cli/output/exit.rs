//! The end of the program: its exit code, its error, and the lines and results that it prints.

use std::error::Error as _;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use svbrdf_core::error::Error as CoreError;
use svbrdf_core::text::{line, printable};
use svbrdf_files::Error as FilesError;

use super::advice;
use super::error::CommandError;
use super::foreign;

/// Bad input, or the work failed.
const FAILED: u8 = 1;
/// No display or no graphics adapter.
const NO_GRAPHICS: u8 = 2;
/// The command line was not understood (EX_USAGE of sysexits.h).
const USAGE: u8 = 64;
/// Stopped by Ctrl+C, as a shell counts it: 128 and the number of the signal.
pub const INTERRUPTED: u8 = 130;

/// Prints the error of the program, if any, and says with which code it ends.
pub fn exit_code(result: Result<(), CommandError>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    if let CommandError::Library(library) = &error
        && let Some(FilesError::Guessed { path, guesses }) = library.files()
    {
        let path = path.display();
        tell(&format!("error: {path} is ambiguous; specify what follows, or leave out --strict"));
        guesses.iter().for_each(|guess| tell(&format!("  {}", advice::guess(guess))));
        return ExitCode::from(code_of(&error));
    }
    let advice = advice::of_error(&error).map(|advice| format!("; {advice}")).unwrap_or_default();
    tell(&format!("error: {error}{advice}"));
    for cause in unspoken_causes(&error) {
        tell(&format!("caused by: {cause}"));
    }
    ExitCode::from(code_of(&error))
}

/// Prints what the parser of the command line has to say: help, version or a misunderstanding.
pub fn explain(unusual: clap::Error) -> ExitCode {
    if unusual.use_stderr() {
        let unusual = with_tip(unusual);
        // There is nowhere else to say that a closed stderr is closed.
        let _ = match escaped(&unusual) {
            Some(text) => io::stderr().write_all(text.as_bytes()),
            None => unusual.print(),
        };
        return ExitCode::from(USAGE);
    }
    exit_code(accepted(unusual.print().and_then(|()| io::stdout().flush())).map_err(CommandError::from))
}

/// The text without colours, each part of it from outside in one line; `None` where no part would steer the terminal.
fn escaped(unusual: &clap::Error) -> Option<String> {
    let of_context = |(_, value): (_, &ContextValue)| match value {
        ContextValue::String(part) => vec![part.clone()],
        ContextValue::Strings(parts) => parts.clone(),
        _ => Vec::new(),
    };
    let mut parts: Vec<String> = unusual.context().flat_map(of_context).collect();
    parts.extend(unusual.source().map(ToString::to_string));
    parts.retain(|part| line(part) != *part);
    (!parts.is_empty()).then(|| {
        let styled = unusual.render().ansi().to_string();
        let text = parts.iter().fold(styled, |text, part| text.replace(part, &line(part)));
        // Only the colours of the parser are left: ESC [ ... m.
        let mut spans = text.split('\u{1b}');
        let first = spans.next().unwrap_or_default().to_owned();
        printable(&spans.fold(first, |text, span| text + span.split_once('m').map_or(span, |(_, text)| text)))
    })
}

/// An unknown option with what does the same here, and without a guess that does not begin as it does. It is not meant as a value.
fn with_tip(mut unusual: clap::Error) -> clap::Error {
    let of = |kind| match unusual.get(kind) {
        Some(ContextValue::String(text)) => Some(text.clone()),
        _ => None,
    };
    let (unknown, guess) = (of(ContextKind::InvalidArg), of(ContextKind::SuggestedArg));
    let (true, Some(unknown)) = (unusual.kind() == ErrorKind::UnknownArgument, unknown) else {
        return unusual;
    };
    let begins = |text: &str| text.chars().take("--xx".len()).collect::<String>();
    let advice = foreign::option(&unknown);
    if advice.is_some() || guess.is_none_or(|guess| begins(&guess) != begins(&unknown)) {
        unusual.remove(ContextKind::SuggestedArg);
        unusual.remove(ContextKind::Suggested);
    }
    if let Some(advice) = advice {
        unusual.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![advice.into()]));
    }
    unusual
}

/// A line on stderr, under the program's name. A closed stderr is no reason to stop.
pub fn tell(text: &str) {
    let _ = writeln!(io::stderr(), "svbrdf: {}", line(text));
}

/// Writes a result for people to stdout: names from files do not steer the terminal.
pub fn put_text(text: &str) -> Result<(), FilesError> {
    put(&printable(text))
}

/// Writes a result to stdout. A reader that has closed the pipe has seen enough.
pub fn put(text: &str) -> Result<(), FilesError> {
    let mut stdout = io::stdout().lock();
    accepted(stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()))
}

/// A closed pipe is the reader's choice.
fn accepted(written: io::Result<()>) -> Result<(), FilesError> {
    match written {
        Err(source) if source.kind() != io::ErrorKind::BrokenPipe => Err(unwritable(source)),
        _ => Ok(()),
    }
}

/// The error of a result that cannot be written to stdout.
fn unwritable(source: io::Error) -> FilesError {
    let path = Path::new("standard output").to_owned();
    FilesError::Unwritable { path, source, remedy: "check where it is redirected to" }
}

fn code_of(error: &CommandError) -> u8 {
    let error = match error {
        CommandError::Usage(_) => return USAGE,
        error if error.is_without_graphics() => return NO_GRAPHICS,
        CommandError::Library(error) => error,
        _ => return FAILED,
    };
    match error.files() {
        Some(
            FilesError::SeveralSceneFiles { .. }
            | FilesError::SpecifiedTwice { .. }
            | FilesError::UnsupportedOutput { .. }
            | FilesError::Core(
                CoreError::SceneCount { .. } | CoreError::NoSceneCount { .. } | CoreError::UnknownName { .. },
            ),
        ) => USAGE,
        Some(FilesError::Core(CoreError::Cancelled)) => INTERRUPTED,
        _ => FAILED,
    }
}

/// The causes of an error whose texts its own text does not contain.
fn unspoken_causes(error: &CommandError) -> Vec<String> {
    let text = error.to_string();
    let causes = std::iter::successors(error.source(), |&cause| cause.source());
    causes.map(ToString::to_string).filter(|cause| !text.contains(cause.as_str())).collect()
}
