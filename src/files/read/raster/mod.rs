//! Pictures as stored, before their values are interpreted.

mod buffer;
pub(super) mod measure;
mod samples;

use glam::DMat3;
use rayon::prelude::*;

pub(super) use buffer::{Buffer, OutOfRange};
pub(super) use samples::Samples;

/// A picture: one plane for each channel, row 0 on top. Alpha is separate.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Raster {
    pub width: usize,
    pub height: usize,
    /// How the file stores a sample, for people: "8-bit", "half".
    pub depth: &'static str,
    /// One plane for gray, two for XY, three for RGB or XYZ.
    pub channels: Vec<Samples>,
    /// Alpha where it is not opaque everywhere.
    pub alpha: Option<Samples>,
    /// From linear red, green and blue of the primaries that the file declares to those of Rec. 709, where they are others.
    pub to_rec709: Option<DMat3>,
}

/// The distance between two stored values; halves have 11 bits at 1, floats count as exact.
pub(super) fn step(depth: &str) -> f64 {
    match depth {
        "8-bit" => 1.0 / 255.0,
        "16-bit" => 1.0 / 65_535.0,
        "half" => 1.0 / 2048.0,
        _ => 0.0,
    }
}

impl Raster {
    /// The part of `size` (width, height) whose top left corner is at `corner` (column, row).
    pub(crate) fn crop(&self, corner: [usize; 2], size: [usize; 2]) -> Self {
        let cut = |plane: &Samples| plane.crop(self.width, corner, size);
        Self {
            width: size[0],
            height: size[1],
            depth: self.depth,
            channels: self.channels.iter().map(cut).collect(),
            alpha: self.alpha.as_ref().map(cut),
            to_rec709: self.to_rec709,
        }
    }

    pub(crate) fn channel(&self, index: usize) -> Self {
        let channels = self.channels.get(index).or(self.channels.last()).cloned();
        Self { channels: channels.into_iter().collect(), ..self.without_samples() }
    }

    /// Only channel number `index`, where 3 is alpha: alpha that is 1 everywhere is not stored.
    pub(crate) fn channel_or_alpha(&self, index: usize) -> Self {
        match (index, &self.alpha) {
            (3, Some(alpha)) => self.of(alpha.clone()),
            (3, None) => Self::constant("alpha", &[1.0]),
            _ => self.channel(index),
        }
    }

    pub(crate) fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The channels at `index`, as many as there are; gray stands for all three.
    pub(crate) fn rgb(&self, index: usize) -> [f64; 3] {
        let last = self.channels.len() - 1;
        [0, 1, 2].map(|c| self.channels[last.min(c)].at(index))
    }

    pub(crate) fn is_float(&self) -> bool {
        self.channels.iter().any(Samples::is_float)
    }

    /// Places all over the picture, about 16,000 at most, evenly.
    pub(crate) fn sampled(&self) -> impl Iterator<Item = usize> + use<> {
        const MOST: usize = 1 << 14;
        let count = self.width * self.height;
        // Odd, so that a picture whose width is a power of two is not sampled in columns only.
        let step = (count / MOST).max(1) | 1;
        (0..count).step_by(step)
    }

    /// `plane`, of the same size.
    pub(crate) fn of(&self, plane: Samples) -> Self {
        Self { channels: vec![plane], ..self.without_samples() }
    }

    /// Size and depth alone.
    pub(crate) fn without_samples(&self) -> Self {
        Self { channels: Vec::new(), alpha: None, ..*self }
    }

    /// Of 1 to 4 channels; the last of 2 or 4 is alpha, and dropped where it is opaque everywhere.
    pub(crate) fn with_alpha(
        width: usize,
        height: usize,
        depth: &'static str,
        mut channels: Vec<Samples>,
    ) -> Self {
        let alpha = if channels.len().is_multiple_of(2) { channels.pop() } else { None };
        let alpha = alpha.filter(|alpha| !alpha.is_all(1.0));
        Self { width, height, depth, channels, alpha, to_rec709: None }
    }

