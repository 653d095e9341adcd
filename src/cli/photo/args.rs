//! The options of `svbrdf photo`; the window shares the options of the photograph.

use std::path::{Path, PathBuf};

use svbrdf::error::Error;
use svbrdf::files::read::{PhotographOptions, Transfer};
#[cfg(feature = "viewer")]
use svbrdf::files::session::SessionPhotograph;
use svbrdf::model::scene::Scene;
use svbrdf::model::scene_file;
use svbrdf::photograph::{Corners, flash};
use svbrdf::picture::difference::Difference;

use crate::cli::comparison_args::ComparisonArgs;
use crate::cli::report::ReportFormat;
use crate::cli::scene_args::numbers;

/// Compares renderings of materials with a photograph
///
/// Each material is rendered under the light and the view of the photograph (Algorithm 3). One factor brings the photograph to the
/// exposure of the rendering, and is printed: the median of rendering / photograph. Then the log, absolute and relative
/// differences are printed, the material with the smallest mean log difference first. Clipped pixels are left out. Beyond the
/// four corners, nothing is aligned or calibrated.
#[derive(Debug, clap::Args)]
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
    #[arg(long, value_name = "KIND", default_value = "log")]
    pub difference: Difference,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    pub format: ReportFormat,

    #[command(flatten)]
    pub comparison: ComparisonArgs,
}

/// Light and view of a photograph.
#[derive(Debug, clap::Args)]
pub struct PhotoSceneArgs {
    /// Light and view from a JSON file of scenes, or from a MaterialGAN capture (render.json)
    #[arg(long, value_name = "FILE", conflicts_with = "flash", requires = "photo")]
    scene: Option<PathBuf>,

    /// The number of the scene in a file of several, from 0
    #[arg(long, value_name = "K", requires = "scene", allow_negative_numbers = true)]
    scene_number: Option<usize>,

    /// The light is a flash at the camera, which is straight above the middle of the material
    #[arg(long, requires_all = ["fov", "photo"])]
    flash: bool,

    /// Angle that the width of the material spans at the camera: the horizontal field of view where it fills the photograph
    #[arg(long, value_name = "DEGREES", value_parser = degrees, requires = "flash", allow_negative_numbers = true)]
    fov: Option<f64>,
}

/// How a photograph is read, and where the material is in it.
#[derive(Debug, clap::Args)]
pub struct PhotoReadingArgs {
    /// Corners of the material in the photograph, in pixels: top left, top right, bottom right, bottom left [default: the whole
    /// picture]
    #[arg(long, value_name = "X,Y", value_parser = pair, num_args = 4, allow_hyphen_values = true)]
    #[arg(requires = "photo")]
    corners: Option<Vec<[f64; 2]>>,

    /// Transfer curve of the photograph [default: linear for floats and PNG files that declare it, srgb for other integers]
    #[arg(long, value_name = "linear|srgb", requires = "photo")]
    transfer: Option<Transfer>,

    /// Stored value from which on a pixel is clipped, where 1 is the largest integer [default: 1, none for floats]
    #[arg(long, value_name = "VALUE", value_parser = positive, allow_negative_numbers = true)]
    #[arg(requires = "photo")]
    clip: Option<f64>,

    /// Divides the photograph by the falloff of a point light, which Algorithm 3 does not model: use it for photographs with a
    /// flash or lamp near the material
    #[arg(long, requires = "photo")]
    pub falloff: bool,
}

impl PhotoSceneArgs {
    /// Light and view as specified, or else of a session.
    ///
    /// # Errors
    /// [`Error::Usage`] where nothing specifies them; or where a scene file cannot be read.
    pub fn scene(&self, saved: Option<Scene>) -> Result<Scene, Error> {
        self.specified()?.or(saved).ok_or_else(|| {
            Error::Usage(
                "light and view of the photograph are missing; give --scene FILE, or --flash with --fov DEGREES"
                    .to_owned(),
            )
        })
    }

    /// Light and view, where they are specified.
    ///
    /// # Errors
    /// Where a scene file cannot be read.
    pub fn specified(&self) -> Result<Option<Scene>, Error> {
        match &self.scene {
            Some(path) => self.of_file(path).map(Some),
            None => self.fov.map(flash).transpose(),
        }
    }

    fn of_file(&self, path: &Path) -> Result<Scene, Error> {
        let scenes = scene_file::read(path)?;
        let number = self.scene_number.unwrap_or(0);
        let count = scenes.len();
        match scenes.get(number) {
            Some(scene) if count == 1 || self.scene_number.is_some() => Ok(*scene),
            found => Err(Error::Usage(format!(
                "{} lists {count} scenes, of which a photograph has one{}; give its number from 0 to {} as --scene-number",
                path.display(),
                if found.is_none() { format!(", found number {number}") } else { String::new() },
                count - 1
            ))),
        }
    }
}

impl PhotoReadingArgs {
    pub fn options(&self) -> PhotographOptions {
        PhotographOptions { transfer: self.transfer, clip: self.clip }
    }

    /// What the window opens.
    #[cfg(feature = "viewer")]
    pub fn of_session(&self, path: PathBuf) -> SessionPhotograph {
        let corners = self.corners.as_ref().and_then(|corners| corners.as_slice().try_into().ok());
        SessionPhotograph { path, read: self.options(), corners, falloff: self.falloff }
    }

    /// The corners in a photograph of `size`.
    pub fn corners(&self, size: [usize; 2]) -> Corners {
        let specified = self.corners.as_ref().and_then(|corners| corners.as_slice().try_into().ok());
        specified.map_or_else(|| Corners::whole(size), Corners)
    }

    /// Whether the whole photograph is taken as the material.
    pub fn is_whole(&self) -> bool {
        self.corners.is_none()
    }
}

fn pair(text: &str) -> Result<[f64; 2], String> {
    numbers(text).ok_or_else(|| format!("expected two numbers like 120,80.5, found `{text}`"))
}

fn degrees(text: &str) -> Result<f64, String> {
    let angle = text.parse().ok().filter(|angle| (0.1..=179.0).contains(angle));
    angle.ok_or_else(|| format!("expected an angle of 0.1 to 179 degrees, found `{text}`"))
}

fn positive(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value: &f64| value.is_finite() && *value > 0.0);
    value.ok_or_else(|| format!("expected a number above 0, found `{text}`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_angles_and_limits_are_numbers_in_their_ranges() {
        assert_eq!(pair("12,-3.5"), Ok([12.0, -3.5]));
        assert!(["1", "1,2,3", "a,b", ""].iter().all(|wrong| pair(wrong).is_err()));
        assert_eq!(degrees("45"), Ok(45.0));
        assert!(["0", "180", "-3", "nan", "wide"].iter().all(|wrong| degrees(wrong).is_err()));
        assert_eq!(positive("0.98"), Ok(0.98));
        assert!(["0", "-1", "inf", "x"].iter().all(|wrong| positive(wrong).is_err()));
    }
}
