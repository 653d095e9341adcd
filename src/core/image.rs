//! A picture of linear radiance in memory.

/// A picture of linear radiance: `width * height` RGB values, row 0 on top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image<T> {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<[T; 3]>,
}

/// The mean of red, green and blue.
pub fn mean_of_channels(rgb: &[f32; 3]) -> f32 {
    rgb.iter().sum::<f32>() / 3.0
}
