//! Materials as EXR, the project's own form: one part with the layers diffuse, specular, normal and roughness.

use std::io::{self, Seek, Write};
use std::ops::Range;

use exr::block::BlockIndex;
use exr::image::write::channels::{ChannelsWriter, WritableChannels};
use exr::math::RoundingMode;
use exr::meta::attribute::{ChannelDescription, ChannelList, LevelMode, SampleType};
use exr::meta::header::Header;
use exr::prelude::{Encoding, Image, Layer, LayerAttributes, Text, Vec2, WritableImage, f16};

use svbrdf_core::material::{Material, Planes, half_normal};

use crate::disk::atomic::SOFTWARE;
use crate::read::decode::exr::NATIVE;

/// The meaning of the values of such an EXR.
const MEANING: &str = "svbrdf:workflow=specular, linear Rec. 709\nsvbrdf:normal=signed, +y\n\
    svbrdf:roughness=r, alpha = r^2\n";

pub(crate) fn write(file: impl Write + Seek, material: &Material<f32>, half: bool) -> io::Result<()> {
    let attributes = LayerAttributes {
        software_name: Text::new_or_none(SOFTWARE),
        comments: Text::new_or_none(format!("{NATIVE}{MEANING}")),
        ..LayerAttributes::default()
    };
    let layer = Layer::new(
        (material.width(), material.height()),
        attributes,
        Encoding::SMALL_LOSSLESS,
        MaterialChannels { material, half },
    );
    Image::from_layer(layer).write().to_buffered(file).map_err(io::Error::other)
}

/// The channels of a material. They become halves block by block: planes of them would take half of its memory again.
struct MaterialChannels<'a> {
    material: &'a Material<f32>,
    half: bool,
}

/// The channels of these names.
fn named_channels<'a>(
    names: [&'static str; 3],
    planes: &'a [Vec<f32>; 3],
) -> impl Iterator<Item = ExrChannel<'a>> {
    names.into_iter().zip(planes).map(|(name, plane)| ExrChannel { name, plane, normal: None })
}

/// A channel of the file.
struct ExrChannel<'a> {
    name: &'static str,
    plane: &'a [f32],
    /// Which component of the normals it is.
    normal: Option<usize>,
}

impl MaterialChannels<'_> {
    /// All channels in the order of their names, as they are in a file.
    fn channels(&self) -> Vec<ExrChannel<'_>> {
        let Planes { normal, diffuse, specular, roughness } = self.material.planes();
        let diffuse = named_channels(["diffuse.R", "diffuse.G", "diffuse.B"], diffuse);
        let specular = named_channels(["specular.R", "specular.G", "specular.B"], specular);
        let normal = named_channels(["normal.X", "normal.Y", "normal.Z"], normal);
        let normal = normal.enumerate().map(|(c, channel)| ExrChannel { normal: Some(c), ..channel });
        let roughness = ExrChannel { name: "roughness.Y", plane: roughness, normal: None };
        let mut all: Vec<_> = diffuse.chain(specular).chain(normal).chain([roughness]).collect();
        all.sort_by_key(|channel| channel.name);
        all
    }
}

impl<'a> WritableChannels<'a> for MaterialChannels<'_> {
    type Writer = ChannelRows<'a>;

    fn infer_channel_list(&self) -> ChannelList {
        let kind = if self.half { SampleType::F16 } else { SampleType::F32 };
        let channels = self.channels().into_iter();
        ChannelList::new(channels.map(|channel| ChannelDescription::named(channel.name, kind)).collect())
    }

    fn infer_level_modes(&self) -> (LevelMode, RoundingMode) {
        (LevelMode::Singular, RoundingMode::Down)
    }

    fn create_writer(&'a self, _: &Header) -> ChannelRows<'a> {
        ChannelRows { channels: self.channels(), material: self.material, half: self.half }
    }
}

/// The channels of a file while it is written.
struct ChannelRows<'a> {
    channels: Vec<ExrChannel<'a>>,
    material: &'a Material<f32>,
    half: bool,
}

impl ChannelsWriter for ChannelRows<'_> {
    fn extract_uncompressed_block(&self, header: &Header, block: BlockIndex) -> Vec<u8> {
        let (Vec2(left, top), Vec2(width, height)) = (block.pixel_position, block.pixel_size);
        let mut bytes = Vec::with_capacity(width * height * header.channels.bytes_per_pixel);
        for row in top..top + height {
            let first = row * self.material.width() + left;
            let texels = first..first + width;
            let normals = if self.half { self.half_normals(texels.clone()) } else { Vec::new() };
            for ExrChannel { plane, normal, .. } in &self.channels {
                let plane = &plane[texels.clone()];
                match normal {
                    Some(c) if self.half => bytes.extend(normals.iter().flat_map(|n| n[*c].to_ne_bytes())),
                    _ if self.half => {
                        bytes.extend(plane.iter().flat_map(|&x| f16::from_f32(x).to_ne_bytes()));
                    }
                    _ => bytes.extend(plane.iter().flat_map(|x| x.to_ne_bytes())),
                }
            }
        }
        bytes
    }
}

impl ChannelRows<'_> {
    /// The normals of these texels.
    fn half_normals(&self, texels: Range<usize>) -> Vec<[f16; 3]> {
        let [x, y, z] = self.material.planes().normal.each_ref().map(|plane| &plane[texels.clone()]);
        x.iter().zip(y).zip(z).map(|((&x, &y), &z)| half_normal([x, y, z])).collect()
    }
}
