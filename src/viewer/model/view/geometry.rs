//! Geometry of the window: what its last frame measured and commands depend on.

/// Sizes and places of the last frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WindowGeometry {
    /// Width and height of the picture of a pane, in physical pixels; 0 before there is one.
    pub pane: [f32; 2],
    /// Width and height of the panes and the legend together, in pixels.
    pub picture: [u32; 2],
    /// Width and height of the window, in points.
    pub window: [f32; 2],
    /// Whether the side panel is closed until it is asked for.
    pub is_narrow: bool,
    /// The texel that was under the pointer last.
    pub texel: Option<[usize; 2]>,
}
