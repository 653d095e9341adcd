//! Materials against photographs as JSON, text and CSV.

use schemars::JsonSchema;
use serde::Serialize;

use crate::error::Error;
use crate::report::{Cell, Field, Reader, Report, Table, position};
use svbrdf_core::loss::Estimate;
use svbrdf_core::material::Material;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_core::statistics::median;

use super::comparison::PhotographComparison;
use super::measured::{PhotoMeans, PhotoMeasure, PhotoResult, ReadPhotograph};
use super::setting::{CaptureExposure, PhotoSetting};
use svbrdf_files::disk::memory;

/// Bytes of a texel on the photographs, and of its ratios.
const BYTES: usize = 12 + 24;

/// Materials against photographs. Its JSON is a scene file, too.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct PhotoReport {
    /// The path of the capture; `None`: a single photograph.
    capture: Option<String>,
    /// The file that lists the photographs.
    file: Option<String>,
    /// In the order of the capture.
    pub photographs: Vec<ReadPhotograph>,
    /// Whether the falloff of the light is divided out of the photographs.
    falloff: bool,
    /// What one factor is fitted to.
    exposure: CaptureExposure,
    /// The factor that the power of the light gives.
    pub declared_factor: Option<f64>,
    /// The name of the convention.
    convention: &'static str,
    epsilon: f64,
    /// The smallest mean log difference first: over the held-out photographs, or over all.
    pub results: Vec<PhotoResult>,
    /// Of the photographs.
    scenes: Vec<Scene>,
    /// What reading the photographs noticed.
    notes: Vec<String>,
    #[serde(skip)]
    pub setting: PhotoSetting,
}

