//! Parameters of the two passes: plain values, no device.

use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::camera::Camera;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;

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
    /// The difference of the first picture from the reference, shown in place of the first; both have the same size.
    pub difference: Option<DisplayedDifference>,
    pub encoding: Encoding,
    /// Stripes pixels of [`Encoding::Radiance`] that are too bright in a channel (magenta) or black (blue).
    pub show_clipping: bool,
    /// Epsilon of the difference's logarithms, from the convention.
    pub epsilon: f32,
    /// Whether [`Encoding::Data`] shows its first channel, in [0, 1], in the colours of
    /// [`heat`](svbrdf_core::picture::colour_map::heat).
    pub false_colour: bool,
    /// Whether a pixel that covers several texels shows the nearest one in place of their mean: for drafts.
    pub nearest: bool,
    /// What is shown beside the material, already encoded for the screen.
    pub background: [f32; 3],
}

/// Which of a pane's two pictures is shown where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DisplayMode {
    /// The first.
    Value,
    /// The reference left of this x of the pane, which runs from -1 to 1, and the first right of it.
    Wipe(f32),
}

/// A difference shown as colours: [`heat`](svbrdf_core::picture::colour_map::heat), or
/// [`diverging`](svbrdf_core::picture::colour_map::diverging) where it is signed. Exposure does not change it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplayedDifference {
    pub kind: Difference,
    /// The difference that has the last colour; positive.
    pub range: f32,
    /// Whether the first picture holds the difference of each channel already.
    pub is_computed: bool,
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
