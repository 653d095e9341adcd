//! A photograph on the texels of a material.

use rayon::prelude::*;

use svbrdf_core::image::Image;
use svbrdf_core::material::Grid;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;

use svbrdf_files::photograph::{Corners, Homography};
use svbrdf_files::read::Photograph;

/// How much a length in pixels may exceed a whole number by rounding.
const ROUNDING: f64 = 1e-6;

/// The part of a photograph within four corners, on the texels of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Rectified {
    /// The mean radiance over the area of each texel, in the unit of the photograph; NaN where a pixel of the area is clipped.
    pub image: Image<f32>,
}

impl Rectified {
    /// Averages `photograph` over the area of each of `size` = (columns, rows) texels.
    ///
    /// A texel that covers several pixels is the mean of evenly spaced samples, at most a pixel apart, and so of every pixel;
    /// samples are bilinear between the middles of pixels. A row is one step of `progress`.
    ///
    /// # Errors
    /// [`Error::UnusableCorners`], [`Cancelled`](Error::is_cancelled).
    pub fn new(
        photograph: &Photograph,
        corners: &Corners,
        [width, height]: [usize; 2],
        progress: &Progress,
    ) -> Result<Self, Error> {
        corners.check(photograph.size())?;
        let area = Area { photograph, map: corners.homography(), size: [width, height].map(|n| n as f64) };
        let mut pixels = vec![[0.0; 3]; width * height];
        progress.begin(height as u64);
        pixels.par_chunks_mut(width).enumerate().try_for_each(|(row, pixels)| {
            pixels.iter_mut().enumerate().for_each(|(column, pixel)| *pixel = area.mean(column, row));
            progress.step()
        })?;
        Ok(Self { image: Image { width, height, pixels } })
    }

    /// The same without the falloff of a near-field light, which Algorithm 3 does not model. A point light at the height h lights
    /// the plane at the distance r with (h / r)^3 of the irradiance right below it: (h / r)^2 by distance, and h / r by the angle
    /// of incidence, which Algorithm 3 divides out. A distant light has no falloff.
    #[must_use]
    pub fn without_falloff(mut self, scene: &Scene) -> Self {
        if scene.kind == Kind::Distant {
            return self;
        }
        let grid = Grid { width: self.image.width, height: self.image.height };
        let light = glam::DVec3::from(scene.light);
        for (index, pixel) in self.image.pixels.iter_mut().enumerate() {
            let place: glam::DVec3 = grid.position(index % grid.width, index / grid.width);
            let gain = ((light - place).length() / light.z).powi(3) as f32;
            *pixel = pixel.map(|value| value * gain);
        }
        self
    }

    /// How many texels have a clipped pixel: they are left out of everything.
    pub fn clipped(&self) -> usize {
        self.image.pixels.iter().filter(|pixel| pixel[0].is_nan()).count()
    }

    /// The share of the texels that have a clipped pixel.
    pub fn clipped_share(&self) -> f64 {
        self.clipped() as f64 / self.image.pixels.len() as f64
    }
}

/// What a material covers of a photograph.
struct Area<'a> {
    photograph: &'a Photograph,
    map: Homography,
    /// Columns and rows of texels.
    size: [f64; 2],
}

impl Area<'_> {
    /// The mean over the area of a texel.
    fn mean(&self, column: usize, row: usize) -> [f32; 3] {
        let place =
            |x: f64, y: f64| self.map.at((column as f64 + x) / self.size[0], (row as f64 + y) / self.size[1]);
        let length = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| (bx - ax).hypot(by - ay);
        let [a, b, c, d] = [place(0.0, 0.0), place(1.0, 0.0), place(1.0, 1.0), place(0.0, 1.0)];
        let count = |length: f64| (length - ROUNDING).ceil().max(1.0) as usize;
        let across = count(length(a, b).max(length(d, c)));
        let down = count(length(a, d).max(length(b, c)));
        let mut sum = [0.0; 3];
        for j in 0..down {
            let y = (j as f64 + 0.5) / down as f64;
            for i in 0..across {
                let Some(sample) = self.sample(place((i as f64 + 0.5) / across as f64, y)) else {
                    return [f32::NAN; 3];
                };
                (0..3).for_each(|channel| sum[channel] += sample[channel]);
            }
        }
        sum.map(|sum| (sum / (across * down) as f64) as f32)
    }

    /// The photograph at a point, bilinear; `None` where a pixel that counts is clipped.
    fn sample(&self, [x, y]: [f64; 2]) -> Option<[f64; 3]> {
        let Image { width, height, pixels } = &self.photograph.image;
        let [columns, rows] = [taps(x, *width), taps(y, *height)];
        let mut sum = [0.0; 3];
        for (row, weight_y) in rows {
            for (column, weight_x) in columns {
                let (weight, index) = (weight_x * weight_y, row * width + column);
                if weight <= ROUNDING {
                    continue;
                }
                if self.photograph.clipped[index] {
                    return None;
                }
                (0..3).for_each(|channel| sum[channel] += weight * f64::from(pixels[index][channel]));
            }
        }
        Some(sum)
    }
}

/// The two pixels of a line of `count` around the position `x`, and their weights.
fn taps(x: f64, count: usize) -> [(usize, f64); 2] {
    let at = (x - 0.5).clamp(0.0, (count - 1) as f64);
    let low = at.floor() as usize;
    let part = at - low as f64;
    // A position in the middle of a pixel but for rounding is that pixel.
    let part = if part < ROUNDING {
        0.0
    } else if part > 1.0 - ROUNDING {
        1.0
    } else {
        part
    };
    [(low, 1.0 - part), ((low + 1).min(count - 1), part)]
}
