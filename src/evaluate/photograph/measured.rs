//! Measures of a material against photographs, and their means.

use schemars::JsonSchema;
use serde::Serialize;

use svbrdf_core::loss::Estimate;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::Scene;

use super::comparison::PhotographComparison;
use super::outliers::PhotoOutlier;
use svbrdf_files::photograph::Corners;
use svbrdf_files::read::{Note, Transfer};

/// How a photograph was read.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ReadPhotograph {
    /// The name of its file in the capture, or the path of a single photograph.
    #[serde(rename = "photograph")]
    pub name: String,
    /// Width and height in pixels.
    pub size: [usize; 2],
    pub transfer: Transfer,
    /// Top left, top right, bottom right and bottom left of the material, in pixels.
    pub corners: Corners,
    /// Whether the exposure of the capture is not fitted to it.
    pub held_out: bool,
    /// The source of the transfer curve.
    #[serde(skip)]
    pub transfer_from: &'static str,
    /// Whether the whole picture is taken as the material.
    #[serde(skip)]
    pub is_whole: bool,
    #[serde(skip)]
    pub notes: Vec<Note>,
}

/// A difference over the texels that are not clipped.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PhotoStatistics {
    pub mean: f64,
    pub median: f64,
    /// The 95th percentile.
    pub p95: f64,
}

/// A material against one photograph; measures are `None` where all of it is clipped.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PhotoMeasure {
    /// The name of the photograph.
    pub photograph: String,
    /// What the photograph was multiplied by; `None` where no factor fits.
    pub factor: Option<f64>,
    /// The factor in stops.
    pub exposure_ev: Option<f64>,
    /// The factor that fits this photograph alone, in stops; `None` where none does.
    pub own_exposure_ev: Option<f64>,
    pub log: Option<PhotoStatistics>,
    pub absolute: Option<PhotoStatistics>,
    pub relative: Option<PhotoStatistics>,
    /// The root mean square difference of sRGB values.
    pub rmse: Option<f64>,
    /// The SSIM of sRGB values.
    pub ssim: Option<f64>,
    pub texels: usize,
    /// The number of texels that are left out.
    pub clipped: usize,
    pub outlier: PhotoOutlier,
    #[serde(skip)]
    pub scene: Scene,
    /// Whether the exposure of the capture is not fitted to it.
    #[serde(skip)]
    pub is_held_out: bool,
    /// Photograph and rendering, where there is one photograph.
    #[serde(skip)]
    pub compared: Option<PhotographComparison>,
}

/// A material against all photographs.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PhotoResult {
    /// The name of the material.
    pub material: String,
    /// Width and height in texels.
    pub size: [usize; 2],
    /// The factor on all photographs: the median of rendering / photograph. `None` where each has its own.
    pub factor: Option<f64>,
    /// The factor in stops.
    pub exposure_ev: Option<f64>,
    /// The stops by which it exceeds the factor that the power of the light gives.
    pub declared_ev: Option<f64>,
    /// Over all photographs, or where some are held out, over the others and over these.
    pub means: Vec<PhotoMeans>,
    /// In the order of the capture.
    pub photographs: Vec<PhotoMeasure>,
}

/// The means over a group of photographs, each with its interval over photographs; `None` where no photograph has the measure.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PhotoMeans {
    /// `all`, `fitted` or `held out`.
    #[serde(rename = "photographs")]
    pub name: &'static str,
    /// The number of photographs.
    pub count: usize,
    pub log: Option<Estimate>,
    pub rmse: Option<Estimate>,
    pub ssim: Option<Estimate>,
}

impl PhotoMeans {
    /// All photographs, or where some are held out, the others and these.
    pub(super) fn all(photographs: &[PhotoMeasure]) -> Vec<Self> {
        let group = |name, wanted: &dyn Fn(&PhotoMeasure) -> bool| {
            let of: Vec<&PhotoMeasure> = photographs.iter().filter(|one| wanted(one)).collect();
            Self {
                name,
                count: of.len(),
                log: estimate(&of, PhotoMeasure::mean_log),
                rmse: estimate(&of, |one| one.rmse),
                ssim: signed_estimate(&of, |one| one.ssim),
            }
        };
        if photographs.iter().any(|one| one.is_held_out) {
            vec![group("fitted", &|one| !one.is_held_out), group("held out", &|one| one.is_held_out)]
        } else {
            vec![group("all", &|_| true)]
        }
    }
}

impl PhotoMeasure {
    /// The mean log difference.
    pub fn mean_log(&self) -> Option<f64> {
        self.log.map(|log| log.mean)
    }
}

impl PhotoResult {
    /// What results are ordered by: the mean log difference over the held-out photographs, or over all.
    pub fn log(&self) -> f64 {
        let log = self.means.last().and_then(|group| group.log);
        log.map_or(f64::INFINITY, |log| log.mean)
    }
}

fn values(
    of: &[&PhotoMeasure],
    measure: impl Fn(&PhotoMeasure) -> Option<f64>,
) -> Option<(Vec<Scene>, Vec<f64>)> {
    let known: (Vec<_>, Vec<_>) =
        of.iter().filter_map(|one| measure(one).map(|value| (one.scene, value))).unzip();
    (!known.0.is_empty()).then_some(known)
}

/// The mean of a measure that is not negative.
fn estimate(of: &[&PhotoMeasure], measure: impl Fn(&PhotoMeasure) -> Option<f64>) -> Option<Estimate> {
    values(of, measure).map(|(scenes, values)| Estimate::of_scenes(&scenes, &values))
}

/// The mean of a measure of at most 1.
fn signed_estimate(of: &[&PhotoMeasure], measure: impl Fn(&PhotoMeasure) -> Option<f64>) -> Option<Estimate> {
    let (scenes, values) = values(of, measure)?;
    let e = Estimate::of_difference(Sampler::Random, &scenes, &values, &vec![0.0; values.len()]);
    Some(Estimate { interval95: e.interval95.map(|[low, high]| [low, high.min(1.0)]), ..e })
}
