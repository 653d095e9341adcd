//! Numbers of pictures and EXR that the tests write.

use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer,
    LayerAttributes, Text, WritableImage,
};
use smallvec::SmallVec;

/// Side of an EXR.
pub const SIDE: usize = 16;

/// The gamma 2.2 of `value`.
pub fn gamma(value: f64) -> f64 {
    value.powf(1.0 / 2.2)
}

/// One EXR of the given parts: (name, channels).
pub fn exr(path: &Path, parts: Vec<(Option<&str>, Vec<AnyChannel<FlatSamples>>)>) {
    let layers: SmallVec<[Layer<AnyChannels<FlatSamples>>; 2]> = parts
        .into_iter()
        .map(|(name, channels)| {
            let attributes = LayerAttributes {
                layer_name: name.and_then(Text::new_or_none),
                ..LayerAttributes::default()
            };
            let channels = AnyChannels::sort(channels.into_iter().collect());
            Layer::new((SIDE, SIDE), attributes, Encoding::FAST_LOSSLESS, channels)
        })
        .collect();
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions((SIDE, SIDE)));
    Image::from_layers(attributes, layers).write().to_file(path).unwrap();
}
