//! Fields: inputs of a principled surface, multiplied texel by texel into diffuse and specular where its dielectric is not
//! the default one.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use svbrdf_core::material::resize::{self, Filter};

use super::material::StoredMap;
use crate::read::options::Albedo;
use crate::read::options::transfer::ColourSpace;
use crate::read::options::transfer::linear;
use crate::read::raster::{Raster, Samples};

/// Colours that lie out_of_range Rec. 709 by less do so by rounding.
const ROUNDING: f64 = 1e-4;

/// An input of a surface, linear: one value, or one for each texel. Of one channel or three.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    size: [usize; 2],
    planes: Vec<Vec<f32>>,
}

impl Field {
    pub(crate) fn constant(values: &[f32]) -> Self {
        Self { size: [1, 1], planes: values.iter().map(|&v| vec![v]).collect() }
    }

    /// The channels of a map, as colours stored as `space`.
    pub(crate) fn of(source: &StoredMap, space: Albedo) -> Self {
        let value = |v: f64| linear(if v.is_finite() { v.clamp(0.0, 1.0) } else { 0.0 }, space);
        let planes = source.raster.channels.iter().map(|plane| plane.decoded(value)).collect();
        Self { size: source.raster.size(), planes }
    }

    /// The colours of a map, stored in `space`, and whether some lie out_of_range those of Rec. 709.
    pub(crate) fn converted(source: &StoredMap, space: ColourSpace) -> (Self, bool) {
        let (raster, out_of_range) = (&source.raster, AtomicBool::new(false));
        let texel = |index: usize| {
            let linear = space.to_linear(raster.rgb(index).map(|v| if v.is_finite() { v } else { 0.0 }));
            if linear.iter().any(|value| !(-ROUNDING..=1.0 + ROUNDING).contains(value)) {
                out_of_range.store(true, Ordering::Relaxed);
            }
            linear.map(|value| value.clamp(0.0, 1.0) as f32)
        };
        let texels: Vec<[f32; 3]> = (0..raster.width * raster.height).into_par_iter().map(texel).collect();
        let planes = [0, 1, 2].map(|c| texels.iter().map(|texel| texel[c]).collect()).into();
        let field = Self { size: raster.size(), planes };
        (field, out_of_range.into_inner())
    }

    /// Each channel times its `scale` plus its `offset`, in [0, 1].
    #[must_use]
    pub(crate) fn affine(self, scale: [f32; 3], offset: [f32; 3]) -> Self {
        let is_gray = [scale, offset].iter().all(|of| of[0] == of[1] && of[1] == of[2]);
        let count = if is_gray { self.planes.len() } else { 3 };
        let plane = |c: usize| {
            let values = self.plane(c).par_iter();
            values.map(|value| (value * scale[c.min(2)] + offset[c.min(2)]).clamp(0.0, 1.0)).collect()
        };
        Self { planes: (0..count).map(plane).collect(), size: self.size }
    }

    /// 1 less each number.
    #[must_use]
    pub(crate) fn complement(self) -> Self {
        self.affine([-1.0; 3], [1.0; 3])
    }

    /// Times `other`, texel by texel.
    #[must_use]
    pub(crate) fn times(self, other: Self) -> Self {
        let mut both = [self, other];
        let size = common_size(&mut both);
        let [a, b] = &both;
        let count = a.planes.len().max(b.planes.len());
        let plane = |c: usize| {
            let (x, y) = (a.plane(c), b.plane(c));
            (0..size[0] * size[1])
                .into_par_iter()
                .map(|i| x[i.min(x.len() - 1)] * y[i.min(y.len() - 1)])
                .collect()
        };
        let planes = (0..count).map(plane).collect();
        Self { size, planes }
    }

    /// With every number at most 1.
    #[must_use]
    pub(crate) fn at_most_one(mut self) -> Self {
        self.planes.iter_mut().flatten().for_each(|value| *value = value.min(1.0));
        self
    }

    pub(crate) fn is(&self, value: f32) -> bool {
        self.size == [1, 1] && self.planes.iter().all(|plane| (plane[0] - value).abs() < 1e-6)
    }

    fn plane(&self, channel: usize) -> &[f32] {
        &self.planes[channel.min(self.planes.len() - 1)]
    }

    /// As a map, which `part` of the file `path` defines.
    pub(crate) fn into_map(self, path: &Path, part: &str) -> StoredMap {
        let [width, height] = self.size;
        let channels = self.planes.into_iter().map(Samples::floats).collect();
        let raster = Raster { width, height, depth: "float", channels, alpha: None, to_rec709: None };
        StoredMap { raster, file: path.to_owned(), part: part.to_owned() }
    }
}

/// Brings all that are larger than a texel to the size of the largest, which it returns; coordinates relate maps of
/// different shapes.
fn common_size(fields: &mut [Field]) -> [usize; 2] {
    let size = fields.iter().map(|field| field.size).max_by_key(|size| size[0] * size[1]).unwrap_or([1, 1]);
    for field in fields.iter_mut().filter(|field| field.size != [1, 1] && field.size != size) {
        let resized = |plane| resize::plane(plane, field.size, size, Filter::Value);
        field.planes = std::mem::take(&mut field.planes).into_iter().map(resized).collect();
        field.size = size;
    }
    size
}

/// Reflectance at normal incidence of a dielectric of the refractive index `ior`; 1 for an index of 0, as glTF has it.
pub(crate) fn reflectance(ior: f32) -> f32 {
    ((ior - 1.0) / (ior + 1.0)).powi(2)
}

/// Diffuse b (1 - m) and specular f (1 - m) + b m of the base colour b, the metallic m and the reflectance f of the
/// dielectric, each at most 1.
pub(crate) fn separated(base: Field, metallic: Field, dielectric: Field) -> [Field; 2] {
    let mut all = [base, metallic, dielectric];
    let size = common_size(&mut all);
    let [base, metallic, dielectric] = &all;
    let of = |value: &(dyn Fn(f32, f32, f32) -> f32 + Sync)| {
        let plane = |c: usize| {
            let (b, m, f) = (base.plane(c), metallic.plane(0), dielectric.plane(c));
            let at = |plane: &[f32], i: usize| plane[i.min(plane.len() - 1)];
            let texels = (0..size[0] * size[1]).into_par_iter();
            texels.map(|i| value(at(b, i), at(m, i), at(f, i).min(1.0)).clamp(0.0, 1.0)).collect()
        };
        Field { size, planes: (0..3).map(plane).collect() }
    };
    [of(&|b, m, _| b * (1.0 - m)), of(&|b, m, f| f * (1.0 - m) + b * m)]
}
