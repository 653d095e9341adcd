//! Curves: from values of [0, 1] to the integers of a picture.

use crate::read::Albedo;
use crate::read::options::transfer::{encoded, linear};

/// Steps of value that have a first guess of their integer.
const STEPS: usize = 1 << 12;

/// An encoding, and the integers that stand for values in it.
///
/// The integer of each value is `round(top * encoded(value))`; powers are looked up.
pub(super) struct Curve {
    encoded: Box<dyn Fn(f64) -> f64 + Sync>,
    top: f64,
    table: Option<NearestTable>,
}

/// The values from which on each integer is the nearest, and the integer of the start of each step.
struct NearestTable {
    from: Vec<f64>,
    first: Vec<u16>,
}

impl Curve {
    /// Of values that are stored as they are, or by an encoding that costs no more than arithmetic.
    pub(super) fn plain(top: u16, encoded: impl Fn(f64) -> f64 + Sync + 'static) -> Self {
        Self { encoded: Box::new(encoded), top: f64::from(top), table: None }
    }

    /// Of an `encoded` that rises, with its inverse.
    pub(super) fn rising(
        top: u16,
        encoded: impl Fn(f64) -> f64 + Sync + 'static,
        decoded: impl Fn(f64) -> f64,
    ) -> Self {
        let most = f64::from(top);
        let mut from: Vec<f64> = (0..top).map(|code| decoded((f64::from(code) + 0.5) / most)).collect();
        from.push(f64::INFINITY);
        let mut code = 0;
        let first = (0..=STEPS).map(|step| {
            while step as f64 / STEPS as f64 >= from[usize::from(code)] {
                code += 1;
            }
            code
        });
        let table = NearestTable { first: first.collect(), from };
        Self { encoded: Box::new(encoded), top: most, table: Some(table) }
    }

    /// Of colours in this encoding.
    pub(super) fn encoding(top: u16, albedo: Albedo) -> Self {
        match albedo {
            Albedo::Linear => Self::plain(top, |value| value),
            _ => Self::rising(top, move |value| encoded(value, albedo), |value| linear(value, albedo)),
        }
    }

    /// The integer of `value`, which lies in [0, 1].
    pub(super) fn code(&self, value: f64) -> u16 {
        match &self.table {
            Some(NearestTable { from, first }) => {
                let mut code = first[(value * STEPS as f64) as usize];
                while value >= from[usize::from(code)] {
                    code += 1;
                }
                code
            }
            None => rounded(self.top * (self.encoded)(value)),
        }
    }
}

/// The nearest integer to `value`, which is not negative: by truncation, since rounding is a call on many processors.
fn rounded(value: f64) -> u16 {
    (value + 0.5) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_that_is_looked_up_is_that_of_the_formula() {
        for albedo in [Albedo::Srgb, Albedo::Gamma22, Albedo::Log] {
            for top in [255, u16::MAX] {
                let curve = Curve::encoding(top, albedo);
                let formula = |value: f32| (f64::from(top) * encoded(value.into(), albedo)).round() as u16;
                let borders = (0..top).step_by(usize::from(top) / 255).flat_map(|code| {
                    let border = linear((f64::from(code) + 0.5) / f64::from(top), albedo) as f32;
                    [border.next_down(), border, border.next_up()]
                });
                let even = (0..=10_000).map(|step| step as f32 / 10_000.0);
                for value in borders.chain(even).filter(|value| (0.0..=1.0).contains(value)) {
                    assert_eq!(curve.code(value.into()), formula(value), "{albedo}, {top}: {value}");
                }
            }
        }
    }

    #[test]
    fn rounding_by_truncation_is_rounding() {
        for step in 0..=1_000_000 {
            let value = f64::from(step) * 255e-6;
            assert_eq!(f64::from(rounded(value)), value.round(), "{value}");
        }
    }
}
