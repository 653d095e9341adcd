//! The loss over the directions of the light or the view.

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Compute, SharedTexels};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Endpoint, Kind, Scene};
use svbrdf_core::progress::Progress;

/// Independent subsets of texels, and the texels of each.
const TEXELS: [usize; 2] = [8, 512];
/// Columns of the coarsest map.
const COARSEST: usize = 8;

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

    /// The index of the cell that has the loss of the unit direction: the cell that the direction is in or, at the rim of the disk, where
    /// the centre of that cell is outside, the nearest one inside. `None` further out than a cell.
    pub fn nearest_cell(&self, direction: [f64; 3]) -> Option<usize> {
        let at = self.cell(direction).map(|[column, row]| row * self.side + column);
        if let Some(index) = at.filter(|index| self.directions[*index].is_some()) {
            return Some(index);
        }
        let [x, y, _] = direction;
        let cells = self.directions.iter().enumerate().filter_map(|(index, cell)| Some((index, (*cell)?)));
        let distances = cells.map(|(index, [cell_x, cell_y, _])| (index, (cell_x - x).hypot(cell_y - y)));
        let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1));
        // No point of the disk is further from the centre of an inner cell than the diagonal of a cell.
        let most = std::f64::consts::SQRT_2 * 2.0 / self.side as f64;
        nearest.filter(|(_, distance)| *distance <= most).map(|(index, _)| index)
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
    moved: Endpoint,
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
    moved: Endpoint,
    fixed: [f64; 3],
    side: usize,
    progress: &Progress,
) -> Result<Hemisphere, Error> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_core::model::convention::PRINTED;

    #[test]
    fn every_direction_of_the_disk_has_a_cell_and_none_beyond_its_rim() {
        for side in [8, 16, 64] {
            let directions = directions(side, &PRINTED);
            let map = Hemisphere { side, directions, losses: Vec::new(), standard_errors: Vec::new() };
            let at = |radius: f64, turn: f64| {
                let (x, y) = (radius * turn.cos(), radius * turn.sin());
                [x, y, (1.0 - radius * radius).max(0.0).sqrt()]
            };
            let rim = PRINTED.u1_max.sqrt();
            let mut outside = 0;
            for turn in (0..720).map(|i| f64::from(i).to_radians() / 2.0) {
                for radius in [0.0, 0.5, 0.9 * rim, rim] {
                    let direction = at(radius, turn);
                    let index = map.nearest_cell(direction).unwrap();
                    let [x, y, _] = map.directions[index].unwrap();
                    let cell = map.cell(direction).map(|[column, row]| row * side + column);
                    let is_inside = cell.filter(|cell| map.directions[*cell].is_some());
                    outside += usize::from(is_inside.is_none());
                    assert!(is_inside.is_none_or(|cell| cell == index), "{side}: {direction:?}");
                    let off = (x - direction[0]).hypot(y - direction[1]);
                    assert!(off <= 2.83 / side as f64, "{side}: {direction:?} is {off} away");
                }
                assert_eq!(map.nearest_cell(at(rim + 3.0 / side as f64, turn)), None, "{side}: {turn}");
            }
            assert!(outside > 100, "{side}: the rim goes through cells whose centres are outside");
        }
    }
}
