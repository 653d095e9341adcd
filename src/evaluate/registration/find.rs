//! The registration of a prediction, found by the maps: normals, diffuse and roughness of the smaller one in the larger one.

use rayon::prelude::*;

use svbrdf_core::error::Error;
use svbrdf_core::loss::check_same_size;
use svbrdf_core::material::resize::{self, Filter, Kernel};
use svbrdf_core::material::{Mask, Material};
use svbrdf_core::math::real::Real;

use super::{Registration, in_one_size};

/// Texels of a prediction that it is compared on.
const TEXELS: usize = 1024;
/// Reductions of a ground truth of which a prediction may be a part.
const REDUCTIONS: [usize; 4] = [1, 2, 4, 8];
/// The most places that are tried one by one; maps of more are searched from reduced ones.
const MOST_PLACES: usize = 4096;
/// Places around the best one of reduced maps.
const AROUND: usize = 2;
/// Spread below which a plane says nothing.
const FLAT: f64 = 1e-3;

const RESIZE: Registration = Registration::Resize(Kernel::Area);

/// A registration, and how well the maps correlate in it, at most 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    pub registration: Registration,
    pub correlation: f64,
}

/// The best registration of a pair of different sizes, good or not; `None` where none is possible, or the maps are flat.
pub fn found(truth: &Material<f32>, prediction: &Material<f32>) -> Option<Found> {
    let pair = [truth, prediction].map(Planes::of);
    let resized = is_same_shape(truth.size(), prediction.size())
        .then(|| Some(Found { registration: RESIZE, correlation: of_resized(&pair)? }))
        .flatten();
    let crops = REDUCTIONS.into_iter().filter_map(|reduced| best_crop(&pair, reduced));
    resized.into_iter().chain(crops).max_by(|a, b| a.correlation.total_cmp(&b.correlation))
}

/// The place of `part` in a larger ground truth, and how well the maps correlate there. A reading of `part` that turns values over does not
/// change it.
pub(crate) fn place(truth: &Material<f32>, part: &Material<f32>) -> Option<([usize; 2], f64)> {
    let part = Planes { is_any_reading: true, ..Planes::of(part) };
    match best_crop(&[Planes::of(truth), part], 1)? {
        Found { registration: Registration::Crop { x, y, .. }, correlation } => Some(([x, y], correlation)),
        _ => None,
    }
}

/// The registration that all `pairs` have in common, one of `allowed` or, where that is empty, any, with their mean correlation; `None` where
/// they correlate no better than maps that have nothing to do with each other.
pub fn common(pairs: &[[&Material<f32>; 2]], allowed: &[Registration]) -> Option<Found> {
    // Four planes of unrelated maps correlate by 0.15 at a place, and by three times that at the best of many.
    let least = 0.3 + 0.45 / (pairs.len() as f64).sqrt();
    let mut ways = allowed.to_vec();
    if allowed.is_empty() {
        let each = pairs.par_iter().filter_map(|[truth, prediction]| found(truth, prediction));
        ways = each.map(|one| one.registration).collect();
        ways.extend([Registration::CentreCrop, RESIZE]);
    }
    ways.sort();
    ways.dedup();
    let of = |registration: &Registration| {
        let correlations: Option<Vec<f64>> =
            pairs.par_iter().map(|pair| correlation_of(*pair, *registration)).collect();
        let correlations = correlations?;
        let correlation = correlations.iter().sum::<f64>() / correlations.len().max(1) as f64;
        Some(Found { registration: *registration, correlation })
    };
    let best = ways.iter().filter_map(of).max_by(|a, b| {
        // A crop at the centre by its name.
        let order = |one: &Found| (one.correlation, one.registration == Registration::CentreCrop);
        order(a).partial_cmp(&order(b)).unwrap_or(std::cmp::Ordering::Equal)
    });
    best.filter(|best| best.correlation >= least)
}

/// A ground truth and its predictions, brought to one size.
#[derive(Clone, Debug)]
pub struct Registered<T> {
    /// The ground truth first.
    pub materials: Vec<Material<T>>,
    pub mask: Option<Mask>,
    /// What was done: a line.
    pub note: Option<String>,
}

