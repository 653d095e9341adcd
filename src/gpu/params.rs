//! What the two passes compute: plain values, no device.

use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::picture::camera::Camera;
use crate::picture::quantity::Quantity;

/// What is shaded, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadeParams {
    pub scene: Scene,
    pub convention: Convention,
    pub quantity: Quantity,
}

/// How a pane shows its pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplayParams {
    pub camera: Camera,
    /// Radiance is multiplied by 2 to this power.
    pub exposure_ev: f32,
    pub mode: DisplayMode,
    pub encoding: Encoding,
    /// Stripes pixels of [`Encoding::Radiance`] that are too bright in a channel (magenta) or black (blue).
    pub show_clipping: bool,
    /// Epsilon of the difference's logarithms: that of the convention.
    pub epsilon: f32,
    /// What is shown beside the material, already encoded for the screen.
    pub background: [f32; 3],
}

/// What of a pane's two pictures is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DisplayMode {
    /// The first.
    Value,
    /// The reference left of this x of the pane, which runs from -1 to 1, and the first right of it.
    Wipe(f32),
    /// How far they differ, as a colour of [`heat`](crate::picture::colour_map::heat): of renderings (of [`Encoding::Radiance`])
    /// `|ln(shown + epsilon) - ln(reference + epsilon)|`, where exposure 0 maps 2 to the last colour; of maps
    /// `|shown - reference|`, where 1 is the last colour. The mean of RGB; both pictures have the same size.
    Difference,
}

/// How numbers become colours of the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Exposed, then sRGB.
    Radiance,
    /// sRGB, never exposed.
    Albedo,
    /// As they are.
    Data,
}

impl From<Quantity> for Encoding {
    fn from(quantity: Quantity) -> Self {
        match quantity {
            Quantity::Rendering => Self::Radiance,
            Quantity::Diffuse | Quantity::Specular => Self::Albedo,
            Quantity::Normal | Quantity::Roughness => Self::Data,
        }
    }
}
