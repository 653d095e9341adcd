//! Materials against photographs as JSON, text and CSV.

use serde::Serialize;

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::progress::Progress;
use svbrdf_core::statistics::sort_by_number;
use svbrdf_files::disk::memory;
use svbrdf_files::photograph::Capture;
use svbrdf_files::read::{Albedo, Photograph, read_photograph};

use super::{PhotographComparison, compare, on_texels};
use crate::error::Error;
use crate::metrics::{PictureMetrics, of_pictures};
use crate::report::{Cell, Field, Reader, Report, Table, position};

/// Bytes of a texel of a photograph: with its rendering, its ratios and itself at the exposure of the rendering.
const BYTES: usize = 3 * 12 + 24;

/// Materials against photographs. Its JSON is a scene file, too.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PhotoReport {
    /// The path of the photograph, or of what lists several.
    pub path: String,
    /// In the order of the capture.
    photographs: Vec<ReadPhotograph>,
    /// Whether the falloff of the light is divided out of the photographs.
    falloff: bool,
    /// The name of the convention.
    pub convention: &'static str,
    epsilon: f64,
    /// The smallest mean log difference first.
    pub results: Vec<PhotoResult>,
    /// Of the photographs.
    pub scenes: Vec<Scene>,
    /// What reading the photographs noticed.
    pub notes: Vec<String>,
}

/// How a photograph was read.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ReadPhotograph {
    /// The name of its file in the capture, or the path of a single photograph.
    photograph: String,
    /// Width and height in pixels.
    size: [usize; 2],
    transfer: Albedo,
    /// The source of the transfer curve.
    #[serde(skip)]
    transfer_from: &'static str,
}

/// A material against one photograph; measures are `None` where all of it is clipped.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PhotoMeasure {
    /// The name of the photograph.
    pub photograph: String,
    /// The mean log difference.
    pub log: Option<f64>,
    /// The root mean square difference of sRGB values.
    pub rmse: Option<f64>,
    /// The SSIM of sRGB values.
    pub ssim: Option<f64>,
    /// The number of texels that are left out.
    pub clipped: usize,
}

/// A material against all photographs; its measures are the means over photographs.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PhotoResult {
    /// The name of the material.
    pub material: String,
    /// Width and height in texels.
    size: [usize; 2],
    /// The factor on all photographs: the median of rendering / photograph.
    pub factor: f64,
    /// The factor in stops.
    pub exposure_ev: f64,
    pub log: Option<f64>,
    rmse: Option<f64>,
    ssim: Option<f64>,
    /// The share of the texels that are left out.
    pub clipped: f64,
    /// In the order of the capture.
    pub photographs: Vec<PhotoMeasure>,
    /// Photograph and rendering, where there is one photograph.
    #[serde(skip)]
    pub compared: Option<PhotographComparison>,
}

impl PhotoReport {
    /// Reads the photographs and compares each of `materials`, which have the names of the report beside them, with all of them.
    ///
    /// A photograph that is read, and a material on a photograph, are a step of `progress`.
    ///
    /// # Errors
    /// As [`read_photograph`], [`on_texels`] and [`compare`]; [`Memory`](svbrdf_files::Error::Memory).
    pub fn new<'a>(
        capture: &Capture,
        materials: impl IntoIterator<Item = (&'a str, &'a Material<f32>)>,
        convention: &Convention,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let materials: Vec<_> = materials.into_iter().collect();
        let count = capture.photographs.len();
        progress.begin((count * (1 + materials.len())) as u64);
        let (mut photographs, mut read, mut notes) = (Vec::new(), Vec::new(), capture.outside());
        for one in &capture.photographs {
            let Photograph { image, transfer, transfer_from, notes: noticed } =
                read_photograph(&one.file, one.transfer)?;
            notes.extend(noticed.iter().map(|note| format!("{}: {note}", one.name)));
            let size = [image.width, image.height];
            read.push(ReadPhotograph { photograph: one.name.clone(), size, transfer, transfer_from });
            photographs.push(Photograph { image, transfer, transfer_from, notes: noticed });
            progress.step()?;
        }
        let result = |(name, material): (&str, &Material<f32>)| {
            let texels = material.width() * material.height();
            let what = || format!("comparing with the {count} photographs");
            let _reserved = memory::reserve((BYTES * count).saturating_mul(texels) as u64, what)?;
            let on_texels = photographs.iter().zip(&capture.photographs).map(|(photograph, one)| {
                let falloff = capture.falloff.then_some(&one.scene);
                Ok((on_texels(photograph, &one.name, material.size(), falloff)?, one.scene))
            });
            let on_texels = on_texels.collect::<Result<Vec<_>, Error>>()?;
            let compared = compare(&on_texels, material, name, convention, progress)?;
            let names = capture.photographs.iter().map(|one| one.name.as_str());
            Ok(PhotoResult::new(name, material.size(), names.zip(compared).collect()))
        };
        let mut results = materials.into_iter().map(result).collect::<Result<Vec<_>, Error>>()?;
        sort_by_number(&mut results, |result| result.log.unwrap_or(f64::INFINITY));
        Ok(Self {
            path: capture.path.display().to_string(),
            photographs: read,
            falloff: capture.falloff,
            convention: convention.name,
            epsilon: convention.epsilon,
            results,
            scenes: capture.photographs.iter().map(|one| one.scene).collect(),
            notes,
        })
    }
}

