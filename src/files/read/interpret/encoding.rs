//! From stored samples to the linear values of a material: each choice made here is recorded as an assumption.

use rayon::prelude::*;

use super::colour;
use super::decide::decide;
use super::detect;
use super::normals;
use super::transfer::{self, linear};
use super::values::{self, Clamped, unit};
use super::workflow;
use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::note::{Gray, Note, SpecifiedBy};
use crate::files::read::options::{Albedo, ReadOptions, Roughness};
use crate::files::read::outside::Outside;
use crate::files::read::reason::Reason;
use crate::files::read::role::Role;
use crate::files::read::samples::Samples;
use crate::files::read::spread::spread;
use crate::files::read::storage_convention::StorageConvention;
use crate::files::read::stored::{Inferred, StoredMap, StoredMaterial};
use crate::material::Planes;
use crate::material::resize::{self, Filter};
use crate::math::real::Real;

/// Channels of a gray map that differ by less were gray before they were rounded.
const ROUNDING: f64 = 2.0 / 255.0;

/// The planes that the maps of `found` stand for, and their (width, height); each map is dropped once it is decoded.
///
/// # Errors
/// [`Error::NotFinite`] at NaN and infinity, [`Error::MapSizesDiffer`] where maps have another shape,
/// [`Error::NotAMaterial`] where the normal map is gray.
pub(crate) fn planes<T: Real>(
    found: &mut StoredMaterial,
    options: &ReadOptions,
) -> Result<(Planes<T>, [usize; 2]), Error> {
    let size = found.common_size()?;
    values::check(found, options)?;
    let (albedo, weighed) = albedo(found, options);
    let specular_space = specular_space(found, options, weighed);
    let roughness_code = roughness_code(found, options);
    let normal = match found.normal.take() {
        Some(source) => normals::planes(source, found, options, size)?,
        None => normals::flat(found, size),
    };
    let mut clamped = Clamped::default();
    let mut colour = |source: StoredMap, space: Albedo, map| -> [Vec<T>; 3] {
        let StoredMap { raster, .. } = source;
        let (from, last) = (raster.size(), raster.channels.len() - 1);
        let channels = [0, 1, 2].map(|c| &raster.channels[last.min(c)]);
        channels.into_iter().for_each(|plane| clamped.add(plane.outside_unit(), map));
        let planes = Samples::decoded_three(channels, |v| linear(unit(v, 0.0), space));
        planes.map(|plane| resize::plane(plane, from, size, Filter::Value))
    };
    let diffuse = colour(found.colour.take(), albedo, Role::Diffuse);
    let specular = found.specular.take().map(|source| colour(source, specular_space, Role::Specular));
    let roughness =
        roughness_plane(found.roughness.take(), roughness_code, size, &mut clamped, &mut found.notes);
    let metallic = found
        .metallic
        .take()
        .map(|source| gray::<T>(source, Role::Metallic, size, &mut clamped, &mut found.notes));
    let level = found.level.take().map(|source| {
        found.assumptions.push(workflow::level_assumed(&source));
        gray::<T>(source, Role::SpecularLevel, size, &mut clamped, &mut found.notes)
    });
    clamped.record(found);
    let maps = workflow::Maps { colour: diffuse, specular, metallic, level };
    let (mut diffuse, specular) = maps.separated(size, found, options);
    workflow::unscale_diffuse(&mut diffuse, &specular, found, options);
    let mut planes = Planes { normal, diffuse, specular, roughness };
    if options.flip_v == Some(true) {
        mirror(&mut planes, size[0]);
        found.notes.push(Note::RowsFlipped { by: SpecifiedBy::Caller });
    }
    Ok((planes, size))
}

/// The red channel of a gray map; noted where the others differ by more than rounding explains.
fn gray<T: Real>(
    source: StoredMap,
    map: Role,
    size: [usize; 2],
    clamped: &mut Clamped,
    notes: &mut Vec<Note>,
) -> Vec<T> {
    let raster = &source.raster;
    let spread = spread(&raster.channels);
    if spread > ROUNDING {
        notes.push(Note::ChannelsDiffer { map, spread, used: Gray::Red });
    }
    clamped.add(raster.channels[0].outside_unit(), map);
    let plane = raster.channels[0].decoded(|v| unit(v, 0.0));
    resize::plane(plane, raster.size(), size, Filter::Value)
}

/// Top and bottom exchanged, and the normals with them.
fn mirror<T: Real>(planes: &mut Planes<T>, width: usize) {
    let Planes { normal, diffuse, specular, roughness } = planes;
    normal[1].iter_mut().for_each(|y| *y = -*y);
    for plane in normal.iter_mut().chain(diffuse).chain(specular).chain([roughness]) {
        let height = plane.len() / width;
        for row in 0..height / 2 {
            let (above, below) = plane.split_at_mut((height - 1 - row) * width);
            above[row * width..(row + 1) * width].swap_with_slice(&mut below[..width]);
        }
    }
}

/// How diffuse is stored, and how specular is by the evidence of both, where nothing else tells.
fn albedo(found: &mut StoredMaterial, options: &ReadOptions) -> (Albedo, Inferred<Albedo>) {
    let inferred = found.inferred.albedo.take();
    let is_known = inferred.is_some() && found.inferred.specular.is_some();
    let specular = found.specular.as_ref().filter(|_| options.albedo.is_none() && !is_known);
    let roughness = options.roughness.or(found.inferred.roughness.as_ref().map(|known| known.0));
    let weighed = specular.map(|specular| colour::weigh(&found.colour, specular, roughness));
    let [diffuse, specular] = weighed.map_or([None, None], |both| both.map(Some));
    let albedo = decide(&mut found.assumptions, What::Albedo, options.albedo, inferred, || {
        diffuse.unwrap_or_else(|| colour::alone(&found.colour.raster))
    });
    (albedo, specular)
}