impl PhotoReport {
    /// Reads the photographs and compares each of `materials`, which have the names of the report beside them, with all of them.
    ///
    /// A photograph that is read, and a material on a photograph, are a step of `progress`.
    ///
    /// # Errors
    /// As [`CapturedPhotograph::read`](svbrdf_files::photograph::CapturedPhotograph::read), and
    /// [`UnusableScene`](svbrdf_core::error::Error::UnusableScene), [`Error::NoExposure`],
    /// [`Memory`](svbrdf_files::Error::Memory), [`Cancelled`](Error::is_cancelled).
    pub fn new<'a>(
        setting: PhotoSetting,
        materials: impl IntoIterator<Item = (&'a str, &'a Material<f32>)>,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let materials: Vec<_> = materials.into_iter().collect();
        let mut sizes: Vec<[usize; 2]> = materials.iter().map(|(_, material)| material.size()).collect();
        sizes.sort_unstable();
        sizes.dedup();
        let count = setting.capture.photographs.len();
        let texels: usize = sizes.iter().map(|[width, height]| width * height).sum();
        let bytes = (BYTES * count).saturating_mul(texels) as u64;
        let _reserved = memory::reserve(bytes, || format!("comparing with the {count} photographs"))?;
        progress.begin((count * (1 + materials.len())) as u64);
        let (photographs, rectified) = setting.read(&sizes, progress)?;
        let measured = materials.into_iter().map(|(name, material)| {
            let index = sizes.partition_point(|size| *size < material.size());
            setting.measure(name, material, &rectified[index], progress)
        });
        let mut results = measured.collect::<Result<Vec<_>, _>>()?;
        results.sort_by(|a, b| a.log().total_cmp(&b.log()));
        let file = setting.capture.file.as_ref();
        Ok(Self {
            capture: file.map(|_| setting.capture.path.display().to_string()),
            file: file.map(|file| file.display().to_string()),
            notes: setting.notes(&photographs),
            photographs,
            falloff: setting.capture.falloff,
            exposure: setting.exposure,
            declared_factor: setting.declared_factor(),
            convention: setting.convention.name,
            epsilon: setting.convention.epsilon,
            results,
            scenes: setting.capture.photographs.iter().map(|one| one.scene).collect(),
            setting,
        })
    }

    /// Of each material, the single photograph and its rendering; none where there are several photographs.
    pub fn compared(&self) -> impl Iterator<Item = &PhotographComparison> {
        self.results.iter().flat_map(|result| &result.photographs).filter_map(|one| one.compared.as_ref())
    }

    /// The photographs, and how they were read.
    pub fn source(&self) -> String {
        let mut transfers: Vec<String> = self
            .photographs
            .iter()
            .map(|one| format!("{} {}", one.transfer.label(), one.transfer_from))
            .collect();
        transfers.dedup();
        let (path, transfers) = (self.setting.capture.path.display(), transfers.join("; "));
        let [one] = self.photographs.as_slice() else {
            return format!("the {} photographs of {path}, {transfers}", self.photographs.len());
        };
        let of = if self.capture.is_some() { format!("{} of {path}", one.name) } else { one.name.clone() };
        let ([width, height], corners) = (one.size, one.corners.0.map(|[x, y]| format!("{x},{y}")).join(" "));
        format!("{of}, {width} x {height} pixels, {transfers}, corners {corners}")
    }

    /// To what the exposure is fitted.
    fn exposure(&self) -> String {
        let held_out = self.setting.held_out();
        let exposure = match (self.exposure, held_out.is_empty()) {
            (CaptureExposure::Capture, true) => "one exposure for all photographs".to_owned(),
            (CaptureExposure::Capture, false) => {
                format!(
                    "one exposure for all photographs, not fitted to the held-out photographs: {held_out}"
                )
            }
            (CaptureExposure::Photograph, true) => "one exposure for each photograph".to_owned(),
            (CaptureExposure::Photograph, false) => {
                format!("one exposure for each photograph; held out: {held_out}")
            }
        };
        exposure + "\nmeans over photographs with 95% intervals"
    }

    /// The line about the photograph at `index` where it is an outlier, with the numbers of the first material for which it is one.
    fn outlier(&self, index: usize) -> Option<String> {
        let is_outlier = |result: &&PhotoResult| result.photographs[index].outlier.is_any();
        let result = self.results.iter().find(is_outlier)?;
        let outlier = result.photographs[index].outlier;
        let exposure = outlier.exposure.then(|| {
            let [own, middle] = beside_median(result, index, |one| one.own_exposure_ev);
            format!("the exposure that fits it alone is {:+.2} EV from the median", own - middle)
        });
        let difference = outlier.difference.then(|| {
            let [log, middle] = beside_median(result, index, PhotoMeasure::mean_log);
            format!("its log difference is {log:.4}, the median {middle:.4}")
        });
        let findings: Vec<String> = exposure.into_iter().chain(difference).collect();
        let (count, all) = (self.results.iter().filter(is_outlier).count(), self.results.len());
        let whose = match all {
            1 => String::new(),
            _ => format!(" for {count} of {all} materials (numbers of {})", result.material),
        };
        Some(format!("{} is an outlier{whose}: {}\n", self.photographs[index].name, findings.join("; ")))
    }

    /// Of each material, its means over groups of several photographs, then its measures on each photograph.
    fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        let has_means = self.photographs.len() > 1;
        self.results.iter().flat_map(move |result| {
            let row = move |group, read, one| Row { report: self, result, group, read, one };
            let groups =
                result.means.iter().filter(move |_| has_means).map(move |group| row(Some(group), None, None));
            let each = self.photographs.iter().zip(&result.photographs);
            groups.chain(each.map(move |(read, one)| row(None, Some(read), Some(one))))
        })
    }
}

/// A quantity of the photograph at `index`, and its median over all photographs.
fn beside_median(result: &PhotoResult, index: usize, of: impl Fn(&PhotoMeasure) -> Option<f64>) -> [f64; 2] {
    let mut known: Vec<f64> = result.photographs.iter().filter_map(&of).collect();
    let middle = median(&mut known).unwrap_or(f64::NAN);
    [of(&result.photographs[index]).unwrap_or(f64::NAN), middle]
}

/// A row of the tables: the means of a material over a group of photographs, or the material against one of them.
#[derive(Clone, Copy)]
struct Row<'a> {
    report: &'a PhotoReport,
    result: &'a PhotoResult,
    group: Option<&'a PhotoMeans>,
    read: Option<&'a ReadPhotograph>,
    one: Option<&'a PhotoMeasure>,
}

