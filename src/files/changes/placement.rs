//! Placement of a prediction on its ground truth: by parts of a texel and in another scale, or mirrored and turned.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use svbrdf_core::choices;
use svbrdf_core::error::Error;
use svbrdf_core::material::{Material, Planes};

/// Texel p of the ground truth is at c + (p - c) * scale + by of the prediction, which has the same size and the centre c.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Placement {
    pub scale: f64,
    /// To the right and down, in texels.
    pub by: [f64; 2],
}

/// Texels with weights, whose sum is 1.
pub type Taps = [(usize, f32); 4];

impl Placement {
    /// Both are in one place.
    pub const NONE: Self = Self { scale: 1.0, by: [0.0; 2] };

    /// A displacement in the same scale.
    pub fn moved(by: [i32; 2]) -> Self {
        Self { by: by.map(f64::from), ..Self::NONE }
    }

    /// The ground truth on the prediction.
    #[must_use]
    pub fn inverse(self) -> Self {
        Self { scale: 1.0 / self.scale, by: self.by.map(|by| -by / self.scale) }
    }

    /// Where texel (x, y) of a ground truth of `size` (width, height) is on the prediction.
    pub fn at(self, texel: [f64; 2], size: [usize; 2]) -> [f64; 2] {
        let along = |axis: usize| {
            let centre = 0.5 * (size[axis] as f64 - 1.0);
            centre + (texel[axis] - centre) * self.scale + self.by[axis]
        };
        [along(0), along(1)]
    }

    /// The texels of the prediction around `texel` = row * width + column of the ground truth: bilinear, those at the edge repeated.
    pub fn taps(self, texel: usize, size: [usize; 2]) -> Taps {
        let at = self.at([(texel % size[0]) as f64, (texel / size[0]) as f64], size);
        let along = |axis: usize| {
            let last = size[axis] - 1;
            let at = if at[axis].is_finite() { at[axis].clamp(0.0, last as f64) } else { 0.0 };
            let low = at as usize;
            let part = (at - low as f64) as f32;
            [(low, 1.0 - part), ((low + 1).min(last), part)]
        };
        let [[left, right], [above, below]] = [along(0), along(1)];
        [(left, above), (right, above), (left, below), (right, below)]
            .map(|((x, of_x), (y, of_y))| (y * size[0] + x, of_x * of_y))
    }

    /// The prediction in the place of the ground truth.
    ///
    /// # Errors
    /// As [`interpolated`].
    pub fn applied(self, prediction: &Material<f32>) -> Result<Material<f32>, Error> {
        let size = prediction.size();
        let taps: Vec<_> =
            (0..size[0] * size[1]).into_par_iter().map(|texel| self.taps(texel, size)).collect();
        interpolated(prediction, &taps, size)
    }
}

/// The material of a size (width, height) whose texels are means of those of `material`.
///
/// # Errors
/// As [`Material::new`], as where normals cancel out.
pub fn interpolated(
    material: &Material<f32>,
    taps: &[Taps],
    [width, height]: [usize; 2],
) -> Result<Material<f32>, Error> {
    let sum =
        |plane: &[f32], taps: &Taps| taps.iter().map(|&(texel, weight)| weight * plane[texel]).sum::<f32>();
    let free = |plane: &Vec<f32>| taps.par_iter().map(|taps| sum(plane, taps)).collect::<Vec<_>>();
    let within = |plane: &Vec<f32>| taps.par_iter().map(|taps| sum(plane, taps).clamp(0.0, 1.0)).collect();
    let Planes { normal, diffuse, specular, roughness } = material.planes();
    let planes = Planes {
        normal: normal.each_ref().map(free),
        diffuse: diffuse.each_ref().map(within),
        specular: specular.each_ref().map(within),
        roughness: within(roughness),
    };
    Material::new(material.name(), width, height, planes)
}

choices! {
    /// A symmetry of a square other than the identity: maps mirrored and turned, their normals with them. Only those that transpose need a
    /// square map.
    Symmetry, "symmetry":
    /// Left to right.
    MirrorX = "mirror_x",
    /// Top to bottom.
    MirrorY = "mirror_y",
    Rotate180 = "rotate_180",
    /// Rows become columns.
    Transpose = "transpose",
    Rotate90Clockwise = "rotate_90_clockwise",
    Rotate90Counterclockwise = "rotate_90_counterclockwise",
    /// About the other diagonal.
    AntiTranspose = "anti_transpose",
}

impl Symmetry {
    /// Whether rows become columns, and whether columns and rows are mirrored after that.
    fn parts(self) -> [bool; 3] {
        match self {
            Self::MirrorX => [false, true, false],
            Self::MirrorY => [false, false, true],
            Self::Rotate180 => [false, true, true],
            Self::Transpose => [true, false, false],
            Self::Rotate90Clockwise => [true, true, false],
            Self::Rotate90Counterclockwise => [true, false, true],
            Self::AntiTranspose => [true, true, true],
        }
    }