/// The part of the ground truth, the first of `materials`, that predictions of another size are compared with, of its mask, and these
/// predictions. Of several `ways`, or of none, which are all, the maps decide; where they do not correlate in any, nothing is done.
///
/// # Errors
/// [`Error::SizesDiffer`] where they correlate in none of the `ways` given; as [`Registration::applied`].
pub fn registered<T: Real>(
    materials: Vec<Material<T>>,
    mask: Option<Mask>,
    ways: &[Registration],
) -> Result<Registered<T>, Error> {
    let is_other = |one: &&Material<T>| one.size() != materials[0].size();
    let others: Vec<&Material<T>> = materials.iter().skip(1).filter(is_other).collect();
    let Some(first) = others.first() else { return Ok(Registered { materials, mask, note: None }) };
    let truth = &materials[0];
    let way = match ways {
        [way] => Some(*way),
        ways => {
            let single: Vec<_> = others.iter().map(|one| [truth.cast::<f32>(), one.cast()]).collect();
            let pairs: Vec<[&Material<f32>; 2]> = single.iter().map(|pair| pair.each_ref()).collect();
            common(&pairs, ways).map(|found| found.registration)
        }
    };
    let Some(way) = way else {
        if !ways.is_empty() {
            check_same_size(truth, first)?;
        }
        return Ok(Registered { materials, mask, note: None });
    };
    let ([w, h], [width, height]) = (truth.size(), first.size());
    let note = format!("{way} of a ground truth of {w} x {h} to predictions of {width} x {height}");
    let mask = mask.and_then(|mask| way.of_mask(&mask, first.size()));
    let registered: Vec<_> = materials[1..].iter().map(|one| (Some(one), Some(way))).collect();
    let (part, predictions) = in_one_size(truth, &registered).transpose()?.unzip();
    let predictions = predictions.into_iter().flatten().flatten();
    let materials = part.map(Ok).into_iter().chain(predictions).collect::<Result<_, Error>>()?;
    Ok(Registered { materials, mask, note: Some(note) })
}

/// How well the maps correlate in a registration; `None` where it is impossible.
fn correlation_of(pair: [&Material<f32>; 2], registration: Registration) -> Option<f64> {
    let is_resized = matches!(registration, Registration::Resize(_));
    let is_possible = !is_resized || is_same_shape(pair[0].size(), pair[1].size());
    let [truth, prediction] = registration.applied(pair).ok().filter(|_| is_possible)?;
    let [truth, prediction] = [&truth, &prediction].map(Planes::of);
    let texels = texels(prediction.size);
    prediction.correlation(&truth, [0, 0], &texels)
}

/// Whether one size is the other one but for a factor.
fn is_same_shape(a: [usize; 2], b: [usize; 2]) -> bool {
    (a[0] * b[1]).abs_diff(a[1] * b[0]) <= a[0].max(a[1]).max(b[0]).max(b[1]) / 2
}

fn of_resized([truth, prediction]: &[Planes; 2]) -> Option<f64> {
    let size = if truth.size[0] < prediction.size[0] { truth.size } else { prediction.size };
    let [truth, prediction] = [truth.resized(size), prediction.resized(size)];
    prediction.correlation(&truth, [0, 0], &texels(size))
}

