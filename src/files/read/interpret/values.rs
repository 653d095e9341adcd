//! Planes of colours, roughness and other gray maps, from stored samples to linear values; choices about them, recorded as assumptions.

use std::fmt::Display;

use glam::Vec3;
use rayon::prelude::*;

use svbrdf_core::material::resize::{self, Filter};
use svbrdf_core::math::real::Real;

use crate::error::Error;
use crate::read::options::transfer::linear;
use crate::read::options::{Albedo, NonFinite, ReadOptions, Role, Roughness, transfer};
use crate::read::raster::{OutOfRange, Raster, Samples, channel_spread};
use crate::read::record::{Assumption, Certainty, Note, Reason, Subject, What};
use crate::read::stored::{Inferred, StoredMap, StoredMaterial};

/// Refuses the first NaN or infinity of any map, or records how many will be replaced, as `options` specify.
///
/// # Errors
/// [`Error::NotFinite`].
pub(crate) fn check(found: &mut StoredMaterial, options: &ReadOptions) -> Result<(), Error> {
    let mut replaced = Vec::new();
    for (map, source) in found.sources() {
        let (mut first, mut nans, mut infinities) = (None, 0, 0);
        for (index, value) in source.raster.channels.iter().flat_map(Samples::not_finite) {
            first = first.or(Some((index, value)));
            if value.is_nan() { nans += 1 } else { infinities += 1 }
        }
        replaced.extend(few_bits(&source.raster).map(|bits| {
            let why = Reason::measured(format!(
                "no sample of the {} map takes more than {bits} of its 16 bits, which stand for [0, 1]",
                map.name()
            ));
            Assumption::new(What::Values, "as stored", why, Certainty::Unsure)
        }));
        let Some((index, value)) = first else { continue };
        match options.non_finite.unwrap_or_default() {
            NonFinite::Refuse => {
                return Err(Error::NotFinite {
                    path: source.file.clone(),
                    map: map.name(),
                    column: index % source.raster.width,
                    row: index / source.raster.width,
                    value,
                    nans,
                    infinities,
                });
            }
            NonFinite::Replace => {
                let (count, map) = (nans + infinities, map.name());
                let why = Reason::measured(format!("{count} samples of the {map} map are NaN or infinite"));
                replaced.push(Assumption::new(What::Values, NonFinite::Replace, why, Certainty::Given));
            }
        }
    }
    found.assumptions.extend(replaced);
    Ok(())
}

/// How many bits the samples of a picture of 16 bits take, where these are 8, 10 or 12: some programs store what has so many without scaling
/// it.
fn few_bits(raster: &Raster) -> Option<u32> {
    let stored = raster.channels.iter().filter(|_| raster.depth == "16-bit");
    let most = stored.flat_map(|plane| raster.sampled().map(|index| plane.stored(index))).fold(0.0, f64::max);
    [8, 10, 12].into_iter().find(|bits| (0.5..1.0).contains(&(most / f64::from(1 << bits))))
}

/// `value` in [0, 1], or `instead` of NaN and infinity.
pub(crate) fn unit(value: f64, instead: f64) -> f64 {
    if value.is_finite() { value.clamp(0.0, 1.0) } else { instead }
}

/// Values that lay outside [0, 1], how many for each map, and how far.
#[derive(Debug, Default)]
pub(crate) struct Clamped {
    maps: Vec<(Role, OutOfRange)>,
}

impl Clamped {
    /// Adds the numbers of the map `map` that lie outside [0, 1].
    pub(crate) fn add(&mut self, numbers: OutOfRange, map: Role) {
        match self.maps.iter_mut().find(|(role, _)| *role == map) {
            Some((_, sum)) => *sum = sum.merged(numbers),
            None if numbers.count > 0 => self.maps.push((map, numbers)),
            None => (),
        }
    }

    pub(crate) fn record(self, assumptions: &mut Vec<Assumption>) {
        for (map, OutOfRange { count, low, high }) in self.maps {
            let why = Reason::measured(format!(
                "{count} samples of the {} map lie outside, between {low} and {high}",
                map.name()
            ));
            let clamped = Assumption::new(What::Values, "clamped to [0, 1]", why, Certainty::Unsure);
            assumptions.push(clamped);
        }
    }
}

/// The `specified` value, else the `inferred`, else the `detected` one; recorded.
pub(crate) fn decide<T: Copy + Display>(
    assumptions: &mut Vec<Assumption>,
    what: What,
    specified: Option<T>,
    inferred: Inferred<T>,
    detected: impl FnOnce() -> (T, Reason, Certainty),
) -> T {
    if let Some(value) = specified {
        assumptions.push(Assumption::given(what, value));
        return value;
    }
    let (value, why, certainty) = inferred.unwrap_or_else(detected);
    assumptions.push(Assumption::new(what, value, why, certainty));
    value
}

/// Channels of a gray map that differ by less were gray before they were rounded.
const ROUNDING: f64 = 2.0 / 255.0;

