//! A material in few bytes, exactly: codes for values that are few, and of a unit vector two components and a hint at the third.

use std::sync::atomic::{AtomicU16, AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};

/// Values that a code can name.
pub(super) const VALUES: usize = 256;
/// Places of the table: so many that each value of an 8-bit map in [0, 1] has one of its own, linear or sRGB.
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

/// Bits of the largest component that the hint holds.
const LOW_BITS: u32 = 5;
/// How many units in the last place the largest component may be away from what the two others say, computed here. From what the
/// adapter computes it may be 16 away: its square root is correct to 5 (WGSL).
const MOST_ULPS: i32 = 10;

/// The two smaller components of a unit vector, and a byte that says which component the largest is, its sign and its last bits:
/// the shader computes it from the others, and takes the nearest number that ends in these bits. `None` where the length is too
/// far from 1 for that.
pub(super) fn packed_normal([x, y, z]: [f32; 3]) -> Option<[u32; 3]> {
    let [a, b, c] = [x, y, z].map(f32::abs);
    let (which, largest, others) = match (c >= a && c >= b, b >= a) {
        (true, _) => (2, z, [x, y]),
        (false, true) => (1, y, [x, z]),
        (false, false) => (0, x, [y, z]),
    };
    let computed = (1.0 - others[0] * others[0] - others[1] * others[1]).max(0.0).sqrt();
    let distance = largest.abs().to_bits() as i32 - computed.to_bits() as i32;
    let (sign, low) = (largest.to_bits() >> 31, largest.to_bits() & ((1 << LOW_BITS) - 1));
    let hint = which << (LOW_BITS + 1) | sign << LOW_BITS | low;
    let [first, second] = others.map(f32::to_bits);
    (distance.abs() <= MOST_ULPS).then_some([first, second, hint])
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

    #[test]
    fn what_is_no_unit_vector_is_not_packed() {
        assert!(packed_normal([0.6, 0.0, 0.8]).is_some());
        // The last bit that the length may be off, and more.
        assert!(packed_normal([0.6, 0.0, 0.800_000_5]).is_some());
        for vector in [[0.6, 0.0, 0.80001], [0.0; 3], [0.6, 0.7, 0.8], [f32::NAN, 0.0, 1.0]] {
            assert_eq!(packed_normal(vector), None, "{vector:?}");
        }
    }
}