impl Row<'_> {
    fn photographs(&self) -> &'static str {
        let of_one = if self.one.is_some_and(|one| one.is_held_out) { "held out" } else { "fitted" };
        self.group.map_or(of_one, |group| group.name)
    }

    fn factor(&self) -> Option<f64> {
        self.one.map_or(self.result.factor, |one| one.factor)
    }

    /// The mean of a measure over a group, or the measure of one photograph.
    fn measure(&self, (of_group, of_one): Measure) -> Option<f64> {
        self.group.and_then(of_group).map(|estimate| estimate.mean).or_else(|| self.one.and_then(of_one))
    }

    fn interval(&self, (of_group, _): Measure) -> Cell {
        let interval = self.group.and_then(of_group).and_then(|estimate| estimate.interval95);
        Cell::or(interval.map(|ends| Cell::Interval(4, ends)), "-")
    }
}

/// A measure of a group and of one photograph.
type Measure = (fn(&PhotoMeans) -> Option<Estimate>, fn(&PhotoMeasure) -> Option<f64>);

const LOG: Measure = (|group| group.log, PhotoMeasure::mean_log);
const RMSE: Measure = (|group| group.rmse, |one| one.rmse);
const SSIM: Measure = (|group| group.ssim, |one| one.ssim);

fn fields<'a>() -> [Field<Row<'a>>; 33] {
    [
        ("material", "material", |row| row.result.material.as_str().into()),
        ("photographs", "", |row| row.photographs().into()),
        ("", "photographs", |row| row.group.map(counted).into()),
        ("photograph", "photograph", |row| row.read.map(|read| read.name.as_str()).into()),
        ("factor", "factor", |row| number(row.factor())),
        ("exposure_ev", "EV", |row| stops(row.factor().map(f64::log2))),
        ("own_exposure_ev", "EV alone", |row| stops(row.one.and_then(|one| one.own_exposure_ev))),
        ("log_mean", "log mean", |row| number(row.measure(LOG))),
        ("log_interval95_low log_interval95_high", "95% interval", |row| row.interval(LOG)),
        ("log_median", "median", |row| number(row.one.and_then(|one| Some(one.log?.median)))),
        ("log_p95", "95%", |row| number(row.one.and_then(|one| Some(one.log?.p95)))),
        ("absolute_mean", "abs. mean", |row| number(row.one.and_then(|one| Some(one.absolute?.mean)))),
        ("absolute_median", "median", |row| number(row.one.and_then(|one| Some(one.absolute?.median)))),
        ("absolute_p95", "95%", |row| number(row.one.and_then(|one| Some(one.absolute?.p95)))),
        ("relative_mean", "rel. mean", |row| number(row.one.and_then(|one| Some(one.relative?.mean)))),
        ("relative_median", "median", |row| number(row.one.and_then(|one| Some(one.relative?.median)))),
        ("relative_p95", "95%", |row| number(row.one.and_then(|one| Some(one.relative?.p95)))),
        ("rmse", "RMSE", |row| number(row.measure(RMSE))),
        ("rmse_interval95_low rmse_interval95_high", "95% interval", |row| row.interval(RMSE)),
        ("ssim", "SSIM", |row| number(row.measure(SSIM))),
        ("ssim_interval95_low ssim_interval95_high", "95% interval", |row| row.interval(SSIM)),
        ("texels", "", |row| row.one.map(|one| one.texels).into()),
        ("clipped", "", |row| row.one.map(|one| one.clipped).into()),
        ("", "clipped", |row| row.one.map(clipped).into()),
        ("outlier", "", |row| row.one.map(|one| one.outlier.is_any()).into()),
        ("", "marks", |row| row.one.map(marks).into()),
        ("transfer", "", |row| row.read.map(|read| read.transfer.name()).into()),
        ("exposure", "", |row| row.report.exposure.name().into()),
        ("declared_ev", "EV from light_pow", |row| stops(row.report.setting.declared_ev(row.factor()))),
        ("falloff", "", |row| row.report.falloff.into()),
        ("capture", "", |row| row.report.capture.as_deref().into()),
        ("convention", "", |row| row.report.convention.into()),
        ("epsilon", "", |row| row.report.epsilon.into()),
    ]
}

