//! `svbrdf conform`: renderers of the grammar are found, and others have no name.

mod outside;
mod peers;
mod random;

use std::path::Path;

use svbrdf_core::model::grammar::{Description, Point, RendererTerms};
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::conform::{RenderedPoints, Verdict, identify, probes, verdict};
use svbrdf_files::arrays::{self, Array, Arrays};

/// A radiance with the rounding of float32.
pub fn single(radiance: [f64; 3]) -> [f64; 3] {
    radiance.map(|x| f64::from(x as f32))
}

/// The probe points.
pub fn points() -> Vec<Point> {
    let count = probes().unwrap()["normal"].shape[0];
    RenderedPoints::new(&arrays_of(&vec![[1.0; 3]; count]), None).unwrap().points
}

/// The arrays of points and radiances.
fn arrays_of(radiance: &[[f64; 3]]) -> Arrays {
    let mut arrays = probes().unwrap();
    arrays.insert("radiance".to_owned(), Array::new(&[radiance.len(), 3], radiance.as_flattened().to_vec()));
    arrays
}

/// Writes what the convention `name` renders at the probe points.
pub fn write_answer(path: &Path, name: &str) {
    let convention = named::all().iter().find(|convention| convention.name == name).unwrap();
    let radiance = |point| single(convention.terms.radiance(point, true));
    let radiances: Vec<[f64; 3]> = points().iter().map(radiance).collect();
    arrays::write(path, &arrays_of(&radiances), &Progress::default()).unwrap();
}

/// The verdict on radiances at points, against the renderer `asked`.
pub fn judged(
    points: &[Point],
    radiance: Vec<[f64; 3]>,
    metallic: Option<bool>,
    asked: &RendererTerms,
) -> Verdict {
    let answer = RenderedPoints { points: points.to_vec(), radiance, metallic };
    verdict(&identify(&answer), &Description { terms: *asked, ..Description::default() })
}
