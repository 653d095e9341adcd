//! One channel of a picture: a view of what a decoder returned.
//!
//! The channels of a picture and its crops share the decoder's buffer, so that taking a picture apart copies nothing.

use std::sync::Arc;

use rayon::prelude::*;

use crate::math::real::Real;

/// Samples that one task converts.
const CHUNK: usize = 1 << 16;

/// What a decoder returned.
#[derive(Clone, Debug)]
pub enum Buffer {
    /// Integers, of which 255 stands for 1.
    Bytes(Arc<Vec<u8>>),
    /// Integers, of which 65535 stands for 1.
    Words(Arc<Vec<u16>>),
    /// Numbers that stand for themselves.
    Floats(Arc<Vec<f32>>),
}

impl From<Vec<u8>> for Buffer {
    fn from(samples: Vec<u8>) -> Self {
        Self::Bytes(Arc::new(samples))
    }
}

impl From<Vec<u16>> for Buffer {
    fn from(samples: Vec<u16>) -> Self {
        Self::Words(Arc::new(samples))
    }
}

impl From<Vec<f32>> for Buffer {
    fn from(samples: Vec<f32>) -> Self {
        Self::Floats(Arc::new(samples))
    }
}

impl Buffer {
    pub fn len(&self) -> usize {
        match self {
            Self::Bytes(all) => all.len(),
            Self::Words(all) => all.len(),
            Self::Floats(all) => all.len(),
        }
    }
}

/// Where the samples of a channel lie in a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct View {
    /// The place of sample 0.
    first: usize,
    /// From one sample of a row to the next.
    step: usize,
    /// From one row to the next.
    stride: usize,
    /// Samples of a row.
    width: usize,
    count: usize,
}

impl View {
    fn place(&self, index: usize) -> usize {
        if self.stride == self.width * self.step {
            self.first + index * self.step
        } else {
            self.first + index / self.width * self.stride + index % self.width * self.step
        }
    }

    /// Puts `of` the samples from number `start` on into `out`.
    fn zip<S: Copy, U>(&self, all: &[S], start: usize, out: &mut [U], of: impl Fn(S) -> U) {
        let (mut start, mut rest) = (start, out);
        while !rest.is_empty() {
            let is_whole = self.stride == self.width * self.step;
            let left = if is_whole { self.count - start } else { self.width - start % self.width };
            let (now, later) = rest.split_at_mut(left.min(rest.len()));
            let from = self.place(start);
            let samples = &all[from..from + (now.len() - 1) * self.step + 1];
            if self.step == 1 {
                now.iter_mut().zip(samples).for_each(|(out, &sample)| *out = of(sample));
            } else {
                let samples = samples.iter().step_by(self.step);
                now.iter_mut().zip(samples).for_each(|(out, &sample)| *out = of(sample));
            }
            (start, rest) = (start + now.len(), later);
        }
    }
}

/// Finite numbers outside [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside {
    pub count: usize,
    /// The least of them, or 0.
    pub low: f64,
    /// The largest of them, or 1.
    pub high: f64,
}

impl Default for Outside {
    fn default() -> Self {
        Self { count: 0, low: 0.0, high: 1.0 }
    }
}

impl Outside {
    /// Counts `value` if it is one of them.
    #[must_use]
    pub fn and(self, value: f64) -> Self {
        let count = self.count + usize::from(!(0.0..=1.0).contains(&value));
        Self { count, low: self.low.min(value), high: self.high.max(value) }
    }

    #[must_use]
    pub fn merged(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }
}

/// One channel of a picture, row 0 on top.
#[derive(Clone, Debug)]
pub struct Samples {
    buffer: Buffer,
    view: View,
}

impl PartialEq for Samples {
    fn eq(&self, other: &Self) -> bool {
        self.len() == other.len()
            && (0..self.len()).all(|i| self.stored(i) == other.stored(i))
            && self.top() == other.top()
    }
}

impl Samples {
    /// The `count` channels of pixels whose samples lie beside one another.
    pub fn interleaved(samples: impl Into<Buffer>, count: usize) -> Vec<Self> {
        let buffer = samples.into();
        let texels = buffer.len() / count;
        let channel = |first| {
            let view = View { first, step: count, stride: texels * count, width: texels, count: texels };
            Self { buffer: buffer.clone(), view }
        };
        (0..count).map(channel).collect()
    }

