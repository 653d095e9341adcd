//! Materials against the photographs of a capture: exposures and measures.

use schemars::JsonSchema;

use crate::error::Error;
use crate::metrics::{PictureMetrics, of_pictures};
use svbrdf_core::choices;
use svbrdf_core::error::Error as CoreError;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error as FilesError;

use super::comparison::no_exposure;
use super::exposure::Ratios;
use super::measured::{PhotoMeans, PhotoMeasure, PhotoResult, PhotoStatistics, ReadPhotograph};
use super::outliers::PhotoOutlier;
use super::rectified::Rectified;
use svbrdf_files::photograph::{Capture, CapturedPhotograph};

choices! {
    /// What one factor brings to the exposure of the renderings.
    #[derive(Default, JsonSchema)]
    CaptureExposure, "exposure":
    /// All photographs of a capture.
    #[default]
    Capture = "capture",
    /// Each photograph.
    Photograph = "photograph",
}

/// Photographs, and how materials are compared with them.
#[derive(Clone, Debug)]
pub struct PhotoSetting {
    pub capture: Capture,
    pub exposure: CaptureExposure,
    pub convention: Convention,
    /// Of each photograph, whether the exposure is not fitted to it.
    held_out: Vec<bool>,
}

impl PhotoSetting {
    /// The differences that are reported.
    pub const DIFFERENCES: [Difference; 3] = [Difference::Log, Difference::Absolute, Difference::Relative];

    /// The setting without the photographs of the names `hold_out`, to which the exposure is not fitted. A name may lack its
    /// extension.
    ///
    /// # Errors
    /// [`CoreError::UnknownName`] for a name that no photograph has; [`FilesError::BadCapture`] where none is left.
    pub fn new(
        capture: Capture,
        exposure: CaptureExposure,
        hold_out: &[String],
        convention: Convention,
    ) -> Result<Self, Error> {
        let mut held_out = vec![false; capture.photographs.len()];
        for name in hold_out {
            let index = capture.photographs.iter().position(|one| one.is_called(name));
            let index =
                index.ok_or_else(|| CoreError::unknown_name("photograph", name, capture.names(|_| true)))?;
            held_out[index] = true;
        }
        if held_out.iter().all(|held_out| *held_out) {
            let problem = "every photograph is held out, and none is left to fit the exposure to".to_owned();
            return Err(FilesError::BadCapture { path: capture.path, problem }.into());
        }
        Ok(Self { capture, exposure, convention, held_out })
    }

    /// The names of the held-out photographs.
    pub fn held_out(&self) -> String {
        self.capture.names(|index| self.held_out[index])
    }

    /// The factor that the power of the light gives, where the capture has it.
    ///
    /// The photograph is `P f NoL / d^2` for a power P, a reflectance f and a light at the distance d and the height h, and the
    /// rendering `I f NoL d / h` for the factor I of the convention. The falloff that is divided out leaves `P f NoL d / (h h_0^2)`,
    /// where h_0 is the height of the first light.
    pub fn declared_factor(&self) -> Option<f64> {
        let height = self.capture.photographs.first()?.scene.light[2];
        self.capture.power.map(|power| self.convention.intensity * height.powi(2) / power.mean)
    }

    /// The stops by which a factor exceeds the one that the power of the light gives.
    pub(super) fn declared_ev(&self, factor: Option<f64>) -> Option<f64> {
        Some((factor? / self.declared_factor()?).log2())
    }

    /// What reading the photographs noticed.
    pub(super) fn notes(&self, photographs: &[ReadPhotograph]) -> Vec<String> {
        let of = |read: &ReadPhotograph| {
            let name = read.name.clone();
            read.notes.clone().into_iter().map(move |note| format!("{name}: {note}"))
        };
        self.capture.outside().into_iter().chain(photographs.iter().flat_map(of)).collect()
    }

    /// A photograph on the texels of a material, without falloff where that is divided out. What remains of the falloff is common to
    /// all photographs: (h / h_0)^2 is that between lights of the heights h and h_0.
    fn without_falloff(&self, rectified: Rectified, one: &CapturedPhotograph) -> Rectified {
        let Some(first) = self.capture.photographs.first().filter(|_| self.capture.falloff) else {
            return rectified;
        };
        let gain = (one.scene.light[2] / first.scene.light[2]).powi(2) as f32;
        let mut rectified = rectified.without_falloff(&one.scene);
        rectified.image.pixels.iter_mut().flatten().for_each(|value| *value *= gain);
        rectified
    }

