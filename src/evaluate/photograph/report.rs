//! Materials against a photograph as text, JSON and CSV.

use schemars::JsonSchema;
use serde::Serialize;

use crate::report::{Column, Report, Table, aligned_columns, position};
use svbrdf_core::error::Error;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_core::progress::Progress;

use super::comparison::PhotographComparison;
use super::corners::Corners;
use super::rectified::Rectified;
use svbrdf_files::read::{Photograph, Transfer};

/// The photograph that materials are compared with, and how.
#[derive(Clone, Debug)]
pub struct PhotoSetting {
    /// What the report calls the photograph: its path.
    pub name: String,
    pub photograph: Photograph,
    pub corners: Corners,
    /// Whether the falloff of the light is divided out of the photograph.
    pub falloff: bool,
    pub scene: Scene,
    pub convention: Convention,
}

/// Materials against a photograph. Its JSON is a scene file, too.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct PhotoReport {
    /// The path of the photograph.
    photograph: String,
    /// Width and height in pixels.
    size: [usize; 2],
    transfer: Transfer,
    /// Top left, top right, bottom right and bottom left of the material, in pixels.
    corners: Corners,
    /// Whether the falloff of the light is divided out of the photograph.
    falloff: bool,
    /// The name of the convention.
    convention: &'static str,
    epsilon: f64,
    /// The smallest mean log difference first.
    pub results: Vec<PhotoResult>,
    /// The one scene of the photograph.
    scenes: Vec<Scene>,
    /// What reading the photograph noticed.
    notes: Vec<String>,
    #[serde(skip)]
    pub setting: PhotoSetting,
}

/// A material against the photograph.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct PhotoResult {
    /// The name of the material.
    pub material: String,
    /// Width and height in texels.
    size: [usize; 2],
    /// The number of texels that are left out.
    clipped: usize,
    /// What the photograph was multiplied by: the median of rendering / photograph.
    factor: f64,
    /// The factor in stops.
    exposure_ev: f64,
    log: PhotoStatistics,
    absolute: PhotoStatistics,
    relative: PhotoStatistics,
    #[serde(skip)]
    pub compared: PhotographComparison,
}

/// A difference over the texels that are not clipped.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
struct PhotoStatistics {
    mean: f64,
    median: f64,
    /// The 95th percentile.
    p95: f64,
}

impl PhotoReport {
    /// The differences that are reported.
    pub const DIFFERENCES: [Difference; 3] = [Difference::Log, Difference::Absolute, Difference::Relative];

    /// Compares each of `materials`, which have the names of the report beside them, with the photograph.
    ///
    /// # Errors
    /// [`Error::UnusableCorners`], [`Error::UnusableScene`], [`Error::NoExposure`], [`Error::Cancelled`].
    pub fn new<'a>(
        setting: PhotoSetting,
        materials: impl IntoIterator<Item = (&'a str, &'a Material<f32>)>,
        progress: &Progress,
    ) -> Result<Self, Error> {
        setting.corners.check(setting.photograph.size())?;
        let mut rectified: Vec<([usize; 2], Rectified)> = Vec::new();
        let mut results = Vec::new();
        for (name, material) in materials {
            let size = material.size();
            let index = match rectified.iter().position(|(of, _)| *of == size) {
                Some(index) => index,
                None => {
                    rectified.push((size, setting.rectified(size, progress)?));
                    rectified.len() - 1
                }
            };
            let photograph = &rectified[index].1;
            let compared = photograph.compare(material, &setting.scene, &setting.convention, progress)?;
            let clipped = photograph.clipped();
            results.push(PhotoResult::new(name.to_owned(), compared, clipped));
        }
        // NaN, of a photograph that is clipped everywhere, comes last.
        results.sort_by(|a, b| a.log.mean.total_cmp(&b.log.mean));
        Ok(Self {
            photograph: setting.name.clone(),
            size: setting.photograph.size(),
            transfer: setting.photograph.transfer,
            corners: setting.corners,
            falloff: setting.falloff,
            convention: setting.convention.name,
            epsilon: setting.convention.epsilon,
            results,
            scenes: vec![setting.scene],
            notes: setting.photograph.notes.iter().map(ToString::to_string).collect(),
            setting,
        })
    }
}

