//! Maps as the page stores them: whole numbers, predicted from their neighbours, deflated, in base64.
//!
//! A map of at most 256 values, as of a file in 8 bits, is stored exactly: the values, and 8 bits per texel. Others have 16 bits:
//! diffuse and specular encoded with the sRGB curve, in which dark values are finer; normals as points of the octahedron
//! |x| + |y| + |z| = 1 (Meyer et al. 2010), whose lower half is folded outwards.

use std::collections::BTreeSet;
use std::io::Write as _;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use rayon::prelude::*;
use serde::Serialize;

use svbrdf_core::material::Material;
use svbrdf_core::picture::tone::srgb_encode;
use svbrdf_files::Error;

/// The largest whole number of a plane of 16 bits.
const MOST: f32 = 65_535.0;
/// Half of the whole numbers of a coordinate of the octahedron: 0 is one of them.
const HALF: f32 = 32_767.0;

/// A plane of whole numbers, row 0 on top.
#[derive(Debug, Serialize)]
pub(super) struct Plane {
    data: String,
    /// The values in 8 bits as 32-bit floats; `None`: the plane has 16 bits.
    palette: Option<String>,
}

/// The maps of a material. Maps name their planes; equal channels name the same one.
#[derive(Debug, Serialize)]
pub(super) struct EncodedMaterial {
    name: String,
    width: usize,
    height: usize,
    planes: Vec<Plane>,
    normal: Vec<usize>,
    diffuse: Vec<usize>,
    specular: Vec<usize>,
    roughness: Vec<usize>,
}

impl EncodedMaterial {
    /// The maps of `material`.
    ///
    /// # Errors
    /// [`Error::Internal`], which memory never gives.
    pub(super) fn new(material: &Material<f32>) -> Result<Self, Error> {
        let maps = material.planes();
        let [width, height] = material.size();
        let mut planes: Vec<Plane> = Vec::new();
        let mut add = |channels: &[Vec<f32>], encode: fn(f32) -> f32| {
            let same = |i: usize| (0..i).find(|j| channels[*j] == channels[i]).unwrap_or(i);
            let distinct: Vec<usize> = (0..channels.len()).filter(|i| same(*i) == *i).collect();
            let first = planes.len();
            let encoded = distinct.par_iter().map(|i| Plane::new(&channels[*i], width, encode));
            planes.extend(encoded.collect::<Result<Vec<_>, _>>()?);
            let place = |i| first + distinct.partition_point(|other| *other < same(i));
            Ok::<_, Error>((0..channels.len()).map(place).collect())
        };
        let octahedral = |c: f32| (c + 1.0) * HALF / MOST;
        let normal = match of_8_bits(&maps.normal) {
            Some(codes) => add(&codes, octahedral)?,
            None => add(&octahedron(&maps.normal), octahedral)?,
        };
        let diffuse = add(&maps.diffuse, srgb_encode)?;
        let specular = add(&maps.specular, srgb_encode)?;
        let roughness = add(std::slice::from_ref(&maps.roughness), |x| x)?;
        let name = material.name().to_owned();
        Ok(Self { name, width, height, planes, normal, diffuse, specular, roughness })
    }

    /// The number of bytes of its planes.
    pub(super) fn bytes(&self) -> usize {
        self.planes.iter().map(|plane| plane.data.len() + plane.palette.as_ref().map_or(0, String::len)).sum()
    }
}

/// The components of normals before they were normalized, where all are those of a map in 8 bits: 2 c / 255 - 1.
fn of_8_bits([x, y, z]: &[Vec<f32>; 3]) -> Option<[Vec<f32>; 3]> {
    let found: Option<Vec<[f32; 3]>> =
        x.par_iter().zip(y).zip(z).map(|((&x, &y), &z)| vector_of_8_bits([x, y, z])).collect();
    let found = found?;
    Some([0, 1, 2].map(|c| found.iter().map(|vector| vector[c]).collect()))
}

