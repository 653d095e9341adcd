//! Materials as EXR, the project's own form: one part with the layers diffuse, specular, normal and roughness.

use std::io::{self, Seek, Write};

use exr::image::{AnyChannel, AnyChannels, FlatSamples};
use exr::prelude::{Encoding, Image, Layer, LayerAttributes, Text, WritableImage, f16};
use glam::DVec3;
use rayon::prelude::*;

use crate::files::read::decode::exr::NATIVE;
use crate::material::{Material, Planes};
use crate::model::convention::PRINTED;
use crate::model::scene::{Kind, Scene};
use crate::picture::export::Provenance;
use crate::progress::Progress;
use crate::render::render_f32;

/// The meaning of the values of such an EXR.
const MEANING: &str = "svbrdf:workflow=specular, linear Rec. 709\nsvbrdf:normal=signed, +y\n\
    svbrdf:roughness=r, alpha = r^2\n";
/// The scene of previews: that in which the window starts.
const PREVIEW: Scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] };

pub(crate) fn write(
    file: impl Write + Seek,
    material: &Material<f32>,
    half: bool,
    preview: bool,
) -> io::Result<()> {
    let Planes { normal, diffuse, specular, roughness } = material.planes();
    let samples = |plane: &Vec<f32>| match half {
        true => FlatSamples::F16(plane.par_iter().map(|&x| f16::from_f32(x)).collect()),
        false => FlatSamples::F32(plane.clone()),
    };
    let normals = match half {
        true => half_normals(normal).map(FlatSamples::F16),
        false => normal.each_ref().map(samples),
    };
    let colours = |planes: &[Vec<f32>; 3]| planes.each_ref().map(samples);
    let rendering = if preview { Some(rendering(material)?) } else { None };
    let layers = [
        Some(("diffuse.", ["R", "G", "B"], colours(diffuse))),
        Some(("specular.", ["R", "G", "B"], colours(specular))),
        Some(("normal.", ["X", "Y", "Z"], normals)),
        rendering.map(|planes| ("", ["R", "G", "B"], colours(&planes))),
    ];
    let named = layers.into_iter().flatten().flat_map(|(layer, names, planes)| {
        names.into_iter().zip(planes).map(move |(name, plane)| (format!("{layer}{name}"), plane))
    });
    let all = named.chain([("roughness.Y".to_owned(), samples(roughness))]);
    let channels = all.map(|(name, plane)| AnyChannel::new(text(&name), plane)).collect();
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

/// Red, green and blue of the material in the scene of previews, no more than a half can hold.
fn rendering(material: &Material<f32>) -> io::Result<[Vec<f32>; 3]> {
    let image = render_f32(material, &PREVIEW, &PRINTED, &Progress::default()).map_err(io::Error::other)?;
    let most = f16::MAX.to_f32();
    Ok([0, 1, 2].map(|c| image.pixels.iter().map(|rgb| rgb[c].min(most)).collect()))
}

/// Text of the ASCII that is written here.
fn text(name: &str) -> Text {
    Text::new_or_none(name).unwrap_or_else(|| Text::from("?"))
}

/// Normals that are halves and, once they have been normalized and rounded to halves again, the same halves.
pub(crate) fn half_normals(normal: &[Vec<f32>; 3]) -> [Vec<f16>; 3] {
    const CHUNK: usize = 1 << 14;
    let mut planes = normal.each_ref().map(|plane| vec![f16::ZERO; plane.len()]);
    let [xs, ys, zs] = planes.each_mut().map(|plane| plane.par_chunks_mut(CHUNK));
    xs.zip(ys).zip(zs).enumerate().for_each(|(number, ((xs, ys), zs))| {
        let texels = xs.iter_mut().zip(ys).zip(zs).enumerate();
        for (index, ((x, y), z)) in texels {
            [*x, *y, *z] = half_normal(normal.each_ref().map(|plane| plane[number * CHUNK + index]));
        }
    });
    planes
}

fn half_normal(normal: [f32; 3]) -> [f16; 3] {
    const MOST_ROUNDS: usize = 16;
    let again =
        |n: [f16; 3]| DVec3::from(n.map(f64::from)).normalize().to_array().map(|x| f16::from_f32(x as f32));
    let mut n = normal.map(f16::from_f32);
    for _ in 0..MOST_ROUNDS {
        let next = again(n);
        if next == n {
            break;
        }
        n = next;
    }
    n
}
