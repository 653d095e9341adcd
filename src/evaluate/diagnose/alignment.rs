//! Alignments: the displacements, scales and symmetries under which the maps of a prediction correlate best with those of a ground truth.
//!
//! The centre of the prediction in each scale is [placed](place) in reduced maps, and what fits is refined level by level.

use std::ops::Range;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};
use rayon::prelude::*;

use crate::registration::find::{correlations, mean, place};
use svbrdf_core::error::Error;
use svbrdf_core::material::Material;
use svbrdf_core::statistics::sort_by_number;
use svbrdf_files::changes::{Placement, Symmetry};

/// Scales of a prediction by its ground truth.
pub(super) const SCALES: [f64; 2] = [0.8, 1.25];
/// The largest side of maps on which all places are tried, and of maps that are not thinned out before they are reduced.
const SMALL: usize = 64;
const LARGE: usize = 1024;
/// Random texels that a placement is compared on, and displacements around none that are tried at full size.
const TEXELS: usize = 1024;
const NEAR: i32 = 8;
/// Placements of reduced maps that are refined.
const REFINED: usize = 3;
/// How much better the maps have to correlate in an alignment than as they are, and the texels within which it is found.
const BETTER: f64 = 0.002;
const EXACT: f64 = 1.0 / 64.0;

/// The texels of a map that have a value of their own in a placement.
#[derive(Clone, Debug)]
pub(super) struct Interior {
    columns: Range<usize>,
    rows: Range<usize>,
    /// Of the map.
    width: usize,
}

impl Interior {
    /// The texels of a ground truth of a size (width, height) that are on the prediction.
    pub(super) fn new(size: [usize; 2], placement: Placement) -> Self {
        let back = placement.inverse();
        let last = size.map(|side| side as f64 - 1.0);
        let [first, end] = [back.at([0.0; 2], size), back.at(last, size)];
        let range = |axis: usize| {
            let first = (first[axis] - 1e-6).ceil().clamp(0.0, last[axis] + 1.0) as usize;
            let end = ((end[axis] + 1e-6).floor() + 1.0).clamp(0.0, last[axis] + 1.0) as usize;
            first..end.max(first)
        };
        Self { columns: range(0), rows: range(1), width: size[0] }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.columns.is_empty() || self.rows.is_empty()
    }

    /// Whether it has this texel, given as row * width + column.
    pub(super) fn contains(&self, texel: usize) -> bool {
        self.columns.contains(&(texel % self.width)) && self.rows.contains(&(texel / self.width))
    }

    /// Its texels in order.
    pub(super) fn texels(&self) -> Vec<usize> {
        let of_row = |row: usize| self.columns.clone().map(move |column| row * self.width + column);
        self.rows.clone().flat_map(of_row).collect()
    }
}

/// Alignments that lower a loss if any does.
#[derive(Debug)]
pub(super) struct Alignments {
    /// By whole texels, other than none.
    pub(super) shifts: Vec<[i32; 2]>,
    /// By parts of a texel, in any scale.
    pub(super) placement: Option<Placement>,
    /// Symmetries with the shift after each, the best first.
    pub(super) symmetries: Vec<(Symmetry, [i32; 2])>,
}

impl Alignments {
    /// Those of `pair`, a ground truth and a prediction. `seed` names the texels.
    ///
    /// # Errors
    /// Those of [`Material::resized`].
    pub(super) fn of(pair: [&Material<f32>; 2], seed: u64) -> Result<Self, Error> {
        let levels = Levels::new(pair, seed)?;
        let unmoved = levels.full().fit(Placement::NONE).unwrap_or(0.0);
        let is_better = |fit: f64| fit > unmoved + BETTER;
        let placed = levels.placed(SCALES);
        let near = levels.full().nearby();
        let refined: Vec<(Placement, f64)> = placed
            .par_iter()
            .take(REFINED)
            .map(|start| levels.refined(*start, true))
            .chain([levels.full().refined(near, EXACT, true)])
            .collect();
        // Means over texels hide noise in either direction; an error is undone in one.
        let is_one_way = |(one, fit): &(Placement, f64)| {
            levels.full().fit(one.inverse()).is_none_or(|other| other - unmoved < 0.5 * (fit - unmoved))
        };
        let placement = refined.iter().max_by(|a, b| a.1.total_cmp(&b.1));
        let placement =
            placement.filter(|found| is_better(found.1) && is_one_way(found)).map(|(one, _)| *one);
        let of_one_scale = levels.placed([1.0; 2]);
        let moved = of_one_scale.iter().map(|start| levels.refined(*start, false).0);
        let mut shifts: Vec<_> = moved.chain([near]).chain(placement).map(whole).collect();
        shifts.sort_unstable();
        shifts.dedup();
        shifts.retain(|by| *by != [0, 0]);
        let mut symmetries = Vec::new();
        let small = &levels.0[0];
        let unmoved = small.fit(Placement::NONE).unwrap_or(0.0);
        for symmetry in Symmetry::of(pair[0].size()) {
            let turned = symmetry.applied(&small.prediction)?;
            let fit = place(&small.truth, &centre(&turned, 1.0)?).map_or(0.0, |(_, fit)| fit);
            symmetries.extend((fit > unmoved + BETTER).then_some((symmetry, fit)));
        }
        sort_by_number(&mut symmetries, |(_, fit)| -fit);
        let shifted = |(symmetry, _): (Symmetry, f64)| {
            let turned = Levels::new([pair[0], &symmetry.applied(pair[1])?], seed)?;
            let best = turned.placed([1.0; 2]).first().map(|start| turned.refined(*start, false).0);
            Ok((symmetry, best.map_or([0, 0], whole)))
        };
        let symmetries = symmetries.into_iter().take(2).map(shifted).collect::<Result<_, Error>>()?;
        let placement = placement.filter(|one| !is_whole(*one, pair[0].size()));
        Ok(Self { shifts, placement, symmetries })
    }
}

