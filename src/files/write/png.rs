//! Materials as PNG files: a packed strip, or a folder of one picture a map.

use std::io::{self, Write};
use std::path::Path;

use png::{BitDepth, ColorType, Encoder};
use rayon::prelude::*;

use svbrdf_core::material::{Material, Planes, base_and_metallic};
use svbrdf_core::progress::Progress;

use crate::disk::atomic::SOFTWARE;
use crate::disk::{atomic, new_folder};
use crate::read::options::transfer::{encoded, encoded_roughness};
use crate::read::{Albedo, Energy, NormalY, Order, Preset, ReadOptions, Roughness};

/// About how many bytes of a picture are computed before they are compressed.
const BAND_BYTES: usize = 1 << 20;

/// A file of a folder.
#[derive(Clone, Copy, Debug)]
pub(super) struct FolderPicture<'a> {
    pub name: &'a str,
    pub map: WrittenMap,
    pub encoding: MapEncoding,
}

pub(super) const fn picture(name: &str, map: WrittenMap, encoding: MapEncoding) -> FolderPicture<'_> {
    FolderPicture { name, map, encoding }
}

pub(super) const PLAIN: [FolderPicture<'_>; 4] = [
    picture("normal_gl", WrittenMap::Normal, MapEncoding::SRGB),
    picture("diffuse", WrittenMap::Diffuse, MapEncoding::SRGB),
    picture("roughness", WrittenMap::Roughness, MapEncoding::SRGB),
    picture("specular", WrittenMap::Specular, MapEncoding::SRGB),
];
pub(super) const MATERIAL_GAN: [FolderPicture<'_>; 4] = [
    picture("nom", WrittenMap::Normal, MapEncoding::MATERIAL_GAN),
    picture("dif", WrittenMap::Diffuse, MapEncoding::MATERIAL_GAN),
    picture("rgh", WrittenMap::Roughness, MapEncoding::MATERIAL_GAN),
    picture("spe", WrittenMap::Specular, MapEncoding::MATERIAL_GAN),
];
/// Four tiles in a row, as `like` orders and encodes them.
pub(super) fn packed(
    file: impl Write,
    material: &Material<f32>,
    like: Preset,
    sixteen: bool,
    progress: &Progress,
) -> io::Result<()> {
    let (order, encoding) = (like.order().unwrap_or(Order::NDRS), MapEncoding::from(like));
    let tiles = order.to_string();
    let map = |letter| match letter {
        'n' => WrittenMap::Normal,
        'd' => WrittenMap::Diffuse,
        'r' => WrittenMap::Roughness,
        _ => WrittenMap::Specular,
    };
    let maps: Vec<WrittenMap> = tiles.chars().map(map).collect();
    let rows = TileRows { material, tiles: &maps, encoding, sixteen, progress };
    let meaning = format!("packed {order}, {}", encoding.text());
    // One picture: the other cores compute its rows.
    rows.write(file, &meaning, |first, band| {
        let bytes = rows.row_bytes();
        band.par_chunks_mut(bytes).enumerate().try_for_each(|(row, bytes)| rows.put(first + row, bytes))
    })
}