/// The best place of the prediction in the ground truth, reduced by `reduced`.
fn best_crop([truth, prediction]: &[Planes; 2], reduced: usize) -> Option<Found> {
    let size = truth.size.map(|side| side / reduced);
    let room = [0, 1].map(|axis| size[axis].checked_sub(prediction.size[axis]));
    let [Some(right), Some(down)] = room else { return None };
    if right + down == 0 {
        return None;
    }
    let truth = truth.resized(size);
    let (mut coarse, smallest) = (1, prediction.size[0].min(prediction.size[1]));
    while (right / coarse + 1) * (down / coarse + 1) > MOST_PLACES && smallest / (2 * coarse) >= 8 {
        coarse *= 2;
    }
    let mut best: Option<([usize; 2], f64)> = None;
    loop {
        let [truth, prediction] =
            [&truth, prediction].map(|one| one.resized(one.size.map(|side| side / coarse)));
        let texels = texels(prediction.size);
        let most = [0, 1].map(|axis| truth.size[axis].saturating_sub(prediction.size[axis]));
        let range = |axis: usize| match best {
            None => 0..=most[axis],
            Some((at, _)) => {
                (2 * at[axis]).saturating_sub(AROUND).min(most[axis])
                    ..=(2 * at[axis] + AROUND).min(most[axis])
            }
        };
        let places: Vec<[usize; 2]> = range(1).flat_map(|y| range(0).map(move |x| [x, y])).collect();
        let of = |at: &[usize; 2]| Some((*at, prediction.correlation(&truth, *at, &texels)?));
        best = places.par_iter().filter_map(of).max_by(|a, b| a.1.total_cmp(&b.1));
        best?;
        if coarse == 1 {
            break;
        }
        coarse /= 2;
    }
    let ([x, y], correlation) = best?;
    Some(Found { registration: Registration::Crop { x, y, reduced }, correlation })
}

/// Places of texels, spread over a map.
fn texels([width, height]: [usize; 2]) -> Vec<[usize; 2]> {
    let count = width * height;
    // A stride without a factor in common with the width of usual maps.
    let stride = (count / TEXELS).max(1) | 1;
    (0..count).step_by(stride).map(|texel| [texel % width, texel / width]).collect()
}

/// x and y of normals, the mean of diffuse, and roughness.
struct Planes {
    size: [usize; 2],
    planes: [Vec<f32>; 4],
    /// Whether values may be turned over.
    is_any_reading: bool,
}

impl Planes {
    fn of(material: &Material<f32>) -> Self {
        let planes = material.planes();
        let [r, g, b] = &planes.diffuse;
        let diffuse = r.iter().zip(g).zip(b).map(|((r, g), b)| (r + g + b) / 3.0).collect();
        let [x, y, _] = &planes.normal;
        let planes = [x.clone(), y.clone(), diffuse, planes.roughness.clone()];
        Self { size: material.size(), planes, is_any_reading: false }
    }

    fn resized(&self, size: [usize; 2]) -> Self {
        let size = size.map(|side| side.max(1));
        let of = |plane: &Vec<f32>| resize::plane(plane, self.size, size, Filter::Value);
        Self { size, planes: self.planes.each_ref().map(of), ..*self }
    }

    fn values(&self, [x, y]: [usize; 2]) -> [f64; 4] {
        self.planes.each_ref().map(|plane| plane[y * self.size[0] + x].into())
    }

    /// The mean correlation over the planes of values at `texels` with those of `larger` from `at` on; `None` where all are flat.
    fn correlation(&self, larger: &Self, at: [usize; 2], texels: &[[usize; 2]]) -> Option<f64> {
        let pairs =
            texels.iter().map(|[x, y]| [self.values([*x, *y]), larger.values([at[0] + x, at[1] + y])]);
        let all = correlations(pairs).into_iter().flatten();
        mean(all.map(|signed| if self.is_any_reading { signed.abs() } else { signed }))
    }
}

/// The mean of what is known; `None` of nothing.
pub(crate) fn mean(known: impl Iterator<Item = f64>) -> Option<f64> {
    let (count, sum) = known.fold((0, 0.0), |(count, sum), value| (count + 1, sum + value));
    (count > 0).then(|| sum / f64::from(count))
}

