//! Codes of the values of a map: where a map holds at most 256 different numbers, as one of an 8-bit file does, a byte names each.

use std::sync::atomic::{AtomicU16, AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};

/// Values that a code can name.
pub(super) const VALUES: usize = 256;
/// Places of the table. Each value of an 8-bit map in [0, 1] has one of its own, linear or sRGB.
const PLACES: usize = 8192;
/// An empty place.
const NONE: u16 = u16::MAX;

/// Values by their bits, which several threads look up and add to.
#[derive(Debug)]
pub(super) struct Codes {
    /// The code of a value, from its first place on.
    places: Box<[AtomicU16; PLACES]>,
    /// The bits of the value of each code.
    bits: [AtomicU32; VALUES],
    /// How many values there are.
    count: Mutex<usize>,
}

impl Codes {
    pub(super) fn new() -> Self {
        let places = Box::new(std::array::from_fn(|_| AtomicU16::new(NONE)));
        Self { places, bits: std::array::from_fn(|_| AtomicU32::new(0)), count: Mutex::default() }
    }

    /// The code of this value; `None` where there are too many values.
    #[inline]
    pub(super) fn code(&self, value: f32) -> Option<u32> {
        let code = self.places[first_place(value)].load(Ordering::Acquire);
        if self.names(code, value) { Some(code.into()) } else { self.find(value) }
    }

    /// Whether this code is there, and the value is its one.
    #[inline]
    fn names(&self, code: u16, value: f32) -> bool {
        self.bits.get(usize::from(code)).is_some_and(|bits| bits.load(Ordering::Relaxed) == value.to_bits())
    }

    /// As [`Codes::code`], of a value that is not at its first place.
    #[cold]
    fn find(&self, value: f32) -> Option<u32> {
        let mut place = first_place(value);
        loop {
            match self.places[place].load(Ordering::Acquire) {
                NONE => return self.add(value),
                code if self.names(code, value) => return Some(code.into()),
                _ => place = (place + 1) % PLACES,
            }
        }
    }

    /// Gives the value a code, unless another thread has.
    fn add(&self, value: f32) -> Option<u32> {
        let mut count = self.count.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(code) = (0..*count).find(|code| self.names(*code as u16, value)) {
            return Some(code as u32);
        }
        let code = *count;
        self.bits.get(code)?.store(value.to_bits(), Ordering::Relaxed);
        *count += 1;
        let mut place = first_place(value);
        while self.places[place].load(Ordering::Relaxed) != NONE {
            place = (place + 1) % PLACES;
        }
        self.places[place].store(code as u16, Ordering::Release);
        Some(code as u32)
    }

    /// The value of each code; 0 of those that name none.
    pub(super) fn values(&self) -> [f32; VALUES] {
        self.bits.each_ref().map(|bits| f32::from_bits(bits.load(Ordering::Relaxed)))
    }
}

/// Where a value is looked for first: of those in [0, 1] the first 12 bits behind the point.
#[inline]
fn first_place(value: f32) -> usize {
    ((1.0 + value).to_bits() >> (f32::MANTISSA_DIGITS - 1 - 12)) as usize % PLACES
}

#[cfg(test)]
mod tests {
    use rayon::prelude::*;

    use super::*;

    #[test]
    fn every_value_has_its_code_from_all_threads_and_the_257th_has_none() {
        let codes = Codes::new();
        let value = |number: usize| if number == 0 { -0.0 } else { (number % VALUES) as f32 / 255.0 };
        let numbers: Vec<usize> = (0..100_000).map(|number| number % VALUES).collect();
        let found: Vec<Option<u32>> = numbers.par_iter().map(|number| codes.code(value(*number))).collect();
        let values = codes.values();
        for (number, code) in numbers.iter().zip(found) {
            assert_eq!(values[code.unwrap() as usize].to_bits(), value(*number).to_bits(), "{number}");
        }
        assert_eq!(codes.code(2.0), None);
        // 0 and -0 are two values.
        assert_eq!(codes.code(0.0), None);
        assert!(codes.code(-0.0).is_some());
    }
}
