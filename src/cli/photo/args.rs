//! The options of `svbrdf photo`.

use std::path::PathBuf;

use svbrdf_core::picture::difference::Difference;

use crate::cli::args::ComparisonArgs;
use crate::cli::args::photograph::{PhotoReadingArgs, PhotoSceneArgs};
use crate::cli::output::report::ReportFormat;

/// Compares renderings of materials with a photograph
///
/// Each material is rendered under the light and the view of the photograph (Algorithm 3). One factor brings the photograph to the
/// exposure of the rendering, and is printed: the median of rendering / photograph. Then the log, absolute and relative
/// differences are printed, the material with the smallest mean log difference first. Clipped pixels are left out. Beyond the
/// four corners, nothing is aligned or calibrated.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf photo photo.jpg a.png b.png --flash --fov 45")]
#[command(mut_arg("ground_truth", |arg| arg.value_name("MATERIAL").required(true).help(
    "Material: a packed or layered image, a folder, a name prefix, or a session file of the window")))]
#[command(mut_arg("predictions", |arg| arg.value_name("MATERIAL").help("More materials")))]
pub struct PhotoArgs {
    /// Photograph: PNG, JPEG, EXR or another picture format
    #[arg(value_name = "PHOTO")]
    pub photo: PathBuf,

    #[command(flatten)]
    pub scene: PhotoSceneArgs,

    #[command(flatten)]
    pub reading: PhotoReadingArgs,

    /// Writes the difference of each material: .exr for numbers, .png for colours
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// The difference that is written: log, absolute or relative
    #[arg(long, value_name = "KIND", default_value = "log", requires = "output")]
    pub difference: Difference,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    pub format: ReportFormat,

    #[command(flatten)]
    pub comparison: ComparisonArgs,
}
