//! From stored samples to the linear values of a material: each choice made here is recorded as an assumption.

use super::assumption::{Assumption, Certainty, What};
use super::evidence;
use super::found::{Found, Hint, Source};
use super::normals;
use super::options::{Albedo, NonFinite, ReadOptions, Roughness};
use super::raster::Samples;
use super::resize::{self, Filter};
use crate::error::Error;
use crate::material::Planes;
use crate::real::Real;

/// Reflectance at normal incidence of what is no metal.
const DIELECTRIC: f64 = 0.04;

/// The planes that the maps of `found` stand for, and their (width, height); each map is let go once it is decoded.
///
/// # Errors
/// [`Error::OutOfRange`] at NaN and infinity, [`Error::SizesDiffer`] where maps have another shape,
/// [`Error::NotAMaterial`] where the normal map is gray.
pub fn planes<T: Real>(found: &mut Found, options: &ReadOptions) -> Result<(Planes<T>, [usize; 2]), Error> {
    let size = common_size(found)?;
    for source in sources(found) {
        check_finite(source.1, source.0, options.non_finite, &mut Vec::new())?;
    }
    say_replaced(found, options);
    let albedo = albedo(found, options);
    let specular_space = specular_space(found, options, albedo);
    let roughness_code = roughness_code(found, options);
    let normal = match found.normal.take() {
        Some(source) => normals::planes(&source, found, options, size)?,
        None => normals::flat(found, size),
    };
    let mut clamped = Clamped::default();
    let mut colour = |source: &Source, space: Albedo, name| -> [Vec<T>; 3] {
        let channels = &source.raster.channels;
        let last = channels.len() - 1;
        let decode = |c: usize| {
            let plane = channels[last.min(c)].decoded(|v| linear(clamped.unit(finite(v, 0.0), name), space));
            resize::plane(plane, source.raster.size(), size, Filter::Value)
        };
        let mut decode = decode;
        [decode(0), decode(1), decode(2)]
    };
    let diffuse = colour(&found.colour, albedo, "diffuse");
    let specular = found.specular.take().map(|source| colour(&source, specular_space, "specular"));
    let roughness = roughness_plane(&found.roughness, roughness_code, size, &mut clamped, &mut found.notes);
    let metallic = found.metallic.take().map(|source| {
        let plane = source.raster.channels[0].decoded(|v| clamped.unit(finite(v, 0.0), "metallic"));
        resize::plane::<T>(plane, source.raster.size(), size, Filter::Value)
    });
    clamped.say(found);
    let (diffuse, specular) = match (metallic, specular) {
        (Some(metallic), _) => from_base(diffuse, &metallic),
        (None, Some(specular)) => (diffuse, specular),
        (None, None) => {
            let why = "there is no specular map; it is that of most that is no metal";
            found.assumptions.push(Assumption::new(What::Missing, "specular 0.04", why, Certainty::Likely));
            (diffuse, [0; 3].map(|_| vec![T::of(DIELECTRIC); size[0] * size[1]]))
        }
    };
    Ok((Planes { normal, diffuse, specular, roughness }, size))
}

/// d = b (1 - m) and s = 0.04 (1 - m) + b m.
fn from_base<T: Real>(mut base: [Vec<T>; 3], metallic: &[T]) -> ([Vec<T>; 3], [Vec<T>; 3]) {
    let specular = base.each_mut().map(|plane| {
        let pairs = plane.iter_mut().zip(metallic);
        pairs
            .map(|(value, &m)| {
                let (b, m) = (value.f64(), m.f64());
                *value = T::of(b * (1.0 - m));
                T::of(DIELECTRIC * (1.0 - m) + b * m)
            })
            .collect()
    });
    (base, specular)
}

/// Every map with its name.
pub fn sources(found: &Found) -> Vec<(&'static str, &Source)> {
    let colour = if found.metallic.is_some() { "base colour" } else { "diffuse" };
    let optional = [("normal", &found.normal), ("specular", &found.specular), ("metallic", &found.metallic)];
    let always = [(colour, &found.colour), ("roughness", &found.roughness)];
    let there = optional.into_iter().filter_map(|(name, source)| source.as_ref().map(|s| (name, s)));
    there.chain(always).collect()
}