impl PhotoSetting {
    fn rectified(&self, size: [usize; 2], progress: &Progress) -> Result<Rectified, Error> {
        let rectified = Rectified::new(&self.photograph, &self.corners, size, progress)?;
        Ok(if self.falloff { rectified.without_falloff(&self.scene) } else { rectified })
    }

    /// The photograph, and how it was read.
    pub fn source(&self) -> String {
        let [width, height] = self.photograph.size();
        let corners = self.corners.0.map(|[x, y]| format!("{x},{y}")).join(" ");
        format!(
            "{}, {width} x {height} pixels, {} {}, corners {corners}",
            self.name, self.photograph.transfer, self.photograph.transfer_from
        )
    }
}

impl PhotoResult {
    fn new(material: String, compared: PhotographComparison, clipped: usize) -> Self {
        let statistics = |kind| match compared.statistics(kind) {
            Some(Statistics { mean, median, p95, .. }) => PhotoStatistics { mean, median, p95 },
            None => PhotoStatistics { mean: f64::NAN, median: f64::NAN, p95: f64::NAN },
        };
        let [log, absolute, relative] = PhotoReport::DIFFERENCES.map(statistics);
        Self {
            material,
            size: [compared.rendering.width, compared.rendering.height],
            clipped,
            factor: compared.factor,
            exposure_ev: compared.exposure_ev(),
            log,
            absolute,
            relative,
            compared,
        }
    }

    fn texels(&self) -> usize {
        self.size[0] * self.size[1]
    }
}

impl Report for PhotoReport {
    fn text(&self) -> String {
        let columns: [Column<'_, &PhotoResult, String>; 13] = [
            ("material", |result| result.material.clone()),
            ("factor", |result| format!("{:.4}", result.factor)),
            ("EV", |result| format!("{:+.2}", result.exposure_ev)),
            ("log mean", |result| format!("{:.4}", result.log.mean)),
            ("median", |result| format!("{:.4}", result.log.median)),
            ("95%", |result| format!("{:.4}", result.log.p95)),
            ("abs. mean", |result| format!("{:.4}", result.absolute.mean)),
            ("median", |result| format!("{:.4}", result.absolute.median)),
            ("95%", |result| format!("{:.4}", result.absolute.p95)),
            ("rel. mean", |result| format!("{:.4}", result.relative.mean)),
            ("median", |result| format!("{:.4}", result.relative.median)),
            ("95%", |result| format!("{:.4}", result.relative.p95)),
            ("clipped", |one| format!("{:.2}%", 100.0 * one.clipped as f64 / one.texels() as f64)),
        ];
        let Scene { kind, view, light } = &self.setting.scene;
        let falloff = if self.falloff { "\nfalloff of the light divided out" } else { "" };
        format!(
            "differences from {}\nconvention {}, epsilon {}\n{kind} scene: view {}, light {}{falloff}\n\n{}",
            self.setting.source(),
            self.convention,
            self.epsilon,
            position(*view),
            position(*light),
            aligned_columns(&columns, &self.results)
        )
    }

    fn table(&self) -> Table {
        let columns: [Column<'_, (&Self, &PhotoResult)>; 18] = [
            ("material", |(_, result)| result.material.as_str().into()),
            ("factor", |(_, result)| result.factor.into()),
            ("exposure_ev", |(_, result)| result.exposure_ev.into()),
            ("log_mean", |(_, result)| result.log.mean.into()),
            ("log_median", |(_, result)| result.log.median.into()),
            ("log_p95", |(_, result)| result.log.p95.into()),
            ("absolute_mean", |(_, result)| result.absolute.mean.into()),
            ("absolute_median", |(_, result)| result.absolute.median.into()),
            ("absolute_p95", |(_, result)| result.absolute.p95.into()),
            ("relative_mean", |(_, result)| result.relative.mean.into()),
            ("relative_median", |(_, result)| result.relative.median.into()),
            ("relative_p95", |(_, result)| result.relative.p95.into()),
            ("texels", |(_, result)| result.texels().into()),
            ("clipped", |(_, result)| result.clipped.into()),
            ("photograph", |(report, _)| report.photograph.as_str().into()),
            ("transfer", |(report, _)| report.transfer.name().into()),
            ("convention", |(report, _)| report.convention.into()),
            ("epsilon", |(report, _)| report.epsilon.into()),
        ];
        Table::of(&columns, self.results.iter().map(|result| (self, result)))
    }
}
