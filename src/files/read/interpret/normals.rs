//! Normal maps: how their components are stored and where y points.

use rayon::prelude::*;

use svbrdf_core::material::resize::{self, Filter};
use svbrdf_core::math::real::Real;

use super::heights::{self, HeightEvidence, is_contradicted};
use super::values::decide;
use crate::error::Error;
use crate::read::options::{NormalEncoding, NormalY, ReadOptions};
use crate::read::raster::measure::{self, NORMAL_AT_LEAST};
use crate::read::raster::{self, Raster, Samples};
use crate::read::record::{Assumption, Certainty, Note, Reason, What};
use crate::read::stored::{Inferred, StoredMaterial};

/// Shorter vectors have no direction: the gray of 127 or 128 is one of length 0.007.
const SHORTEST: f64 = 0.02;
/// Sum of the components of a vector, as far down as black, below which none is meant.
const BLACK: f64 = -2.9;
/// Below this correlation of the curl test an unlabelled map is taken to be y down: of 20 maps of known direction
/// none with y up lies below it.
const DOWN: f64 = -0.05;
/// Heights whose slopes correlate better with the normals outweigh the curl test.
const CLEAR: f64 = 0.5;
/// Above this correlation it is taken to be y up.
const UP: f64 = 0.1;

/// Share of the texels of an unsigned map that filters may have made negative.
const OVERSHOOT: f64 = 0.1;

/// From this mean distance of the lengths from 1 it is noted: beside it, losses of renderers that do not normalize are right.
const OFF_UNIT: f64 = 1e-3;

/// Squared sine of the slope above which z is visibly below 1.
const STEEP: f64 = 0.05;

/// The components of the normals, not yet of unit length, y up.
///
/// # Errors
/// [`Error::NotAMaterial`] where the map is gray.
pub(super) fn planes<T: Real>(
    found: &mut StoredMaterial,
    options: &ReadOptions,
    size: [usize; 2],
) -> Result<[Vec<T>; 3], Error> {
    let heights = heights::evidence(found, options);
    let Some(source) = found.normal.take() else { return Ok(flat(found, size)) };
    let raster = &source.raster;
    if raster.channels.len() < 2 {
        return Err(Error::NotAMaterial {
            path: source.file,
            expected: "a normal map in RGB".to_owned(),
            found: "one in gray".to_owned(),
            remedy: "give a normal map, not a height map".to_owned(),
        });
    }
    let (encoding, why, share) = encoding_of(raster);
    let is_usual = encoding == NormalEncoding::Unsigned || raster.is_float();
    // Where few texels have unit length, either reading may be wrong.
    let is_unit =
        share >= NORMAL_AT_LEAST || share >= NORMAL_AT_LEAST * (1.0 - share_without_direction(raster));
    let certainty = if is_usual && is_unit { Certainty::Likely } else { Certainty::Unsure };
    // A format that defines all three components leaves none to be rebuilt.
    let is_rebuilt = matches!(encoding, NormalEncoding::Xy | NormalEncoding::Ag) && raster.channels.len() > 2;
    let defined = found.inferred.normal_encoding.take().filter(|_| is_rebuilt);
    let encoding =
        decide(&mut found.assumptions, What::NormalEncoding, options.normal_encoding, defined, || {
            (encoding, why, certainty)
        });
    let off = off_unit(raster, encoding);
    if off > OFF_UNIT {
        found.notes.push(Note::NormalLengths(off));
    }
    let y = normal_y(raster, encoding, found, heights, options);
    let (mut planes, missing) = decoded::<T>(raster, encoding, y);
    if missing > 0 {
        let why = Reason::measured(format!(
            "{missing} texels have no direction: they are black, gray or not finite"
        ));
        found.assumptions.push(Assumption::new(What::Values, "normal (0, 0, 1)", why, Certainty::Unsure));
    }
    let from = raster.size();
    drop(source);
    if from != size {
        planes = planes.map(|plane| resize::plane(plane, from, size, Filter::Value));
    }
    Ok(planes)
}

/// Normals of a material without a normal map.
fn flat<T: Real>(found: &mut StoredMaterial, size: [usize; 2]) -> [Vec<T>; 3] {
    // A file that lists its textures has no other ones.
    let (why, certainty) = match found.assumptions.iter().any(|one| one.why == Reason::LISTED) {
        true => ("the file lists its textures, and none of normals; the surface is flat", Certainty::Sure),
        false => ("there is no normal map; the surface is taken as flat", Certainty::Unsure),
    };
    let missing = Assumption::new(What::Missing, "normal (0, 0, 1)", Reason::measured(why), certainty);
    found.assumptions.push(missing);
    [T::zero(), T::zero(), T::one()].map(|value| vec![value; size[0] * size[1]])
}

