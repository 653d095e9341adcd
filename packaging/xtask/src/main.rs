//! `cargo xtask bless [NAME...]` renews what is generated; `cargo xtask size` prints the size of each room.

#![allow(clippy::disallowed_methods, reason = "it reads files of this repository")]

mod bless;
mod size;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

const USAGE: &str = "usage: cargo xtask bless [NAME...]
       cargo xtask size [--lower]";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let done = match arguments.split_first() {
        Some((name, rest)) if name == "bless" => bless::run(rest),
        Some((name, rest)) if name == "size" => size::run(rest),
        _ => Err(format!("{USAGE}\n\n{}\n{}", bless::help(), size::help())),
    };
    done.map_or_else(
        |problem| {
            eprintln!("{problem}");
            ExitCode::FAILURE
        },
        |()| ExitCode::SUCCESS,
    )
}

/// The root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A program in the root of the repository.
fn command(program: &str) -> Command {
    let mut command = Command::new(program);
    command.current_dir(root());
    command
}

/// Runs a command to its end.
fn finish(command: &mut Command) -> Result<(), String> {
    let status = command.status().map_err(|problem| format!("{command:?}: {problem}"))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?}: {status}")) }
}
