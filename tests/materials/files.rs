//! Files as the tables describe them: pictures by formulas, documents by their text, anything else by its bytes.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::Path;

use exr::prelude::f16;
use image::metadata::Orientation;
use image::{DynamicImage, ImageFormat};
use serde::Deserialize;
use tiff::encoder::{TiffEncoder, colortype};

use super::formula::{Place, values};
use crate::support::png::{self, Png};
use crate::support::textures::dds;

/// The side of a picture.
pub(super) const SIDE: usize = 16;

/// A file: in a table a text, which is the formula of a picture or the text of a document, or these.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Content {
    /// The formula of a picture: tiles of a row with `|` between them, rows with `;`. Of an EXR also `layer.RGB = formula;`, of an npz
    /// `name 16x16x3 type = formula;`, channels first after `planes`.
    pub is: String,
    /// Of a document.
    pub text: Option<String>,
    /// Characters below 256.
    pub bytes: Option<String>,
    /// Of a tile.
    pub(super) size: Option<[usize; 2]>,
    /// Black texels around each tile.
    borders: usize,
    /// Of a sample: 8 by default, 16, `half` or `float`; `u32` and `i16` of a TIFF; 1 to 16 of a PNG of its own.
    pub(super) bits: Option<String>,
    /// Of a PNG: `gray`, `palette` or `rgb`; of its chunks the name and content in hexadecimal.
    colour: Option<String>,
    interlaced: bool,
    chunks: BTreeMap<String, String>,
    /// Of a TIFF.
    orientation: Option<String>,
    pages: Option<usize>,
    /// Of an EXR: the place of the data in the display window, and the size of that.
    pub(super) at: Option<[i32; 2]>,
    pub(super) display: Option<[usize; 2]>,
    pub(super) chromaticities: Option<[[f32; 2]; 4]>,
    pub(super) parts: bool,
    pub(super) compression: String,
    /// Of a DDS: its code of four letters, or the number of its DXGI format, or the words of its pixel format; and its blocks in hexadecimal.
    code: Option<String>,
    blocks: String,
    /// Of a TIFF: whether its alpha multiplies its colours, and whether a page before it is a smaller version of it.
    premultiplied: bool,
    thumbnail: bool,
    /// Bytes in hexadecimal by their place in the file, and text that is inserted there.
    patch: BTreeMap<String, String>,
    insert: BTreeMap<String, String>,
    /// Bytes that are cut off its end.
    cut: usize,
}

impl From<toml::Value> for Content {
    fn from(value: toml::Value) -> Self {
        match value {
            toml::Value::String(text) => Self { is: text, ..Self::default() },
            table => table.try_into().unwrap_or_else(|error| panic!("{error}")),
        }
    }
}

impl Content {
    /// Writes the file.
    pub fn put(&self, path: &Path) {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match (extension.as_str(), &self.text, &self.bytes) {
            (_, Some(text), _) => fs::write(path, text).unwrap(),
            (_, _, Some(bytes)) => fs::write(path, latin(bytes)).unwrap(),
            ("exr", ..) => self.exr(path),
            ("npz", ..) => self.npz(path),
            ("npy", ..) => fs::write(path, self.array(&self.is)).unwrap(),
            ("dds", ..) => fs::write(path, self.dds()).unwrap(),
            ("pfm", ..) => fs::write(path, self.pfm()).unwrap(),
            ("tif" | "tiff", ..)
                if self.orientation.is_some()
                    || self.pages.is_some()
                    || self.is_of("i16")
                    || self.premultiplied
                    || self.thumbnail =>
            {
                self.tiff(path);
            }
            ("png", ..) if self.colour.is_some() || !self.chunks.is_empty() => {
                fs::write(path, self.own_png()).unwrap();
            }
            (
                "png" | "jpg" | "jpeg" | "tga" | "bmp" | "webp" | "ppm" | "pgm" | "qoi" | "tif" | "tiff"
                | "hdr",
                ..,
            ) => {
                self.picture().save_with_format(path, ImageFormat::from_path(path).unwrap()).unwrap();
            }
            _ => fs::write(path, &self.is).unwrap(),
        }
        if !self.patch.is_empty() || !self.insert.is_empty() {
            let mut bytes = fs::read(path).unwrap();
            for (at, patch) in &self.patch {
                let (at, patch) = (at.parse::<usize>().unwrap(), hex(patch));
                bytes[at..at + patch.len()].copy_from_slice(&patch);
            }
            for (at, text) in &self.insert {
                let at: usize = at.parse().unwrap();
                bytes.splice(at..at, text.bytes());
            }
            fs::write(path, bytes).unwrap();
        }
        if self.cut > 0 {
            let bytes = fs::read(path).unwrap();
            fs::write(path, &bytes[..bytes.len() - self.cut]).unwrap();
        }
    }

