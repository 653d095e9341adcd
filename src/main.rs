//! The program `svbrdf`: see `svbrdf --help`.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
