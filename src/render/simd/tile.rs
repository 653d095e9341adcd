//! What is kept in the nearest cache while all scenes pass over a few texels.

use fearless_simd::{Simd, prelude::*};
use glam::Vec3;

use super::lanes::{Lanes, V};
use crate::material::{Grid, Planes};

/// Texels of a tile. Its planes (22 KiB for two materials) stay in the nearest cache; a multiple of two vectors of
/// every instruction set.
pub(crate) const TEXELS: usize = 128;

/// How many texels before they are needed memory is asked for: what the last scene of a tile asks of the very next one
/// comes too late.
pub(crate) const AHEAD: usize = 2 * TEXELS;

/// One number for each texel of a tile, aligned so that no vector straddles two cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Plane([f32; TEXELS]);

impl Plane {
    pub(crate) const ZERO: Self = Self([0.0; TEXELS]);

    pub(crate) fn values(&self) -> &[f32; TEXELS] {
        &self.0
    }

    /// Texels per vector times `index`, and on.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S, index: usize) -> V<S> {
        let at = index * V::<S>::LEN;
        V::<S>::from_slice(simd, &self.0[at..at + V::<S>::LEN])
    }

    #[inline(always)]
    pub(crate) fn store<S: Simd>(&mut self, index: usize, value: V<S>) {
        let at = index * V::<S>::LEN;
        value.store_slice(&mut self.0[at..at + V::<S>::LEN]);
    }

    /// The first texels are those `at` some of a plane, the others `pad`.
    #[inline(always)]
    fn fill(&mut self, plane: &[f32], at: &At<'_>, pad: f32) {
        match at {
            At::Run(range) => match plane[range.clone()].try_into() {
                Ok(values) => self.0 = values,
                Err(_) => {
                    let (used, unused) = self.0.split_at_mut(range.len());
                    used.copy_from_slice(&plane[range.clone()]);
                    unused.fill(pad);
                }
            },
            At::Listed(texels) => {
                let (used, unused) = self.0.split_at_mut(texels.len());
                for (value, &texel) in used.iter_mut().zip(*texels) {
                    *value = plane[texel];
                }
                unused.fill(pad);
            }
        }
    }
}

/// At most [`TEXELS`] texels of a picture, as row * width + column.
#[derive(Clone, Debug)]
pub(crate) enum At<'a> {
    /// One after another.
    Run(std::ops::Range<usize>),
    Listed(&'a [usize]),
}

/// Vectors in a tile.
#[inline(always)]
pub(crate) const fn vectors<S: Simd>() -> usize {
    TEXELS / V::<S>::LEN
}

/// The terms of a material that do not depend on the scene.
#[derive(Clone, Debug)]
pub(crate) struct Terms {
    pub(crate) normal: [Plane; 3],
    /// The GGX width a = rough^2; k = a / 2.
    pub(crate) a: Plane,
    /// 1 - k.
    pub(crate) one_minus_k: Plane,
    pub(crate) specular: [Plane; 3],
    /// d (1 - s).
    pub(crate) lambert: [Plane; 3],
}

impl Terms {
    pub(crate) const ZERO: Self = Self {
        normal: [Plane::ZERO; 3],
        a: Plane::ZERO,
        one_minus_k: Plane::ZERO,
        specular: [Plane::ZERO; 3],
        lambert: [Plane::ZERO; 3],
    };

    /// The terms of the texels `at`. The rest of the tile is lit from nowhere: n = 0, R = 0 in
    /// every material, so that it adds nothing to a loss.
    #[inline(always)]
    pub(crate) fn fill(&mut self, planes: &Planes<f32>, at: &At<'_>, roughness_floor: f32) {
        for (tile, plane) in self.normal.iter_mut().zip(&planes.normal) {
            tile.fill(plane, at, 0.0);
        }
        self.a.fill(&planes.roughness, at, 1.0);
        for (a, other) in self.a.0.iter_mut().zip(&mut self.one_minus_k.0) {
            let rough = a.max(roughness_floor);
            *a = rough * rough;
            *other = 1.0 - 0.5 * *a;
        }
        for channel in 0..3 {
            let (specular, lambert) = (&mut self.specular[channel], &mut self.lambert[channel]);
            specular.fill(&planes.specular[channel], at, 0.0);
            lambert.fill(&planes.diffuse[channel], at, 0.0);
            for (l, s) in lambert.0.iter_mut().zip(&specular.0) {
                *l *= 1.0 - s;
            }
        }
    }
}

/// The planes of a material, in the order that a tile is filled.
pub(crate) fn planes(planes: &Planes<f32>) -> impl Iterator<Item = &[f32]> {
    let vectors = planes.normal.iter().chain(&planes.specular).chain(&planes.diffuse);
    vectors.chain([&planes.roughness]).map(Vec::as_slice)
}

/// Asks for the tile at `start` of some planes, so that memory works while the kernel computes.
#[inline(always)]
pub(crate) fn prefetch<S: Lanes>(simd: S, planes: &[&[f32]], start: usize) {
    for plane in planes {
        if let Some(tile) = plane.get(start..).and_then(|rest| rest.first_chunk()) {
            simd.prefetch(tile);
        }
    }
}

/// A grid, and the coordinates of all its columns and rows, which runs of texels need.
#[derive(Debug)]
pub(crate) struct Axes {
    grid: Grid,
    x: Vec<f32>,
    y: Vec<f32>,
}

impl From<Grid> for Axes {
    fn from(grid: Grid) -> Self {
        Self {
            grid,
            x: (0..grid.width).map(|column| grid.position::<Vec3>(column, 0).x).collect(),
            y: (0..grid.height).map(|row| grid.position::<Vec3>(0, row).y).collect(),
        }
    }
}

impl Axes {
    /// For listed texels only.
    pub(crate) fn without_runs(grid: Grid) -> Self {
        Self { grid, x: Vec::new(), y: Vec::new() }
    }
}

/// Where the texels of a tile lie.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    pub(crate) x: Plane,
    pub(crate) y: Plane,
}

impl Places {
    pub(crate) const ZERO: Self = Self { x: Plane::ZERO, y: Plane::ZERO };

    /// The places of the texels `at`; the rest of the tile keeps what it had.
    #[inline(always)]
    pub(crate) fn fill(&mut self, axes: &Axes, at: &At<'_>) {
        let width = axes.grid.width;
        let at = match at {
            At::Run(range) => range,
            At::Listed(texels) => {
                for ((x, y), &texel) in self.x.0.iter_mut().zip(&mut self.y.0).zip(*texels) {
                    let position = axes.grid.position::<Vec3>(texel % width, texel / width);
                    (*x, *y) = (position.x, position.y);
                }
                return;
            }
        };
        let mut next = at.start;
        while next < at.end {
            let (row, column) = (next / width, next % width);
            let count = (width - column).min(at.end - next);
            let tile = next - at.start..next - at.start + count;
            self.x.0[tile.clone()].copy_from_slice(&axes.x[column..column + count]);
            self.y.0[tile].fill(axes.y[row]);
            next += count;
        }
    }
}