    /// The `count` channels that lie one behind another.
    pub fn planar(samples: impl Into<Buffer>, count: usize) -> Vec<Self> {
        let buffer = samples.into();
        let texels = buffer.len() / count;
        let channel = |index| {
            let view = View { first: index * texels, step: 1, stride: texels, width: texels, count: texels };
            Self { buffer: buffer.clone(), view }
        };
        (0..count).map(channel).collect()
    }

    /// A channel of numbers that stand for themselves.
    pub fn floats(values: Vec<f32>) -> Self {
        let count = values.len();
        let view = View { first: 0, step: 1, stride: count, width: count, count };
        Self { buffer: values.into(), view }
    }

    pub fn len(&self) -> usize {
        self.view.count
    }

    /// The number that sample `index` stands for: an integer as a fraction of the largest one.
    pub fn at(&self, index: usize) -> f64 {
        let place = self.view.place(index);
        match &self.buffer {
            Buffer::Bytes(all) => f64::from(all[place]) / 255.0,
            Buffer::Words(all) => f64::from(all[place]) / 65_535.0,
            Buffer::Floats(all) => f64::from(all[place]),
        }
    }

    /// Sample `index` as it is stored, an integer as such.
    pub fn stored(&self, index: usize) -> f64 {
        let place = self.view.place(index);
        match &self.buffer {
            Buffer::Bytes(all) => f64::from(all[place]),
            Buffer::Words(all) => f64::from(all[place]),
            Buffer::Floats(all) => f64::from(all[place]),
        }
    }

    /// What stands for 1.
    pub fn top(&self) -> f64 {
        match &self.buffer {
            Buffer::Bytes(_) => 255.0,
            Buffer::Words(_) => 65_535.0,
            Buffer::Floats(_) => 1.0,
        }
    }

    pub fn is_float(&self) -> bool {
        matches!(self.buffer, Buffer::Floats(_))
    }

    /// Whether every sample stands for `value`.
    pub fn is_all(&self, value: f64) -> bool {
        self.is_all_stored(value * self.top())
    }

    /// Whether all samples are the same.
    pub fn is_constant(&self) -> bool {
        self.len() == 0 || self.is_all_stored(self.stored(0))
    }

    fn is_all_stored(&self, value: f64) -> bool {
        // Nearly always the first samples tell.
        let few = self.len().min(1 << 12);
        let is = |index: usize| self.stored(index) == value;
        (0..few).all(is) && (few..self.len()).into_par_iter().all(is)
    }

    /// `of` every number, on all cores; each possible integer is computed once.
    pub fn decoded<T: Real>(&self, of: impl Fn(f64) -> f64 + Sync) -> Vec<T> {
        let table =
            |top: usize| -> Vec<T> { (0..=top).map(|code| T::of(of(code as f64 / top as f64))).collect() };
        match &self.buffer {
            Buffer::Bytes(all) => {
                let table: [T; 256] = std::array::from_fn(|code| T::of(of(code as f64 / 255.0)));
                self.mapped(all, |code| table[usize::from(code)])
            }
            Buffer::Words(all) => {
                let table = table(usize::from(u16::MAX));
                self.mapped(all, |code| table[usize::from(code)])
            }
            Buffer::Floats(all) => self.mapped(all, |value| T::of(of(f64::from(value)))),
        }
    }

    fn mapped<S: Copy + Sync, T: Real>(&self, all: &[S], of: impl Fn(S) -> T + Sync) -> Vec<T> {
        let mut out = vec![T::zero(); self.len()];
        let chunks = out.par_chunks_mut(CHUNK).enumerate();
        chunks.for_each(|(number, chunk)| self.view.zip(all, number * CHUNK, chunk, &of));
        out
    }

    /// Puts the numbers from sample `start` on into `out`.
    pub fn read(&self, start: usize, out: &mut [f64]) {
        match &self.buffer {
            Buffer::Bytes(all) => self.view.zip(all, start, out, |code| f64::from(code) / 255.0),
            Buffer::Words(all) => self.view.zip(all, start, out, |code| f64::from(code) / 65_535.0),
            Buffer::Floats(all) => self.view.zip(all, start, out, f64::from),
        }
    }

