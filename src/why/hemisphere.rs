//! The loss over the directions of the light or the view.

use crate::error::Error;
use crate::loss::{Comparison, Compute, SharedTexels};
use crate::model::convention::Convention;
use crate::model::scene::{Kind, Scene};
use crate::progress::Progress;

/// Independent subsets of texels, and the texels of each.
const TEXELS: [usize; 2] = [8, 512];
/// Columns of the coarsest map.
const COARSEST: usize = 8;

/// What moves over the hemisphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moved {
    /// The light, with a fixed view.
    Light,
    /// The view, with a fixed light.
    View,
}

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

    /// Where the unit direction is: its (column, row), unless it is outside of the grid.
    pub fn cell(&self, [x, y, _]: [f64; 3]) -> Option<[usize; 2]> {
        let side = self.side as f64;
        let [column, row] = [(x + 1.0) / 2.0, (1.0 - y) / 2.0].map(|share| (share * side).floor());
        let inside = |at: f64| at >= 0.0 && at < side;
        (inside(column) && inside(row)).then_some([column as usize, row as usize])
    }
}

/// The loss over the directions of what is `moved`, on a grid of `side` columns; `fixed` is the direction of the other.
///
/// `update` sees coarser maps first, each with half as many columns as the next. Each map compares 8 independent random subsets
/// of 512 texels, the same in all cells; all texels where there are no more.
///
/// # Errors
/// [`Error::UnusableScene`] where `fixed` is not above the plane, [`Error::Cancelled`].
pub fn hemisphere<T: Compute>(
    comparison: &Comparison<'_, T>,
    moved: Moved,
    fixed: [f64; 3],
    side: usize,
    progress: &Progress,
    mut update: impl FnMut(&Hemisphere),
) -> Result<Hemisphere, Error> {
    let texels = SharedTexels::new(comparison, TEXELS, 0);
    let mut sides = vec![side.max(1)];
    while sides[0] >= 2 * COARSEST {
        sides.insert(0, sides[0].div_ceil(2));
    }
    let mut map = of_side(comparison, &texels, moved, fixed, sides[0], progress)?;
    for side in sides.into_iter().skip(1) {
        update(&map);
        map = of_side(comparison, &texels, moved, fixed, side, progress)?;
    }
    update(&map);
    Ok(map)
}

fn of_side<T: Compute>(
    comparison: &Comparison<'_, T>,
    texels: &SharedTexels,
    moved: Moved,
    fixed: [f64; 3],
    side: usize,
    progress: &Progress,
) -> Result<Hemisphere, Error> {
    let directions = directions(side, comparison.convention());
    let scene = |direction: [f64; 3]| match moved {
        Moved::Light => Scene { kind: Kind::Distant, view: fixed, light: direction },
        Moved::View => Scene { kind: Kind::Distant, view: direction, light: fixed },
    };
    let scenes: Vec<Scene> = directions.iter().flatten().map(|&direction| scene(direction)).collect();
    let usable = scenes.iter().try_for_each(Scene::check);
    usable.map_err(|problem| Error::UnusableScene { problem })?;
    let mut map = Hemisphere { side, directions, losses: Vec::new(), standard_errors: Vec::new() };
    for losses in texels.losses(comparison, &scenes, progress)? {
        let spread = |values: Vec<f64>| -> Vec<f64> {
            let mut values = values.into_iter();
            map.directions.iter().map(|d| d.and_then(|_| values.next()).unwrap_or(f64::NAN)).collect()
        };
        let errors = spread(losses.iter().map(|scene| scene.standard_error).collect());
        let losses = spread(losses.iter().map(|scene| scene.loss).collect());
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
