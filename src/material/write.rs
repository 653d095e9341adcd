//! Materials as files: one layered EXR, a packed PNG, a folder of PNG files.

use std::fs;
use std::io::{self, Seek, Write};
use std::path::Path;
use std::str::FromStr;

use exr::image::{AnyChannel, AnyChannels, FlatSamples};
use exr::prelude::{Encoding, Image, Layer, LayerAttributes, Text, WritableImage, f16};

use super::{Material, Planes};
use crate::error::Error;
use crate::export::{self, Provenance};
use crate::vec3::Vec3;

/// How the comments of an EXR begin that this module wrote.
pub(crate) const NATIVE: &str = "svbrdf:version=1\n";
/// What the values of such an EXR mean.
const MEANING: &str = "svbrdf:workflow=specular, linear Rec. 709\nsvbrdf:normal=signed, +y\n\
    svbrdf:roughness=r, alpha = r^2\n";

/// How samples are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    Eight,
    Sixteen,
    Half,
    Float,
}

impl Depth {
    /// How the command line calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Eight => "8",
            Self::Sixteen => "16",
            Self::Half => "half",
            Self::Float => "float",
        }
    }
}

impl FromStr for Depth {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        match name {
            "8" => Ok(Self::Eight),
            "16" => Ok(Self::Sixteen),
            "half" => Ok(Self::Half),
            "float" => Ok(Self::Float),
            _ => Err(Error::UnknownName {
                what: "depth",
                found: name.to_owned(),
                known: "8, 16 (PNG), half, float (EXR)".to_owned(),
            }),
        }
    }
}

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One layered EXR: signed normals, y up, everything linear.
    Exr { half: bool },
    /// normal | diffuse | roughness | specular, linear.
    Packed { sixteen: bool },
    /// Four PNG files, colours in sRGB.
    Folder { sixteen: bool },
}

impl Kind {
    /// By the extension of `path`, with half floats and 8 bits where `depth` says nothing.
    ///
    /// # Errors
    /// [`Error::Usage`] for a depth that the kind of file has not.
    pub fn new(path: &Path, depth: Option<Depth>) -> Result<Self, Error> {
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let sixteen = depth == Some(Depth::Sixteen);
        let (kind, fits) = match extension.as_str() {
            "exr" => (
                Self::Exr { half: depth != Some(Depth::Float) },
                matches!(depth, None | Some(Depth::Half | Depth::Float)),
            ),
            "png" => (Self::Packed { sixteen }, matches!(depth, None | Some(Depth::Eight | Depth::Sixteen))),
            _ => (Self::Folder { sixteen }, matches!(depth, None | Some(Depth::Eight | Depth::Sixteen))),
        };
        if fits {
            return Ok(kind);
        }
        Err(Error::Usage(format!(
            "{} cannot have that depth; EXR has half and float, PNG and folders have 8 and 16",
            path.display()
        )))
    }
}

/// Writes `material`: the file or folder appears when it is complete, or not at all.
///
/// # Errors
/// [`Error::Unwritable`]; a folder that is there and not empty is not replaced.
pub fn write(material: &Material<f32>, path: &Path, kind: Kind) -> Result<(), Error> {
    match kind {
        Kind::Exr { half } => export::replace(path, |file| exr(file, material, half)),
        Kind::Packed { sixteen } => export::replace(path, |file| packed(file, material, sixteen)),
        Kind::Folder { sixteen } => folder(path, material, sixteen).map_err(|source| Error::Unwritable {
            path: path.to_owned(),
            source,
            remedy: "name a folder that is not there yet, in one that is writable",
        }),
    }
}

/// `material` as it is read back from a file of this depth that this module wrote: EXR for half and float, a packed PNG
/// for 8 and 16 bits.
///
/// # Errors
/// As [`Material::new`], as where a normal becomes too short to have a direction.
pub fn held(material: &Material<f32>, depth: Depth) -> Result<Material<f32>, Error> {
    let Planes { normal, diffuse, specular, roughness } = material.planes();
    // Normals are stored as (n + 1) / 2.
    let vector = |levels| {
        let component = |x: &f32| (2.0 * rounded((0.5 * x + 0.5).clamp(0.0, 1.0), levels) - 1.0) as f32;
        normal.each_ref().map(|plane| plane.iter().map(component).collect())
    };
    let (normal, value): (_, &dyn Fn(f32) -> f32) = match depth {
        Depth::Float => return Ok(material.clone()),
        Depth::Half => (half_normals(normal), &|x| f16::from_f32(x).to_f32()),
        Depth::Eight => (vector(255.0), &|x| rounded(x, 255.0) as f32),
        Depth::Sixteen => (vector(65_535.0), &|x| rounded(x, 65_535.0) as f32),
    };
    let plane = |plane: &Vec<f32>| plane.iter().map(|&x| value(x)).collect();
    let planes = Planes {
        normal,
        diffuse: diffuse.each_ref().map(plane),
        specular: specular.each_ref().map(plane),
        roughness: plane(roughness),
    };
    Material::new(material.name(), material.width(), material.height(), planes)
}

/// `value` of [0, 1] to the nearest of `levels` + 1 steps.
fn rounded(value: f32, levels: f64) -> f64 {
    (f64::from(value) * levels).round() / levels
}

