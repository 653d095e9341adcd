//! Pictures of one map as EXR: linear floats, normals as (n + 1) / 2.

use std::io::{self, Seek, Write};

use exr::prelude::{
    Encoding, Image, Layer, LayerAttributes, LineOrder, SpecificChannels, Text, Vec2, WritableImage, f16,
};

use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;

use super::png::FolderPicture;
use crate::disk::atomic::{self, SOFTWARE};

/// Writes one layer of the channels R, G and B.
pub(super) fn write(
    file: impl Write + Seek,
    material: &Material<f32>,
    picture: &FolderPicture<'_>,
    half: bool,
    progress: &Progress,
) -> io::Result<()> {
    atomic::check(progress)?;
    let FolderPicture { map, encoding, .. } = *picture;
    let texel = |Vec2(x, y): Vec2<usize>| {
        let [r, g, b] = encoding.values(material, map, y * material.width() + x).map(|value| value as f32);
        (r, g, b)
    };
    let size = (material.width(), material.height());
    let attributes =
        LayerAttributes { software_name: Text::new_or_none(SOFTWARE), ..LayerAttributes::default() };
    // In any other order, blocks stand as the threads finish them.
    let encoding = Encoding { line_order: LineOrder::Increasing, ..Encoding::SMALL_LOSSLESS };
    if half {
        let texel = |at: Vec2<usize>| {
            let (r, g, b) = texel(at);
            (f16::from_f32(r), f16::from_f32(g), f16::from_f32(b))
        };
        let layer = Layer::new(size, attributes, encoding, SpecificChannels::rgb(texel));
        Image::from_layer(layer).write().to_buffered(file).map_err(io::Error::other)
    } else {
        let layer = Layer::new(size, attributes, encoding, SpecificChannels::rgb(texel));
        Image::from_layer(layer).write().to_buffered(file).map_err(io::Error::other)
    }
}