/// How the components are stored, the reason, and the share of the texels that have unit length so where that is the reason, else 1; 0
/// of normals that were saved as colours.
fn encoding_of(raster: &Raster) -> (NormalEncoding, Reason, f64) {
    let range = |plane: &Samples| {
        let values = raster.sampled().map(|i| plane.at(i));
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    };
    if raster.channels.len() == 2 {
        return two_channels(raster);
    }
    let [x, _, z] = [0, 1, 2].map(|c| range(&raster.channels[c]));
    if let Some(alpha) = &raster.alpha
        && x.0 > 0.98
        && range(alpha).1 - range(alpha).0 > 0.05
    {
        return (NormalEncoding::Ag, Reason::measured("red is 1 everywhere, alpha varies"), 1.0);
    }
    let score = measure::normal_score(raster);
    if raster.is_float() {
        // Filters overshoot: lengths tell signed from unsigned, a negative value does not.
        let signed = measure::signed_normal_score(raster);
        if signed > score {
            return (NormalEncoding::Signed, unit_length(true, signed), signed);
        }
    }
    if !raster.is_float() && score < NORMAL_AT_LEAST {
        let without = measure::curved_normal_score(raster);
        if without > NORMAL_AT_LEAST {
            let why = Reason::measured(format!(
                "the map seems to be saved as colours, through the sRGB curve: {:.0}% of the texels have length 1 as they are, \
                 {:.0}% without the curve; save it again as data",
                100.0 * score,
                100.0 * without
            ));
            return (NormalEncoding::Unsigned, why, 0.0);
        }
    }
    // Blue 1 everywhere is also what a flat map has: only slopes that it cannot have tell.
    let steep = |i: usize| {
        let [x, y, _] = raster.rgb(i).map(|c| 2.0 * c - 1.0);
        x * x + y * y > STEEP
    };
    if z.1 < 0.02 || (z.0 > 0.98 && raster.sampled().any(steep)) {
        let why = Reason::measured(format!("blue is {:.0} everywhere", z.0.round()));
        return (NormalEncoding::Xy, why, 1.0);
    }
    (NormalEncoding::Unsigned, unit_length(false, score), score)
}

/// A picture that is named after normals holds them in the usual way where their lengths confirm it.
fn unit_length(signed: bool, share: f64) -> Reason {
    let text = format!(
        "{:.0}% of the texels have length 1 {}{}{}",
        100.0 * share,
        if signed { "as stored" } else { "if read so" },
        if share < 0.995 { ", the others are normalized" } else { "" },
        if share < 0.6 { "; blue may hold another map, or they are no normals" } else { "" }
    );
    if signed || share > 0.9 { Reason::stated(text) } else { Reason::measured(text) }
}

/// The share of the texels that are black or gray, as outside of an island of coordinates.
fn share_without_direction(raster: &Raster) -> f64 {
    let has_none = |index: &usize| {
        let n = raster.rgb(*index).map(|c| 2.0 * c - 1.0);
        n.iter().sum::<f64>() < BLACK || n.iter().map(|c| c * c).sum::<f64>() < SHORTEST * SHORTEST
    };
    raster.sampled().filter(has_none).count() as f64 / raster.sampled().count().max(1) as f64
}

/// Of x and y alone: signed where a share of the components is negative that overshoot does not explain.
fn two_channels(raster: &Raster) -> (NormalEncoding, Reason, f64) {
    let is_negative = |i: &usize| raster.channels.iter().any(|channel| channel.at(*i) < -0.01);
    let (count, negative) = (raster.sampled().count(), raster.sampled().filter(is_negative).count());
    if raster.is_float() && negative as f64 > OVERSHOOT * count as f64 {
        let values = raster.sampled().flat_map(|i| raster.channels.iter().map(move |c| c.at(i)));
        let why = format!("the least component is {:.2}", values.fold(0.0, f64::min));
        return (NormalEncoding::Signed, Reason::stated(why), 1.0);
    }
    (NormalEncoding::Xy, Reason::stated("the map has two channels"), 1.0)
}

fn vector(raster: &Raster, encoding: NormalEncoding, index: usize) -> [f64; 3] {
    let mut stored = [0.0; 3];
    stored.iter_mut().zip(components(raster, encoding)).for_each(|(value, plane)| *value = plane.at(index));
    vector_of(stored, encoding, raster.channels.len() == 2)
}

/// The channels that hold x, y and, where it is stored, z.
fn components(raster: &Raster, encoding: NormalEncoding) -> impl Iterator<Item = &Samples> {
    let last = raster.channels.len() - 1;
    let x = if encoding == NormalEncoding::Ag { raster.alpha.as_ref() } else { None };
    let others = [1, 2].map(|c| &raster.channels[last.min(c)]);
    [x.unwrap_or(&raster.channels[0])].into_iter().chain(others)
}

