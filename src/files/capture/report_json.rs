//! Materials against the photographs of a capture as JSON: a scene file, too.

use serde::{Serialize, Serializer};

use svbrdf_core::loss::Estimate;
use svbrdf_core::model::scene::Scene;

use super::comparison::{CaptureReport, CaptureSetting, ReadCaptured};
use super::measured::{CaptureGroup, CapturedResult, MaterialResult};
use super::outliers::Outlier;

#[derive(Serialize)]
struct CaptureJson<'a> {
    capture: &'a str,
    /// The file that lists the photographs.
    file: String,
    photographs: Vec<PhotographJson<'a>>,
    /// Whether the falloff of the light is divided out of the photographs.
    falloff: bool,
    /// `capture` or `photograph`: what one factor is fitted to.
    exposure: &'static str,
    /// The factor that the power of the light gives.
    declared_factor: Option<f64>,
    convention: &'a str,
    epsilon: f64,
    results: Vec<ResultJson<'a>>,
    scenes: Vec<Scene>,
}

#[derive(Serialize)]
struct PhotographJson<'a> {
    photograph: &'a str,
    size: [usize; 2],
    transfer: &'a str,
    /// Top left, top right, bottom right and bottom left, in pixels.
    corners: [[f64; 2]; 4],
    held_out: bool,
}

#[derive(Serialize)]
struct ResultJson<'a> {
    material: &'a str,
    size: [usize; 2],
    factor: Option<f64>,
    exposure_ev: Option<f64>,
    /// The stops by which `factor` exceeds `declared_factor`.
    declared_ev: Option<f64>,
    means: Vec<GroupJson>,
    photographs: Vec<EntryJson<'a>>,
}

#[derive(Serialize)]
struct GroupJson {
    photographs: &'static str,
    count: usize,
    log: Option<Estimate>,
    rmse: Option<Estimate>,
    ssim: Option<Estimate>,
}

#[derive(Serialize)]
struct EntryJson<'a> {
    photograph: &'a str,
    factor: Option<f64>,
    exposure_ev: Option<f64>,
    own_exposure_ev: Option<f64>,
    log: Option<f64>,
    rmse: Option<f64>,
    ssim: Option<f64>,
    texels: usize,
    clipped: usize,
    outlier: Outlier,
}

impl CaptureReport {
    fn photograph(&self, index: usize) -> PhotographJson<'_> {
        let read = &self.photographs[index];
        PhotographJson {
            photograph: &read.name,
            size: read.size,
            transfer: read.transfer.name(),
            corners: read.corners.0,
            held_out: self.setting.is_held_out(index),
        }
    }

    fn result<'a>(&'a self, result: &'a MaterialResult) -> ResultJson<'a> {
        let means = result.groups().into_iter().map(|CaptureGroup { name, count, log, rmse, ssim }| {
            GroupJson { photographs: name, count, log, rmse, ssim }
        });
        let photographs =
            self.photographs.iter().zip(&result.photographs).map(|(read, one)| entry(read, one));
        ResultJson {
            material: &result.material,
            size: result.size,
            factor: result.factor,
            exposure_ev: result.factor.map(f64::log2),
            declared_ev: self.setting.declared_ev(result.factor),
            means: means.collect(),
            photographs: photographs.collect(),
        }
    }
}

fn entry<'a>(read: &'a ReadCaptured, one: &CapturedResult) -> EntryJson<'a> {
    EntryJson {
        photograph: &read.name,
        factor: one.factor,
        exposure_ev: one.factor.map(f64::log2),
        own_exposure_ev: one.own_ev(),
        log: one.log,
        rmse: one.rmse,
        ssim: one.ssim,
        texels: one.texels,
        clipped: one.clipped,
        outlier: one.outlier,
    }
}

impl Serialize for CaptureReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let CaptureSetting { name, capture, exposure, convention, .. } = &self.setting;
        let object = CaptureJson {
            capture: name,
            file: capture.file.display().to_string(),
            photographs: (0..self.photographs.len()).map(|index| self.photograph(index)).collect(),
            falloff: capture.falloff,
            exposure: exposure.name(),
            declared_factor: self.setting.declared_factor(),
            convention: convention.name,
            epsilon: convention.epsilon,
            results: self.results.iter().map(|result| self.result(result)).collect(),
            scenes: capture.photographs.iter().map(|one| one.scene).collect(),
        };
        object.serialize(serializer)
    }
}
