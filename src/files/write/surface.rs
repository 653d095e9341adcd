//! Surfaces of glTF and MaterialX: how they express diffuse and specular, and how much of these they lose.

use std::fmt;

use exr::prelude::f16;
use rayon::prelude::*;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::material::{DIELECTRIC, Depth, Material, Planes, base_and_metallic};
use svbrdf_core::progress::Progress;

use super::curve::Curve;
use super::maps::{SpecularScale, Weight};
use crate::error::Error;
use crate::read::Albedo;
use crate::read::options::transfer::{encoded, linear};

/// The refractive index of the reflectance [`DIELECTRIC`].
pub(super) const USUAL_IOR: f64 = 1.5;
/// The largest reflectance that a refractive index is computed for: that of 2,000. Larger ones need indices without end.
const MOST_REFLECTANCE: f64 = 0.998;
/// Texels whose changes are summed in one piece.
const CHUNK: usize = 1 << 14;

/// How a written file expresses diffuse and specular, and what that changes. Its text is a sentence for users.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    pub form: SurfaceForm,
    pub target: SurfaceTarget,
    /// The changes of the form that was chosen, as it is written.
    pub changes: SurfaceChanges,
    /// What base colour and metallic would change, where they were not chosen.
    pub rejected: Option<SurfaceChanges>,
}

/// The form of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SurfaceForm {
    /// Base colour b and metallic m: d = b (1 - m), s = 0.04 (1 - m) + b m.
    Metallic,
    /// Diffuse as base colour, and specular as a part of the reflectance at this refractive index.
    Specular { ior: f64 },
}

/// What a surface is written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceTarget {
    /// A folder of pictures for glTF, which has base colour and metallic only.
    Folder,
    Gltf,
    OpenPbr,
}

/// What a form changes of a material.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceChanges {
    pub diffuse: WrittenChange,
    pub specular: WrittenChange,
    /// The largest change of diffuse and specular encoded in sRGB, in steps of 8 bits.
    pub steps: f64,
}

/// Absolute differences of linear values over all texels and channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WrittenChange {
    pub mean: f64,
    pub largest: f64,
}

impl Surface {
    /// Base colour and metallic for a folder.
    pub(super) fn metallic(material: &Material<f32>, depth: Depth, progress: &Progress) -> Self {
        let changes = SurfaceChanges::of_metallic(material, depth, progress);
        Self { form: SurfaceForm::Metallic, target: SurfaceTarget::Folder, changes, rejected: None }
    }

    /// Base colour and metallic where they change nothing by more than a step of 8 bits, since every program reads them;
    /// else the form whose mean change is less.
    ///
    /// # Errors
    /// [`Cancelled`](Error::is_cancelled).
    pub(super) fn choose(
        material: &Material<f32>,
        target: SurfaceTarget,
        depth: Depth,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let metallic = SurfaceChanges::of_metallic(material, depth, progress);
        let chosen = |form, changes, rejected| Self { form, target, changes, rejected };
        let plain = chosen(SurfaceForm::Metallic, metallic, None);
        if metallic.steps <= 1.0 && !progress.is_cancelled() {
            return Ok(plain);
        }
        let form = SurfaceForm::Specular { ior: ior(material) };
        let other = chosen(form, SurfaceChanges::default(), Some(metallic));
        let changes = SurfaceChanges::of_specular(material, other.scale(depth), depth, progress);
        let specular = Self { changes, ..other };
        match progress.is_cancelled() {
            true => Err(CoreError::Cancelled.into()),
            false if changes.mean() < metallic.mean() => Ok(specular),
            false => Ok(plain),
        }
    }

    /// How specular is divided into a reflectance, a weight and a tint.
    pub(super) fn scale(&self, depth: Depth) -> SpecularScale {
        let ior = match self.form {
            SurfaceForm::Metallic => USUAL_IOR,
            SurfaceForm::Specular { ior } => ior,
        };
        let weight = match (self.target, depth) {
            // KHR_materials_specular scales the reflectance by the tint and leaves that at grazing angles 1, as here.
            (SurfaceTarget::Folder | SurfaceTarget::Gltf, _) => Weight::One,
            // OpenPBR tints the reflectance of all angles, and scales by the weight what is left to diffuse.
            (SurfaceTarget::OpenPbr, Depth::Eight) => Weight::Levels(255),
            (SurfaceTarget::OpenPbr, Depth::Sixteen) => Weight::Levels(u16::MAX),
            (SurfaceTarget::OpenPbr, Depth::Half | Depth::Float) => Weight::Exact,
        };
        SpecularScale { reflectance: reflectance(ior), weight }
    }
}

/// The reflectance at normal incidence of a dielectric.
fn reflectance(ior: f64) -> f64 {
    ((ior - 1.0) / (ior + 1.0)).powi(2)
}

/// The refractive index, in four decimals, whose reflectance is the largest specular of the material, at least the usual one.
fn ior(material: &Material<f32>) -> f64 {
    let largest = material.planes().specular.iter().flatten().fold(0.0, |most: f32, s| most.max(*s));
    let root = f64::from(largest).clamp(DIELECTRIC, MOST_REFLECTANCE).sqrt();
    let exact = (1.0 + root) / (1.0 - root);
    // As stored: 1.2 / 0.8 is not 1.5 to the last bit.
    (exact * 1e4 - 1e-6).ceil() / 1e4
}

