//! `cargo xtask bless [NAME...]` renews what is generated; `cargo xtask shot STATE` takes a screenshot of the window.

mod bless;
mod shot;

use std::path::Path;
use std::process::{Command, ExitCode};

const USAGE: &str = "usage: cargo xtask bless [NAME...]
       cargo xtask shot STATE [--size WIDTHxHEIGHT] [--output FILE]";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let done = match arguments.split_first() {
        Some((name, rest)) if name == "bless" => bless::run(rest),
        Some((name, rest)) if name == "shot" => shot::run(rest),
        _ => Err(format!("{USAGE}\n\n{}\n{}", bless::help(), shot::help())),
    };
    done.map_or_else(
        |problem| {
            eprintln!("{problem}");
            ExitCode::FAILURE
        },
        |()| ExitCode::SUCCESS,
    )
}

/// A program in the root of the repository.
fn command(program: &str) -> Command {
    let mut command = Command::new(program);
    command.current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."));
    command
}

/// Runs a command to its end.
fn finish(command: &mut Command) -> Result<(), String> {
    let status = command.status().map_err(|problem| format!("{command:?}: {problem}"))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?}: {status}")) }
}