/// What the median of specular suggests: 0.04 stored linearly, or encoded.
fn by_median(median: f64) -> (Albedo, Reason, Certainty) {
    let (albedo, suggests, certainty) = match median {
        0.03..=0.06 => (Albedo::Linear, Some(Albedo::Linear), Certainty::Likely),
        0.2..=0.26 => (Albedo::Srgb, Some(Albedo::Srgb), Certainty::Likely),
        _ => (Albedo::Srgb, None, Certainty::Unsure),
    };
    (albedo, Reason::SpecularMedian { median, suggests }, certainty)
}

fn specular_space(found: &mut StoredMaterial, options: &ReadOptions, weighed: Inferred<Albedo>) -> Albedo {
    let Some(source) = &found.specular else { return Albedo::Srgb };
    let median = detect::specular_median(&source.raster);
    let hint = found.inferred.specular.take();
    let is_known = hint.is_some();
    let hint = hint.or(weighed);
    let chosen = options.specular.or(options.albedo).or(hint.as_ref().map(|h| h.0)).unwrap_or(Albedo::Srgb);
    let (says, why, certainty) = by_median(median);
    let contradicts =
        (says == Albedo::Linear) != (chosen == Albedo::Linear) && certainty == Certainty::Likely;
    let assumption = if options.specular.or(options.albedo).is_some() {
        if contradicts && !source.raster.is_float() {
            found.notes.push(Note::SpecularMedian {
                chosen,
                by: SpecifiedBy::Caller,
                median,
                suggests: says,
            });
        }
        Assumption::given(What::Specular, chosen)
    } else if contradicts
        && is_known
        && !source.raster.is_float()
        && hint.as_ref().is_none_or(|(.., certainty)| *certainty != Certainty::Sure)
    {
        let convention = hint.map_or(StorageConvention::SeparateColours.into(), |(_, why, _)| why);
        let why = Reason::ContradictedBy(Box::new(convention), Box::new(why));
        Assumption::new(What::Specular, chosen, why, Certainty::Unsure)
    } else if let Some((_, why, certainty)) = hint {
        Assumption::new(What::Specular, chosen, why, certainty)
    } else {
        Assumption::new(What::Specular, chosen, why, certainty)
    };
    found.assumptions.push(assumption);
    chosen
}

fn roughness_code(found: &mut StoredMaterial, options: &ReadOptions) -> Roughness {
    let hint = found.inferred.roughness.take();
    decide(&mut found.assumptions, What::Roughness, options.roughness, hint, || {
        (Roughness::R, StorageConvention::RoughnessName.into(), Certainty::Likely)
    })
}

/// The first channel, or the mean of channels that differ; the geometric mean of two widths.
fn roughness_plane<T: Real>(
    source: StoredMap,
    code: Roughness,
    size: [usize; 2],
    clamped: &mut Clamped,
    notes: &mut Vec<Note>,
) -> Vec<T> {
    let StoredMap { raster, .. } = source;
    let channels = &raster.channels;
    let value = |v: f64| transfer::roughness(unit(v, 1.0), code);
    let largest = spread(channels);
    let (plane, outside) = if code == Roughness::Anisotropic && channels.len() > 1 {
        notes.push(Note::Anisotropic { spread: spread(&channels[..2]) });
        let top = channels[0].top();
        combined(&channels[..2], |widths| (widths[0] / top * (widths[1] / top)).sqrt(), value)
    } else if largest == 0.0 {
        (channels[0].decoded(value), channels[0].outside_unit())
    } else {
        notes.push(Note::ChannelsDiffer { map: Role::Roughness, spread: largest, used: Gray::Mean });
        // Of integers exactly: their sum is one.
        let scale = channels.len() as f64 * channels[0].top();
        combined(channels, |stored| stored.iter().sum::<f64>() / scale, value)
    };
    clamped.add(outside, Role::Roughness);
    resize::plane(plane, raster.size(), size, Filter::Roughness)
}

/// `value` of what `of` makes of the stored samples of each texel, and what of that lies outside [0, 1].
fn combined<T: Real>(
    channels: &[Samples],
    of: impl Fn(&[f64]) -> f64 + Sync,
    value: impl Fn(f64) -> f64 + Sync,
) -> (Vec<T>, Outside) {
    const CHUNK: usize = 1 << 14;
    /// Texels that stay in the nearest cache.
    const FEW: usize = 1 << 9;
    let mut plane = vec![T::zero(); channels[0].len()];
    let convert = |(number, out): (usize, &mut [T])| {
        let mut outside = Outside::default();
        let mut stored = vec![[0.0_f32; FEW]; channels.len()];
        let mut texel = vec![0.0; channels.len()];
        for (part, out) in out.chunks_mut(FEW).enumerate() {
            let start = number * CHUNK + part * FEW;
            for (channel, stored) in channels.iter().zip(&mut stored) {
                channel.read_stored(start, &mut stored[..out.len()]);
            }
            for (index, out) in out.iter_mut().enumerate() {
                texel.iter_mut().zip(&stored).for_each(|(texel, stored)| *texel = f64::from(stored[index]));
                let number = of(&texel);
                if number.is_finite() {
                    outside = outside.and(number);
                }
                *out = T::of(value(number));
            }
        }
        outside
    };
    let outside = plane.par_chunks_mut(CHUNK).enumerate().map(convert);
    let outside = outside.reduce(Outside::default, Outside::merged);
    (plane, outside)
}
