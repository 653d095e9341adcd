//! Placement of a prediction on its ground truth: by parts of a texel and in another scale, or mirrored and turned.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

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

/// A symmetry of a square other than the identity: maps mirrored and turned, their normals with them. Only those that transpose need a square map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Symmetry {
    /// Rows become columns; before the mirrorings.
    transposed: bool,
    mirrored_x: bool,
    mirrored_y: bool,
}

impl Symmetry {
    /// All seven.
    pub const ALL: [Self; 7] = [
        Self::new(false, true, false),
        Self::new(false, false, true),
        Self::new(false, true, true),
        Self::new(true, false, false),
        Self::new(true, true, false),
        Self::new(true, false, true),
        Self::new(true, true, true),
    ];

    const fn new(transposed: bool, mirrored_x: bool, mirrored_y: bool) -> Self {
        Self { transposed, mirrored_x, mirrored_y }
    }

    /// The change that it makes, for reports.
    pub fn name(self) -> &'static str {
        match (self.transposed, self.mirrored_x, self.mirrored_y) {
            (false, true, false) => "mirror_x",
            (false, false, true) => "mirror_y",
            (false, true, true) => "rotate_180",
            (true, false, false) => "transpose",
            (true, true, false) => "rotate_90_clockwise",
            (true, false, true) => "rotate_90_counterclockwise",
            (true, true, true) => "anti_transpose",
            (false, false, false) => "none",
        }
    }

    /// What it does, for titles.
    pub fn words(self) -> &'static str {
        match (self.transposed, self.mirrored_x, self.mirrored_y) {
            (false, true, false) => "mirrored left to right",
            (false, false, true) => "mirrored top to bottom",
            (false, true, true) => "rotated by 180 degrees",
            (true, false, false) => "transposed",
            (true, true, false) => "rotated by 90 degrees clockwise",
            (true, false, true) => "rotated by 90 degrees counterclockwise",
            (true, true, true) => "transposed about the other diagonal",
            (false, false, false) => "unchanged",
        }
    }

    /// The symmetries of maps of a size (width, height).
    pub fn of([width, height]: [usize; 2]) -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(move |symmetry| !symmetry.transposed || width == height)
    }

    /// The symmetry that undoes this one.
    #[must_use]
    pub fn inverse(self) -> Self {
        if self.transposed {
            Self { mirrored_x: self.mirrored_y, mirrored_y: self.mirrored_x, ..self }
        } else {
            self
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
        let (column, row) = (texel % width, texel / width);
        let column = if self.mirrored_x { width - 1 - column } else { column };
        let row = if self.mirrored_y { height - 1 - row } else { row };
        if self.transposed { column * width + row } else { row * width + column }
    }

    /// The material with its normals turned as the symmetry turns them; its texels stay where they are.
    ///
    /// # Errors
    /// As [`Self::applied`].
    pub fn turned(self, material: &Material<f32>) -> Result<Material<f32>, Error> {
        let mut planes = material.planes().clone();
        let [x, y, _] = &mut planes.normal;
        // Transposed rows and columns exchange x with -y, which points up.
        if self.transposed {
            std::mem::swap(x, y);
        }
        let negated = [self.transposed != self.mirrored_x, self.transposed != self.mirrored_y];
        for (plane, negated) in [x, y].into_iter().zip(negated) {
            if negated {
                plane.iter_mut().for_each(|value| *value = -*value);
            }
        }
        Material::new(material.name(), material.width(), material.height(), planes)
    }
}

impl From<Symmetry> for String {
    fn from(symmetry: Symmetry) -> Self {
        symmetry.name().to_owned()
    }
}

impl TryFrom<String> for Symmetry {
    type Error = Error;

    fn try_from(name: String) -> Result<Self, Error> {
        let known = || Self::ALL.map(Self::name).join(", ");
        let found = Self::ALL.into_iter().find(|symmetry| symmetry.name() == name);
        found.ok_or_else(|| Error::unknown_name("symmetry", name, known()))
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