/// A new folder of pictures.
pub(super) fn folder(
    path: &Path,
    material: &Material<f32>,
    files: &[FolderPicture<'_>],
    sixteen: bool,
    progress: &Progress,
) -> io::Result<()> {
    new_folder::new_folder(path, progress, |folder| {
        files.par_iter().try_for_each(|picture| {
            new_folder::new_file(&folder.join(format!("{}.png", picture.name)), progress, |file| {
                one(file, material, picture, sixteen, progress)
            })
        })
    })
}

/// The picture of one map.
pub(super) fn one(
    file: impl Write,
    material: &Material<f32>,
    FolderPicture { map, encoding, .. }: &FolderPicture<'_>,
    sixteen: bool,
    progress: &Progress,
) -> io::Result<()> {
    let rows = TileRows { material, tiles: &[*map], encoding: *encoding, sixteen, progress };
    rows.write(file, &encoding.text(), |first, band| {
        band.chunks_mut(rows.row_bytes())
            .enumerate()
            .try_for_each(|(row, bytes)| rows.put(first + row, bytes))
    })
}

/// The rows of a picture; in each row one tile beside the other.
struct TileRows<'a> {
    material: &'a Material<f32>,
    tiles: &'a [WrittenMap],
    encoding: MapEncoding,
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
                put(self.encoding.values(self.material, *map, index), out);
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

/// The map in a picture.
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

/// The encoding of colours and roughness.
#[derive(Clone, Copy, Debug)]
pub(super) struct MapEncoding {
    diffuse: Albedo,
    specular: Albedo,
    roughness: Roughness,
    normal_y: NormalY,
    energy: Energy,
}

impl From<Preset> for MapEncoding {
    fn from(preset: Preset) -> Self {
        let ReadOptions { albedo, specular, roughness, normal_y, energy, .. } = preset.options();
        let diffuse = albedo.unwrap_or(Albedo::Linear);
        Self {
            diffuse,
            specular: specular.unwrap_or(diffuse),
            roughness: roughness.unwrap_or(Roughness::R),
            normal_y: normal_y.unwrap_or(NormalY::Up),
            energy: energy.unwrap_or(Energy::Scaled),
        }
    }
}

impl MapEncoding {
    pub(super) const SRGB: Self = Self {
        diffuse: Albedo::Srgb,
        specular: Albedo::Srgb,
        roughness: Roughness::R,
        normal_y: NormalY::Up,
        energy: Energy::Scaled,
    };
    pub(super) const MATERIAL_GAN: Self = Self {
        diffuse: Albedo::Gamma22,
        specular: Albedo::Gamma22,
        roughness: Roughness::Gamma22,
        ..Self::SRGB
    };

    /// For the metadata of a picture.
    pub(super) fn text(&self) -> String {
        let Self { diffuse, specular, roughness, normal_y, energy } = self;
        format!(
            "diffuse {diffuse}, specular {specular}, roughness {roughness}, normal y {normal_y}, energy {energy}"
        )
    }

    /// (red, green, blue) of the texel at `index` as they are stored, in [0, 1].
    pub(super) fn values(&self, material: &Material<f32>, map: WrittenMap, index: usize) -> [f64; 3] {
        let Planes { normal, diffuse, specular, roughness } = material.planes();
        let at = |planes: &[Vec<f32>; 3]| planes.each_ref().map(|plane| f64::from(plane[index]));
        let rough = || encoded_roughness(roughness[index].into(), self.roughness);
        let base_and_metallic = || base_and_metallic(at(diffuse), at(specular));
        let diffuse_code = |value| encoded(value, self.diffuse);
        let specular_code = |value| encoded(value, self.specular);
        match map {
            WrittenMap::Normal => {
                let [x, y, z] = at(normal);
                let y = if self.normal_y == NormalY::Up { y } else { -y };
                [x, y, z].map(|n| (0.5 * n + 0.5).clamp(0.0, 1.0))
            }
            WrittenMap::Diffuse if self.energy == Energy::Unscaled => {
                let [d, s] = [at(diffuse), at(specular)];
                [0, 1, 2].map(|c| diffuse_code(d[c] * (1.0 - s[c])))
            }
            WrittenMap::Diffuse => at(diffuse).map(diffuse_code),
            WrittenMap::Specular => at(specular).map(specular_code),
            WrittenMap::Roughness => [rough(); 3],
            WrittenMap::Base => base_and_metallic().0.map(diffuse_code),
            WrittenMap::Orm => [1.0, rough(), base_and_metallic().1],
            WrittenMap::SpecularTint(reflectance) => {
                at(specular).map(|s| specular_code((s / reflectance).min(1.0)))
            }
        }
    }
}

/// The integer that stands for `value` of [0, 1]; `top` stands for 1.
pub(super) fn code(value: f64, top: u16) -> u16 {
    // By truncation, since rounding is a call on many processors.
    (f64::from(top) * value + 0.5) as u16
}
