//! The material terms and positions of one tile, kept in the L1 cache while all scenes pass over it.

use fearless_simd::{Simd, prelude::*};
use glam::Vec3;

use super::TEXELS;
use super::lanes::{Lanes, V, vec3};
use crate::material::{Grid, Planes};

/// One number per texel of a tile, aligned so that no vector straddles two cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct TilePlane([f32; TEXELS]);

impl TilePlane {
    pub(crate) const ZERO: Self = Self([0.0; TEXELS]);

    pub(crate) fn values(&self) -> &[f32; TEXELS] {
        &self.0
    }

    /// Vector number `index`.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S, index: usize) -> V<S> {
        let at = index * V::<S>::LEN;
        V::<S>::from_slice(simd, &self.0[at..at + V::<S>::LEN])
    }

    /// Vector number `index` of each of three planes.
    #[inline(always)]
    pub(crate) fn load_three<S: Simd>(planes: &[Self; 3], simd: S, index: usize) -> [V<S>; 3] {
        vec3!(C => planes[C].load(simd, index))
    }

    #[inline(always)]
    pub(crate) fn store<S: Simd>(&mut self, index: usize, value: V<S>) {
        let at = index * V::<S>::LEN;
        value.store_slice(&mut self.0[at..at + V::<S>::LEN]);
    }

    /// Copies the texels `span` of a plane, and pads the rest of the tile with `pad`.
    #[inline(always)]
    fn fill<S: Simd>(&mut self, simd: S, plane: &[f32], span: &TexelSpan<'_>, pad: f32) {
        if let Some(values) = self.source(plane, span, pad) {
            for i in 0..vectors::<S>() {
                let value = self.load_from(simd, Some(values), i);
                self.store::<S>(i, value);
            }
        }
    }

    /// The texels `span` of a plane where they fill a tile and follow each other. Else `None`, and they are in the tile,
    /// whose rest is `pad`.
    #[inline(always)]
    fn source<'a>(&mut self, plane: &'a [f32], span: &TexelSpan<'_>, pad: f32) -> Option<&'a [f32; TEXELS]> {
        match span {
            TexelSpan::Range(range) => {
                let values = &plane[range.clone()];
                if let Ok(values) = values.try_into() {
                    return Some(values);
                }
                let (used, unused) = self.0.split_at_mut(values.len());
                used.copy_from_slice(values);
                unused.fill(pad);
            }
            TexelSpan::Listed(texels) => {
                let (used, unused) = self.0.split_at_mut(texels.len());
                for (value, &texel) in used.iter_mut().zip(*texels) {
                    *value = plane[texel];
                }
                unused.fill(pad);
            }
        }
        None
    }

    /// Vector number `index` of what [`Self::source`] returned.
    #[inline(always)]
    fn load_from<S: Simd>(&self, simd: S, source: Option<&[f32; TEXELS]>, index: usize) -> V<S> {
        let at = index * V::<S>::LEN;
        V::<S>::from_slice(simd, &source.unwrap_or(&self.0)[at..at + V::<S>::LEN])
    }
}

/// At most [`TEXELS`] texels of a material, each as row * width + column.
#[derive(Clone, Debug)]
pub(crate) enum TexelSpan<'a> {
    /// Consecutive texels.
    Range(std::ops::Range<usize>),
    /// Any texels, in any order.
    Listed(&'a [usize]),
}

/// Vectors in a tile.
#[inline(always)]
pub(crate) const fn vectors<S: Simd>() -> usize {
    TEXELS / V::<S>::LEN
}

/// The terms of a material that do not depend on the scene.
#[derive(Clone, Debug)]
pub(crate) struct MaterialTerms {
    pub(crate) normal: [TilePlane; 3],
    /// The GGX width a = rough^2; k = a / 2.
    pub(crate) a: TilePlane,
    /// Whether an a of the tile is below the limit that [`Self::fill`] was given.
    pub(crate) is_narrow: bool,
    /// 1 - k.
    pub(crate) one_minus_k: TilePlane,
    pub(crate) specular: [TilePlane; 3],
    /// d (1 - s).
    pub(crate) lambert: [TilePlane; 3],
}

impl MaterialTerms {
    pub(crate) const ZERO: Self = Self {
        normal: [TilePlane::ZERO; 3],
        a: TilePlane::ZERO,
        is_narrow: false,
        one_minus_k: TilePlane::ZERO,
        specular: [TilePlane::ZERO; 3],
        lambert: [TilePlane::ZERO; 3],
    };