    /// Reads the photographs: how, and for each of `sizes` of materials, all of them on its texels.
    pub(super) fn read(
        &self,
        sizes: &[[usize; 2]],
        progress: &Progress,
    ) -> Result<(Vec<ReadPhotograph>, Vec<Vec<Rectified>>), Error> {
        let (mut photographs, mut rectified) = (Vec::new(), vec![Vec::new(); sizes.len()]);
        for one in &self.capture.photographs {
            let (photograph, corners) = one.read()?;
            for (size, rectified) in sizes.iter().zip(&mut rectified) {
                let found = Rectified::new(&photograph, &corners, *size, &progress.part())?;
                rectified.push(self.without_falloff(found, one));
            }
            photographs.push(ReadPhotograph {
                name: one.name.clone(),
                size: photograph.size(),
                transfer: photograph.transfer,
                transfer_from: one.transfer_from(&photograph, self.capture.is_materialgan),
                corners,
                held_out: self.held_out[photographs.len()],
                is_whole: one.corners.is_none(),
                notes: photograph.notes,
            });
            progress.step()?;
        }
        Ok((photographs, rectified))
    }

    /// The factors that fit `material` to all photographs but the held-out ones, and to each photograph.
    fn factors(
        &self,
        material: &Material<f32>,
        photographs: &[Rectified],
        progress: &Progress,
    ) -> Result<(Option<f64>, Vec<Option<f64>>), Error> {
        let (mut together, mut own) = (Ratios::default(), Vec::new());
        for (index, (rectified, one)) in photographs.iter().zip(&self.capture.photographs).enumerate() {
            let rendering = rectified.rendering(material, &one.scene, &self.convention, &progress.part())?;
            let mut ratios = rectified.ratios(&rendering, self.convention.epsilon);
            own.push(ratios.factor());
            if !self.held_out[index] && self.exposure == CaptureExposure::Capture {
                together.append(ratios);
            }
        }
        Ok((together.factor(), own))
    }

    /// Fits the exposure of `material` and measures it on every photograph.
    pub(super) fn measure(
        &self,
        name: &str,
        material: &Material<f32>,
        photographs: &[Rectified],
        progress: &Progress,
    ) -> Result<PhotoResult, Error> {
        let (factor, own) = self.factors(material, photographs, progress)?;
        let is_fitted = match self.exposure {
            CaptureExposure::Capture => factor.is_some(),
            CaptureExposure::Photograph => own.iter().any(Option::is_some),
        };
        if !is_fitted {
            return Err(no_exposure(name, photographs));
        }
        let mut results = Vec::new();
        for (index, rectified) in photographs.iter().enumerate() {
            let factors = [factor.or(own[index]), own[index]];
            results.push(self.result(index, rectified, material, factors, progress)?);
            progress.step()?;
        }
        let exposures: Vec<_> = results.iter().map(|one| one.own_exposure_ev).collect();
        let differences: Vec<_> = results.iter().map(PhotoMeasure::mean_log).collect();
        let outliers = PhotoOutlier::among(&exposures, &differences);
        results.iter_mut().zip(outliers).for_each(|(one, outlier)| one.outlier = outlier);
        Ok(PhotoResult {
            material: name.to_owned(),
            size: material.size(),
            factor,
            exposure_ev: factor.map(f64::log2),
            declared_ev: self.declared_ev(factor),
            means: PhotoMeans::all(&results),
            photographs: results,
        })
    }

    /// `material` against the photograph at `index`, at the first of the factors; the second fits it alone.
    fn result(
        &self,
        index: usize,
        rectified: &Rectified,
        material: &Material<f32>,
        [factor, own_factor]: [Option<f64>; 2],
        progress: &Progress,
    ) -> Result<PhotoMeasure, Error> {
        let CapturedPhotograph { name, scene, .. } = &self.capture.photographs[index];
        let rendering = rectified.rendering(material, scene, &self.convention, &progress.part())?;
        let compared = factor.map(|factor| rectified.at(factor, rendering, self.convention.epsilon));
        let [log, absolute, relative] = Self::DIFFERENCES.map(|kind| {
            let Statistics { mean, median, p95, .. } = compared.as_ref()?.statistics(kind)?;
            Some(PhotoStatistics { mean, median, p95 })
        });
        let metrics =
            compared.as_ref().map(|compared| of_pictures(&compared.photograph, &compared.rendering));
        let PictureMetrics { rmse, ssim } = metrics.unwrap_or(PictureMetrics { rmse: None, ssim: None });
        Ok(PhotoMeasure {
            photograph: name.clone(),
            scene: *scene,
            is_held_out: self.held_out[index],
            factor,
            exposure_ev: factor.map(f64::log2),
            own_exposure_ev: own_factor.map(f64::log2),
            log,
            absolute,
            relative,
            rmse,
            ssim,
            texels: rectified.image.pixels.len(),
            clipped: rectified.clipped(),
            outlier: PhotoOutlier::default(),
            compared: compared.filter(|_| self.capture.photographs.len() == 1),
        })
    }
}
