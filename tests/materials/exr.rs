//! EXR files as the tables describe them.

use std::collections::BTreeMap;
use std::path::Path;

use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds,
    Layer, LayerAttributes, Text, Vec2, WritableImage, f16,
};
use smallvec::SmallVec;

use super::files::{Content, SIDE};
use super::formula::{Place, values};

impl Content {
    pub(super) fn exr(&self, path: &Path) {
        let size = self.size.unwrap_or([SIDE; 2]);
        let flat = |values: Vec<f64>| match self.bits.as_deref() {
            Some("uint") => {
                FlatSamples::U32(values.into_iter().map(|v| (65_535.0 * v).round() as u32).collect())
            }
            Some("half") => FlatSamples::F16(values.into_iter().map(f16::from_f64).collect()),
            _ => FlatSamples::F32(values.into_iter().map(|v| v as f32).collect()),
        };
        // Parts with their channels.
        let mut parts: BTreeMap<String, Vec<AnyChannel<FlatSamples>>> = BTreeMap::new();
        for one in self.is.split(';').map(str::trim).filter(|one| !one.is_empty()) {
            let (names, formula) = one.split_once('=').unwrap_or(("", one));
            let (layer, letters) = names.trim().rsplit_once('.').unwrap_or(("", names.trim()));
            let texels: Vec<_> = (0..size[0] * size[1])
                .map(|i| values(formula, Place { x: i % size[0], y: i / size[0], size }))
                .collect();
            let letters = match (letters, texels[0].len()) {
                ("", 1) => "Y",
                ("", _) => "RGB",
                _ => letters,
            };
            for (c, letter) in letters.chars().enumerate() {
                let name = if layer.is_empty() || self.parts {
                    letter.to_string()
                } else if letter == '*' {
                    layer.to_owned()
                } else {
                    format!("{layer}.{letter}")
                };
                let plane = texels.iter().map(|texel| texel[c.min(texel.len() - 1)]).collect();
                let part =
                    parts.entry(if self.parts { layer.to_owned() } else { String::new() }).or_default();
                part.push(AnyChannel::new(Text::new_or_none(name).unwrap(), flat(plane)));
            }
        }
        // Without a compression in tiles.
        let usual =
            if self.compression.is_empty() { Encoding::FAST_LOSSLESS } else { Encoding::SMALL_LOSSLESS };
        let encoding = Encoding { compression: self.compression(), ..usual };
        let [left, top] = self.at.unwrap_or([0; 2]);
        let layer = |(name, channels): (String, Vec<AnyChannel<FlatSamples>>)| {
            let attributes = LayerAttributes {
                layer_name: if name.is_empty() { None } else { Text::new_or_none(name) },
                layer_position: Vec2(left, top),
                ..LayerAttributes::default()
            };
            Layer::new(
                (size[0], size[1]),
                attributes,
                encoding,
                AnyChannels::sort(channels.into_iter().collect()),
            )
        };
        let layers: SmallVec<[Layer<AnyChannels<FlatSamples>>; 2]> = parts.into_iter().map(layer).collect();
        let [width, height] = self.display.unwrap_or(size);
        let mut attributes = ImageAttributes::new(IntegerBounds::from_dimensions((width, height)));
        attributes.chromaticities = self.chromaticities.map(|all| {
            let [red, green, blue, white] = all.map(|[x, y]| Vec2(x, y));
            Chromaticities { red, green, blue, white }
        });
        Image::from_layers(attributes, layers).write().to_file(path).unwrap();
    }

    fn compression(&self) -> Compression {
        match self.compression.as_str() {
            "" | "none" => Compression::Uncompressed,
            "rle" => Compression::RLE,
            "zip" => Compression::ZIP16,
            "zips" => Compression::ZIP1,
            "piz" => Compression::PIZ,
            "pxr24" => Compression::PXR24,
            "b44" => Compression::B44,
            "b44a" => Compression::B44A,
            "dwaa" => Compression::DWAA(None),
            "dwab" => Compression::DWAB(None),
            other => panic!("no compression {other}"),
        }
    }
}