impl PhotoResult {
    fn new(material: &str, size: [usize; 2], compared: Vec<(&str, PhotographComparison)>) -> Self {
        let measure = |(name, one): &(&str, PhotographComparison)| {
            let PictureMetrics { rmse, ssim } = of_pictures(&one.photograph, &one.rendering);
            let log = one.statistics(Difference::Log).map(|statistics| statistics.mean);
            PhotoMeasure { photograph: (*name).to_owned(), log, rmse, ssim, clipped: one.clipped() }
        };
        let photographs: Vec<_> = compared.iter().map(measure).collect();
        let mean = |of: fn(&PhotoMeasure) -> Option<f64>| {
            let known: Vec<f64> = photographs.iter().filter_map(of).collect();
            (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
        };
        let clipped: usize = photographs.iter().map(|one| one.clipped).sum();
        let factor = compared.first().map_or(f64::NAN, |(_, one)| one.factor);
        Self {
            material: material.to_owned(),
            size,
            factor,
            exposure_ev: factor.log2(),
            log: mean(|one| one.log),
            rmse: mean(|one| one.rmse),
            ssim: mean(|one| one.ssim),
            clipped: clipped as f64 / (photographs.len() * size[0] * size[1]) as f64,
            compared: (compared.len() == 1)
                .then(|| compared.into_iter().next())
                .flatten()
                .map(|(_, one)| one),
            photographs,
        }
    }
}

type Row<'a> = (&'a PhotoReport, &'a PhotoResult);

fn fields<'a>() -> [Field<Row<'a>>; 13] {
    [
        ("material", "material", |(_, result)| result.material.as_str().into()),
        ("factor", "factor", |(_, result)| Cell::Digits(4, result.factor)),
        ("exposure_ev", "EV", |(_, result)| Cell::Stops(result.exposure_ev)),
        ("log", "log difference", |(_, result)| number(result.log)),
        ("rmse", "RMSE", |(_, result)| number(result.rmse)),
        ("ssim", "SSIM", |(_, result)| number(result.ssim)),
        ("clipped", "", |(_, result)| result.clipped.into()),
        ("", "clipped", |(_, result)| format!("{:.2}%", 100.0 * result.clipped).into()),
        ("photographs", "", |(report, _)| report.photographs.len().into()),
        ("falloff", "", |(report, _)| report.falloff.into()),
        ("path", "", |(report, _)| report.path.as_str().into()),
        ("convention", "", |(report, _)| report.convention.into()),
        ("epsilon", "", |(report, _)| report.epsilon.into()),
    ]
}

fn number(value: Option<f64>) -> Cell {
    Cell::or(value.map(|number| Cell::Digits(4, number)), "-")
}

impl Report for PhotoReport {
    fn heading(&self) -> String {
        let mut transfers: Vec<String> = self
            .photographs
            .iter()
            .map(|one| format!("{} {}", one.transfer.label(), one.transfer_from))
            .collect();
        transfers.dedup();
        let (source, below) = match (self.photographs.as_slice(), self.scenes.as_slice()) {
            ([one], [Scene { kind, view, light }]) => {
                let [width, height] = one.size;
                let scene = format!("{kind} scene: view {}, light {}", position(*view), position(*light));
                (format!("{}, {width} x {height} pixels", one.photograph), scene)
            }
            (several, _) => (
                format!("the {} photographs of {}", several.len(), self.path),
                "one exposure for all photographs, means over photographs".to_owned(),
            ),
        };
        let falloff = if self.falloff { ", falloff of the light divided out" } else { "" };
        format!(
            "differences from {source}, {}{falloff}\nconvention {}, epsilon {}\n{below}; RMSE and SSIM of sRGB values\n",
            transfers.join("; "),
            self.convention,
            self.epsilon
        )
    }

    fn table(&self, reader: Reader) -> Table {
        Table::fields(&fields(), self.results.iter().map(|result| (self, result)), reader)
    }
}
