//! Materials against a photograph as text, JSON and CSV.

use serde::{Serialize, Serializer};

use svbrdf_core::error::Error;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_core::progress::Progress;
use svbrdf_core::report::{Cell, Report, Table, aligned, position};

use super::comparison::PhotographComparison;
use super::corners::Corners;
use super::rectified::Rectified;
use crate::read::Photograph;

const TITLES: [&str; 13] = [
    "material",
    "factor",
    "EV",
    "log mean",
    "median",
    "95%",
    "abs. mean",
    "median",
    "95%",
    "rel. mean",
    "median",
    "95%",
    "clipped",
];

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

/// A material against the photograph.
#[derive(Clone, Debug)]
pub struct PhotoResult {
    /// The name of the material.
    pub material: String,
    pub compared: PhotographComparison,
    /// Number of texels that are left out.
    pub clipped: usize,
}

/// Materials against a photograph.
#[derive(Clone, Debug)]
pub struct PhotoReport {
    pub setting: PhotoSetting,
    /// The smallest mean log difference first.
    pub results: Vec<PhotoResult>,
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
            results.push(PhotoResult { material: name.to_owned(), compared, clipped });
        }
        let mean = |result: &PhotoResult| {
            result.compared.statistics(Difference::Log).map_or(f64::INFINITY, |statistics| statistics.mean)
        };
        results.sort_by(|a, b| mean(a).total_cmp(&mean(b)));
        Ok(Self { setting, results })
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
    fn texels(&self) -> usize {
        self.compared.rendering.pixels.len()
    }

    /// Mean, median and 95th percentile of a difference.
    fn summary(&self, kind: Difference) -> [f64; 3] {
        let statistics = self.compared.statistics(kind);
        statistics.map_or([f64::NAN; 3], |Statistics { mean, median, p95, .. }| [mean, median, p95])
    }
}

impl Report for PhotoReport {
    fn text(&self) -> String {
        let PhotoSetting { convention, scene: Scene { kind, view, light }, falloff, .. } = &self.setting;
        let falloff = if *falloff { "\nfalloff of the light divided out" } else { "" };
        let mut rows = vec![TITLES.map(str::to_owned).to_vec()];
        rows.extend(self.results.iter().map(|result| {
            let start = [
                result.material.clone(),
                format!("{:.4}", result.compared.factor),
                format!("{:+.2}", result.compared.exposure_ev()),
            ];
            let numbers = Self::DIFFERENCES.into_iter().flat_map(|kind| result.summary(kind));
            let clipped = format!("{:.2}%", 100.0 * result.clipped as f64 / result.texels() as f64);
            start.into_iter().chain(numbers.map(|x| format!("{x:.4}"))).chain([clipped]).collect()
        }));
        format!(
            "differences from {}\nconvention {}, epsilon {}\n{kind} scene: view {}, light {}{falloff}\n\n{}",
            self.setting.source(),
            convention.name,
            convention.epsilon,
            position(*view),
            position(*light),
            aligned(&rows)
        )
    }

    fn table(&self) -> Table {
        let PhotoSetting { name, photograph, convention, .. } = &self.setting;
        let statistics = Self::DIFFERENCES
            .into_iter()
            .flat_map(|kind| ["mean", "median", "p95"].map(|what| format!("{}_{what}", kind.key())));
        let start = ["material", "factor", "exposure_ev"].map(str::to_owned).into_iter();
        let end = ["texels", "clipped", "photograph", "transfer", "convention", "epsilon"].map(str::to_owned);
        let row = |result: &PhotoResult| {
            let start: [Cell; 3] = [
                result.material.as_str().into(),
                result.compared.factor.into(),
                result.compared.exposure_ev().into(),
            ];
            let numbers = Self::DIFFERENCES.into_iter().flat_map(|kind| result.summary(kind));
            let end = [
                result.texels().into(),
                result.clipped.into(),
                name.as_str().into(),
                photograph.transfer.name().into(),
                convention.name.into(),
                convention.epsilon.into(),
            ];
            start.into_iter().chain(numbers.map(Cell::from)).chain(end).collect()
        };
        Table::new(start.chain(statistics).chain(end), self.results.iter().map(row))
    }
}

/// A scene file, too.
#[derive(Serialize)]
struct PhotoJson<'a> {
    photograph: &'a str,
    size: [usize; 2],
    transfer: &'a str,
    /// Top left, top right, bottom right and bottom left, in pixels.
    corners: [[f64; 2]; 4],
    /// Whether the falloff of the light is divided out of the photograph.
    falloff: bool,
    convention: &'a str,
    epsilon: f64,
    results: Vec<PhotoEntry<'a>>,
    scenes: [Scene; 1],
}

#[derive(Serialize)]
struct PhotoEntry<'a> {
    material: &'a str,
    size: [usize; 2],
    /// Number of texels that are left out.
    clipped: usize,
    /// What the photograph was multiplied by.
    factor: f64,
    exposure_ev: f64,
    log: PhotoStatistics,
    absolute: PhotoStatistics,
    relative: PhotoStatistics,
}

#[derive(Serialize)]
struct PhotoStatistics {
    mean: f64,
    median: f64,
    p95: f64,
}

impl PhotoResult {
    fn entry(&self) -> PhotoEntry<'_> {
        let statistics = |kind| {
            let [mean, median, p95] = self.summary(kind);
            PhotoStatistics { mean, median, p95 }
        };
        let [log, absolute, relative] = PhotoReport::DIFFERENCES.map(statistics);
        let Self { material, compared, clipped } = self;
        PhotoEntry {
            material,
            size: [compared.rendering.width, compared.rendering.height],
            clipped: *clipped,
            factor: compared.factor,
            exposure_ev: compared.exposure_ev(),
            log,
            absolute,
            relative,
        }
    }
}

impl Serialize for PhotoReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let PhotoSetting { name, photograph, corners, falloff, scene, convention } = &self.setting;
        let object = PhotoJson {
            photograph: name,
            size: photograph.size(),
            transfer: photograph.transfer.name(),
            corners: corners.0,
            falloff: *falloff,
            convention: convention.name,
            epsilon: convention.epsilon,
            results: self.results.iter().map(PhotoResult::entry).collect(),
            scenes: [*scene],
        };
        object.serialize(serializer)
    }
}
