//! One channel of a picture: a view of the buffer that a decoder returned.
//!
//! The channels of a picture and its crops share the decoder's buffer, so that taking a picture apart copies nothing.

use rayon::prelude::*;

use svbrdf_core::math::real::Real;

use super::buffer::{Buffer, ChannelView, OutOfRange};

const CHUNK: usize = 1 << 16;

/// One channel of a picture, row 0 on top.
#[derive(Clone, Debug)]
pub(crate) struct Samples {
    buffer: Buffer,
    view: ChannelView,
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
    pub(crate) fn interleaved(samples: impl Into<Buffer>, count: usize) -> Vec<Self> {
        let buffer = samples.into();
        let texels = buffer.len() / count;
        (0..count).map(|first| Self::new(buffer.clone(), first, count, texels)).collect()
    }

    /// The `count` channels that lie one behind another.
    pub(crate) fn planar(samples: impl Into<Buffer>, count: usize) -> Vec<Self> {
        let buffer = samples.into();
        let texels = buffer.len() / count;
        (0..count).map(|index| Self::new(buffer.clone(), index * texels, 1, texels)).collect()
    }

    /// A channel of numbers that stand for themselves.
    pub(crate) fn floats(values: Vec<f32>) -> Self {
        let count = values.len();
        Self::new(values.into(), 0, 1, count)
    }

    /// A channel of codes of 16 bits.
    pub(crate) fn words(codes: Vec<u16>) -> Self {
        let count = codes.len();
        Self::new(codes.into(), 0, 1, count)
    }

    /// The `count` samples from number `first` on, `step` apart.
    fn new(buffer: Buffer, first: usize, step: usize, count: usize) -> Self {
        Self { buffer, view: ChannelView { first, step, stride: step * count, width: count, count } }
    }

    pub(crate) fn len(&self) -> usize {
        self.view.count
    }

    /// The number that sample `index` stands for: an integer as a fraction of the largest one.
    pub(crate) fn at(&self, index: usize) -> f64 {
        self.stored(index) / self.top()
    }

    /// Sample `index` as it is stored, an integer as such.
    pub(crate) fn stored(&self, index: usize) -> f64 {
        let place = self.view.place(index);
        match &self.buffer {
            Buffer::Bytes(all) => f64::from(all[place]),
            Buffer::Words(all) => f64::from(all[place]),
            Buffer::Floats(all) => f64::from(all[place]),
        }
    }

    /// The stored value of 1.
    pub(crate) fn top(&self) -> f64 {
        match &self.buffer {
            Buffer::Bytes(_) => 255.0,
            Buffer::Words(_) => 65_535.0,
            Buffer::Floats(_) => 1.0,
        }
    }

    pub(crate) fn is_float(&self) -> bool {
        matches!(self.buffer, Buffer::Floats(_))
    }

    /// Whether every sample stands for `value`.
    pub(crate) fn is_all(&self, value: f64) -> bool {
        self.is_all_stored(value * self.top())
    }

    /// Whether all samples are the same.
    pub(crate) fn is_constant(&self) -> bool {
        self.len() == 0 || self.is_all_stored(self.stored(0))
    }

    fn is_all_stored(&self, value: f64) -> bool {
        // Nearly always the first samples tell.
        let few = self.len().min(1 << 12);
        if !(0..few).all(|index| self.stored(index) == value) {
            return false;
        }
        match &self.buffer {
            Buffer::Bytes(all) => self.are_all(all, |sample| f64::from(sample) == value),
            Buffer::Words(all) => self.are_all(all, |sample| f64::from(sample) == value),
            Buffer::Floats(all) => self.are_all(all, |sample| f64::from(sample) == value),
        }
    }

    fn are_all<S: Copy + Sync>(&self, all: &[S], is: impl Fn(S) -> bool + Sync) -> bool {
        (0..self.len().div_ceil(CHUNK)).into_par_iter().all(|number| {
            let (start, mut are) = (number * CHUNK, true);
            self.view.runs(start, CHUNK.min(self.len() - start), |from, _, run| {
                let samples = &all[from..from + (run - 1) * self.view.step + 1];
                are = are && samples.iter().step_by(self.view.step).all(|&sample| is(sample));
            });
            are
        })
    }