/// The size of the largest map; says so where others are smaller.
fn common_size(found: &mut Found) -> Result<[usize; 2], Error> {
    let all: Vec<_> = sources(found)
        .into_iter()
        .map(|(name, s)| (format!("{name} map {}", s.file.display()), name, s.raster.size()))
        .collect();
    let Some((largest_whose, _, largest)) = all.iter().max_by_key(|(.., size)| size[0] * size[1]) else {
        return Ok([0; 2]);
    };
    let [width, height] = *largest;
    let mut smaller = Vec::new();
    for (whose, name, size) in &all {
        // A single value has every shape.
        if *size == [1, 1] {
            continue;
        }
        if size[0] * height != size[1] * width {
            return Err(Error::SizesDiffer {
                first: largest_whose.clone(),
                first_size: *largest,
                second: whose.clone(),
                second_size: *size,
                remedy: "resize them so that the maps of a material have one shape",
            });
        }
        if size != largest {
            smaller.push(format!("{name} from {} x {}", size[0], size[1]));
        }
    }
    if !smaller.is_empty() {
        let chosen = format!("{width} x {height}");
        let why = format!("the largest map has it; resampled bilinearly: {}", smaller.join(", "));
        found.assumptions.push(Assumption::new(What::Size, chosen, why, Certainty::Likely));
    }
    Ok([width, height])
}

/// Counts NaN and infinity; refuses the first one where the user does not want them replaced.
fn check_finite(
    source: &Source,
    map: &'static str,
    policy: NonFinite,
    counts: &mut Vec<usize>,
) -> Result<(), Error> {
    let width = source.raster.width;
    let mut first = None;
    let (mut nans, mut infinities) = (0, 0);
    for channel in &source.raster.channels {
        let Samples::Floats(values) = channel else { continue };
        for (index, value) in values.iter().enumerate().filter(|(_, v)| !v.is_finite()) {
            first = first.or(Some((index, *value)));
            if value.is_nan() { nans += 1 } else { infinities += 1 }
        }
    }
    counts.push(nans + infinities);
    match (first, policy) {
        (Some((index, value)), NonFinite::Refuse) => Err(Error::OutOfRange {
            whose: source.file.display().to_string(),
            map,
            column: index % width,
            row: index / width,
            expected: "finite numbers (--non-finite replace puts others in their place)",
            found: format!("{value}, one of {nans} NaN and {infinities} infinite samples"),
        }),
        _ => Ok(()),
    }
}

fn say_replaced(found: &mut Found, options: &ReadOptions) {
    let mut said = Vec::new();
    for (name, source) in sources(found) {
        let mut counts = Vec::new();
        let _ = check_finite(source, name, NonFinite::Replace, &mut counts);
        if counts.iter().any(|&n| n > 0) {
            let why =
                format!("{} samples of the {name} map are NaN or infinite", counts.iter().sum::<usize>());
            said.push(Assumption::new(What::Values, options.non_finite, why, Certainty::Given));
        }
    }
    found.assumptions.extend(said);
}

/// `value`, or `instead` of NaN and infinity.
fn finite(value: f64, instead: f64) -> f64 {
    if value.is_finite() { value } else { instead }
}

/// What the user said, else the hint, else `detected`; recorded.
pub fn decide<T: Copy + std::fmt::Display>(
    assumptions: &mut Vec<Assumption>,
    what: What,
    given: Option<T>,
    hint: Hint<T>,
    detected: impl FnOnce() -> (T, String, Certainty),
) -> T {
    if let Some(value) = given {
        assumptions.push(Assumption::given(what, value));
        return value;
    }
    let (value, why, certainty) = hint.unwrap_or_else(detected);
    assumptions.push(Assumption::new(what, value, why, certainty));
    value
}

fn albedo(found: &mut Found, options: &ReadOptions) -> Albedo {
    let hint = found.hints.albedo.take();
    let specular = found.specular.as_ref().map(|source| evidence::specular_median(&source.raster));
    decide(&mut found.assumptions, What::Albedo, options.albedo, hint, || match specular {
        None => {
            (Albedo::Srgb, "colours in files of their own are sRGB by custom".to_owned(), Certainty::Likely)
        }
        Some(median) => by_median(median),
    })
}

/// What the median of specular says: 0.04 stored as it is, or encoded.
fn by_median(median: f64) -> (Albedo, String, Certainty) {
    let measured = format!("the median of specular is {median:.3}");
    match median {
        0.03..=0.06 => (Albedo::Linear, format!("{measured}, 0.04 as it is"), Certainty::Likely),
        0.2..=0.26 => (Albedo::Srgb, format!("{measured}, 0.04 encoded"), Certainty::Likely),
        _ => (
            Albedo::Srgb,
            format!("colours in files of their own are sRGB by custom; {measured}, which tells nothing"),
            Certainty::Unsure,
        ),
    }
}

