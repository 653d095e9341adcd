//! The buffer that a decoder returned, the places of the samples of one channel in it, and counts of those outside [0, 1].

use std::sync::Arc;

/// The samples of a picture as a decoder returned them.
#[derive(Clone, Debug)]
pub(crate) enum Buffer {
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
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Bytes(all) => all.len(),
            Self::Words(all) => all.len(),
            Self::Floats(all) => all.len(),
        }
    }

    pub(crate) fn is(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Bytes(a), Self::Bytes(b)) => Arc::ptr_eq(a, b),
            (Self::Words(a), Self::Words(b)) => Arc::ptr_eq(a, b),
            (Self::Floats(a), Self::Floats(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

/// Where the samples of a channel lie in a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ChannelView {
    pub first: usize,
    /// From one sample of a row to the next.
    pub step: usize,
    /// From one row to the next.
    pub stride: usize,
    pub width: usize,
    pub count: usize,
}

impl ChannelView {
    /// Whether a row follows the one above it like any sample the one before it.
    pub(super) fn is_whole(&self) -> bool {
        self.stride == self.width * self.step
    }

    pub(super) fn place(&self, index: usize) -> usize {
        if self.is_whole() {
            return self.first + index * self.step;
        }
        // Nearly always small: then a division takes half the time.
        let (row, column) = match (u32::try_from(index), u32::try_from(self.width)) {
            (Ok(index), Ok(width)) => ((index / width) as usize, (index % width) as usize),
            _ => (index / self.width, index % self.width),
        };
        self.first + row * self.stride + column * self.step
    }

    /// Calls `of` for each run of samples that lie a step apart, of the `count` from number `start` on: with the place
    /// of the first of them, how many there were before, and how many they are.
    pub(super) fn runs(&self, start: usize, count: usize, mut of: impl FnMut(usize, usize, usize)) {
        let mut done = 0;
        while done < count {
            let index = start + done;
            let left = if self.is_whole() { count } else { self.width - index % self.width };
            let run = left.min(count - done);
            of(self.place(index), done, run);
            done += run;
        }
    }

    /// Puts `of` the samples from number `start` on into `out`.
    pub(super) fn zip<S: Copy, U>(&self, all: &[S], start: usize, out: &mut [U], of: impl Fn(S) -> U) {
        self.runs(start, out.len(), |from, done, run| {
            let out = out[done..done + run].iter_mut();
            let samples = &all[from..from + (run - 1) * self.step + 1];
            match self.step {
                1 => out.zip(samples).for_each(|(out, &sample)| *out = of(sample)),
                step => out.zip(samples.iter().step_by(step)).for_each(|(out, &sample)| *out = of(sample)),
            }
        });
    }

    /// As [`zip`](Self::zip), of this channel, which is the first of its pixels, and the two that follow.
    pub(super) fn zip_three<S: Copy, U>(
        &self,
        all: &[S],
        start: usize,
        out: [&mut [U]; 3],
        of: impl Fn(S) -> U,
    ) {
        let [red, green, blue] = out;
        let count = red.len();
        self.runs(start, count, |from, done, run| {
            let [red, green, blue] =
                [&mut *red, &mut *green, &mut *blue].map(|out| &mut out[done..done + run]);
            let out = red.iter_mut().zip(green).zip(blue);
            let samples = &all[from..from + (run - 1) * self.step + 3];
            match self.step {
                3 => out.zip(samples.as_chunks::<3>().0).for_each(|(((r, g), b), pixel)| {
                    [*r, *g, *b] = [of(pixel[0]), of(pixel[1]), of(pixel[2])];
                }),
                step => out.zip(samples.chunks(step)).for_each(|(((r, g), b), pixel)| {
                    [*r, *g, *b] = [of(pixel[0]), of(pixel[1]), of(pixel[2])];
                }),
            }
        });
    }
}

/// Finite numbers outside [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OutOfRange {
    pub count: usize,
    /// The least of them, or 0.
    pub low: f64,
    /// The largest of them, or 1.
    pub high: f64,
}

impl Default for OutOfRange {
    fn default() -> Self {
        Self { count: 0, low: 0.0, high: 1.0 }
    }
}

impl OutOfRange {
    /// Counts `value` if it is one of them.
    #[must_use]
    pub(crate) fn and(self, value: f64) -> Self {
        let count = self.count + usize::from(!(0.0..=1.0).contains(&value));
        Self { count, low: self.low.min(value), high: self.high.max(value) }
    }

    #[must_use]
    pub(crate) fn merged(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }
}