/// A vector in 8 bits along this normal, the length nearest to 1 first.
fn vector_of_8_bits(normal: [f32; 3]) -> Option<[f32; 3]> {
    const CLOSE: f32 = 1e-6;
    let largest = normal.into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let decoded = |code: f32| (2.0 * code / 255.0) - 1.0;
    let code = |x: f32| ((x + 1.0) * 127.5).round().clamp(0.0, 255.0);
    let start = code(largest);
    let outwards = (0..64u8).flat_map(|i| [start - f32::from(i), start + f32::from(i)]);
    outwards.filter(|c| (0.0..=255.0).contains(c) && decoded(*c) * largest > 0.0).find_map(|c| {
        let length = decoded(c) / largest;
        let vector = normal.map(|n| decoded(code(n * length)));
        let norm = vector.iter().map(|c| c * c).sum::<f32>().sqrt();
        let is_close = vector.iter().zip(normal).all(|(c, n)| (c / norm - n).abs() < CLOSE);
        is_close.then_some(vector)
    })
}

/// The two coordinates of normals on the octahedron, in [-1, 1].
fn octahedron([x, y, z]: &[Vec<f32>; 3]) -> [Vec<f32>; 2] {
    let points = x.par_iter().zip(y).zip(z).map(|((&x, &y), &z)| {
        let sum = x.abs() + y.abs() + z.abs();
        let (u, v) = (x / sum, y / sum);
        if z < 0.0 { ((1.0 - v.abs()).copysign(u), (1.0 - u.abs()).copysign(v)) } else { (u, v) }
    });
    let (u, v) = points.unzip::<f32, f32, Vec<f32>, Vec<f32>>();
    [u, v]
}

/// The distinct values in rising order, where there are at most 256.
fn palette(values: &[f32]) -> Option<Vec<f32>> {
    let mut distinct = BTreeSet::new();
    for value in values {
        // Neither is negative zero a value of its own, nor is there NaN in a material.
        distinct.insert((value + 0.0).to_bits());
        if distinct.len() > 256 {
            return None;
        }
    }
    let mut palette: Vec<f32> = distinct.into_iter().map(f32::from_bits).collect();
    palette.sort_by(f32::total_cmp);
    Some(palette)
}

impl Plane {
    /// `encode` maps values to [0, 1], in which they have 16 bits.
    fn new(values: &[f32], width: usize, encode: fn(f32) -> f32) -> Result<Self, Error> {
        let palette = palette(values);
        let whole: Vec<u16> = match &palette {
            Some(all) => {
                values.iter().map(|value| all.partition_point(|other| other < value) as u16).collect()
            }
            None => values.iter().map(|value| (encode(*value) * MOST).round() as u16).collect(),
        };
        let bytes = residuals(&whole, width, palette.is_some());
        let failed = |problem: std::io::Error| Error::Internal(format!("deflating failed: {problem}"));
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(&bytes).map_err(failed)?;
        let data = BASE64_STANDARD.encode(encoder.finish().map_err(failed)?);
        let bytes_of = |palette: Vec<f32>| palette.iter().flat_map(|value| value.to_le_bytes()).collect();
        let palette = palette.map(|palette| BASE64_STANDARD.encode::<Vec<u8>>(bytes_of(palette)));
        Ok(Self { data, palette })
    }
}

/// What is left of each value after its prediction, left + above - above left: upper bytes, then lower bytes, where there are 16 bits.
fn residuals(values: &[u16], width: usize, is_in_8_bits: bool) -> Vec<u8> {
    let at = |i: usize, is_there: bool, back: usize| if is_there { values[i - back] } else { 0 };
    let residual = |i: usize| {
        let column = i % width;
        let (has_left, has_above) = (column > 0, i >= width);
        let predicted = at(i, has_left, 1).wrapping_add(at(i, has_above, width));
        values[i].wrapping_sub(predicted).wrapping_add(at(i, has_left && has_above, width + 1))
    };
    let all: Vec<u16> = (0..values.len()).map(residual).collect();
    let upper = all.iter().map(|value| (value >> 8) as u8);
    let upper = upper.take(if is_in_8_bits { 0 } else { all.len() });
    upper.chain(all.iter().map(|value| *value as u8)).collect()
}
