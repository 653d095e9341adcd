//! Results of `svbrdf photo`: text, JSON, CSV, and the metadata of pictures.

use serde::Serialize;
use svbrdf::error::Error;
use svbrdf::model::scene::Scene;
use svbrdf::picture::difference::Difference;
use svbrdf::picture::export::Provenance;
use svbrdf::picture::statistics::{Distributions, Statistics};
use svbrdf::report::table::aligned;

use super::results::{PhotoResult, Setting};
use crate::cli::output::table::{self, kind_name, triple};
use crate::cli::report::ReportFormat;

/// The differences that are printed.
pub const KINDS: [Difference; 3] = [Difference::Log, Difference::Absolute, Difference::Relative];

/// The report in this format, complete with its last line break.
pub fn report(setting: &Setting<'_>, results: &[PhotoResult], format: ReportFormat) -> Result<String, Error> {
    match format {
        ReportFormat::Text => Ok(text(setting, results)),
        ReportFormat::Json => json(setting, results),
        ReportFormat::Csv => csv(setting, results),
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

fn text(setting: &Setting<'_>, results: &[PhotoResult]) -> String {
    let convention = setting.convention;
    let Scene { kind, view, light } = setting.scene;
    let falloff = if setting.args.reading.falloff { "\nfalloff of the light divided out" } else { "" };
    let titles = [
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
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    rows.extend(results.iter().map(|result| {
        let start = [
            result.material.name().to_owned(),
            format!("{:.4}", result.compared.factor),
            format!("{:+.2}", result.compared.exposure_ev()),
        ];
        let numbers = KINDS.into_iter().flat_map(|kind| result.summary(kind)).map(|x| format!("{x:.4}"));
        let clipped = format!("{:.2}%", 100.0 * result.clipped as f64 / result.texels() as f64);
        start.into_iter().chain(numbers).chain([clipped]).collect()
    }));
    format!(
        "differences from {}\nconvention {}, epsilon {}\n{} scene: view {}, light {}{falloff}\n\n{}",
        source(setting),
        convention.name,
        convention.epsilon,
        kind_name(kind),
        triple(view),
        triple(light),
        aligned(&rows)
    )
}

/// The photograph, and how it was read.
fn source(setting: &Setting<'_>) -> String {
    let photograph = &setting.photograph;
    let [width, height] = photograph.size();
    let corners = setting.corners.0.map(|[x, y]| format!("{x},{y}")).join(" ");
    format!(
        "{}, {width} x {height} pixels, {} {}, corners {corners}",
        setting.args.photo.display(),
        photograph.transfer,
        photograph.transfer_from
    )
}

fn csv(setting: &Setting<'_>, results: &[PhotoResult]) -> Result<String, Error> {
    let convention = setting.convention;
    let statistics = KINDS
        .into_iter()
        .flat_map(|kind| ["mean", "median", "p95"].map(|what| format!("{}_{what}", kind.key())));
    let start = ["material", "factor", "exposure_ev"].map(str::to_owned).into_iter();
    let end = ["texels", "clipped", "photograph", "transfer", "convention", "epsilon"].map(str::to_owned);
    let heading = start.chain(statistics).chain(end).collect();
    let row = |result: &PhotoResult| {
        let start = [
            result.material.name().to_owned(),
            result.compared.factor.to_string(),
            result.compared.exposure_ev().to_string(),
        ];
        let numbers = KINDS.into_iter().flat_map(|kind| result.summary(kind)).map(|x| x.to_string());
        let end = [
            result.texels().to_string(),
            result.clipped.to_string(),
            setting.args.photo.display().to_string(),
            setting.photograph.transfer.name().to_owned(),
            convention.name.to_owned(),
            convention.epsilon.to_string(),
        ];
        start.into_iter().chain(numbers).chain(end).collect()
    };
    table::csv([heading].into_iter().chain(results.iter().map(row)))
}

/// A scene file, too.
#[derive(Serialize)]
struct PhotoJson<'a> {
    photograph: String,
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
    /// The factor of the photograph.
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

fn json(setting: &Setting<'_>, results: &[PhotoResult]) -> Result<String, Error> {
    let convention = setting.convention;
    fn entry(result: &PhotoResult) -> PhotoEntry<'_> {
        let statistics = |kind| {
            let [mean, median, p95] = result.summary(kind);
            PhotoStatistics { mean, median, p95 }
        };
        let [log, absolute, relative] = KINDS.map(statistics);
        let compared = &result.compared;
        PhotoEntry {
            material: result.material.name(),
            size: result.material.size(),
            clipped: result.clipped,
            factor: compared.factor,
            exposure_ev: compared.exposure_ev(),
            log,
            absolute,
            relative,
        }
    }
    table::json(&PhotoJson {
        photograph: setting.args.photo.display().to_string(),
        size: setting.photograph.size(),
        transfer: setting.photograph.transfer.name(),
        corners: setting.corners.0,
        falloff: setting.args.reading.falloff,
        convention: convention.name,
        epsilon: convention.epsilon,
        results: results.iter().map(entry).collect(),
        scenes: [setting.scene],
    })
}

/// The difference that has the last colour: the 99th percentile of the material where it is largest.
pub fn last_colour(results: &[PhotoResult], kind: Difference) -> f64 {
    let values: Vec<_> = results.iter().map(|result| result.compared.differences(kind)).collect();
    Distributions::of(&values, kind.is_signed()).auto_range
}

/// The metadata of a picture of the differences.
pub fn entries(setting: &Setting<'_>, results: &[PhotoResult], last: f64) -> [(&'static str, String); 7] {
    let kind = setting.args.difference;
    let names: Vec<_> = results.iter().map(|result| result.material.name()).collect();
    let factors: Vec<_> = results.iter().map(|result| result.compared.factor.to_string()).collect();
    let Scene { kind: near, view, light } = setting.scene;
    let shows = format!(
        "{} from the photograph g, {} of renderings p; NaN or gray where the photograph is clipped; {last} the last colour",
        kind.name(),
        kind.unit()
    );
    [
        ("svbrdf:shows", shows),
        ("svbrdf:photograph", source(setting)),
        ("svbrdf:factors", factors.join(" | ")),
        ("svbrdf:sources", names.join(" | ")),
        ("svbrdf:convention", setting.convention.name.to_owned()),
        ("svbrdf:scene", format!("{}, view {}, light {}", kind_name(near), triple(view), triple(light))),
        ("svbrdf:version", Provenance::SOFTWARE.to_owned()),
    ]
}
