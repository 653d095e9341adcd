//! Materials against all photographs of a capture.

use std::str::FromStr;

use schemars::JsonSchema;
use serde::Serialize;

use crate::metrics::{PictureMetrics, of_pictures};
use svbrdf_core::error::Error;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::progress::Progress;

use super::measured::CaptureGroup;
use super::outliers::Outlier;
use super::{Capture, CapturedPhotograph, CapturedResult, MaterialResult};
use crate::photograph::{Corners, Ratios, Rectified};
use svbrdf_files::disk::memory;
use svbrdf_files::read::{Note, Transfer};

/// Bytes of a texel on the photographs, and of its ratios.
const BYTES: usize = 12 + 24;

/// What one factor brings to the exposure of the renderings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CaptureExposure {
    /// All photographs of a capture.
    #[default]
    Capture,
    /// Each photograph.
    Photograph,
}

/// A capture, and how materials are compared with it.
#[derive(Clone, Debug)]
pub struct CaptureSetting {
    /// What the report calls the capture: its path.
    pub name: String,
    pub capture: Capture,
    pub exposure: CaptureExposure,
    pub convention: Convention,
    /// Of each photograph, whether the exposure is not fitted to it.
    held_out: Vec<bool>,
}

/// How a photograph of a capture was read.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(rename = "CapturePhotograph")]
pub struct ReadCaptured {
    /// The name of its file in the capture.
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

/// Materials against the photographs of a capture. Its JSON is a scene file, too.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct CaptureReport {
    /// The path of the capture.
    capture: String,
    /// The file that lists the photographs.
    file: String,
    /// In the order of the capture.
    pub photographs: Vec<ReadCaptured>,
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
    pub results: Vec<MaterialResult>,
    /// Of the photographs.
    scenes: Vec<Scene>,
    /// What reading the photographs noticed.
    notes: Vec<String>,
    #[serde(skip)]
    pub setting: CaptureSetting,
}

impl CaptureExposure {
    pub const ALL: [Self; 2] = [Self::Capture, Self::Photograph];

    /// The name on the command line and in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Capture => "capture",
            Self::Photograph => "photograph",
        }
    }
}

impl FromStr for CaptureExposure {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let found = Self::ALL.into_iter().find(|exposure| exposure.name() == text);
        found.ok_or_else(|| Error::UnknownName {
            what: "exposure",
            found: text.to_owned(),
            known: Self::ALL.map(Self::name).join(", "),
        })
    }
}