fn specular_space(found: &mut Found, options: &ReadOptions, albedo: Albedo) -> Albedo {
    let Some(source) = &found.specular else { return albedo };
    let median = evidence::specular_median(&source.raster);
    let hint = found.hints.specular.take();
    let chosen = options.specular.or(options.albedo).or(hint.as_ref().map(|h| h.0)).unwrap_or(albedo);
    let (says, why, certainty) = by_median(median);
    let contradicts =
        (says == Albedo::Linear) != (chosen == Albedo::Linear) && certainty == Certainty::Likely;
    let assumption = if options.specular.or(options.albedo).is_some() {
        Assumption::given(What::Specular, chosen)
    } else if contradicts && !source.raster.is_float() {
        Assumption::new(
            What::Specular,
            chosen,
            format!("by convention, but {why}: look at it"),
            Certainty::Unsure,
        )
    } else if let Some((_, why, certainty)) = hint {
        Assumption::new(What::Specular, chosen, why, certainty)
    } else {
        Assumption::new(What::Specular, chosen, why, certainty)
    };
    found.assumptions.push(assumption);
    chosen
}

fn roughness_code(found: &mut Found, options: &ReadOptions) -> Roughness {
    let hint = found.hints.roughness.take();
    decide(&mut found.assumptions, What::Roughness, options.roughness, hint, || {
        (Roughness::R, "it is called roughness".to_owned(), Certainty::Likely)
    })
}

/// The first channel, or the mean of channels that differ.
fn roughness_plane<T: Real>(
    source: &Source,
    code: Roughness,
    size: [usize; 2],
    clamped: &mut Clamped,
    notes: &mut Vec<String>,
) -> Vec<T> {
    let channels = &source.raster.channels;
    let mut value = |v: f64| roughness(clamped.unit(finite(v, 1.0), "roughness"), code);
    let largest = channel_spread(channels);
    let plane = if largest == 0.0 {
        channels[0].decoded(value)
    } else {
        notes.push(format!(
            "The red, green and blue of the roughness map differ by up to {largest:.4}; their mean is used."
        ));
        (0..channels[0].len()).map(|i| T::of(value(mean(channels, i)))).collect()
    };
    resize::plane(plane, source.raster.size(), size, Filter::Roughness)
}

/// Of codes exactly: their sum is an integer.
fn mean(channels: &[Samples], index: usize) -> f64 {
    let mut codes = 0.0;
    for channel in channels {
        match channel {
            Samples::Codes { codes: all, .. } => codes += f64::from(all[index]),
            Samples::Floats(all) => codes += f64::from(all[index]),
        }
    }
    let top = match &channels[0] {
        Samples::Codes { max, .. } => f64::from(*max),
        Samples::Floats(_) => 1.0,
    };
    codes / (channels.len() as f64 * top)
}

fn channel_spread(channels: &[Samples]) -> f64 {
    let [red, green, blue] = channels else { return 0.0 };
    if red == green && green == blue {
        return 0.0;
    }
    let spread = |i| {
        let rgb = [red.at(i), green.at(i), blue.at(i)];
        rgb.iter().fold(f64::MIN, |a, &b| a.max(b)) - rgb.iter().fold(f64::MAX, |a, &b| a.min(b))
    };
    (0..red.len()).map(spread).fold(0.0, f64::max)
}

/// The roughness r that a stored `value` of [0, 1] stands for.
fn roughness(value: f64, code: Roughness) -> f64 {
    match code {
        Roughness::R => value,
        Roughness::Gloss => 1.0 - value,
        Roughness::Alpha => value.sqrt(),
        Roughness::Gamma22 => value.powf(2.2),
    }
}

/// The reflectance, in [0, 1], that a stored `value` of [0, 1] stands for.
fn linear(value: f64, albedo: Albedo) -> f64 {
    match albedo {
        Albedo::Linear => value,
        Albedo::Srgb if value <= 0.040_45 => value / 12.92,
        Albedo::Srgb => ((value + 0.055) / 1.055).powf(2.4),
        Albedo::Gamma22 => value.powf(2.2),
    }
}

/// Values that lay outside [0, 1], and how far.
#[derive(Debug, Default)]
struct Clamped {
    maps: Vec<(&'static str, usize, f64, f64)>,
}

impl Clamped {
    fn unit(&mut self, value: f64, map: &'static str) -> f64 {
        if (0.0..=1.0).contains(&value) {
            return value;
        }
        let place = self.maps.iter().position(|m| m.0 == map).unwrap_or_else(|| {
            self.maps.push((map, 0, 0.0, 1.0));
            self.maps.len() - 1
        });
        let entry = &mut self.maps[place];
        *entry = (map, entry.1 + 1, entry.2.min(value), entry.3.max(value));
        value.clamp(0.0, 1.0)
    }

    fn say(self, found: &mut Found) {
        for (map, count, low, high) in self.maps {
            let why = format!("{count} samples of the {map} map lie outside, between {low} and {high}");
            found.assumptions.push(Assumption::new(
                What::Values,
                "clamped to [0, 1]",
                why,
                Certainty::Unsure,
            ));
        }
    }
}
