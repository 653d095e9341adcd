//! Materials as EXR, the project's own form: one part with the layers diffuse, specular, normal and roughness.

use std::io::{self, Seek, Write};

use exr::image::{AnyChannel, AnyChannels, FlatSamples};
use exr::prelude::{Encoding, Image, Layer, LayerAttributes, Text, WritableImage, f16};
use rayon::prelude::*;

use svbrdf_core::material::{Material, Planes, half_normals};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;

use crate::atomic::SOFTWARE;
use crate::read::decode::exr::NATIVE;

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
        software_name: Text::new_or_none(SOFTWARE),
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
