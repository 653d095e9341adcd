//! Picture made by a job, for a texture of the window.

/// Pixels of sRGB with premultiplied alpha, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width and height.
    pub size: [usize; 2],
    pub pixels: Vec<[u8; 4]>,
}

impl Picture {
    /// A pixel that hides what is behind it.
    pub fn opaque([r, g, b]: [u8; 3]) -> [u8; 4] {
        [r, g, b, 255]
    }

    /// A pixel that shows what is behind it.
    pub const TRANSPARENT: [u8; 4] = [0; 4];
}
