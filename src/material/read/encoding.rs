//! From stored codes to the linear values of a material.

use std::path::PathBuf;

use super::decode::Raster;
use super::layout::Found;
use super::names::Map;
use super::options::{Albedo, NormalY, ReadOptions};
use crate::error::Error;
use crate::material::Planes;
use crate::real::Real;

/// The planes that the maps of `found` stand for; notes what was noticed.
///
/// # Errors
/// [`Error::SizesDiffer`], [`Error::NotAMaterial`] where the normal map is gray.
pub fn planes<T: Real>(found: &mut Found, options: &ReadOptions) -> Result<Planes<T>, Error> {
    check_sizes(found)?;
    let Found { maps: [normal, diffuse, roughness, specular], files, notes, .. } = found;
    for (map, raster) in Map::ALL.iter().zip([&*normal, diffuse, roughness, specular]) {
        if raster.transparent {
            notes.push(format!("The {} map is partly transparent; its alpha is ignored.", map.name()));
        }
    }
    notes.push(format!(
        "Diffuse and specular are taken as {}, normals with y {}.",
        options.albedo, options.normal_y
    ));
    Ok(Planes {
        normal: normal_planes(normal, options.normal_y, &files[Map::Normal as usize])?,
        diffuse: colour_planes(diffuse, options.albedo),
        specular: colour_planes(specular, options.albedo),
        roughness: roughness_plane(roughness, notes),
    })
}

fn check_sizes(found: &Found) -> Result<(), Error> {
    let whose = |i: usize| format!("{} map {}", Map::ALL[i].name(), found.files[i].display());
    let size = |i: usize| [found.maps[i].width, found.maps[i].height];
    match (1..found.maps.len()).find(|&i| size(i) != size(0)) {
        None => Ok(()),
        Some(i) => Err(Error::SizesDiffer {
            first: whose(0),
            first_size: size(0),
            second: whose(i),
            second_size: size(i),
            remedy: "resize them so that the maps of a material have one size",
        }),
    }
}

fn normal_planes<T: Real>(raster: &Raster, y: NormalY, file: &PathBuf) -> Result<[Vec<T>; 3], Error> {
    let [xs, ys, zs] = raster.channels.as_slice() else {
        return Err(Error::NotAMaterial {
            path: file.to_owned(),
            expected: "a normal map in RGB".to_owned(),
            found: "one in gray".to_owned(),
            remedy: "give a normal map, not a height map".to_owned(),
        });
    };
    let signed = |value: f64| 2.0 * value - 1.0;
    let flipped = |value: f64| 1.0 - 2.0 * value;
    let ys = match y {
        NormalY::Up => decoded(ys, raster.max, signed),
        NormalY::Down => decoded(ys, raster.max, flipped),
    };
    Ok([decoded(xs, raster.max, signed), ys, decoded(zs, raster.max, signed)])
}

/// RGB; gray stands for all three.
fn colour_planes<T: Real>(raster: &Raster, albedo: Albedo) -> [Vec<T>; 3] {
    let last = raster.channels.len() - 1;
    [0, 1, 2].map(|c| decoded(&raster.channels[last.min(c)], raster.max, |value| linear(value, albedo)))
}

/// The first channel, or the mean of channels that differ.
fn roughness_plane<T: Real>(raster: &Raster, notes: &mut Vec<String>) -> Vec<T> {
    let [red, green, blue] = raster.channels.as_slice() else {
        return decoded(&raster.channels[0], raster.max, |value| value);
    };
    let codes = || red.iter().zip(green).zip(blue).map(|((&r, &g), &b)| [r, g, b]);
    let spread = |[r, g, b]: [u16; 3]| r.max(g).max(b) - r.min(g).min(b);
    let largest = codes().map(spread).max().unwrap_or(0);
    if largest == 0 {
        return decoded(red, raster.max, |value| value);
    }
    let max = f64::from(raster.max);
    notes.push(format!(
        "The red, green and blue of the roughness map differ by up to {:.4}; their mean is used.",
        f64::from(largest) / max
    ));
    codes().map(|rgb| T::of(rgb.map(f64::from).iter().sum::<f64>() / (3.0 * max))).collect()
}

/// The values that `codes` stand for: `decode` of code / `max`, each code decoded once.
fn decoded<T: Real>(codes: &[u16], max: u16, decode: impl Fn(f64) -> f64) -> Vec<T> {
    let table: Vec<T> = (0..=max).map(|code| T::of(decode(f64::from(code) / f64::from(max)))).collect();
    codes.iter().map(|&code| table[usize::from(code)]).collect()
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
