//! Texels in the plane: each once or, where the material is repeated, in several cells. The one mapping between points of the
//! plane and texels.

use glam::DVec3;
use svbrdf_core::material::Grid;
use svbrdf_core::model::scene::{Kind, Scene};

use crate::model::inspection::Region;

/// The cells of the plane, each of which shows one texel.
///
/// A repeated material is shown 2 x 2 times in its own place, shifted by half of itself; cell `i` along an axis of `n` texels shows
/// texel `i mod n`. `repeated` in `shaders/display.wgsl` is its twin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexelPlane {
    grid: Grid,
    /// How many times the material is repeated along an axis.
    repeats: f32,
    /// The cell of the upper left corner of the plane, a fraction where it cuts a texel.
    corner: [f32; 2],
}

/// A texel, and the cell of the plane that shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen {
    pub cell: [i64; 2],
    /// (column, row).
    pub texel: [usize; 2],
}

/// The part of the plane from one place to another, in cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellRect {
    pub min: [f32; 2],
    pub max: [f32; 2],
}

impl CellRect {
    /// The part that cell (column, row) covers.
    pub fn of_cell(cell: [i64; 2]) -> Self {
        let min = cell.map(|number| number as f32);
        Self { min, max: min.map(|edge| edge + 1.0) }
    }

    pub fn centre(&self) -> [f32; 2] {
        [0, 1].map(|axis| 0.5 * (self.min[axis] + self.max[axis]))
    }
}

impl TexelPlane {
    pub fn new(grid: Grid, tiled: bool) -> Self {
        if tiled {
            let corner = [grid.width, grid.height].map(|count| 0.5 * count as f32);
            Self { grid, repeats: 2.0, corner }
        } else {
            Self { grid, repeats: 1.0, corner: [0.0; 2] }
        }
    }

    /// The place of a point of the plane, in cells.
    pub fn place(&self, point: [f32; 2]) -> [f32; 2] {
        let place = self.grid.place(point);
        [0, 1].map(|axis| self.repeats * place[axis] + self.corner[axis])
    }

    /// The point of the plane at a place in cells: the inverse of [`TexelPlane::place`].
    pub fn point(&self, place: [f32; 2]) -> [f32; 2] {
        self.grid.point([0, 1].map(|axis| (place[axis] - self.corner[axis]) / self.repeats))
    }

    /// What is seen at a point of the plane; `None` outside of it.
    pub fn seen(&self, point: [f32; 2]) -> Option<Seen> {
        self.grid.texel_at(point)?;
        Some(self.seen_in(self.place(point).map(|place| place.floor() as i64)))
    }

    /// What is seen in a cell.
    pub fn seen_in(&self, cell: [i64; 2]) -> Seen {
        Seen { cell, texel: self.texel_of(cell) }
    }

    /// The (column, row) of the texel that a cell shows.
    pub fn texel_of(&self, cell: [i64; 2]) -> [usize; 2] {
        [0, 1].map(|axis| cell[axis].rem_euclid(self.size()[axis]) as usize)
    }

    /// The scene in which a texel in its own place is lit as this cell of the plane is in `scene`.
    pub fn scene_of_cell(&self, scene: &Scene, cell: [i64; 2]) -> Scene {
        if scene.kind == Kind::Distant || self.repeats == 1.0 {
            return *scene;
        }
        let [column, row] = cell.map(|number| number.max(0) as usize);
        let at = self.grid.cell_position(column, row);
        let [column, row] = self.texel_of(cell);
        let own = self.grid.position::<DVec3>(column, row);
        let moved = |[x, y, z]: [f64; 3]| [x + own.x - at[0], y + own.y - at[1], z];
        Scene { kind: scene.kind, view: moved(scene.view), light: moved(scene.light) }
    }

    /// The first and the last cell between two points of the plane, both included; `None` where all lie outside of it.
    pub fn cells(&self, a: [f32; 2], b: [f32; 2]) -> Option<[[i64; 2]; 2]> {
        let (a, b) = (self.place(a), self.place(b));
        let (mut first, mut last) = ([0; 2], [0; 2]);
        for axis in 0..2 {
            let [left, right] = self.edges(axis);
            let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
            if high < left || low >= right {
                return None;
            }
            first[axis] = low.max(left).floor() as i64;
            last[axis] = (high.floor() as i64).min(right.ceil() as i64 - 1);
        }
        Some([first, last])
    }

