//! Probe points and pictures, and answers: arrays by name.

use svbrdf_core::model::grammar::{GridTerms, Point};
use svbrdf_files::arrays::{self, Arrays};

use super::columns::{column, rows};
use super::pictures::{self, Picture};

/// Points chosen so that all members of the grammar differ where float32 or 8 bits can see it; the last 20 are repeated.
const POINTS: &[u8] = include_bytes!("data/probes.npz");
/// Most points of an answer.
const MOST: usize = 100_000;
/// The fewest points that a renderer is named by.
const FEWEST: usize = 60;

/// The probe points and pictures, as arrays; `radiance` is missing.
///
/// # Errors
/// None: a test reads them.
pub fn probes() -> Result<Arrays, String> {
    let mut arrays = arrays::parse(POINTS)?;
    arrays.extend(pictures::probes());
    Ok(arrays)
}

/// Radiances at points, as a renderer gave them out.
#[derive(Clone, Debug)]
pub struct Answer {
    pub points: Vec<Point>,
    /// The points under each grid, where they are texels of pictures; the first are `points`.
    pub grids: Vec<(GridTerms, Vec<Point>)>,
    pub radiance: Vec<[f64; 3]>,
    /// Whether base colour and metallic were read; `None` where that is unknown.
    pub metallic: Option<bool>,
    /// A small picture, which tells the grid.
    pub picture: Option<Picture>,
}

impl Answer {
    /// The answer in arrays: those of [`probes`] with `radiance`, and `picture_radiance` where pictures were rendered.
    ///
    /// # Errors
    /// Which array is missing, or has another shape.
    pub fn new(arrays: &Arrays, metallic: Option<bool>) -> Result<Self, String> {
        let count = arrays.get("normal").map_or(0, |array| array.shape.first().copied().unwrap_or(0));
        if !(1..=MOST).contains(&count) {
            return Err(format!(
                "expected the array `normal` of 1 to {MOST} points x 3, found {count} points"
            ));
        }
        let three = |name: &str| rows(arrays, name, count);
        let one = |name: &str| column(arrays, name, count);
        let (normal, light, view) = (three("normal")?, three("light")?, three("view")?);
        let radiance = three("radiance").map_err(|problem| {
            format!(
                "{problem}; render each point with your code, and save the result as the array `radiance`"
            )
        })?;
        let roughness = one("roughness")?;
        let has = |names: [&str; 2]| names.iter().all(|name| arrays.contains_key(*name));
        let (is_diffuse, is_metallic) = (has(["diffuse", "specular"]), has(["base_color", "metallic"]));
        if !is_diffuse && !is_metallic {
            return Err(
                "expected the arrays `diffuse` and `specular`, or `base_color` and `metallic`, found neither"
                    .to_owned(),
            );
        }
        let colours = |names, is_there: bool| {
            if is_there { rows(arrays, names, count) } else { Ok(vec![[0.0; 3]; count]) }
        };
        let (diffuse, specular) = (colours("diffuse", is_diffuse)?, colours("specular", is_diffuse)?);
        let base_color = colours("base_color", is_metallic)?;
        let metallics = if is_metallic { one("metallic")? } else { vec![0.0; count] };
        let point = |i: usize| Point {
            normal: normal[i],
            diffuse: diffuse[i],
            specular: specular[i],
            roughness: roughness[i],
            base_color: base_color[i],
            metallic: metallics[i],
            light: light[i],
            view: view[i],
        };
        let points: Vec<Point> = (0..count).map(point).collect();
        check(&points)?;
        if radiance.as_flattened().iter().filter(|x| x.is_finite()).count() < FEWEST {
            return Err(format!("expected at least {FEWEST} finite values in `radiance`"));
        }
        let only = if is_diffuse && is_metallic { None } else { Some(is_metallic) };
        let picture = Picture::new(arrays)?;
        Ok(Self { points, grids: Vec::new(), radiance, metallic: metallic.or(only), picture })
    }
}

fn check(points: &[Point]) -> Result<(), String> {
    for (i, point) in points.iter().enumerate() {
        let vectors = [point.normal, point.light, point.view];
        let colours = [point.diffuse, point.specular, point.base_color];
        let mut all = vectors.as_flattened().iter().chain(colours.as_flattened());
        if !all.all(|x| x.is_finite() && x.abs() < 1e9)
            || !point.roughness.is_finite()
            || !point.metallic.is_finite()
        {
            return Err(format!("point {i}: expected finite numbers below 1e9, found {point:?}"));
        }
        if vectors.iter().any(|v| v.iter().map(|x| x * x).sum::<f64>() < 1e-18) {
            return Err(format!(
                "point {i}: expected a normal, a light and a view that are not 0, found {vectors:?}"
            ));
        }
    }
    Ok(())
}