/// The columns for people, by their names for programs, or their titles where they have none: of means over photographs, of each of
/// several photographs, and of a single one.
const OF_MEANS: &str = "material photographs factor exposure_ev declared_ev log_mean log_interval95_low \
                        rmse rmse_interval95_low ssim ssim_interval95_low";
const OF_EACH: &str = "photograph material own_exposure_ev log_mean rmse ssim clipped marks";
const OF_ONE: &str = "material factor exposure_ev declared_ev log_mean log_median log_p95 \
                      absolute_mean absolute_median absolute_p95 relative_mean relative_median relative_p95 rmse ssim clipped";

fn number(value: Option<f64>) -> Cell {
    Cell::or(value.map(|number| Cell::Digits(4, number)), "-")
}

fn stops(value: Option<f64>) -> Cell {
    Cell::or(value.map(Cell::Stops), "-")
}

fn counted(group: &PhotoMeans) -> String {
    format!("{} {}", group.count, group.name).replace(" all", "")
}

fn clipped(one: &PhotoMeasure) -> String {
    format!("{:.2}%", 100.0 * one.clipped as f64 / one.texels as f64)
}

fn marks(one: &PhotoMeasure) -> String {
    let marks = [(one.outlier.is_any(), "outlier"), (one.is_held_out, "held out")];
    marks.into_iter().filter(|(is, _)| *is).map(|(_, mark)| mark).collect::<Vec<_>>().join(", ")
}

/// The columns of these names for people. That of the power of the light is left out where there is none.
fn table_of(rows: &[Row<'_>], names: &str) -> Table {
    let has_power = rows.iter().any(|row| row.report.declared_factor.is_some());
    let names = names.split_whitespace().filter(|name| has_power || *name != "declared_ev");
    let all = fields();
    let is_of = |(name, title, _): &&Field<Row<'_>>, of: &str| match name.split_whitespace().next() {
        Some(name) => name == of && !title.is_empty(),
        None => *title == of,
    };
    let fields: Vec<_> = names.filter_map(|of| all.iter().find(|field| is_of(field, of)).copied()).collect();
    Table::fields(&fields, rows, Reader::Person)
}

impl Report for PhotoReport {
    fn heading(&self) -> String {
        let falloff = if self.falloff { ", falloff of the light divided out" } else { "" };
        let below = match self.scenes.as_slice() {
            [Scene { kind, view, light }] => {
                format!("{kind} scene: view {}, light {}", position(*view), position(*light))
            }
            _ => self.exposure(),
        };
        let (source, convention) = (self.source(), self.convention);
        format!(
            "differences from {source}{falloff}\nconvention {convention}, epsilon {}\n{below}; RMSE and SSIM of sRGB values\n",
            self.epsilon
        )
    }

    /// With the outliers above the tables, where there are several photographs.
    fn text(&self) -> String {
        let (heading, count) = (self.heading(), self.photographs.len());
        let table = self.table(Reader::Person).text();
        if count == 1 {
            return format!("{heading}\n{table}");
        }
        let outliers: String = (0..count).filter_map(|index| self.outlier(index)).collect();
        let each: Vec<_> = self.rows().filter(|row| row.group.is_none()).collect();
        let by_photograph = (0..count).flat_map(|index| each.iter().skip(index).step_by(count).copied());
        let each = table_of(&by_photograph.collect::<Vec<_>>(), OF_EACH).text();
        format!("{heading}{outliers}\n{table}\n{each}")
    }

    /// For people the means over several photographs, or the differences from a single one.
    fn table(&self, reader: Reader) -> Table {
        match reader {
            Reader::Program => Table::fields(&fields(), self.rows(), reader),
            Reader::Person if self.photographs.len() == 1 => {
                table_of(&self.rows().collect::<Vec<_>>(), OF_ONE)
            }
            Reader::Person => {
                table_of(&self.rows().filter(|row| row.group.is_some()).collect::<Vec<_>>(), OF_MEANS)
            }
        }
    }
}
