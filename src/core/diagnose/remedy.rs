//! The options of the command line that correct how a prediction is read.

use super::reading::Reading;
use super::storage::{Storage, Transfer};

/// The option of the command line that reads a prediction this way; `None`: there is none.
pub(super) fn remedy(storage: &Storage, reading: Reading) -> Option<String> {
    let present = storage.roughness.as_deref().unwrap_or("r");
    let option = match reading {
        Reading::NormalY if storage.normal_down => "--pred-normal-y up",
        Reading::NormalY => "--pred-normal-y down",
        Reading::Colours(Transfer::Linear) => "--pred-albedo linear",
        Reading::Colours(_) => "--pred-albedo srgb",
        Reading::Specular(Transfer::Linear) => "--pred-specular-albedo linear",
        Reading::Specular(_) => "--pred-specular-albedo srgb",
        Reading::Gloss if present == "gloss" => "--pred-roughness r",
        Reading::Gloss if present == "r" => "--pred-roughness gloss",
        Reading::RootOfRoughness if present == "r" => "--pred-roughness alpha",
        Reading::SquaredRoughness if present == "alpha" => "--pred-roughness r",
        Reading::Unscaled => "--pred-energy unscaled",
        Reading::Scaled => "--pred-energy scaled",
        Reading::NormalX
        | Reading::RedBlue
        | Reading::Gloss
        | Reading::RootOfRoughness
        | Reading::SquaredRoughness => return None,
    };
    Some(option.to_owned())
}