    /// Computes the terms of the texels `span`. The rest of the tile gets n = 0, so that R = 0 in every material and
    /// it adds nothing to a loss. A tile is narrow where an a is below `narrow`.
    #[inline(always)]
    pub(crate) fn fill<S: Simd>(
        &mut self,
        simd: S,
        planes: &Planes<f32>,
        span: &TexelSpan<'_>,
        roughness_floor: f32,
        narrow: f32,
    ) {
        for (tile, plane) in self.normal.iter_mut().zip(&planes.normal) {
            tile.fill(simd, plane, span, 0.0);
        }
        self.is_narrow = self
            .fill_widths(simd, &planes.roughness, span, roughness_floor)
            .simd_lt(V::<S>::splat(simd, narrow))
            .any_true();
        for channel in 0..3 {
            let (specular, lambert) = (&mut self.specular[channel], &mut self.lambert[channel]);
            specular.fill(simd, &planes.specular[channel], span, 0.0);
            let diffuse = lambert.source(&planes.diffuse[channel], span, 0.0);
            for i in 0..vectors::<S>() {
                let diffuse = lambert.load_from(simd, diffuse, i);
                lambert.store::<S>(i, diffuse * (V::<S>::splat(simd, 1.0) - specular.load(simd, i)));
            }
        }
    }

    /// Computes the terms of the roughness. Returns the least width of each lane.
    #[inline(always)]
    fn fill_widths<S: Simd>(&mut self, simd: S, plane: &[f32], span: &TexelSpan<'_>, floor: f32) -> V<S> {
        let splat = |c| V::<S>::splat(simd, c);
        let roughness = self.a.source(plane, span, 1.0);
        let mut least = splat(1.0);
        for i in 0..vectors::<S>() {
            let rough = self.a.load_from(simd, roughness, i).max(splat(floor));
            let a = rough * rough;
            least = least.min(a);
            self.a.store::<S>(i, a);
            self.one_minus_k.store::<S>(i, splat(1.0) - a * 0.5);
        }
        least
    }
}

/// Prefetches `N` texels of some planes from `start` on, where there are as many. `N` is a multiple of a cache line's.
#[inline(always)]
pub(crate) fn prefetch<S: Lanes, const N: usize>(simd: S, planes: &[&[f32]], start: usize) {
    for plane in planes {
        if let Some(texels) = plane.get(start..).and_then(|rest| rest.first_chunk::<N>()) {
            texels.as_chunks().0.iter().for_each(|line| simd.prefetch(line));
        }
    }
}

/// A grid with the coordinates of its columns and rows, which runs of texels need.
#[derive(Debug)]
pub(crate) struct GridAxes {
    grid: Grid,
    x: Vec<f32>,
    y: Vec<f32>,
}

impl From<Grid> for GridAxes {
    fn from(grid: Grid) -> Self {
        Self {
            grid,
            x: (0..grid.width).map(|column| grid.position::<Vec3>(column, 0).x).collect(),
            y: (0..grid.height).map(|row| grid.position::<Vec3>(0, row).y).collect(),
        }
    }
}

impl GridAxes {
    /// Axes for listed texels only.
    pub(crate) fn without_runs(grid: Grid) -> Self {
        Self { grid, x: Vec::new(), y: Vec::new() }
    }
}

/// The positions of the texels of a tile.
#[derive(Clone, Debug)]
pub(crate) struct Positions {
    pub(crate) x: TilePlane,
    pub(crate) y: TilePlane,
}

impl Positions {
    pub(crate) const ZERO: Self = Self { x: TilePlane::ZERO, y: TilePlane::ZERO };

    /// Computes the positions of the texels `span`; the rest of the tile has that of the first.
    #[inline(always)]
    pub(crate) fn fill(&mut self, axes: &GridAxes, span: &TexelSpan<'_>) {
        let width = axes.grid.width;
        let range = match span {
            TexelSpan::Range(range) => range,
            TexelSpan::Listed(texels) => {
                for ((x, y), &texel) in self.x.0.iter_mut().zip(&mut self.y.0).zip(*texels) {
                    let position = axes.grid.position::<Vec3>(texel % width, texel / width);
                    (*x, *y) = (position.x, position.y);
                }
                return self.pad(texels.len());
            }
        };
        let mut next = range.start;
        while next < range.end {
            let (row, column) = (next / width, next % width);
            let count = (width - column).min(range.end - next);
            let tile = next - range.start..next - range.start + count;
            self.x.0[tile.clone()].copy_from_slice(&axes.x[column..column + count]);
            self.y.0[tile].fill(axes.y[row]);
            next += count;
        }
        self.pad(range.len());
    }

    /// Gives the texels after the first `count` the position of the first, so that no tile depends on what was in it before.
    #[inline(always)]
    fn pad(&mut self, count: usize) {
        for plane in [&mut self.x.0, &mut self.y.0] {
            let first = plane[0];
            plane[count..].fill(first);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_of_a_tile_has_the_position_of_its_first_texel_whatever_was_in_it() {
        let axes = GridAxes::from(Grid { width: 20, height: 20 });
        let listed: Vec<usize> = (7..10).collect();
        for span in [TexelSpan::Range(7..10), TexelSpan::Listed(&listed)] {
            let mut positions = Positions::ZERO;
            positions.fill(&axes, &TexelSpan::Range(200..200 + TEXELS));
            positions.fill(&axes, &span);
            for plane in [positions.x.values(), positions.y.values()] {
                assert!(plane[3..].iter().all(|value| *value == plane[0]), "{span:?}");
            }
        }
    }
}