/// Whether a placement is a displacement by whole texels, as far as it is found.
fn is_whole(placement: Placement, size: [usize; 2]) -> bool {
    let edge = 0.5 * size[0].max(size[1]) as f64;
    let is_exact = |off: f64| off.abs() <= EXACT;
    placement.by.iter().all(|by| is_exact(by - by.round())) && is_exact((placement.scale - 1.0) * edge)
}

/// The displacement by whole texels.
fn whole(placement: Placement) -> [i32; 2] {
    placement.by.map(|by| by.round() as i32)
}

/// The central half of a prediction that is `scale` times as large as its ground truth, in the size of that.
fn centre(prediction: &Material<f32>, scale: f64) -> Result<Material<f32>, Error> {
    let [width, height] = prediction.size();
    let half = [width, height].map(|side| side.div_ceil(2));
    let from = [(width - half[0]) / 2, (height - half[1]) / 2];
    let texels: Vec<usize> =
        (0..half[0] * half[1]).map(|i| (from[1] + i / half[0]) * width + from[0] + i % half[0]).collect();
    let size = half.map(|side| ((side as f64 / scale).round() as usize).max(1));
    prediction.gathered(&texels, half).resized(size)
}

/// A pair in growing sizes; the last one is its own.
#[derive(Debug)]
struct Levels(Vec<Level>);

#[derive(Debug)]
struct Level {
    truth: Material<f32>,
    prediction: Material<f32>,
    /// Random places of the ground truth.
    texels: Vec<[usize; 2]>,
}

impl Levels {
    fn new(pair: [&Material<f32>; 2], seed: u64) -> Result<Self, Error> {
        let level = |[truth, prediction]: [Material<f32>; 2]| {
            let mut generator = ChaCha8Rng::seed_from_u64(seed);
            let [width, height] = truth.size();
            let random = |_| [generator.random_range(0..width), generator.random_range(0..height)];
            Level { texels: (0..TEXELS).map(random).collect(), truth, prediction }
        };
        let mut all = vec![level(pair.map(Clone::clone))];
        let side = |level: &Level| level.truth.width().max(level.truth.height());
        while let Some(last) = all.last().filter(|last| side(last) > SMALL) {
            let by = side(last).div_ceil(LARGE).max(2);
            let is_large = side(last) > LARGE;
            let reduced = |material: &Material<f32>| {
                let size = material.size().map(|side| (side / by).max(1));
                if !is_large {
                    return material.clone().resized(size);
                }
                let middle =
                    |i: usize| (i / size[0] * by + by / 2) * material.width() + i % size[0] * by + by / 2;
                let count = material.width() * material.height();
                let texels: Vec<_> = (0..size[0] * size[1]).map(|i| middle(i).min(count - 1)).collect();
                Ok(material.gathered(&texels, size))
            };
            let next = [reduced(&last.truth)?, reduced(&last.prediction)?];
            all.push(level(next));
        }
        all.reverse();
        Ok(Self(all))
    }

    fn full(&self) -> &Level {
        &self.0[self.0.len() - 1]
    }

    /// Placements of the smallest maps in all scales of a range, the best first.
    fn placed(&self, [least, most]: [f64; 2]) -> Vec<Placement> {
        let Level { truth, prediction, .. } = &self.0[0];
        let size = truth.size();
        let half = size[0].max(size[1]).div_ceil(2) as f64;
        let sides = (half / most).round() as usize..=(half / least).round() as usize;
        let of_side = |side: usize| {
            let part = centre(prediction, half / side as f64).ok()?;
            let ([x, y], fit) = place(truth, &part)?;
            let scale = half / side as f64;
            // The middle of the part, on either map.
            let along = |axis: usize, at: usize| {
                let half = size[axis].div_ceil(2);
                let of_prediction = ((size[axis] - half) / 2) as f64 + 0.5 * (half as f64 - 1.0);
                let of_truth = at as f64 + 0.5 * (part.size()[axis] as f64 - 1.0);
                let centre = 0.5 * (size[axis] as f64 - 1.0);
                of_prediction - centre - (of_truth - centre) * scale
            };
            Some((Placement { scale, by: [along(0, x), along(1, y)] }, fit))
        };
        let mut all: Vec<_> = sides.filter_map(of_side).collect();
        sort_by_number(&mut all, |(_, fit)| -fit);
        all.into_iter().map(|(placement, _)| placement).collect()
    }

