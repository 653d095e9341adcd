//! The program `svbrdf`: see `svbrdf --help`.

mod cli;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match cli::Cli::try_parse() {
        Ok(cli) => cli::exit_code(cli.run()),
        Err(unusual) => cli::explain(&unusual),
    }
}
