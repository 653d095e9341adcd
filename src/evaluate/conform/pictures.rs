//! A small picture: where its texels lie, and which way its rows run.

use glam::DVec3;

use svbrdf_core::model::grammar::words::{Rows, Sites};
use svbrdf_core::model::grammar::{GridTerms, Point};
use svbrdf_files::arrays::{Array, Arrays};

use super::columns::rows;
use super::fit::{CLEARLY, Fit, Problem};
use super::observed::{Bound, Observed, Storage};

/// Texels along a side. Centres and corners differ the less the more there are.
const SIDE: usize = 8;
/// The light and the camera, in units of half the width of the material.
const LIGHT: [f64; 3] = [0.35, -0.6, 0.55];
const VIEW: [f64; 3] = [-0.5, 0.25, 1.4];

/// A rendered picture, of maps that do not vary: only the positions of the texels matter.
#[derive(Clone, Debug)]
pub struct Picture {
    side: usize,
    light: DVec3,
    view: DVec3,
    texels: Vec<Point>,
    radiance: Vec<[f64; 3]>,
}

/// The arrays of a picture to be rendered.
pub fn probes() -> Arrays {
    let square = |name: &str, values: &[f64]| {
        let channels = values.len();
        let shape = if channels == 1 { vec![SIDE, SIDE] } else { vec![SIDE, SIDE, channels] };
        (format!("picture_{name}"), Array::new(&shape, values.repeat(SIDE * SIDE)))
    };
    let place = |name: &str, values: [f64; 3]| (format!("picture_{name}"), Array::new(&[3], values.to_vec()));
    [
        square("normal", &[0.0, 0.0, 1.0]),
        square("diffuse", &[0.4, 0.3, 0.2]),
        square("specular", &[0.2, 0.3, 0.4]),
        square("roughness", &[0.5]),
        square("base_color", &[0.4, 0.3, 0.2]),
        square("metallic", &[0.4]),
        place("light", LIGHT),
        place("view", VIEW),
    ]
    .into()
}

impl Picture {
    /// The picture in an answer; `None` where it was not rendered.
    pub fn new(arrays: &Arrays) -> Result<Option<Self>, String> {
        let Some(rendered) = arrays.get("picture_radiance") else { return Ok(None) };
        let side = rendered.shape.first().copied().unwrap_or(0);
        let count = side * side;
        let radiance = rows(arrays, "picture_radiance", count)?;
        let three = |name: &str| rows(arrays, &format!("picture_{name}"), count);
        let one = |name: &str| {
            let values = arrays.get(&format!("picture_{name}")).map(|array| &array.values);
            values
                .filter(|values| values.len() == count)
                .ok_or(format!("expected the array `picture_{name}`"))
        };
        let place =
            |name: &str| Ok::<_, String>(DVec3::from(rows(arrays, &format!("picture_{name}"), 1)?[0]));
        let (normal, diffuse, specular, base_color) =
            (three("normal")?, three("diffuse")?, three("specular")?, three("base_color")?);
        let (roughness, metallic) = (one("roughness")?, one("metallic")?);
        let texel = |i: usize| Point {
            normal: normal[i],
            diffuse: diffuse[i],
            specular: specular[i],
            roughness: roughness[i],
            base_color: base_color[i],
            metallic: metallic[i],
            light: [0.0; 3],
            view: [0.0; 3],
        };
        let texels = (0..count).map(texel).collect();
        Ok(Some(Self { side, light: place("light")?, view: place("view")?, texels, radiance }))
    }

    /// The grid that the renderer `fit` drew it on; `None` where several fit as well, or none does.
    pub fn grid(&self, problem: &Problem, fit: &Fit) -> Option<GridTerms> {
        let storage = Storage::of(self.radiance.as_flattened());
        let observed = Observed::new(&self.radiance, storage, problem.observed.transfer);
        let mut tried = Vec::new();
        for sampling in Sites::ALL {
            for orientation in Rows::ALL {
                let grid = GridTerms { sampling, orientation, ..fit.terms.grid };
                tried.push((self.off(&grid, &observed, fit), grid));
            }
        }
        tried.sort_by(|a, b| a.0.total_cmp(&b.0));
        let tolerance = 3.0 * problem.noise + 2e-4;
        let (best, second) = (tried.first()?, tried.get(1)?);
        (best.0 < tolerance + 0.02 && second.0 > CLEARLY * best.0.max(1e-6)).then_some(best.1)
    }

    /// The mean absolute log ratio, with the best factor.
    fn off(&self, grid: &GridTerms, observed: &Observed, fit: &Fit) -> f64 {
        let mut logs = Vec::new();
        for (i, texel) in self.texels.iter().enumerate() {
            let at = grid.position(i % self.side, i / self.side, self.side, self.side);
            let (light, view) = grid.vectors(at, self.light, self.view, true);
            let base_color = if fit.metallic { texel.base_color } else { texel.diffuse };
            let point = Point { light: light.to_array(), view: view.to_array(), base_color, ..*texel };
            let radiance = fit.terms.radiance(&point, true);
            for ((reading, radiance), factor) in observed.readings[i].iter().zip(radiance).zip(fit.factor) {
                if reading.bound == Bound::Value && reading.value > 0.0 && radiance > 0.0 {
                    logs.push((reading.value / (radiance * factor)).ln());
                }
            }
        }
        let count = logs.len().max(1) as f64;
        let mean = logs.iter().sum::<f64>() / count;
        if logs.is_empty() {
            f64::INFINITY
        } else {
            logs.iter().map(|log| (log - mean).abs()).sum::<f64>() / count
        }
    }
}
