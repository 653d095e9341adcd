//! Materials as PNG files: a packed strip, or a folder of one picture a map.

use std::io::{self, Write};
use std::path::Path;

use png::{BitDepth, ColorType, Encoder};
use rayon::prelude::*;

use svbrdf_core::material::{Material, Planes, base_and_metallic};
use svbrdf_core::progress::Progress;

use crate::disk::atomic::SOFTWARE;
use crate::disk::{atomic, own};
use crate::read::Albedo;
use crate::read::options::transfer::{PACKED, encoded, written};

/// About how many bytes of a picture are computed before they are compressed.
const BAND_BYTES: usize = 1 << 20;

pub(super) type NamedMap = (&'static str, WrittenMap);

const FILES: [NamedMap; 4] = [
    ("normal_gl", WrittenMap::Normal),
    ("diffuse", WrittenMap::Diffuse),
    ("roughness", WrittenMap::Roughness),
    ("specular", WrittenMap::Specular),
];

const TILES: [WrittenMap; 4] =
    [WrittenMap::Normal, WrittenMap::Diffuse, WrittenMap::Roughness, WrittenMap::Specular];

/// Four tiles N D R S in a row, linear.
pub(super) fn packed(
    file: impl Write,
    material: &Material<f32>,
    sixteen: bool,
    progress: &Progress,
) -> io::Result<()> {
    let rows = TileRows { material, tiles: &TILES, albedo: Albedo::Linear, sixteen, progress };
    let meaning = format!("{PACKED}{}", written(Albedo::Linear));
    // One picture: the other cores compute its rows.
    rows.write(file, &meaning, |first, band| {
        let bytes = rows.row_bytes();
        band.par_chunks_mut(bytes).enumerate().try_for_each(|(row, bytes)| rows.put(first + row, bytes))
    })
}

pub(super) fn folder(
    path: &Path,
    material: &Material<f32>,
    sixteen: bool,
    progress: &Progress,
) -> io::Result<()> {
    own::new_folder(path, progress, |folder| {
        FILES.par_iter().try_for_each(|(name, map)| {
            own::new_file(&folder.join(format!("{name}.png")), progress, |file| {
                one(file, material, *map, sixteen, progress)
            })
        })
    })
}

/// The picture of one map, colours in sRGB.
pub(super) fn one(
    file: impl Write,
    material: &Material<f32>,
    map: WrittenMap,
    sixteen: bool,
    progress: &Progress,
) -> io::Result<()> {
    let rows = TileRows { material, tiles: &[map], albedo: Albedo::Srgb, sixteen, progress };
    rows.write(file, &written(Albedo::Srgb), |first, band| {
        band.chunks_mut(rows.row_bytes())
            .enumerate()
            .try_for_each(|(row, bytes)| rows.put(first + row, bytes))
    })
}

/// The rows of a picture; in each row one tile beside the other.
struct TileRows<'a> {
    material: &'a Material<f32>,
    tiles: &'a [WrittenMap],
    albedo: Albedo,
    sixteen: bool,
    progress: &'a Progress,
}

impl TileRows<'_> {
    fn pixel_bytes(&self) -> usize {
        if self.sixteen { 6 } else { 3 }
    }

    fn row_bytes(&self) -> usize {
        self.tiles.len() * self.material.width() * self.pixel_bytes()
    }

    /// Puts the samples of row number `row` into `bytes`.
    fn put(&self, row: usize, bytes: &mut [u8]) -> io::Result<()> {
        atomic::check(self.progress)?;
        let (width, pixel) = (self.material.width(), self.pixel_bytes());
        for (map, tile) in self.tiles.iter().zip(bytes.chunks_exact_mut(width * pixel)) {
            for (index, out) in (row * width..).zip(tile.chunks_exact_mut(pixel)) {
                put(map.values(self.material, self.albedo, index), out);
            }
        }
        Ok(())
    }

    /// Writes the picture band by band; `fill` puts the rows from number `first` on into a band.
    fn write(
        &self,
        file: impl Write,
        meaning: &str,
        fill: impl Fn(usize, &mut [u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        let [width, height] = self.material.size();
        let [columns, rows] =
            [self.tiles.len() * width, height].map(|side| u32::try_from(side).map_err(io::Error::other));
        let mut encoder = Encoder::new(file, columns?, rows?);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(if self.sixteen { BitDepth::Sixteen } else { BitDepth::Eight });
        encoder.add_text_chunk("Software".to_owned(), SOFTWARE.to_owned())?;
        encoder.add_text_chunk("svbrdf".to_owned(), meaning.to_owned())?;
        let mut writer = encoder.write_header()?;
        let mut stream = writer.stream_writer()?;
        let rows_of_band = (BAND_BYTES / self.row_bytes()).clamp(1, height);
        let mut band = vec![0; rows_of_band * self.row_bytes()];
        for first in (0..height).step_by(rows_of_band) {
            let band = &mut band[..rows_of_band.min(height - first) * self.row_bytes()];
            fill(first, band)?;
            stream.write_all(band)?;
        }
        stream.finish()?;
        Ok(writer.finish()?)
    }
}

/// The samples of a pixel into 3 bytes, or into 6.
fn put(rgb: [f64; 3], out: &mut [u8]) {
    if out.len() == 6 {
        out.copy_from_slice(rgb.map(|value| code(value, u16::MAX).to_be_bytes()).as_flattened());
    } else {
        out.copy_from_slice(&rgb.map(|value| code(value, 255) as u8));
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) enum WrittenMap {
    Normal,
    Diffuse,
    Specular,
    Roughness,
    Base,
    /// Occlusion (none), roughness, metallic.
    Orm,
    /// Specular as a part of this reflectance.
    SpecularTint(f64),
}

impl WrittenMap {
    /// (red, green, blue) of the texel at `index` as they are stored, in [0, 1].
    fn values(self, material: &Material<f32>, albedo: Albedo, index: usize) -> [f64; 3] {
        let Planes { normal, diffuse, specular, roughness } = material.planes();
        let at = |planes: &[Vec<f32>; 3]| planes.each_ref().map(|plane| f64::from(plane[index]));
        let base_and_metallic = || base_and_metallic(at(diffuse), at(specular));
        let rough = f64::from(roughness[index]);
        let code = |value| encoded(value, albedo);
        match self {
            Self::Normal => at(normal).map(|n| (0.5 * n + 0.5).clamp(0.0, 1.0)),
            Self::Diffuse => at(diffuse).map(code),
            Self::Specular => at(specular).map(code),
            Self::Roughness => [rough; 3],
            Self::Base => base_and_metallic().0.map(code),
            Self::Orm => [1.0, rough, base_and_metallic().1],
            Self::SpecularTint(reflectance) => at(specular).map(|s| code((s / reflectance).min(1.0))),
        }
    }
}

/// The integer that stands for `value` of [0, 1]; `top` stands for 1.
pub(super) fn code(value: f64, top: u16) -> u16 {
    // By truncation, since rounding is a call on many processors.
    (f64::from(top) * value + 0.5) as u16
}