    /// A placement of the smallest maps on the largest ones, refined.
    fn refined(&self, start: Placement, scales: bool) -> (Placement, f64) {
        let (mut placement, mut size) = (start, self.0[0].truth.size());
        let mut fit = 0.0;
        for (number, level) in self.0.iter().enumerate() {
            let next = level.truth.size();
            let by = [0, 1].map(|axis| placement.by[axis] * next[axis] as f64 / size[axis] as f64);
            let exact = if number + 1 == self.0.len() { EXACT } else { 0.25 };
            (placement, fit) = level.refined(Placement { by, ..placement }, exact, scales);
            size = next;
        }
        (placement, fit)
    }
}

impl Level {
    /// How well the maps correlate in a placement, as the mean of the absolute value over planes: a reading that turns values over does
    /// not change it. `None` where all planes are flat, or too few texels are on both.
    fn fit(&self, placement: Placement) -> Option<f64> {
        let size = self.truth.size();
        let interior = Interior::new(size, placement);
        let texel = |[x, y]: &[usize; 2]| y * size[0] + x;
        let texels = self.texels.iter().map(texel).filter(|texel| interior.contains(*texel));
        let pairs: Vec<[[f64; 4]; 2]> = texels
            .map(|texel| {
                let mut there = [0.0; 4];
                for (at, weight) in placement.taps(texel, size) {
                    let values = values(&self.prediction, at);
                    there.iter_mut().zip(values).for_each(|(sum, value)| *sum += f64::from(weight) * value);
                }
                [values(&self.truth, texel), there]
            })
            .collect();
        let is_known = 4 * pairs.len() >= self.texels.len();
        mean(correlations(pairs.into_iter()).into_iter().flatten().map(f64::abs)).filter(|_| is_known)
    }

    /// The best displacement by whole texels of all near none.
    fn nearby(&self) -> Placement {
        let most = self.truth.size().map(|side| NEAR.min(side as i32 / 4));
        let all = (-most[1]..=most[1]).flat_map(|down| (-most[0]..=most[0]).map(move |right| [right, down]));
        let all: Vec<[i32; 2]> = all.filter(|by| *by != [0, 0]).collect();
        let fit = |by: &[i32; 2]| Some((Placement::moved(*by), self.fit(Placement::moved(*by))?));
        let best = all.par_iter().filter_map(fit).max_by(|a, b| a.1.total_cmp(&b.1));
        best.map_or(Placement::NONE, |(placement, _)| placement)
    }

    /// The best placement near one, within `exact` texels, by steps along each of its numbers.
    fn refined(&self, mut best: Placement, exact: f64, scales: bool) -> (Placement, f64) {
        let size = self.truth.size();
        let edge = 0.5 * size[0].max(size[1]) as f64;
        let mut fit = self.fit(best).unwrap_or(0.0);
        let mut step = 1.0;
        while step >= exact {
            let moved = |axis: usize, by: f64| {
                let mut moved = best;
                moved.by[axis] += by * step;
                moved
            };
            let scaled = |by: f64| Placement { scale: best.scale + by * step / edge, ..best };
            let all =
                [moved(0, 1.0), moved(0, -1.0), moved(1, 1.0), moved(1, -1.0), scaled(1.0), scaled(-1.0)];
            let tried = all[..if scales { 6 } else { 4 }].iter();
            let tried = tried.filter_map(|one| Some((*one, self.fit(*one)?)));
            match tried.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, new)| *new > fit) {
                Some(better) => (best, fit) = better,
                None => step *= 0.5,
            }
        }
        (best, fit)
    }
}

/// x and y of a normal, the mean of diffuse, and roughness.
fn values(material: &Material<f32>, texel: usize) -> [f64; 4] {
    let planes = material.planes();
    let diffuse = planes.diffuse.iter().map(|plane| plane[texel]).sum::<f32>() / 3.0;
    [planes.normal[0][texel], planes.normal[1][texel], diffuse, planes.roughness[texel]].map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interior_has_the_texels_that_are_on_both() {
        let texels = |size, by| Interior::new(size, Placement::moved(by)).texels();
        assert_eq!(texels([3, 2], [-1, 0]), [1, 2, 4, 5]);
        assert_eq!(texels([3, 2], [1, 1]), [0, 1]);
        assert_eq!(texels([2, 2], [0, 0]), [0, 1, 2, 3]);
        let twice = Placement { scale: 2.0, by: [0.0; 2] };
        assert_eq!(Interior::new([5, 1], twice).texels(), [1, 2, 3]);
    }
}