    /// `of` every number, on all cores; each possible integer is computed once.
    pub(crate) fn decoded<T: Real>(&self, of: impl Fn(f64) -> f64 + Sync) -> Vec<T> {
        match &self.buffer {
            Buffer::Bytes(all) => {
                let table = of_bytes(of);
                self.mapped(all, |code| table[usize::from(code)])
            }
            Buffer::Words(all) => {
                let table = of_words(of);
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

    /// As [`decoded`](Self::decoded) of three channels; in one pass where they are those of one picture.
    pub(crate) fn decoded_three<T: Real>(
        channels: [&Self; 3],
        of: impl Fn(f64) -> f64 + Sync,
    ) -> [Vec<T>; 3] {
        if !Self::are_one_picture(channels) {
            return channels.map(|channel| channel.decoded(&of));
        }
        let first = channels[0];
        match &first.buffer {
            Buffer::Bytes(all) => {
                let table = of_bytes(of);
                first.mapped_three(all, |code| table[usize::from(code)])
            }
            Buffer::Words(all) => {
                let table = of_words(of);
                first.mapped_three(all, |code| table[usize::from(code)])
            }
            Buffer::Floats(all) => first.mapped_three(all, |value| T::of(of(f64::from(value)))),
        }
    }

    fn are_one_picture(channels: [&Self; 3]) -> bool {
        let [first, others @ ..] = channels;
        let follows = |(number, other): (usize, &&Self)| {
            let place = ChannelView { first: first.view.first + number + 1, ..first.view };
            first.buffer.is(&other.buffer) && other.view == place
        };
        first.view.step >= 3 && others.iter().enumerate().all(follows)
    }

    fn mapped_three<S: Copy + Sync, T: Real>(&self, all: &[S], of: impl Fn(S) -> T + Sync) -> [Vec<T>; 3] {
        let mut out = [0; 3].map(|_| vec![T::zero(); self.len()]);
        let [red, green, blue] = out.each_mut().map(|plane| plane.par_chunks_mut(CHUNK));
        red.zip(green).zip(blue).enumerate().for_each(|(number, ((red, green), blue))| {
            self.view.zip_three(all, number * CHUNK, [red, green, blue], &of);
        });
        out
    }

    /// Puts the numbers from sample `start` on into `out`.
    pub(crate) fn read(&self, start: usize, out: &mut [f64]) {
        match &self.buffer {
            Buffer::Bytes(all) => self.view.zip(all, start, out, |code| BYTES[usize::from(code)]),
            Buffer::Words(all) => self.view.zip(all, start, out, |code| f64::from(code) / 65_535.0),
            Buffer::Floats(all) => self.view.zip(all, start, out, f64::from),
        }
    }

    /// The NaN and infinite samples with their numbers.
    pub(crate) fn not_finite(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
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
    pub(crate) fn out_of_range(&self) -> OutOfRange {
        match &self.buffer {
            Buffer::Floats(all) => self
                .scanned(all, |chunk| {
                    let finite = chunk.iter().map(|&v| f64::from(v)).filter(|v| v.is_finite());
                    finite.fold(OutOfRange::default(), OutOfRange::and)
                })
                .reduce(OutOfRange::default, OutOfRange::merged),
            _ => OutOfRange::default(),
        }
    }

    /// `of` the floats of each chunk.
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
    pub(crate) fn read_stored(&self, start: usize, out: &mut [f32]) {
        match &self.buffer {
            Buffer::Bytes(all) => self.view.zip(all, start, out, f32::from),
            Buffer::Words(all) => self.view.zip(all, start, out, f32::from),
            Buffer::Floats(all) => self.view.zip(all, start, out, |value| value),
        }
    }

    /// `count` samples, each from the place that `place` returns.
    pub(crate) fn picked(&self, count: usize, place: impl Fn(usize) -> usize) -> Self {
        fn pick<S: Copy>(all: &[S], places: impl Iterator<Item = usize>) -> Vec<S> {
            places.map(|place| all[place]).collect()
        }
        let places = (0..count).map(|i| self.view.place(place(i)));
        let buffer = match &self.buffer {
            Buffer::Bytes(all) => pick(all, places).into(),
            Buffer::Words(all) => pick(all, places).into(),
            Buffer::Floats(all) => pick(all, places).into(),
        };
        Self::new(buffer, 0, 1, count)
    }

    /// The part of `size` whose top left corner is at `corner`, of a channel of rows of `width` samples.
    pub(crate) fn crop(&self, width: usize, [left, top]: [usize; 2], [w, h]: [usize; 2]) -> Self {
        let Self { buffer, view } = self;
        let stride = if view.is_whole() { width * view.step } else { view.stride };
        let first = view.place(top * width + left);
        Self {
            buffer: buffer.clone(),
            view: ChannelView { first, step: view.step, stride, width: w, count: w * h },
        }
    }
}

/// `of` the number of each byte.
fn of_bytes<T: Real>(of: impl Fn(f64) -> f64) -> [T; 256] {
    BYTES.map(|value| T::of(of(value)))
}

/// `of` the number of each word.
fn of_words<T: Real>(of: impl Fn(f64) -> f64 + Sync) -> Vec<T> {
    let top = usize::from(u16::MAX);
    (0..=top).into_par_iter().map(|code| T::of(of(code as f64 / top as f64))).collect()
}

/// The numbers that bytes stand for.
const BYTES: [f64; 256] = {
    let mut all = [0.0; 256];
    let mut code = 0;
    while code < all.len() {
        all[code] = code as f64 / 255.0;
        code += 1;
    }
    all
};