fn exr(file: impl Write + Seek, material: &Material<f32>, half: bool) -> io::Result<()> {
    let Planes { normal, diffuse, specular, roughness } = material.planes();
    let normal = if half { half_normals(normal) } else { normal.clone() };
    let samples = |plane: &[f32]| match half {
        true => FlatSamples::F16(plane.iter().map(|&x| f16::from_f32(x)).collect()),
        false => FlatSamples::F32(plane.to_vec()),
    };
    let layers = [
        ("diffuse", ["R", "G", "B"], diffuse),
        ("specular", ["R", "G", "B"], specular),
        ("normal", ["X", "Y", "Z"], &normal),
    ];
    let colours = layers.into_iter().flat_map(|(layer, names, planes)| {
        names.into_iter().zip(planes).map(move |(name, plane)| (format!("{layer}.{name}"), plane.as_slice()))
    });
    let all = colours.chain([("roughness.Y".to_owned(), roughness.as_slice())]);
    let channels = all.map(|(name, plane)| AnyChannel::new(text(&name), samples(plane))).collect();
    let attributes = LayerAttributes {
        software_name: Text::new_or_none(Provenance::SOFTWARE),
        comments: Text::new_or_none(format!("{NATIVE}{MEANING}")),
        ..LayerAttributes::default()
    };
    let layer = Layer::new(
        (material.width(), material.height()),
        attributes,
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(channels),
    );
    Image::from_layer(layer).write().to_buffered(file).map_err(io::Error::other)
}

/// Text of the ASCII that is written here.
fn text(name: &str) -> Text {
    Text::new_or_none(name).unwrap_or_else(|| Text::from("?"))
}

/// Normals that are halves and, once they have been normalized and rounded to halves again, the same halves.
fn half_normals([xs, ys, zs]: &[Vec<f32>; 3]) -> [Vec<f32>; 3] {
    const MOST_ROUNDS: usize = 16;
    let round = |n: [f32; 3]| n.map(|x| f16::from_f32(x).to_f32());
    let again = |n: [f32; 3]| round(Vec3::from(n.map(f64::from)).normalize().to_array().map(|x| x as f32));
    let mut planes = [0; 3].map(|_| Vec::with_capacity(xs.len()));
    for ((&x, &y), &z) in xs.iter().zip(ys).zip(zs) {
        let mut n = round([x, y, z]);
        for _ in 0..MOST_ROUNDS {
            let next = again(n);
            if next == n {
                break;
            }
            n = next;
        }
        planes.iter_mut().zip(n).for_each(|(plane, x)| plane.push(x));
    }
    planes
}

/// The code of `value` of [0, 1], as one or two bytes.
fn code(value: f32, sixteen: bool, bytes: &mut Vec<u8>) {
    if sixteen {
        bytes.extend(((f64::from(value) * 65_535.0).round() as u16).to_be_bytes());
    } else {
        bytes.push((f64::from(value) * 255.0).round() as u8);
    }
}

/// The maps as (red, green, blue) in [0, 1]: normal, diffuse, roughness, specular.
fn coded(material: &Material<f32>, map: usize, index: usize) -> [f32; 3] {
    let Planes { normal, diffuse, specular, roughness } = material.planes();
    let at = |planes: &[Vec<f32>; 3]| planes.each_ref().map(|plane| plane[index]);
    match map {
        0 => at(normal).map(|x| (0.5 * x + 0.5).clamp(0.0, 1.0)),
        1 => at(diffuse),
        2 => [roughness[index]; 3],
        _ => at(specular),
    }
}

fn packed(file: impl Write, material: &Material<f32>, sixteen: bool) -> io::Result<()> {
    let [width, height] = material.size();
    let mut bytes = Vec::new();
    for row in 0..height {
        for map in 0..4 {
            for index in row * width..(row + 1) * width {
                coded(material, map, index).into_iter().for_each(|value| code(value, sixteen, &mut bytes));
            }
        }
    }
    png(file, [4 * width, height], sixteen, "packed NDRS, linear, normals +y, alpha = r^2", &bytes)
}

fn png(file: impl Write, size: [usize; 2], sixteen: bool, meaning: &str, bytes: &[u8]) -> io::Result<()> {
    let [width, height] = size.map(|side| u32::try_from(side).map_err(io::Error::other));
    let mut encoder = png::Encoder::new(file, width?, height?);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(if sixteen { png::BitDepth::Sixteen } else { png::BitDepth::Eight });
    encoder.add_text_chunk("Software".to_owned(), Provenance::SOFTWARE.to_owned())?;
    encoder.add_text_chunk("svbrdf".to_owned(), meaning.to_owned())?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(bytes)?;
    Ok(writer.finish()?)
}

/// Fills a temporary folder beside `path` and renames it.
fn folder(path: &Path, material: &Material<f32>, sixteen: bool) -> io::Result<()> {
    let temporary = tempfile::Builder::new().prefix(".svbrdf-").tempdir_in(export::folder_of(path))?;
    for (map, name) in ["normal_gl", "diffuse", "roughness", "specular"].into_iter().enumerate() {
        let file = fs::File::create(temporary.path().join(format!("{name}.png")))?;
        let mut bytes = Vec::new();
        for index in 0..material.width() * material.height() {
            let rgb = coded(material, map, index);
            let rgb = if map % 2 == 1 { rgb.map(srgb) } else { rgb };
            rgb.into_iter().for_each(|value| code(value, sixteen, &mut bytes));
        }
        let meaning = if map % 2 == 1 { "sRGB" } else { "data, linear" };
        png(io::BufWriter::new(file), material.size(), sixteen, meaning, &bytes)?;
    }
    // Only an empty folder gives way to a rename.
    fs::rename(temporary.path(), path)?;
    #[cfg(unix)]
    fs::set_permissions(path, std::os::unix::fs::PermissionsExt::from_mode(0o755))?;
    let _ = temporary.keep();
    Ok(())
}

fn srgb(value: f32) -> f32 {
    if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
}