impl SurfaceChanges {
    fn of_metallic(material: &Material<f32>, depth: Depth, progress: &Progress) -> Self {
        let rounding = Rounding::new(depth);
        Self::of(material, progress, |d, s| {
            let (base, metallic) = base_and_metallic(d, s);
            let (base, m) = (base.map(|b| rounding.colour(b)), rounding.number(metallic));
            [base.map(|b| b * (1.0 - m)), base.map(|b| DIELECTRIC * (1.0 - m) + b * m)]
        })
    }

    fn of_specular(
        material: &Material<f32>,
        scale: SpecularScale,
        depth: Depth,
        progress: &Progress,
    ) -> Self {
        let rounding = Rounding::new(depth);
        Self::of(material, progress, |d, s| {
            let all = scale.reflectance * rounding.number(scale.weight(s));
            [d.map(|d| rounding.colour(d)), scale.tint(s).map(|tint| all * rounding.colour(tint))]
        })
    }

    /// The changes where a texel's diffuse and specular become what `held` returns for them.
    fn of(
        material: &Material<f32>,
        progress: &Progress,
        held: impl Fn([f64; 3], [f64; 3]) -> [[f64; 3]; 2] + Sync,
    ) -> Self {
        let Planes { diffuse, specular, .. } = material.planes();
        let count = material.width() * material.height();
        let chunk = |number: usize| {
            let mut sums = Self::default();
            let texels = number * CHUNK..count.min((number + 1) * CHUNK);
            for index in texels.filter(|_| !progress.is_cancelled()) {
                let [d, s] = [diffuse, specular].map(|map| map.each_ref().map(|plane| plane[index].into()));
                sums.add(d, s, held(d, s));
            }
            sums
        };
        // In the order of the chunks: the number of threads does not change a sum.
        let chunks: Vec<Self> = (0..count.div_ceil(CHUNK)).into_par_iter().map(chunk).collect();
        let Self { diffuse, specular, steps } = chunks.into_iter().fold(Self::default(), Self::joined);
        let per_value =
            |change: WrittenChange| WrittenChange { mean: change.mean / (3 * count) as f64, ..change };
        Self { diffuse: per_value(diffuse), specular: per_value(specular), steps }
    }

    /// Adds the changes of a texel to these sums.
    fn add(&mut self, d: [f64; 3], s: [f64; 3], held: [[f64; 3]; 2]) {
        let code = |value: f64| encoded(value.clamp(0.0, 1.0), Albedo::Srgb);
        for (change, true_values, values) in
            [(&mut self.diffuse, d, held[0]), (&mut self.specular, s, held[1])]
        {
            for (value, true_value) in values.into_iter().zip(true_values) {
                let difference = (value - true_value).abs();
                change.mean += difference;
                change.largest = change.largest.max(difference);
                self.steps = self.steps.max(255.0 * (code(value) - code(true_value)).abs());
            }
        }
    }

    fn joined(self, other: Self) -> Self {
        let both = |a: WrittenChange, b: WrittenChange| WrittenChange {
            mean: a.mean + b.mean,
            largest: a.largest.max(b.largest),
        };
        Self {
            diffuse: both(self.diffuse, other.diffuse),
            specular: both(self.specular, other.specular),
            steps: self.steps.max(other.steps),
        }
    }

    fn mean(&self) -> f64 {
        self.diffuse.mean + self.specular.mean
    }
}

/// Values as they are read again from pictures of a depth.
struct Rounding {
    depth: Depth,
    /// The codes of colours in sRGB, and their linear values.
    codes: Option<(Curve, Vec<f64>)>,
}

impl Rounding {
    fn new(depth: Depth) -> Self {
        let levels = match depth {
            Depth::Eight => Some(255),
            Depth::Sixteen => Some(u16::MAX),
            Depth::Half | Depth::Float => None,
        };
        let codes = levels.map(|top| {
            let decoded = |value| linear(value, Albedo::Srgb);
            let curve = Curve::rising(top, |value| encoded(value, Albedo::Srgb), decoded);
            (curve, (0..=top).map(|code| decoded(f64::from(code) / f64::from(top))).collect())
        });
        Self { depth, codes }
    }

    fn colour(&self, value: f64) -> f64 {
        match &self.codes {
            Some((curve, values)) => values[usize::from(curve.code(value))],
            None => self.number(value),
        }
    }

    fn number(&self, value: f64) -> f64 {
        match self.depth {
            Depth::Eight => (255.0 * value).round() / 255.0,
            Depth::Sixteen => (65_535.0 * value).round() / 65_535.0,
            Depth::Half => f16::from_f64(value).to_f64(),
            Depth::Float => f64::from(value as f32),
        }
    }
}

impl fmt::Display for WrittenChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.4} (mean {:.4})", self.largest, self.mean)
    }
}

impl fmt::Display for SurfaceChanges {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "diffuse by at most {}, specular by at most {}", self.diffuse, self.specular)
    }
}

impl fmt::Display for Surface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let form = match (self.form, self.target) {
            (SurfaceForm::Metallic, _) => "base colour and metallic",
            (SurfaceForm::Specular { .. }, SurfaceTarget::OpenPbr) => {
                "base colour (diffuse) and specular weight, colour and index of refraction"
            }
            (SurfaceForm::Specular { .. }, _) => "base colour (diffuse) and KHR_materials_specular",
        };
        write!(f, "written as {form}, which change {}", self.changes)?;
        if let Some(rejected) = self.rejected {
            write!(f, "; base colour and metallic would change {rejected}")?;
        }
        if self.target == SurfaceTarget::Gltf && self.form != SurfaceForm::Metallic {
            f.write_str("; programs without this extension show specular 0.04")?;
        }
        Ok(())
    }
}