    /// Every number of the channels times a factor, one for each; as it is where all are 1.
    pub(crate) fn scaled(self, factors: &[f32]) -> Self {
        if factors.iter().all(|&factor| factor == 1.0) {
            return self;
        }
        let times = |(plane, &factor): (&Samples, &f32)| {
            Samples::floats(plane.decoded(|value| f64::from(value as f32 * factor)))
        };
        Self { channels: self.channels.iter().zip(factors.iter().cycle()).map(times).collect(), ..self }
    }

    /// The channels divided by alpha, by which the file multiplies them; 0 where nothing is left of them.
    pub(crate) fn unmultiplied(self) -> Self {
        let Some(alpha) = &self.alpha else { return self };
        let divided = |plane: &Samples| {
            let value = |index: usize| plane.at(index) / alpha.at(index);
            let finite = (0..plane.len()).map(value).map(|v| if v.is_finite() { v } else { 0.0 });
            if plane.is_float() {
                return Samples::floats(finite.map(|value| value as f32).collect());
            }
            Samples::words(finite.map(|value| (65_535.0 * value.min(1.0)).round() as u16).collect())
        };
        Self { channels: self.channels.iter().map(divided).collect(), ..self }
    }

    /// The upright picture of one whose rows and columns are stored in the TIFF `orientation` (1 to 8).
    pub(crate) fn oriented(self, orientation: u16) -> Self {
        let (mirrored, upset) = (matches!(orientation, 2 | 3 | 6 | 7), matches!(orientation, 3 | 4 | 7 | 8));
        let turned = matches!(orientation, 5..=8);
        if !(mirrored || upset || turned) {
            return self;
        }
        let [width, height] = if turned { [self.height, self.width] } else { self.size() };
        let stored = |index: usize| {
            let (x, y) = (index % width, index / width);
            let x = if mirrored { width - 1 - x } else { x };
            let y = if upset { height - 1 - y } else { y };
            if turned { x * self.width + y } else { y * self.width + x }
        };
        let plane = |plane: &Samples| plane.picked(width * height, stored);
        let (channels, alpha) = (self.channels.iter().map(plane).collect(), self.alpha.as_ref().map(plane));
        Self { width, height, channels, alpha, ..self }
    }

    /// A single texel of the given channels.
    pub(crate) fn constant(depth: &'static str, values: &[f32]) -> Self {
        let channels = values.iter().map(|&value| Samples::floats(vec![value])).collect();
        Self { width: 1, height: 1, depth, channels, alpha: None, to_rec709: None }
    }
}

/// The largest difference between the channels of a texel.
pub(crate) fn channel_spread(channels: &[Samples]) -> f64 {
    const CHUNK: usize = 1 << 16;
    /// Texels that stay in the nearest cache.
    const FEW: usize = 1 << 9;
    let Some((first, others)) = channels.split_first().filter(|(_, others)| !others.is_empty()) else {
        return 0.0;
    };
    let largest = |number: usize| {
        let (mut low, mut high, mut other) = ([0.0; FEW], [0.0; FEW], [0.0; FEW]);
        let end = first.len().min((number + 1) * CHUNK);
        let mut largest = 0.0_f32;
        for start in (number * CHUNK..end).step_by(FEW) {
            let count = FEW.min(end - start);
            let (low, high, other) = (&mut low[..count], &mut high[..count], &mut other[..count]);
            first.read_stored(start, low);
            high.copy_from_slice(low);
            for channel in others {
                channel.read_stored(start, other);
                for ((low, high), value) in low.iter_mut().zip(&mut *high).zip(&*other) {
                    (*low, *high) = (low.min(*value), high.max(*value));
                }
            }
            largest = low.iter().zip(&*high).map(|(low, high)| high - low).fold(largest, f32::max);
        }
        largest
    };
    let chunks = (0..first.len().div_ceil(CHUNK)).into_par_iter();
    f64::from(chunks.map(largest).reduce(|| 0.0, f32::max)) / first.top()
}