    /// The texels between two points of the plane; `None` where it shows none there.
    pub fn region(&self, a: [f32; 2], b: [f32; 2]) -> Option<Region> {
        let [low, high] = self.cells(a, b)?;
        let size = self.size();
        let is_all = |axis: usize| high[axis] - low[axis] + 1 >= size[axis];
        let first = [0, 1].map(|axis| if is_all(axis) { 0 } else { low[axis].rem_euclid(size[axis]) });
        let count = [0, 1].map(|axis| (high[axis] - low[axis] + 1).min(size[axis]));
        let last = [0, 1].map(|axis| first[axis] + count[axis] - 1);
        Some(Region { first: first.map(|end| end as usize), last: last.map(|end| end as usize) })
    }

    /// Where the plane shows a region: each of its copies, cut off at the edges of the plane.
    pub fn copies(&self, region: Region) -> Vec<CellRect> {
        let [columns, rows] = [0, 1].map(|axis| self.copies_along(axis, region));
        let with = |[top, bottom]: [f32; 2]| {
            let columns = columns.iter();
            columns.map(move |[left, right]| CellRect { min: [*left, top], max: [*right, bottom] })
        };
        rows.iter().flat_map(|row| with(*row)).collect()
    }

    fn copies_along(&self, axis: usize, region: Region) -> Vec<[f32; 2]> {
        let ([left, right], size) = (self.edges(axis), self.size()[axis] as f32);
        let [first, end] = [region.first[axis], region.last[axis] + 1].map(|number| number as f32);
        if end - first >= size {
            return vec![[left, right]];
        }
        let copy = |shift: i8| {
            let shift = f32::from(shift) * size;
            [(first + shift).max(left), (end + shift).min(right)]
        };
        // The plane begins in the first copy and ends in the third.
        (-1..=2).map(copy).filter(|[low, high]| low < high).collect()
    }

    /// The places of the edges of the plane along an axis.
    fn edges(&self, axis: usize) -> [f32; 2] {
        let start = self.corner[axis];
        [start, start + self.repeats * self.size()[axis] as f32]
    }

