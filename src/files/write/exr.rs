//! Materials as EXR, the project's own form: one part with the layers diffuse, specular, normal and roughness.

use std::io::{self, Seek, Write};

use exr::io::Data;
use exr::prelude::{
    Encoding, Image, IntoSample, Layer, LayerAttributes, SpecificChannels, Text, Vec2, WritableImage, f16,
};

use svbrdf_core::material::{Material, Planes, half_normal};

use crate::disk::atomic::SOFTWARE;
use crate::read::decode::exr::NATIVE;

/// The meaning of the values of such an EXR.
const MEANING: &str = "svbrdf:workflow=specular, linear Rec. 709\nsvbrdf:normal=signed, +y\n\
    svbrdf:roughness=r, alpha = r^2\n";

pub(crate) fn write(file: impl Write + Seek, material: &Material<f32>, half: bool) -> io::Result<()> {
    match half {
        true => write_as(file, material, half_normal, f16::from_f32),
        false => write_as(file, material, |normal| normal, |value| value),
    }
}

/// Writes the samples that `normal` and `value` return. They are computed block by block: planes of them would take the memory of the
/// material again.
fn write_as<S: IntoSample + Data>(
    file: impl Write + Seek,
    material: &Material<f32>,
    normal: impl Fn([f32; 3]) -> [S; 3] + Sync,
    value: impl Fn(f32) -> S + Sync,
) -> io::Result<()> {
    let planes = material.planes();
    let width = material.width();
    let sample = |Vec2(column, row): Vec2<usize>| {
        let Planes { normal: normals, diffuse, specular, roughness } = planes;
        let at = |map: &[Vec<f32>; 3]| map.each_ref().map(|plane| plane[row * width + column]);
        let [[dr, dg, db], [sr, sg, sb]] = [diffuse, specular].map(|map| at(map).map(&value));
        let [x, y, z] = normal(at(normals));
        (dr, dg, db, sr, sg, sb, x, y, z, value(roughness[row * width + column]))
    };
    let channels = SpecificChannels::build()
        .with_channel("diffuse.R")
        .with_channel("diffuse.G")
        .with_channel("diffuse.B")
        .with_channel("specular.R")
        .with_channel("specular.G")
        .with_channel("specular.B")
        .with_channel("normal.X")
        .with_channel("normal.Y")
        .with_channel("normal.Z")
        .with_channel("roughness.Y")
        .with_pixel_fn(sample);
    let attributes = LayerAttributes {
        software_name: Text::new_or_none(SOFTWARE),
        comments: Text::new_or_none(format!("{NATIVE}{MEANING}")),
        ..LayerAttributes::default()
    };
    let layer = Layer::new((width, material.height()), attributes, Encoding::SMALL_LOSSLESS, channels);
    Image::from_layer(layer).write().to_buffered(file).map_err(io::Error::other)
}
