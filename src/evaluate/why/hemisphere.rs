//! The loss over the directions of the light or the view.

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Compute, SharedTexels};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Endpoint, Kind, Scene};
use svbrdf_core::progress::Progress;

/// Independent subsets of texels, and the texels of each.
const TEXELS: [usize; 2] = [8, 512];

/// The loss in distant scenes over the directions of the light or the view, the other being fixed.
///
/// A square grid, row 0 on top, over the disk that the unit directions make seen from above: x to the right, y up. It covers
/// the directions that Algorithm 2 samples, up to the convention's u1. Equal areas are equally likely there, so that the
/// mean of a map is the loss over that direction alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Hemisphere {
    /// Columns and rows.
    pub side: usize,
    /// For each cell its direction; `None` outside of the disk.
    pub directions: Vec<Option<[f64; 3]>>,
    /// For each prediction the loss of each cell; NaN outside of the disk.
    pub losses: Vec<Vec<f64>>,
    /// The standard errors of `losses`, which are due to the choice of texels; 0 where all were compared. The cells of a map share
    /// their texels, so that differences between them are better known.
    pub standard_errors: Vec<Vec<f64>>,
}

impl Hemisphere {
    /// The direction with the largest loss of the prediction with index `prediction`, and this loss.
    pub fn worst(&self, prediction: usize) -> Option<([f64; 3], f64)> {
        let cells = self.directions.iter().zip(&self.losses[prediction]);
        cells.filter_map(|(direction, &loss)| Some(((*direction)?, loss))).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The mean loss of the prediction with index `prediction` over the disk.
    pub fn mean(&self, prediction: usize) -> f64 {
        let inside = || self.losses[prediction].iter().filter(|loss| !loss.is_nan());
        inside().sum::<f64>() / inside().count() as f64
    }

    /// The root mean square of the standard errors of all cells.
    pub fn standard_error(&self, prediction: usize) -> f64 {
        let inside = || self.standard_errors[prediction].iter().filter(|error| !error.is_nan());
        (inside().map(|error| error * error).sum::<f64>() / inside().count() as f64).sqrt()
    }
}

/// The loss over the directions of what is `moved`, on a grid of `side` columns; `fixed` is the direction of the other.
///
/// It compares 8 independent random subsets of 512 texels, the same in all cells; all texels where there are no more.
///
/// # Errors
/// [`Error::UnusableScene`] where `fixed` is not above the plane, [`Error::Cancelled`].
pub fn hemisphere<T: Compute>(
    comparison: &Comparison<'_, T>,
    moved: Endpoint,
    fixed: [f64; 3],
    side: usize,
    progress: &Progress,
) -> Result<Hemisphere, Error> {
    let side = side.max(1);
    let texels = SharedTexels::new(comparison, TEXELS, 0);
    let directions = directions(side, comparison.convention());
    let scene = |direction: [f64; 3]| match moved {
        Endpoint::Light => Scene { kind: Kind::Distant, view: fixed, light: direction },
        Endpoint::View => Scene { kind: Kind::Distant, view: direction, light: fixed },
    };
    let scenes: Vec<Scene> = directions.iter().flatten().map(|&direction| scene(direction)).collect();
    scenes.iter().try_for_each(Scene::check_usable)?;
    let mut map = Hemisphere { side, directions, losses: Vec::new(), standard_errors: Vec::new() };
    for losses in texels.losses(comparison, &scenes, progress)? {
        let on_grid = |values: Vec<f64>| -> Vec<f64> {
            let mut values = values.into_iter();
            map.directions.iter().map(|d| d.and_then(|_| values.next()).unwrap_or(f64::NAN)).collect()
        };
        let errors = on_grid(losses.iter().map(|scene| scene.standard_error).collect());
        let losses = on_grid(losses.iter().map(|scene| scene.loss).collect());
        map.losses.push(losses);
        map.standard_errors.push(errors);
    }
    Ok(map)
}

/// The directions of the cells whose centres are on the disk.
fn directions(side: usize, convention: &Convention) -> Vec<Option<[f64; 3]>> {
    let at = |index: usize| (2 * index + 1) as f64 / side as f64 - 1.0;
    let cell = |index: usize| {
        let [x, y] = [at(index % side), -at(index / side)];
        let squared = x * x + y * y;
        (squared <= convention.u1_max).then(|| [x, y, (1.0 - squared).sqrt()])
    };
    (0..side * side).map(cell).collect()
}