/// The correlation of pairs in each plane; `None` where a side is flat.
pub(crate) fn correlations<const PLANES: usize>(
    pairs: impl Iterator<Item = [[f64; PLANES]; 2]>,
) -> [Option<f64>; PLANES] {
    let (mut count, mut sums) = (0.0, [[0.0; PLANES]; 5]);
    for [a, b] in pairs {
        count += 1.0;
        for plane in 0..PLANES {
            let (a, b) = (a[plane], b[plane]);
            for (sum, value) in sums.iter_mut().zip([a, b, a * a, b * b, a * b]) {
                sum[plane] += value;
            }
        }
    }
    std::array::from_fn(|plane| {
        let [a, b, aa, bb, ab] = sums.map(|sum| sum[plane]);
        let spread = |squares: f64, sum: f64| (squares / count - (sum / count).powi(2)).max(0.0).sqrt();
        let (of_a, of_b) = (spread(aa, a), spread(bb, b));
        (of_a > FLAT && of_b > FLAT).then(|| (ab / count - a * b / count.powi(2)) / (of_a * of_b))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt as _, SeedableRng as _};

    /// A smooth material that no other seed has.
    fn material(size: [usize; 2], generator: &mut ChaCha8Rng) -> Material<f32> {
        let mut field = || {
            let mut random = |scale: f32| scale * generator.random_range(-1.0_f32..1.0);
            let waves: Vec<[f32; 3]> = (0..24).map(|_| [random(0.35), random(0.35), random(3.0)]).collect();
            let at = |texel: usize| {
                let [x, y] = [texel % size[0], texel / size[0]].map(|place| place as f32);
                waves.iter().map(|[u, v, phase]| (u * x + v * y + phase).sin()).sum::<f32>() / 24.0
            };
            (0..size[0] * size[1]).map(at).collect::<Vec<f32>>()
        };
        let [x, y, diffuse, roughness] = [field(), field(), field(), field()];
        let unit = |plane: &Vec<f32>| plane.iter().map(|value| 0.5 + 0.45 * value).collect::<Vec<_>>();
        let (gray, ones) = (unit(&diffuse), vec![1.0; x.len()]);
        let planes = svbrdf_core::material::Planes {
            normal: [x, y, ones],
            diffuse: [gray.clone(), gray.clone(), gray.clone()],
            specular: [gray.clone(), gray.clone(), gray],
            roughness: unit(&roughness),
        };
        Material::new("m", size[0], size[1], planes).unwrap()
    }

    /// A prediction with errors: another diffuse, and roughness that says nothing.
    fn worse(material: &Material<f32>, generator: &mut ChaCha8Rng) -> Material<f32> {
        let mut planes = material.planes().clone();
        planes.diffuse.iter_mut().flatten().for_each(|value| *value = (0.3 * *value + 0.1).min(1.0));
        planes.roughness.iter_mut().for_each(|value| *value = generator.random_range(0.2..0.8));
        let [width, height] = material.size();
        Material::new("p", width, height, planes).unwrap()
    }

    #[test]
    fn crops_and_scales_are_found() {
        let mut generator = ChaCha8Rng::seed_from_u64(3);
        let mut right = 0;
        for trial in 0..100 {
            let sides = [generator.random_range(80..200), generator.random_range(80..200)];
            let truth = material(sides, &mut generator);
            let reduced = [1, 1, 1, 2][trial % 4];
            let most = sides.map(|side: usize| side / reduced);
            let expected = if trial % 5 == 4 {
                RESIZE
            } else {
                let [x, y] = [generator.random_range(1..24), generator.random_range(0..24)];
                Registration::Crop { x, y, reduced }
            };
            let size = match expected {
                Registration::Crop { x, y, .. } => {
                    [most[0] - x - generator.random_range(0..8), most[1] - y - generator.random_range(0..8)]
                }
                _ => sides.map(|side| side / 2),
            };
            let blank = Material::uniform("p", size[0], size[1], &truth.texel(0)).unwrap();
            let [part, _] = expected.applied([&truth, &blank]).unwrap();
            let prediction = worse(&part, &mut generator);
            right += usize::from(found(&truth, &prediction).is_some_and(|one| one.registration == expected));
        }
        assert!(right >= 98, "{right} of 100");
    }

    #[test]
    fn what_has_nothing_to_do_with_each_other_is_not_located() {
        let mut generator = ChaCha8Rng::seed_from_u64(4);
        let located = (0..100).filter(|trial| {
            let truth = material([72, 72 + trial % 9], &mut generator);
            let prediction = material([64, 64], &mut generator);
            common(&[[&truth, &prediction]], &[]).is_some()
        });
        assert_eq!(located.count(), 0, "of 100");
    }
}