    /// What it does, for titles.
    pub fn words(self) -> &'static str {
        match self {
            Self::MirrorX => "mirrored left to right",
            Self::MirrorY => "mirrored top to bottom",
            Self::Rotate180 => "rotated by 180 degrees",
            Self::Transpose => "transposed",
            Self::Rotate90Clockwise => "rotated by 90 degrees clockwise",
            Self::Rotate90Counterclockwise => "rotated by 90 degrees counterclockwise",
            Self::AntiTranspose => "transposed about the other diagonal",
        }
    }

    /// The symmetries of maps of a size (width, height).
    pub fn of([width, height]: [usize; 2]) -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(move |symmetry| !symmetry.parts()[0] || width == height)
    }

    /// The symmetry that undoes this one.
    #[must_use]
    pub fn inverse(self) -> Self {
        match self {
            Self::Rotate90Clockwise => Self::Rotate90Counterclockwise,
            Self::Rotate90Counterclockwise => Self::Rotate90Clockwise,
            other => other,
        }
    }

    /// The material moved by this symmetry; one that transposes is for square maps.
    ///
    /// # Errors
    /// Those of [`Material::new`], which values of a material do not give.
    pub fn applied(self, material: &Material<f32>) -> Result<Material<f32>, Error> {
        let [width, height] = material.size();
        let texels: Vec<usize> =
            (0..width * height).map(|texel| self.before(texel, [width, height])).collect();
        self.turned(&material.gathered(&texels, [width, height]))
    }

    /// Where the texel was that is at `texel` of a map of this size (width, height) after the symmetry, as row * width + column.
    pub fn before(self, texel: usize, [width, height]: [usize; 2]) -> usize {
        let ([transposed, mirrored_x, mirrored_y], column, row) =
            (self.parts(), texel % width, texel / width);
        let column = if mirrored_x { width - 1 - column } else { column };
        let row = if mirrored_y { height - 1 - row } else { row };
        if transposed { column * width + row } else { row * width + column }
    }

    /// The material with its normals turned as the symmetry turns them; its texels stay where they are.
    ///
    /// # Errors
    /// As [`Self::applied`].
    pub fn turned(self, material: &Material<f32>) -> Result<Material<f32>, Error> {
        let ([transposed, mirrored_x, mirrored_y], mut planes) = (self.parts(), material.planes().clone());
        let [x, y, _] = &mut planes.normal;
        // Transposed rows and columns exchange x with -y, which points up.
        if transposed {
            std::mem::swap(x, y);
        }
        let negated = [transposed != mirrored_x, transposed != mirrored_y];
        for (plane, negated) in [x, y].into_iter().zip(negated) {
            if negated {
                plane.iter_mut().for_each(|value| *value = -*value);
            }
        }
        Material::new(material.name(), material.width(), material.height(), planes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_undoes_each_symmetry_and_slopes_stay_those_of_the_heights() {
        let height = |x: f32, y: f32| 0.3 * x + 0.11 * y * y + 0.07 * x * y;
        let slope = |x: f32, y: f32| [0.3 + 0.07 * y, 0.22 * y + 0.07 * x];
        let at = |index: usize| [(index % 5) as f32 - 2.0, 2.0 - (index / 5) as f32];
        let normals = (0..25).map(|i| slope(at(i)[0], at(i)[1])).collect::<Vec<_>>();
        let heights = (0..25).map(|i| height(at(i)[0], at(i)[1]) * 0.2 + 0.5).collect::<Vec<_>>();
        let planes = Planes {
            normal: [
                normals.iter().map(|s| -s[0]).collect(),
                normals.iter().map(|s| -s[1]).collect(),
                vec![1.0; 25],
            ],
            diffuse: [heights.clone(), heights.clone(), heights.clone()],
            specular: [heights.clone(), heights.clone(), heights.clone()],
            roughness: heights,
        };
        let material = Material::new("saddle", 5, 5, planes).unwrap();
        for symmetry in Symmetry::ALL {
            let moved = symmetry.applied(&material).unwrap();
            assert_eq!(symmetry.inverse().applied(&moved).unwrap(), material, "{}", symmetry.name());
            // Central differences of the height that moved with the maps: twice the slope in x.
            let r = &moved.planes().roughness;
            let [x, _, z] = moved.planes().normal.each_ref().map(|plane| plane[12]);
            assert!(((r[13] - r[11]) / 0.4 + x / z).abs() < 1e-5, "{}", symmetry.name());
        }
        let clockwise = Symmetry::ALL[4].applied(&material).unwrap();
        assert_eq!(
            clockwise.planes().roughness[4],
            material.planes().roughness[0],
            "{}",
            Symmetry::ALL[4].name()
        );
    }
}
