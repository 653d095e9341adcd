//! Materials as PNG files: a packed strip, or a folder of one picture a map.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use png::{BitDepth, ColorType, Encoder};
use rayon::prelude::*;

use svbrdf_core::material::{Material, Planes, base_and_metallic};
use svbrdf_core::progress::Progress;

use super::curve::Curve;
use crate::atomic::{self, SOFTWARE};
use crate::read::options::transfer::{encoded, encoded_roughness, linear, roughness};
use crate::read::{Albedo, Energy, NormalY, Order, Preset, ReadOptions, Roughness};

/// About how many bytes of a picture are computed before they are compressed.
const BAND_BYTES: usize = 1 << 20;

/// The map in a picture.
#[derive(Clone, Copy, Debug)]
enum WrittenMap {
    Normal,
    Diffuse,
    Specular,
    Roughness,
    Base,
    /// Occlusion (none), roughness, metallic.
    Orm,
}

/// The encoding of colours and roughness.
#[derive(Clone, Copy, Debug)]
struct MapEncoding {
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
    const SRGB: Self = Self {
        diffuse: Albedo::Srgb,
        specular: Albedo::Srgb,
        roughness: Roughness::R,
        normal_y: NormalY::Up,
        energy: Energy::Scaled,
    };
    const MATERIAL_GAN: Self = Self {
        diffuse: Albedo::Gamma22,
        specular: Albedo::Gamma22,
        roughness: Roughness::Gamma22,
        ..Self::SRGB
    };

    fn text(&self) -> String {
        let Self { diffuse, specular, roughness, normal_y, energy } = self;
        format!(
            "diffuse {diffuse}, specular {specular}, roughness {roughness}, normal y {normal_y}, energy {energy}"
        )
    }

    /// The curves of diffuse, of specular, of roughness and of what is stored as it is.
    fn curves(&self, sixteen: bool) -> Curves {
        let top = if sixteen { u16::MAX } else { 255 };
        let colour = |albedo| match albedo {
            Albedo::Linear => Curve::plain(top, |value| value),
            _ => Curve::rising(top, move |value| encoded(value, albedo), |value| linear(value, albedo)),
        };
        let code = self.roughness;
        let roughness = match code {
            Roughness::Gamma22 => {
                Curve::rising(top, move |r| encoded_roughness(r, code), |value| roughness(value, code))
            }
            _ => Curve::plain(top, move |r| encoded_roughness(r, code)),
        };
        let plain = Curve::plain(top, |value| value);
        Curves { diffuse: colour(self.diffuse), specular: colour(self.specular), roughness, plain }
    }

    /// (red, green, blue) of the texel at `index`, as integers.
    fn of(&self, material: &Material<f32>, map: WrittenMap, index: usize, curves: &Curves) -> [u16; 3] {
        let Planes { normal, diffuse, specular, roughness } = material.planes();
        let at = |planes: &[Vec<f32>; 3]| planes.each_ref().map(|plane| f64::from(plane[index]));
        let rough = || curves.roughness.code(f64::from(roughness[index]));
        let colour = |rgb: [f64; 3], curve: &Curve| rgb.map(|value| curve.code(value));
        match map {
            WrittenMap::Normal => {
                let [x, y, z] = at(normal);
                let y = if self.normal_y == NormalY::Up { y } else { -y };
                [x, y, z].map(|n| curves.plain.code((0.5 * n + 0.5).clamp(0.0, 1.0)))
            }
            WrittenMap::Diffuse if self.energy == Energy::Unscaled => {
                let [d, s] = [at(diffuse), at(specular)];
                colour([0, 1, 2].map(|c| d[c] * (1.0 - s[c])), &curves.diffuse)
            }
            WrittenMap::Diffuse => colour(at(diffuse), &curves.diffuse),
            WrittenMap::Specular => colour(at(specular), &curves.specular),
            WrittenMap::Roughness => [rough(); 3],
            WrittenMap::Base => colour(base_and_metallic(at(diffuse), at(specular)).0, &curves.diffuse),
            WrittenMap::Orm => {
                let metallic = base_and_metallic(at(diffuse), at(specular)).1;
                [curves.plain.code(1.0), rough(), curves.plain.code(metallic)]
            }
        }
    }
}