    /// The NaN and infinite samples with their numbers.
    pub fn not_finite(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
        let all = match &self.buffer {
            Buffer::Floats(all) => {
                self.scanned(all, |chunk| chunk.iter().any(|v| !v.is_finite())).any(|any| any).then_some(all)
            }
            _ => None,
        };
        let places = (0..if all.is_some() { self.len() } else { 0 }).map(|i| (i, self.stored(i) as f32));
        places.filter(|(_, value)| !value.is_finite())
    }

    /// How many finite samples lie outside [0, 1], and the range from the least (or 0) to the largest (or 1).
    pub fn outside_unit(&self) -> Outside {
        match &self.buffer {
            Buffer::Floats(all) => self
                .scanned(all, |chunk| {
                    let finite = chunk.iter().map(|&v| f64::from(v)).filter(|v| v.is_finite());
                    finite.fold(Outside::default(), Outside::and)
                })
                .reduce(Outside::default, Outside::merged),
            _ => Outside::default(),
        }
    }

    /// What `of` returns for the floats of each chunk.
    fn scanned<'a, R: Send>(
        &'a self,
        all: &'a [f32],
        of: impl Fn(&[f32]) -> R + Sync + Send + 'a,
    ) -> impl ParallelIterator<Item = R> + 'a {
        (0..self.len().div_ceil(CHUNK)).into_par_iter().map(move |number| {
            let mut chunk = vec![0.0; CHUNK.min(self.len() - number * CHUNK)];
            self.view.zip(all, number * CHUNK, &mut chunk, |v| v);
            of(&chunk)
        })
    }

    /// Puts the samples from number `start` on into `out` as they are stored.
    fn read_stored(&self, start: usize, out: &mut [f32]) {
        match &self.buffer {
            Buffer::Bytes(all) => self.view.zip(all, start, out, f32::from),
            Buffer::Words(all) => self.view.zip(all, start, out, f32::from),
            Buffer::Floats(all) => self.view.zip(all, start, out, |value| value),
        }
    }

    /// `count` samples, each from the place that `place` returns.
    pub fn picked(&self, count: usize, place: impl Fn(usize) -> usize) -> Self {
        fn pick<S: Copy>(all: &[S], places: impl Iterator<Item = usize>) -> Vec<S> {
            places.map(|place| all[place]).collect()
        }
        let places = (0..count).map(|i| self.view.place(place(i)));
        let buffer = match &self.buffer {
            Buffer::Bytes(all) => pick(all, places).into(),
            Buffer::Words(all) => pick(all, places).into(),
            Buffer::Floats(all) => pick(all, places).into(),
        };
        Self { buffer, view: View { first: 0, step: 1, stride: count, width: count, count } }
    }

    /// The part of `size` whose top left corner is at `corner`, of a channel of rows of `width` samples.
    pub fn crop(&self, width: usize, [left, top]: [usize; 2], [w, h]: [usize; 2]) -> Self {
        let Self { buffer, view } = self;
        let is_whole = view.stride == view.width * view.step;
        let stride = if is_whole { width * view.step } else { view.stride };
        let first = view.place(top * width + left);
        Self { buffer: buffer.clone(), view: View { first, step: view.step, stride, width: w, count: w * h } }
    }
}

/// The largest difference between the channels of a texel.
pub fn spread(channels: &[Samples]) -> f64 {
    const CHUNK: usize = 1 << 13;
    let Some((first, others)) = channels.split_first().filter(|(_, others)| !others.is_empty()) else {
        return 0.0;
    };
    let largest = |number: usize| {
        let start = number * CHUNK;
        let stored = |channel: &Samples| {
            let mut chunk = vec![0.0; CHUNK.min(first.len() - start)];
            channel.read_stored(start, &mut chunk);
            chunk
        };
        let mut low = stored(first);
        let mut high = low.clone();
        for other in others {
            for ((low, high), value) in low.iter_mut().zip(&mut high).zip(stored(other)) {
                (*low, *high) = (low.min(value), high.max(value));
            }
        }
        low.iter().zip(&high).map(|(low, high)| high - low).fold(0.0, f32::max)
    };
    let chunks = (0..first.len().div_ceil(CHUNK)).into_par_iter();
    f64::from(chunks.map(largest).reduce(|| 0.0, f32::max)) / first.top()
}
