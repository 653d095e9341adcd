//! `svbrdf completions` and `svbrdf man`: files that packages install.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::Command;
use clap_complete::Shell;

use svbrdf_files::Error;

use super::output::CommandError;
use super::output::exit::put;

/// Prints the completions of a shell
///
/// The packages install them. By hand, in bash: source <(svbrdf completions bash).
#[derive(Debug, clap::Args)]
pub struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Writes a man page of each command into a folder
#[derive(Debug, clap::Args)]
pub struct ManArgs {
    /// Folder to write; it is made
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
}

/// Prints the completions to stdout.
pub fn completions(args: &CompletionsArgs, mut program: Command) -> Result<(), CommandError> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut program, "svbrdf", &mut script);
    Ok(put(&String::from_utf8_lossy(&script))?)
}

/// Writes the pages.
pub fn man(args: &ManArgs, program: Command) -> Result<(), CommandError> {
    let write = move |folder: &Path| -> io::Result<()> {
        fs::create_dir_all(folder)?;
        clap_mangen::generate_to(program, folder)
    };
    let of_file = |source| if args.folder.is_file() { io::Error::other("it is a file") } else { source };
    Ok(write(&args.folder).map_err(of_file).map_err(|source| Error::Unwritable {
        path: args.folder.clone(),
        source,
        remedy: "choose a folder that can be written",
    })?)
}
