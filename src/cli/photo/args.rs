//! The options of `svbrdf photo`.

use std::path::PathBuf;

use svbrdf_core::picture::difference::Difference;
use svbrdf_evaluate::photograph::CaptureExposure;

use crate::cli::args::photograph::{PhotoReadingArgs, PhotoSceneArgs};
use crate::cli::args::{ComparisonArgs, NamedPath, offered};
use crate::cli::output::CommandError;
use crate::cli::output::report::ReportFormat;

/// Compares renderings of materials with a photograph, or with all photographs of a capture
///
/// Each material is rendered under the light and the view of the photograph (Algorithm 3). One factor brings the photograph to the
/// exposure of the rendering, and is printed: the median of rendering / photograph. Then the log, absolute and relative
/// differences, RMSE and SSIM are printed, the material with the smallest mean log difference first. Clipped pixels are left out.
/// Beyond the four corners, nothing is aligned or calibrated.
///
/// With --capture: the photographs of a capture, which lists their lights and views. One factor for all of them is fitted, and the
/// mean log difference, RMSE and SSIM are printed for each photograph and as means with their intervals over photographs. A
/// photograph far from the others is named. docs/photographs.md describes the files of a capture.
#[derive(Debug, clap::Args)]
#[command(
    override_usage = "svbrdf photo [OPTIONS] <PHOTO> <MATERIAL>...\n       svbrdf photo [OPTIONS] --capture <FOLDER> <MATERIAL>..."
)]
#[command(mut_arg("ground_truth", |arg| arg.value_name("MATERIAL").required_unless_present("capture").help(
    "Material: a packed or layered image, a folder, a name prefix, or a session file of the window")))]
#[command(mut_arg("predictions", |arg| arg.value_name("MATERIAL").help("More materials")))]
pub struct PhotoArgs {
    /// Photograph: PNG, JPEG, EXR or another picture format
    #[arg(value_name = "PHOTO")]
    pub photo: PathBuf,

    #[command(flatten)]
    pub capture: PhotoCaptureArgs,

    #[command(flatten)]
    pub scene: PhotoSceneArgs,

    #[command(flatten)]
    pub reading: PhotoReadingArgs,

    /// Writes the difference of each material: .exr for numbers, .png for colours
    #[arg(short, long, value_name = "FILE", conflicts_with = "capture")]
    pub output: Option<PathBuf>,

    /// The difference that is written: log, absolute or relative
    #[arg(long, value_name = "KIND", default_value = "log", requires = "output", conflicts_with = "capture")]
    #[arg(value_parser = offered(str::parse::<Difference>, ["log", "absolute", "relative"]), hide_possible_values = true)]
    pub difference: Difference,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    pub format: ReportFormat,

    #[command(flatten)]
    pub comparison: ComparisonArgs,
}

/// A capture in the place of the photograph.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Photograph")]
pub struct PhotoCaptureArgs {
    /// Folder of a capture, or the file that lists its photographs
    ///
    /// capture.json, or the JSON file (render.json) or camera_pos.txt of MaterialGAN.
    #[arg(long, value_name = "FOLDER")]
    #[arg(conflicts_with_all = ["scene", "scene_number", "flash", "fov", "corners", "falloff"])]
    pub capture: Option<PathBuf>,

    /// What one factor is fitted to: capture (all photographs) or photograph (each)
    #[arg(long, value_name = "WHAT", default_value = "capture")]
    #[arg(value_parser = offered(str::parse::<CaptureExposure>, ["capture", "photograph"]), hide_possible_values = true)]
    pub exposure: CaptureExposure,

    /// Photographs to which the exposure is not fitted; the others and these have means of their own
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub hold_out: Vec<String>,
}

impl PhotoArgs {
    /// The first argument without an option, which is a material where there is a capture, put before the others.
    ///
    /// # Errors
    /// As [`MaterialArgs::set`](crate::cli::args::MaterialArgs::set).
    pub fn shift_materials(&mut self) -> Result<(), CommandError> {
        let materials = &mut self.comparison.materials;
        let first = NamedPath::from(std::mem::take(&mut self.photo).into_os_string());
        let others =
            materials.ground_truth.take().into_iter().chain(std::mem::take(&mut materials.predictions));
        materials.set(std::iter::once(first).chain(others))
    }
}
