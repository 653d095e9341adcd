//! Codes of the values of a map: where a map holds at most 256 different numbers, as one of an 8-bit file does, a byte names each.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

/// Values that a code can name.
pub(super) const VALUES: usize = 256;
/// Places of the table: a power of two, of which at most a quarter is taken.
const PLACES: usize = 1024;
/// An empty place.
const NONE: u64 = u64::MAX;

/// Values by their bits, which several threads look up and add to.
#[derive(Debug)]
pub(super) struct Codes {
    /// The code of a value over its bits.
    places: Vec<AtomicU64>,
    values: Mutex<Vec<f32>>,
}

impl Codes {
    pub(super) fn new() -> Self {
        let places = (0..PLACES).map(|_| AtomicU64::new(NONE)).collect();
        Self { places, values: Mutex::default() }
    }

    /// The code of this value; `None` where there are too many values.
    pub(super) fn code(&self, value: f32) -> Option<u32> {
        let bits = value.to_bits();
        let mut place = first_place(bits);
        loop {
            match self.places[place].load(Ordering::Acquire) {
                NONE => return self.add(value),
                found if found as u32 == bits => return Some((found >> 32) as u32),
                _ => place = (place + 1) % PLACES,
            }
        }
    }

    /// Gives the value a code, unless another thread has.
    fn add(&self, value: f32) -> Option<u32> {
        let mut values = self.values.lock().unwrap_or_else(PoisonError::into_inner);
        let bits = value.to_bits();
        if let Some(code) = values.iter().position(|known| known.to_bits() == bits) {
            return Some(code as u32);
        }
        if values.len() == VALUES {
            return None;
        }
        let code = values.len() as u32;
        values.push(value);
        let mut place = first_place(bits);
        while self.places[place].load(Ordering::Acquire) != NONE {
            place = (place + 1) % PLACES;
        }
        self.places[place].store((u64::from(code) << 32) | u64::from(bits), Ordering::Release);
        Some(code)
    }

    /// The value of each code.
    pub(super) fn values(&self) -> Vec<f32> {
        self.values.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// Where a value is looked for first.
fn first_place(bits: u32) -> usize {
    (bits.wrapping_mul(0x9e37_79b1) >> 22) as usize
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
        assert_eq!(values.len(), VALUES);
        for (number, code) in numbers.iter().zip(found) {
            assert_eq!(values[code.unwrap() as usize].to_bits(), value(*number).to_bits(), "{number}");
        }
        assert_eq!(codes.code(2.0), None);
        // 0 and -0 are two values.
        assert_eq!(codes.code(0.0), None);
        assert!(codes.code(-0.0).is_some());
    }
}