/// The linear planes of a colour, stored in this encoding.
pub(super) fn colour_planes<T: Real>(
    map: StoredMap,
    encoding: Albedo,
    role: Role,
    size: [usize; 2],
    clamped: &mut Clamped,
    notes: &mut Vec<Note>,
) -> [Vec<T>; 3] {
    let StoredMap { raster, .. } = map;
    let (raster, encoding) = match in_rec709(&raster, encoding) {
        Some(converted) => {
            notes.push(Note::Converted(Subject::Map(role)));
            (converted, Albedo::Linear)
        }
        None => (raster, encoding),
    };
    let (from, last) = (raster.size(), raster.channels.len() - 1);
    let channels = [0, 1, 2].map(|c| &raster.channels[last.min(c)]);
    channels.into_iter().for_each(|plane| clamped.add(plane.out_of_range(), role));
    let planes = Samples::decoded_three(channels, |v| linear(unit(v, 0.0), encoding));
    planes.map(|plane| resize::plane(plane, from, size, Filter::Value))
}

/// The colours of a picture of other primaries, linear in those of Rec. 709, in which white stays within [0, 1] also after rounding;
/// `None` of the primaries of Rec. 709.
fn in_rec709(raster: &Raster, encoding: Albedo) -> Option<Raster> {
    let (matrix, [r, g, b]) = (raster.to_rec709?, raster.channels.as_array::<3>()?.each_ref());
    let stored = |v: f64| linear(if v.is_finite() { v } else { 0.0 }, encoding);
    let mut planes = Samples::decoded_three::<f32>([r, g, b], stored);
    let [r, g, b] = planes.each_mut();
    r.par_iter_mut().zip(g).zip(b).for_each(|((r, g), b)| {
        let rgb = (matrix * Vec3::new(*r, *g, *b).as_dvec3()).to_array();
        [*r, *g, *b] =
            rgb.map(|v| if (v - v.clamp(0.0, 1.0)).abs() < 1e-6 { v.clamp(0.0, 1.0) } else { v } as f32);
    });
    Some(Raster { channels: planes.map(Samples::floats).into(), to_rec709: None, ..raster.without_samples() })
}

/// The red channel of a gray map; noted where the others differ by more than rounding explains.
pub(super) fn gray_plane<T: Real>(
    source: StoredMap,
    map: Role,
    size: [usize; 2],
    clamped: &mut Clamped,
    notes: &mut Vec<Note>,
) -> Vec<T> {
    let raster = &source.raster;
    let channel_spread = channel_spread(&raster.channels);
    if channel_spread > ROUNDING {
        notes.push(Note::ChannelsDiffer { map, channel_spread });
    }
    clamped.add(raster.channels[0].out_of_range(), map);
    let plane = raster.channels[0].decoded(|v| unit(v, 0.0));
    resize::plane(plane, raster.size(), size, Filter::Value)
}

/// The meaning of roughness: as specified, else as the files tell, else the roughness itself.
pub(super) fn roughness_encoding(found: &mut StoredMaterial, options: &ReadOptions) -> Roughness {
    let hint = found.inferred.roughness.take();
    decide(&mut found.assumptions, What::Roughness, options.roughness, hint, || {
        (Roughness::R, Reason::stated("the map is named roughness"), Certainty::Likely)
    })
}

/// The first channel, or the mean of channels that differ; the geometric mean of two widths.
pub(super) fn roughness_plane<T: Real>(
    source: StoredMap,
    code: Roughness,
    size: [usize; 2],
    clamped: &mut Clamped,
    notes: &mut Vec<Note>,
) -> Vec<T> {
    let StoredMap { raster, .. } = source;
    let channels = &raster.channels;
    let value = |v: f64| transfer::roughness(unit(v, 1.0), code);
    let largest = channel_spread(channels);
    let (plane, out_of_range) = if code == Roughness::Anisotropic && channels.len() > 1 {
        notes.push(Note::Changed(format!(
            "The two widths of the roughness map differ by up to {:.4}; an isotropic lobe replaces them.",
            channel_spread(&channels[..2])
        )));
        let top = channels[0].top();
        combined(&channels[..2], |widths| (widths[0] / top * (widths[1] / top)).sqrt(), value)
    } else if largest == 0.0 {
        (channels[0].decoded(value), channels[0].out_of_range())
    } else {
        notes.push(Note::ChannelsDiffer { map: Role::Roughness, channel_spread: largest });
        // Of integers exactly: their sum is one.
        let scale = channels.len() as f64 * channels[0].top();
        combined(channels, |stored| stored.iter().sum::<f64>() / scale, value)
    };
    clamped.add(out_of_range, Role::Roughness);
    resize::plane(plane, raster.size(), size, Filter::Roughness)
}

/// `value` of the number that `of` computes from the stored samples of each texel, and the numbers outside [0, 1].
fn combined<T: Real>(
    channels: &[Samples],
    of: impl Fn(&[f64]) -> f64 + Sync,
    value: impl Fn(f64) -> f64 + Sync,
) -> (Vec<T>, OutOfRange) {
    const CHUNK: usize = 1 << 14;
    /// Texels that stay in the nearest cache.
    const FEW: usize = 1 << 9;
    let mut plane = vec![T::zero(); channels[0].len()];
    let convert = |(number, out): (usize, &mut [T])| {
        let mut out_of_range = OutOfRange::default();
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
                    out_of_range = out_of_range.and(number);
                }
                *out = T::of(value(number));
            }
        }
        out_of_range
    };
    let out_of_range = plane.par_chunks_mut(CHUNK).enumerate().map(convert);
    let out_of_range = out_of_range.reduce(OutOfRange::default, OutOfRange::merged);
    (plane, out_of_range)
}