    fn size(&self) -> [i64; 2] {
        [self.grid.width as i64, self.grid.height as i64]
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use rand::rngs::ChaCha8Rng;
    use rand::{Rng as _, SeedableRng as _};

    fn unit(random: &mut ChaCha8Rng) -> f32 {
        random.next_u32() as f32 / u32::MAX as f32
    }

    /// A plane of a random grid, repeated or not.
    fn plane(random: &mut ChaCha8Rng) -> TexelPlane {
        let mut side = || 1 + random.next_u32() as usize % 40;
        let grid = Grid { width: side(), height: side() };
        TexelPlane::new(grid, random.next_u32().is_multiple_of(2))
    }

    /// A point of the plane, up to a tenth outside of the material.
    fn point(plane: TexelPlane, random: &mut ChaCha8Rng) -> [f32; 2] {
        plane.grid.half_extent().map(|half| half * 1.1 * (2.0 * unit(random) - 1.0))
    }

    fn is_between(value: [f32; 2], a: [f32; 2], b: [f32; 2]) -> bool {
        (0..2).all(|axis| (a[axis].min(b[axis])..=a[axis].max(b[axis])).contains(&value[axis]))
    }

    fn texels(plane: TexelPlane, region: Region) -> BTreeSet<[usize; 2]> {
        let parts = region.parts([plane.grid.width, plane.grid.height]);
        let rows = parts.iter().flat_map(|part| (part.first[1]..=part.last[1]).map(move |row| (part, row)));
        rows.flat_map(|(part, row)| (part.first[0]..=part.last[0]).map(move |column| [column, row])).collect()
    }

    #[test]
    fn a_texel_in_its_own_place_is_lit_in_the_moved_scene_as_its_cell_is() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let scene = Scene { kind: Kind::Near, view: [0.2, -0.1, 2.0], light: [-0.6, 0.4, 1.2] };
        let mut moved = 0;
        for _ in 0..300 {
            let plane = plane(&mut random);
            let seen = point(plane, &mut random);
            let Some(Seen { cell, texel: [column, row] }) = plane.seen(seen) else { continue };
            let of_cell = plane.scene_of_cell(&scene, cell);
            let own = plane.grid.position::<DVec3>(column, row).to_array();
            let [x, y] = plane.point(CellRect::of_cell(cell).centre()).map(f64::from);
            let [left, top, up] = [of_cell.light[0] - own[0], of_cell.light[1] - own[1], of_cell.light[2]];
            let expected = [scene.light[0] - x, scene.light[1] - y, scene.light[2]];
            let off = [left, top, up].iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-5, "{plane:?} {cell:?}: {off}");
            moved += usize::from(of_cell != scene);
        }
        assert!(moved > 50, "{moved}");
        let distant = Scene { kind: Kind::Distant, ..scene };
        let repeated = TexelPlane::new(Grid { width: 4, height: 4 }, true);
        assert_eq!(repeated.scene_of_cell(&distant, [3, 3]), distant);
    }

    #[test]
    fn a_region_has_the_texels_that_are_seen_between_its_corners_and_no_others() {
        let mut random = ChaCha8Rng::seed_from_u64(46);
        for _ in 0..300 {
            let plane = plane(&mut random);
            let (a, b) = (point(plane, &mut random), point(plane, &mut random));
            let Some([first, last]) = plane.cells(a, b) else { continue };
            let of_cells: BTreeSet<_> = (first[1]..=last[1])
                .flat_map(|row| (first[0]..=last[0]).map(move |column| [column, row]))
                .map(|cell| plane.texel_of(cell))
                .collect();
            let region = plane.region(a, b).unwrap();
            assert_eq!(texels(plane, region), of_cells, "{plane:?} {region:?}");
            for _ in 0..40 {
                let seen = point(plane, &mut random);
                let Some(texel) = plane.seen(seen).map(|seen| seen.texel).filter(|_| is_between(seen, a, b))
                else {
                    continue;
                };
                assert!(of_cells.contains(&texel), "{texel:?} at {seen:?} in {plane:?}");
            }
            for corner in [a, b].into_iter().filter_map(|corner| plane.seen(corner).map(|seen| seen.texel)) {
                assert!(of_cells.contains(&corner), "{plane:?}: {region:?} has its corner {corner:?}");
            }
        }
    }

    #[test]
    fn the_copies_of_a_region_show_its_texels_and_nothing_else_does() {
        let mut random = ChaCha8Rng::seed_from_u64(47);
        for _ in 0..300 {
            let plane = plane(&mut random);
            let Some(region) = plane.region(point(plane, &mut random), point(plane, &mut random)) else {
                continue;
            };
            let (inside, copies) = (texels(plane, region), plane.copies(region));
            for _ in 0..40 {
                let seen = point(plane, &mut random);
                let Some(texel) = plane.seen(seen).map(|seen| seen.texel) else { continue };
                let place = plane.place(seen);
                let is_shown = copies.iter().any(|copy| is_between(place, copy.min, copy.max));
                let is_near_edge = place.iter().any(|place| (place - place.round()).abs() < 1e-3);
                assert!(
                    is_near_edge || is_shown == inside.contains(&texel),
                    "{plane:?} {region:?}: {place:?}"
                );
            }
        }
    }

    #[test]
    fn a_point_is_found_again_and_outside_there_is_no_texel() {
        let mut random = ChaCha8Rng::seed_from_u64(48);
        for _ in 0..300 {
            let plane = plane(&mut random);
            let seen = point(plane, &mut random);
            let found = plane.point(plane.place(seen));
            assert!((0..2).all(|axis| (found[axis] - seen[axis]).abs() < 1e-4), "{seen:?}, {found:?}");
            let half = plane.grid.half_extent();
            let is_inside = (0..2).all(|axis| seen[axis].abs() < half[axis]);
            assert_eq!(plane.seen(seen).map(|seen| seen.texel).is_some(), is_inside, "{plane:?} {seen:?}");
        }
    }
}
