//! The command line: one file per subcommand.

mod advice;
mod backend;
mod bar;
mod convert;
mod exit;
mod info;
mod loss;
mod materials;
mod reading;
mod render;
mod report;
mod stop;
mod study;
mod view;

use clap::{Parser, Subcommand};
use svbrdf::error::Error;

pub use exit::{exit_code, explain};

const EXAMPLES: &str = "\
Examples:
  svbrdf                                  the built-in pair in a window
  svbrdf gt.png prediction.png            your own materials in a window
  svbrdf loss gt.png a.png b.png          the losses of two predictions
  svbrdf loss gt.png a.png --format json  the same for a program to read
  svbrdf render gt.png -o gt.exr          a rendering, as floats
  svbrdf study gt.png a.png --plot s.svg  what accuracy costs on this machine
  svbrdf info gt.png                      what its files hold, and what was assumed
  svbrdf convert gt.png gt.exr            the material as one layered EXR

Exit codes:
   0  fine
   1  bad input, or the work failed
   2  no display, or no graphics adapter
  64  the command line was not understood
 130  stopped by Ctrl+C; what was being written is as it was";

/// Shows SVBRDF materials under a light that you drag, and computes the rendering loss between them.
///
/// A material is a packed image (photos, then normal | diffuse | roughness | specular, or another order), a layered
/// EXR or npz, a glTF, MaterialX or MTL file, or a folder or name prefix with one file a map. Without a subcommand: `view`.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true, after_help = EXAMPLES)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    view: view::ViewArgs,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Opens the window on a ground truth and predictions, or on the built-in pair
    View(view::ViewArgs),
    Loss(loss::LossArgs),
    Render(render::RenderArgs),
    Study(study::StudyArgs),
    Info(info::InfoArgs),
    Convert(convert::ConvertArgs),
}

impl Cli {
    /// Does what the command line asks for.
    ///
    /// # Errors
    /// Those of the subcommand.
    pub fn run(self) -> Result<(), Error> {
        match self.command.unwrap_or(Command::View(self.view)) {
            Command::View(args) => view::run(args),
            Command::Loss(args) => loss::run(&args),
            Command::Render(args) => render::run(&args),
            Command::Study(args) => study::run(&args),
            Command::Info(args) => info::run(&args),
            Command::Convert(args) => convert::run(&args),
        }
    }
}