/// How the values of a material become integers.
struct Curves {
    diffuse: Curve,
    specular: Curve,
    roughness: Curve,
    plain: Curve,
}

/// A file of a folder.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Picture<'a> {
    name: &'a str,
    map: WrittenMap,
    encoding: MapEncoding,
}

const fn picture(name: &str, map: WrittenMap, encoding: MapEncoding) -> Picture<'_> {
    Picture { name, map, encoding }
}

pub(crate) const PLAIN: [Picture<'_>; 4] = [
    picture("normal_gl", WrittenMap::Normal, MapEncoding::SRGB),
    picture("diffuse", WrittenMap::Diffuse, MapEncoding::SRGB),
    picture("roughness", WrittenMap::Roughness, MapEncoding::SRGB),
    picture("specular", WrittenMap::Specular, MapEncoding::SRGB),
];
pub(crate) const MATERIAL_GAN: [Picture<'_>; 4] = [
    picture("nom", WrittenMap::Normal, MapEncoding::MATERIAL_GAN),
    picture("dif", WrittenMap::Diffuse, MapEncoding::MATERIAL_GAN),
    picture("rgh", WrittenMap::Roughness, MapEncoding::MATERIAL_GAN),
    picture("spe", WrittenMap::Specular, MapEncoding::MATERIAL_GAN),
];
pub(crate) const GLTF: [Picture<'_>; 3] = [
    picture("normal_gl", WrittenMap::Normal, MapEncoding::SRGB),
    picture("basecolor", WrittenMap::Base, MapEncoding::SRGB),
    picture("occlusion_roughness_metallic", WrittenMap::Orm, MapEncoding::SRGB),
];

/// Four tiles in a row, as `like` orders and encodes them.
pub(crate) fn packed(
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
    let rows = Rows { material, tiles: &maps, encoding, curves: encoding.curves(sixteen), sixteen, progress };
    let meaning = format!("packed {order}, {}", encoding.text());
    // One picture: the other cores compute its rows.
    rows.write(file, &meaning, |first, band| {
        let bytes = rows.row_bytes();
        band.par_chunks_mut(bytes).enumerate().try_for_each(|(row, bytes)| rows.put(first + row, bytes))
    })
}

/// Fills a temporary folder beside `path` and renames it.
pub(crate) fn folder(
    path: &Path,
    material: &Material<f32>,
    files: &[Picture<'_>],
    sixteen: bool,
    progress: &Progress,
) -> io::Result<()> {
    let temporary = tempfile::Builder::new().prefix(".svbrdf-").tempdir_in(atomic::folder_of(path))?;
    files.par_iter().try_for_each(|Picture { name, map, encoding }| {
        let mut file = fs::File::create(temporary.path().join(format!("{name}.png")))?;
        let (tiles, curves) = (&[*map][..], encoding.curves(sixteen));
        let rows = Rows { material, tiles, encoding: *encoding, curves, sixteen, progress };
        let buffer = io::BufWriter::new(atomic::Watched::new(&mut file, progress));
        rows.write(buffer, &encoding.text(), |first, band| {
            band.chunks_mut(rows.row_bytes())
                .enumerate()
                .try_for_each(|(row, bytes)| rows.put(first + row, bytes))
        })?;
        file.sync_all()
    })?;
    atomic::check(progress)?;
    // Only an empty folder gives way to a rename.
    fs::rename(temporary.path(), path)?;
    #[cfg(unix)]
    fs::set_permissions(path, std::os::unix::fs::PermissionsExt::from_mode(0o755))?;
    let _ = temporary.keep();
    Ok(())
}

/// The rows of a picture; in each row one tile beside the other.
struct Rows<'a> {
    material: &'a Material<f32>,
    tiles: &'a [WrittenMap],
    encoding: MapEncoding,
    curves: Curves,
    sixteen: bool,
    progress: &'a Progress,
}

impl Rows<'_> {
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
                put(self.encoding.of(self.material, *map, index, &self.curves), out);
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
fn put(rgb: [u16; 3], out: &mut [u8]) {
    if out.len() == 6 {
        rgb.into_iter()
            .zip(out.chunks_exact_mut(2))
            .for_each(|(code, out)| out.copy_from_slice(&code.to_be_bytes()));
    } else {
        rgb.into_iter().zip(out).for_each(|(code, out)| *out = code as u8);
    }
}