/// The vector that is stored as (x, y, z), y as stored; of `two` channels z is not stored.
fn vector_of([x, y, z]: [f64; 3], encoding: NormalEncoding, two: bool) -> [f64; 3] {
    let signed = |value: f64| 2.0 * value - 1.0;
    let with_z = |x: f64, y: f64| [x, y, (1.0 - x * x - y * y).max(0.0).sqrt()];
    match encoding {
        NormalEncoding::Unsigned => [x, y, z].map(signed),
        NormalEncoding::Signed if two => with_z(x, y),
        NormalEncoding::Signed => [x, y, z],
        NormalEncoding::Xy | NormalEncoding::Ag => with_z(signed(x), signed(y)),
    }
}

/// How far the lengths of the stored vectors are from 1 on average, beyond the rounding of their codes; 0 where z is not stored.
fn off_unit(raster: &Raster, encoding: NormalEncoding) -> f64 {
    if raster.channels.len() < 3 || matches!(encoding, NormalEncoding::Xy | NormalEncoding::Ag) {
        return 0.0;
    }
    // Of a code half a step is unknown, of a component between -1 and 1 twice as much.
    let rounding = 3.0_f64.sqrt() * raster::step(raster.depth);
    let off = |i: usize| {
        let length = vector(raster, encoding, i).iter().map(|c| c * c).sum::<f64>().sqrt();
        if length.is_finite() { ((length - 1.0).abs() - rounding).max(0.0) } else { 1.0 }
    };
    raster.sampled().map(off).sum::<f64>() / raster.sampled().count().max(1) as f64
}

fn normal_y(
    raster: &Raster,
    encoding: NormalEncoding,
    found: &mut StoredMaterial,
    heights: Option<HeightEvidence>,
    options: &ReadOptions,
) -> NormalY {
    let curl = measure::curl(raster.width, raster.height, |index| vector(raster, encoding, index));
    let hint = found.inferred.normal_y.take();
    let named = hint.as_ref().is_some_and(|(.., certainty)| *certainty == Certainty::Sure);
    let of_preset = options.preset.and_then(|preset| preset.options().normal_y).filter(|_| !named);
    let given = options.normal_y.or(of_preset);
    let hint = match (heights, given) {
        (Some(heights), None) => Some(by_heights(hint, heights, curl, found)),
        _ => contradicted(hint, curl.filter(|_| given.is_none())),
    };
    decide(&mut found.assumptions, What::NormalY, given, hint, || match curl {
        Some(c) if c <= DOWN => {
            let why = Reason::measured(format!("{}, as of maps with y down", curled(c)));
            (NormalY::Down, why, Certainty::Unsure)
        }
        Some(c) if c >= UP => (NormalY::Up, curled(c), Certainty::Likely),
        // A flat map points nowhere.
        None => (NormalY::Up, Reason::stated("the map has no slopes to tell from"), Certainty::Likely),
        Some(c) => {
            let why = Reason::measured(format!("most maps point up; {}", curled(c)));
            (NormalY::Up, why, Certainty::Unsure)
        }
    })
}

fn curled(correlation: f64) -> Reason {
    Reason::measured(format!("the curl correlation is {correlation:+.2}"))
}

/// A direction that a name or a specification states, unsure where the curl test contradicts it.
fn contradicted(hint: Inferred<NormalY>, curl: Option<f64>) -> Inferred<NormalY> {
    hint.map(|(y, why, certainty)| match curl {
        Some(curl) if is_contradicted(y, curl) => (y, why.contradicted(&curled(curl)), Certainty::Unsure),
        _ => (y, why, certainty),
    })
}

/// The direction that the heights show; that of a name or a specification, where there is one.
fn by_heights(
    hint: Inferred<NormalY>,
    heights: HeightEvidence,
    curl: Option<f64>,
    found: &mut StoredMaterial,
) -> (NormalY, Reason, Certainty) {
    let (y, weakest) = (heights.y(), heights.correlations.map(f64::abs).into_iter().fold(1.0, f64::min));
    found.use_heights(&heights.file);
    let [x, y_of_normals] = heights.correlations;
    let why = Reason::measured(format!(
        "the slopes of {} correlate by {x:+.2} with x of the normals and by {y_of_normals:+.2} with y",
        heights.file.display()
    ));
    match hint {
        Some((named, reason, Certainty::Sure)) if named == y => (y, reason, Certainty::Sure),
        Some((named, reason, Certainty::Sure)) => (named, reason.contradicted(&why), Certainty::Unsure),
        _ => match curl.filter(|curl| weakest < CLEAR && is_contradicted(y, *curl)) {
            Some(curl) => (y, why.contradicted(&curled(curl)), Certainty::Unsure),
            None => (y, why, Certainty::Likely),
        },
    }
}