impl CaptureSetting {
    /// The setting without the photographs of the names `hold_out`, to which the exposure is not fitted. A name may lack its
    /// extension.
    ///
    /// # Errors
    /// [`Error::UnknownName`] for a name that no photograph has; [`Error::BadCapture`] where none is left.
    pub fn new(
        name: String,
        capture: Capture,
        exposure: CaptureExposure,
        hold_out: &[String],
        convention: Convention,
    ) -> Result<Self, Error> {
        let mut held_out = vec![false; capture.photographs.len()];
        for name in hold_out {
            let index = capture.photographs.iter().position(|one| one.is_called(name));
            let index = index.ok_or_else(|| Error::UnknownName {
                what: "photograph",
                found: name.clone(),
                known: capture.names(|_| true),
            })?;
            held_out[index] = true;
        }
        if held_out.iter().all(|held_out| *held_out) {
            let problem = "every photograph is held out, and none is left to fit the exposure to".to_owned();
            return Err(Error::BadCapture { path: capture.file, problem });
        }
        Ok(Self { name, capture, exposure, convention, held_out })
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
    fn notes(&self, photographs: &[ReadCaptured]) -> Vec<String> {
        let by = self.capture.file.display();
        let outside = self.capture.outside();
        let outside = outside
            .map(|file| format!("{} lies outside of the folder of {by}, which names it", file.display()));
        let of = |read: &ReadCaptured| {
            let name = read.name.clone();
            read.notes.clone().into_iter().map(move |note| format!("{name}: {note}"))
        };
        outside.chain(photographs.iter().flat_map(of)).collect()
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
    fn read(
        &self,
        sizes: &[[usize; 2]],
        progress: &Progress,
    ) -> Result<(Vec<ReadCaptured>, Vec<Vec<Rectified>>), Error> {
        let (mut photographs, mut rectified) = (Vec::new(), vec![Vec::new(); sizes.len()]);
        for one in &self.capture.photographs {
            let (photograph, corners) = one.read()?;
            for (size, rectified) in sizes.iter().zip(&mut rectified) {
                let found = Rectified::new(&photograph, &corners, *size, &progress.part())?;
                rectified.push(self.without_falloff(found, one));
            }
            photographs.push(ReadCaptured {
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
    fn measure(
        &self,
        name: &str,
        material: &Material<f32>,
        photographs: &[Rectified],
        progress: &Progress,
    ) -> Result<MaterialResult, Error> {
        let (factor, own) = self.factors(material, photographs, progress)?;
        let is_fitted = match self.exposure {
            CaptureExposure::Capture => factor.is_some(),
            CaptureExposure::Photograph => own.iter().any(Option::is_some),
        };
        if !is_fitted {
            let problem = "in no photograph is a part of the material lit and not clipped".to_owned();
            return Err(Error::NoExposure { name: name.to_owned(), problem });
        }
        let mut results = Vec::new();
        for (index, rectified) in photographs.iter().enumerate() {
            let factors = [factor.or(own[index]), own[index]];
            results.push(self.result(index, rectified, material, factors, progress)?);
            progress.step()?;
        }
        let exposures: Vec<_> = results.iter().map(|one| one.own_exposure_ev).collect();
        let differences: Vec<_> = results.iter().map(|one| one.log).collect();
        let outliers = Outlier::among(&exposures, &differences);
        results.iter_mut().zip(outliers).for_each(|(one, outlier)| one.outlier = outlier);
        Ok(MaterialResult {
            material: name.to_owned(),
            size: material.size(),
            factor,
            exposure_ev: factor.map(f64::log2),
            declared_ev: self.declared_ev(factor),
            means: CaptureGroup::all(&results),
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
    ) -> Result<CapturedResult, Error> {
        let CapturedPhotograph { name, scene, .. } = &self.capture.photographs[index];
        let rendering = rectified.rendering(material, scene, &self.convention, &progress.part())?;
        let compared = factor.map(|factor| rectified.at(factor, rendering, self.convention.epsilon));
        let statistics = compared.as_ref().and_then(|compared| compared.statistics(Difference::Log));
        let metrics = compared.map(|compared| of_pictures(&compared.photograph, &compared.rendering));
        let PictureMetrics { rmse, ssim } = metrics.unwrap_or(PictureMetrics { rmse: None, ssim: None });
        Ok(CapturedResult {
            photograph: name.clone(),
            scene: *scene,
            is_held_out: self.held_out[index],
            factor,
            exposure_ev: factor.map(f64::log2),
            own_exposure_ev: own_factor.map(f64::log2),
            log: statistics.map(|statistics| statistics.mean),
            rmse,
            ssim,
            texels: rectified.image.pixels.len(),
            clipped: rectified.clipped(),
            outlier: Outlier::default(),
        })
    }
}

impl CaptureReport {
    /// Reads the photographs and compares each of `materials`, which have the names of the report beside them, with all of them.
    ///
    /// A photograph that is read, and a material on a photograph, are a step of `progress`.
    ///
    /// # Errors
    /// As [`CapturedPhotograph::read`], and [`Error::UnusableScene`], [`Error::NoExposure`], [`Error::Memory`], [`Error::Cancelled`].
    pub fn new<'a>(
        setting: CaptureSetting,
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
        Ok(Self {
            capture: setting.name.clone(),
            file: setting.capture.file.display().to_string(),
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
}