    fn is_of(&self, bits: &str) -> bool {
        self.bits.as_deref() == Some(bits)
    }

    /// The size, the number of channels, and all samples, of the formula with its tiles.
    fn samples(&self) -> ([usize; 2], usize, Vec<f64>) {
        let size = self.size.unwrap_or([SIDE; 2]);
        let rows: Vec<Vec<&str>> = self.is.split(';').map(|row| row.split('|').collect()).collect();
        let border = self.borders;
        let step = size.map(|side| side + border);
        let [width, height] = [rows[0].len() * step[0] + border, rows.len() * step[1] + border];
        let texels: Vec<Vec<f64>> = (0..width * height)
            .map(|i| [i % width, i / width])
            .map(|[x, y]| {
                let [column, row] = [x % step[0], y % step[1]];
                if column < border || row < border {
                    return vec![0.0];
                }
                let place = Place { x: column - border, y: row - border, size };
                values(rows[y / step[1]][x / step[0]], place)
            })
            .collect();
        let count = texels.iter().map(Vec::len).max().unwrap();
        let texels = texels.into_iter().flat_map(|texel| match texel.len() {
            1 => vec![texel[0]; count],
            _ => texel,
        });
        ([width, height], count, texels.collect())
    }

    fn picture(&self) -> DynamicImage {
        let (size, count, samples) = self.samples();
        let [width, height] = size.map(|side| side as u32);
        let codes = |top: f64| samples.iter().map(move |v| (top * v).round());
        let eight = || codes(255.0).map(|code| code as u8).collect();
        let sixteen = || codes(65_535.0).map(|code| code as u16).collect();
        let floats = || samples.iter().map(|v| *v as f32).collect();
        let image = match (self.bits.as_deref().unwrap_or("8"), count) {
            ("8", 1) => image::GrayImage::from_raw(width, height, eight()).map(DynamicImage::from),
            ("8", 2) => image::GrayAlphaImage::from_raw(width, height, eight()).map(DynamicImage::from),
            ("8", 3) => image::RgbImage::from_raw(width, height, eight()).map(DynamicImage::from),
            ("8", _) => image::RgbaImage::from_raw(width, height, eight()).map(DynamicImage::from),
            ("16", 1) => {
                image::ImageBuffer::from_raw(width, height, sixteen()).map(DynamicImage::ImageLuma16)
            }
            ("16", _) => image::ImageBuffer::from_raw(width, height, sixteen()).map(DynamicImage::ImageRgb16),
            (_, 3) => image::Rgb32FImage::from_raw(width, height, floats()).map(DynamicImage::from),
            other => panic!("{other:?}"),
        };
        image.unwrap()
    }

    /// A TIFF of an orientation, of several pages, of integers of 32 bits or of signed ones.
    fn tiff(&self, path: &Path) {
        let mut encoder = TiffEncoder::new(File::create(path).unwrap()).unwrap();
        let tag: u16 = self.orientation.as_ref().map_or(1, |tag| tag.parse().unwrap());
        let (size, _, samples) = self.samples();
        let [width, height] = size.map(|side| side as u32);
        if self.thumbnail {
            let mut page = encoder.new_image::<colortype::RGB8>(1, 1).unwrap();
            page.encoder().write_tag(tiff::tags::Tag::NewSubfileType, 1_u32).unwrap();
            page.write_data(&[9; 3]).unwrap();
        }
        if self.premultiplied {
            let mut page = encoder.new_image::<colortype::RGBA8>(width, height).unwrap();
            page.encoder().write_tag(tiff::tags::Tag::ExtraSamples, &[1_u16][..]).unwrap();
            return page.write_data(self.picture().as_bytes()).unwrap();
        }
        for _ in 0..self.pages.unwrap_or(1) {
            match self.bits.as_deref() {
                Some("u32") => {
                    let codes: Vec<u32> = samples.iter().map(|v| (v * f64::from(u32::MAX)) as u32).collect();
                    encoder.write_image::<colortype::RGB32>(width, height, &codes).unwrap();
                }
                Some("i16") => {
                    let codes: Vec<i16> = samples.iter().map(|v| (v * 100.0) as i16).collect();
                    encoder.write_image::<colortype::GrayI16>(width, height, &codes).unwrap();
                }
                _ => {
                    // As it is stored, so that the orientation brings it back.
                    let inverse = [1, 2, 3, 4, 5, 8, 7, 6][usize::from(tag) - 1];
                    let mut stored = self.picture();
                    stored.apply_orientation(Orientation::from_exif(inverse).unwrap());
                    let (width, height) = (stored.width(), stored.height());
                    let mut page = encoder.new_image::<colortype::RGB8>(width, height).unwrap();
                    page.encoder().write_tag(tiff::tags::Tag::Orientation, tag).unwrap();
                    page.write_data(stored.as_bytes()).unwrap();
                }
            }
        }
    }