/// x, y up, z; and how many had no direction.
fn decoded<T: Real>(raster: &Raster, encoding: NormalEncoding, y: NormalY) -> ([Vec<T>; 3], usize) {
    let sign = if y == NormalY::Up { 1.0 } else { -1.0 };
    let two = raster.channels.len() == 2;
    match encoding {
        // By far the most common, and of a loop of its own without branches.
        NormalEncoding::Unsigned => filled(raster, encoding, |stored| {
            let [x, y, z] = stored.map(|value| 2.0 * value - 1.0);
            let is_black = x + y + z < BLACK;
            [x, sign * y, z].map(|component| if is_black { 0.0 } else { component })
        }),
        _ => filled(raster, encoding, |stored| {
            let [x, y, z] = vector_of(stored, encoding, two);
            [x, sign * y, z]
        }),
    }
}

/// The vector that `of` computes from the stored components of each texel, or (0, 0, 1); and how many have no direction.
fn filled<T: Real>(
    raster: &Raster,
    encoding: NormalEncoding,
    of: impl Fn([f64; 3]) -> [f64; 3] + Sync,
) -> ([Vec<T>; 3], usize) {
    const CHUNK: usize = 1 << 14;
    /// Texels that stay in the nearest cache.
    const FEW: usize = 1 << 9;
    let [mut xs, mut ys, mut zs] = [0; 3].map(|_| vec![T::zero(); raster.width * raster.height]);
    let convert = |first: usize, [xs, ys, zs]: [&mut [T]; 3]| {
        let mut stored = [[0.0; FEW]; 3];
        for (plane, stored) in components(raster, encoding).zip(&mut stored) {
            plane.read(first, &mut stored[..xs.len()]);
        }
        let mut missing = 0;
        let texels = xs.iter_mut().zip(ys).zip(zs).zip(stored[0].iter().zip(&stored[1]).zip(&stored[2]));
        for (((x, y), z), ((&stored_x, &stored_y), &stored_z)) in texels {
            let n = of([stored_x, stored_y, stored_z]);
            let squared = n.iter().map(|x| x * x).sum::<f64>();
            let is_direction = squared.is_finite() & (squared >= SHORTEST * SHORTEST);
            missing += usize::from(!is_direction);
            let n = if is_direction { n } else { [0.0, 0.0, 1.0] };
            [*x, *y, *z] = n.map(T::of);
        }
        missing
    };
    let chunks = xs.par_chunks_mut(CHUNK).zip(ys.par_chunks_mut(CHUNK)).zip(zs.par_chunks_mut(CHUNK));
    let missing = chunks.enumerate().map(|(number, ((xs, ys), zs))| {
        let parts = xs.chunks_mut(FEW).zip(ys.chunks_mut(FEW)).zip(zs.chunks_mut(FEW)).enumerate();
        let counts = parts.map(|(part, ((xs, ys), zs))| convert(number * CHUNK + part * FEW, [xs, ys, zs]));
        counts.sum::<usize>()
    });
    let missing = missing.sum();
    ([xs, ys, zs], missing)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A map of these 8-bit values.
    fn map(texels: &[[u8; 3]]) -> Raster {
        let samples = Samples::interleaved(texels.concat(), 3);
        Raster::with_alpha(texels.len(), 1, "8-bit", samples)
    }

    #[test]
    fn normals_that_were_saved_as_colours_are_said() {
        let curve = |value: f64| {
            let encoded =
                if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 };
            (255.0 * encoded).round() as u8
        };
        // Of small slopes blue is almost 1 everywhere.
        for slope in [1.0, 0.3] {
            let direction = |i: u8| {
                let [x, y] = [i % 8, i / 8].map(|i| slope * (f64::from(i) / 8.0 - 0.45));
                [x, y, (1.0 - x * x - y * y).sqrt()]
            };
            let stored = |of: &dyn Fn(f64) -> u8| -> Vec<[u8; 3]> {
                (0..64).map(|i| direction(i).map(|c| of(0.5 * c + 0.5))).collect()
            };
            let (encoding, why, share) = encoding_of(&map(&stored(&curve)));
            assert!(why.to_string().contains("saved as colours") && share == 0.0, "{why}");
            assert_eq!(encoding, NormalEncoding::Unsigned);
            let (_, why, share) = encoding_of(&map(&stored(&|value| (255.0 * value).round() as u8)));
            assert!(share > 0.99, "{why}");
        }
    }
}
