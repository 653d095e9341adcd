//! A photograph as arguments: its light and view, how it is read, and the material in it. The window takes them, too.

use std::path::PathBuf;

use svbrdf_core::model::scene::Scene;
use svbrdf_files::photograph::{Corners, SessionPhotograph};
use svbrdf_files::read::{PhotographOptions, Transfer};
use svbrdf_files::scene_file::PhotographLight;

use super::offered;
use super::values::{degrees, pair, positive, whole};
use crate::cli::output::CommandError;

/// Light and view of a photograph.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Photograph")]
pub struct PhotoSceneArgs {
    /// Light and view from a JSON file of scenes, or from a MaterialGAN capture (render.json)
    #[arg(long, value_name = "FILE", conflicts_with = "flash", requires = "photo")]
    scene: Option<PathBuf>,

    /// The number of the scene in a file of several, from 0
    #[arg(
        long,
        value_name = "K",
        value_parser = whole::<usize>,
        requires = "scene",
        conflicts_with = "flash",
        allow_negative_numbers = true
    )]
    scene_number: Option<usize>,

    /// The light is a flash at the camera, which is straight above the middle of the material
    #[arg(long, requires_all = ["fov", "photo"])]
    flash: bool,

    /// Angle that the width of the material spans at the camera
    ///
    /// The horizontal field of view where it fills the photograph.
    #[arg(long, value_name = "DEGREES", value_parser = degrees, requires = "flash", conflicts_with = "scene", allow_negative_numbers = true)]
    fov: Option<f64>,
}

/// How a photograph is read, and where the material is in it.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Photograph")]
pub struct PhotoReadingArgs {
    /// Corners of the material in pixels, clockwise from the top left [default: the whole picture]
    #[arg(long, value_name = "X,Y", value_parser = pair, num_args = 4, allow_hyphen_values = true)]
    #[arg(requires = "photo")]
    corners: Option<Vec<[f64; 2]>>,

    /// Transfer curve of the photograph [default: linear for floats and PNG files that declare it, srgb for other integers]
    #[arg(long, value_name = "linear|srgb|gamma2.2", requires = "photo")]
    #[arg(value_parser = offered(str::parse::<Transfer>, ["linear", "srgb", "gamma2.2"]), hide_possible_values = true)]
    transfer: Option<Transfer>,

    /// Stored value from which on a pixel is clipped, where 1 is the largest integer [default: 1, none for floats]
    #[arg(long, value_name = "VALUE", value_parser = positive, allow_negative_numbers = true)]
    #[arg(requires = "photo")]
    clip: Option<f64>,

    /// Divides the photograph by the falloff of a point light, (l.z / d)^3 at the distance d, which Algorithm 3 does not model: use it
    /// for photographs with a flash or lamp near the material
    #[arg(long, requires = "photo")]
    falloff: bool,
}

impl PhotoSceneArgs {
    /// Light and view as specified, or else of a session.
    ///
    /// # Errors
    /// [`CommandError::Usage`] where nothing specifies them; or where a scene file cannot be read.
    pub fn scene(&self, saved: Option<Scene>) -> Result<Scene, CommandError> {
        let specified = self.specified().map(|light| light.scene()).transpose()?;
        specified.or(saved).ok_or_else(|| {
            CommandError::usage(
                "light and view of the photograph are missing; give --scene FILE, or --flash with --fov DEGREES",
            )
        })
    }

    /// Where light and view come from, where that is specified.
    pub fn specified(&self) -> Option<PhotographLight> {
        let file = |path: &PathBuf| PhotographLight::File { path: path.clone(), number: self.scene_number };
        let flash = self.fov.map(|fov_degrees| PhotographLight::Flash { fov_degrees });
        self.scene.as_ref().map(file).or(flash)
    }
}

impl PhotoReadingArgs {
    /// The photograph at `path`.
    pub fn photograph(&self, path: PathBuf) -> SessionPhotograph {
        let corners =
            self.corners.as_ref().and_then(|corners| corners.as_slice().try_into().ok()).map(Corners);
        let read = PhotographOptions { transfer: self.transfer, clip: self.clip, light_colour: None };
        SessionPhotograph { path, read, corners, falloff: self.falloff, capture: None }
    }
}
