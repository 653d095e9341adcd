//! The quantities of a material: its rendering and its maps.

use serde::{Deserialize, Serialize};

/// The rendering or a map of a material.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Quantity {
    /// Algorithm 3 under the light and the view.
    #[default]
    Rendering,
    /// The unit normal n as (n + 1) / 2, as normal maps are stored.
    Normal,
    /// The diffuse albedo, linear; encoded as sRGB on the screen.
    Diffuse,
    /// The specular reflectance, linear; encoded as sRGB on the screen.
    Specular,
    /// The roughness as a gray value, shown as it is.
    Roughness,
}

impl Quantity {
    /// Every choice, in the order in which keys cycle through them.
    pub const ALL: [Self; 5] =
        [Self::Rendering, Self::Normal, Self::Diffuse, Self::Specular, Self::Roughness];

    /// The name for users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rendering => "rendering",
            Self::Normal => "normal",
            Self::Diffuse => "diffuse",
            Self::Specular => "specular",
            Self::Roughness => "roughness",
        }
    }
}
