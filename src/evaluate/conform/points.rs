//! Probe points, and points with the radiances of a renderer: arrays by name.

use svbrdf_core::model::grammar::Point;
use svbrdf_files::arrays::{self, Arrays};

/// Points chosen so that all members of the grammar differ where float32 can see it; the last 20 are repeated.
const POINTS: &[u8] = include_bytes!("data/probes.npz");
/// Most points with radiances.
const MOST: usize = 100_000;
/// The fewest values that a renderer is named by.
const FEWEST: usize = 60;

/// The probe points, as arrays; `radiance` is missing.
///
/// # Errors
/// None: a test reads them.
pub fn probes() -> Result<Arrays, String> {
    arrays::parse(POINTS)
}

/// Radiances at points, as a renderer gave them out.
#[derive(Clone, Debug)]
pub struct RenderedPoints {
    pub points: Vec<Point>,
    pub radiance: Vec<[f64; 3]>,
    /// Whether base colour and metallic were read; `None` where that is unknown.
    pub metallic: Option<bool>,
}

impl RenderedPoints {
    /// The points in arrays: those of [`probes`] with `radiance`.
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
        let array = |name: &str, channels: usize| {
            let array = arrays.get(name).ok_or_else(|| {
                let found = arrays.keys().map(String::as_str).collect::<Vec<_>>().join(", ");
                format!("expected the array `{name}`, found {found}")
            })?;
            let is_right = array.values.len() == channels * count
                && (channels == 1 || array.shape.last() == Some(&channels));
            let expected = if channels == 1 { String::new() } else { format!(" x {channels}") };
            let found = &array.shape;
            let problem =
                || format!("array `{name}`: expected {count}{expected} values, found the shape {found:?}");
            if is_right { Ok(array.values.as_slice()) } else { Err(problem()) }
        };
        let triples = |values: &[f64]| -> Vec<[f64; 3]> {
            values.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect()
        };
        let three = |name: &str| array(name, 3).map(triples);
        let (normal, light, view) = (three("normal")?, three("light")?, three("view")?);
        let radiance = three("radiance").map_err(|problem| {
            format!(
                "{problem}; render each point with your code, and save the result as the array `radiance`"
            )
        })?;
        let roughness = array("roughness", 1)?;
        let has = |names: [&str; 2]| names.iter().all(|name| arrays.contains_key(*name));
        let (is_diffuse, is_metallic) = (has(["diffuse", "specular"]), has(["base_color", "metallic"]));
        if !is_diffuse && !is_metallic {
            return Err(
                "expected the arrays `diffuse` and `specular`, or `base_color` and `metallic`, found neither"
                    .to_owned(),
            );
        }
        let colours = |name, is_there| if is_there { three(name) } else { Ok(vec![[0.0; 3]; count]) };
        let (diffuse, specular) = (colours("diffuse", is_diffuse)?, colours("specular", is_diffuse)?);
        let base_color = colours("base_color", is_metallic)?;
        let zeros = vec![0.0; count];
        let metallics = if is_metallic { array("metallic", 1)? } else { &zeros };
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
        points.iter().enumerate().try_for_each(check)?;
        if radiance.as_flattened().iter().filter(|x| x.is_finite()).count() < FEWEST {
            return Err(format!("expected at least {FEWEST} finite values in `radiance`"));
        }
        let only = if is_diffuse && is_metallic { None } else { Some(is_metallic) };
        Ok(Self { points, radiance, metallic: metallic.or(only) })
    }
}

fn check((i, point): (usize, &Point)) -> Result<(), String> {
    let vectors = [point.normal, point.light, point.view];
    let colours = [point.diffuse, point.specular, point.base_color];
    let values = vectors.as_flattened().iter().chain(colours.as_flattened());
    if !values.chain([&point.roughness, &point.metallic]).all(|x| x.is_finite() && x.abs() < 1e9) {
        return Err(format!("point {i}: expected finite numbers below 1e9, found {point:?}"));
    }
    if vectors.iter().any(|v| v.iter().map(|x| x * x).sum::<f64>() < 1e-18) {
        return Err(format!(
            "point {i}: expected a normal, a light and a view that are not 0, found {vectors:?}"
        ));
    }
    Ok(())
}