    /// A PNG byte by byte. Entry k of a palette is gray 255 - k.
    fn own_png(&self) -> Vec<u8> {
        let (size, count, samples) = self.samples();
        let depth: u8 = self.bits.as_deref().unwrap_or("8").parse().unwrap();
        let colour = match self.colour.as_deref() {
            Some("palette") => png::PALETTE,
            Some("gray") if count == 1 => png::GRAY,
            _ => [png::GRAY, png::GRAY_ALPHA, png::RGB, png::RGBA][count - 1],
        };
        let mut chunks: Vec<([u8; 4], Vec<u8>)> = Vec::new();
        if colour == png::PALETTE {
            chunks.push((*b"PLTE", (0..1_u16 << depth).flat_map(|k| [255 - k as u8; 3]).collect()));
        }
        for (name, content) in &self.chunks {
            chunks.push((name.as_bytes().try_into().unwrap(), hex(content)));
        }
        let top = f64::from(u16::MAX >> (16 - depth));
        let png = Png { size, depth, colour, interlaced: self.interlaced, chunks: &chunks };
        png.bytes(|x, y, c| {
            let value = samples[(y * size[0] + x) * count + c];
            if colour == png::PALETTE {
                (255.0 * (1.0 - value)).round() as u16
            } else {
                (top * value).round() as u16
            }
        })
    }

    /// A PFM, the lowest row first; big endian with `bits = "big"`.
    fn pfm(&self) -> Vec<u8> {
        let ([width, height], count, samples) = self.samples();
        let is_big = self.is_of("big");
        let bytes = |v: &f64| if is_big { (*v as f32).to_be_bytes() } else { (*v as f32).to_le_bytes() };
        let values = samples.chunks(width * count).rev().flatten().flat_map(bytes);
        let scale = if is_big { "1" } else { "-1.0" };
        let kind = if count == 3 { "PF" } else { "Pf" };
        format!("{kind}\n{width} {height}\n{scale}\n").into_bytes().into_iter().chain(values).collect()
    }

    fn dds(&self) -> Vec<u8> {
        let (size, count, samples) = self.samples();
        let [width, height] = size.map(|side| side as u32);
        let codes = || samples.iter().map(|v| (255.0 * v).round() as u8).collect::<Vec<_>>();
        match (self.code.as_deref().filter(|code| !code.is_empty()), count) {
            (None, 4) => {
                dds(width, height, [32, 0x41, 0, 32, 0xff, 0xff00, 0xff_0000, 0xff00_0000], &codes())
            }
            // Luminance and alpha, and alpha alone.
            (None, 2) => dds(width, height, [32, 0x2_0001, 0, 16, 0xff, 0, 0, 0xff00], &codes()),
            (None, _) => dds(width, height, [32, 2, 0, 8, 0, 0, 0, 0xff], &codes()),
            (Some(code), _) if code.parse::<u32>().is_ok() => {
                // Format, a picture of two dimensions, no cube, one picture, alpha not stated.
                let head = [code.parse().unwrap(), 3, 0, 1, 0].into_iter().flat_map(u32::to_le_bytes);
                let halves = samples.iter().flat_map(|v| f16::from_f64(*v).to_le_bytes());
                let data = if self.blocks.is_empty() { halves.collect() } else { hex(&self.blocks) };
                let pixels: Vec<u8> = head.chain(data).collect();
                dds(width, height, [32, 4, u32::from_le_bytes(*b"DX10"), 0, 0, 0, 0, 0], &pixels)
            }
            (Some(code), _) => {
                let letters = u32::from_le_bytes(code.as_bytes().try_into().unwrap());
                dds(width, height, [32, 4, letters, 0, 0, 0, 0, 0], &hex(&self.blocks))
            }
        }
    }
}

/// The bytes of characters below 256.
fn latin(text: &str) -> Vec<u8> {
    text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect()
}

/// The bytes of hexadecimal digits; `*N` after some repeats them.
fn hex(text: &str) -> Vec<u8> {
    let mut all = Vec::new();
    for word in text.split_whitespace() {
        let (digits, times) = word.split_once('*').unwrap_or((word, "1"));
        let bytes: Vec<u8> = (0..digits.len())
            .step_by(2)
            .map(|i| u8::from_str_radix(&digits[i..i + 2], 16).unwrap())
            .collect();
        all.extend(bytes.repeat(times.parse().unwrap()));
    }
    all
}
