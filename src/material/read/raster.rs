//! Pictures as stored, before anything is made of their values.

use crate::real::Real;

/// One channel.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// Integers, of which `max` stands for 1.
    Codes { codes: Vec<u16>, max: u16 },
    /// Numbers that stand for themselves.
    Floats(Vec<f32>),
}

impl Samples {
    pub fn len(&self) -> usize {
        match self {
            Self::Codes { codes, .. } => codes.len(),
            Self::Floats(values) => values.len(),
        }
    }

    /// The number that sample `index` stands for: a code as a fraction of the largest one.
    pub fn at(&self, index: usize) -> f64 {
        match self {
            Self::Codes { codes, max } => f64::from(codes[index]) / f64::from(*max),
            Self::Floats(values) => f64::from(values[index]),
        }
    }

    /// `of` every number; each code is computed once.
    pub fn decoded<T: Real>(&self, mut of: impl FnMut(f64) -> f64) -> Vec<T> {
        match self {
            Self::Codes { codes, max } => {
                let top = f64::from(*max);
                let table: Vec<T> = (0..=*max).map(|code| T::of(of(f64::from(code) / top))).collect();
                codes.iter().map(|&code| table[usize::from(code)]).collect()
            }
            Self::Floats(values) => values.iter().map(|&value| T::of(of(f64::from(value)))).collect(),
        }
    }

    pub fn is_float(&self) -> bool {
        matches!(self, Self::Floats(_))
    }

    fn crop(&self, width: usize, [left, top]: [usize; 2], [w, h]: [usize; 2]) -> Self {
        fn cut<S: Copy>(all: &[S], width: usize, [left, top, w, h]: [usize; 4]) -> Vec<S> {
            let rows = all.chunks_exact(width).skip(top).take(h);
            rows.flat_map(|row| &row[left..left + w]).copied().collect()
        }
        let place = [left, top, w, h];
        match self {
            Self::Codes { codes, max } => Self::Codes { codes: cut(codes, width, place), max: *max },
            Self::Floats(values) => Self::Floats(cut(values, width, place)),
        }
    }
}

/// A picture: one plane for each channel, row 0 on top. Alpha is kept apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    pub width: usize,
    pub height: usize,
    /// How the file stores a sample, for people: "8-bit", "half".
    pub depth: &'static str,
    /// One plane for gray, two for XY, three for RGB or XYZ.
    pub channels: Vec<Samples>,
    /// Alpha where it is not opaque everywhere.
    pub alpha: Option<Samples>,
}

impl Raster {
    /// The part of `size` (width, height) whose top left corner is at `corner` (column, row).
    pub fn crop(&self, corner: [usize; 2], size: [usize; 2]) -> Self {
        let cut = |plane: &Samples| plane.crop(self.width, corner, size);
        Self {
            width: size[0],
            height: size[1],
            depth: self.depth,
            channels: self.channels.iter().map(cut).collect(),
            alpha: self.alpha.as_ref().map(cut),
        }
    }

    /// Only channel number `index`.
    pub fn channel(&self, index: usize) -> Self {
        let channels = self.channels.get(index).or(self.channels.last()).cloned();
        Self { channels: channels.into_iter().collect(), alpha: None, ..*self }
    }

    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The channels at `index`, as many as there are; gray stands for all three.
    pub fn rgb(&self, index: usize) -> [f64; 3] {
        let last = self.channels.len() - 1;
        [0, 1, 2].map(|c| self.channels[last.min(c)].at(index))
    }

    pub fn is_float(&self) -> bool {
        self.channels.iter().any(Samples::is_float)
    }

    /// Places all over the picture, a million at most, evenly.
    pub fn sampled(&self) -> impl Iterator<Item = usize> + use<> {
        const MOST: usize = 1 << 20;
        let count = self.width * self.height;
        // Odd, so that a picture whose width is a power of two is not seen in columns only.
        let step = (count / MOST).max(1) | 1;
        (0..count).step_by(step)
    }
}

impl Raster {
    /// Of 1 to 4 channels; the last of 2 or 4 is alpha, and forgotten where it is opaque everywhere.
    pub fn with_alpha(width: usize, height: usize, depth: &'static str, mut channels: Vec<Samples>) -> Self {
        let alpha = if channels.len().is_multiple_of(2) { channels.pop() } else { None };
        let opaque = |alpha: &Samples| (0..alpha.len()).all(|i| alpha.at(i) == 1.0);
        Self { width, height, depth, channels, alpha: alpha.filter(|alpha| !opaque(alpha)) }
    }
}
