//! The transfer curve of sRGB (IEC 61966-2-1).

use super::real::Real;

/// The stored value of a linear `value`, both in [0, 1]. NaN stays NaN.
pub fn encode<T: Real>(value: T) -> T {
    if value <= T::of(0.003_130_8) {
        T::of(12.92) * value
    } else {
        T::of(1.055) * value.powf(T::one() / T::of(2.4)) - T::of(0.055)
    }
}

/// The linear value of a stored `value`, both in [0, 1]: the inverse of [`encode`].
pub fn decode<T: Real>(value: T) -> T {
    if value <= T::of(0.040_45) {
        value / T::of(12.92)
    } else {
        ((value + T::of(0.055)) / T::of(1.055)).powf(T::of(2.4))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values_of_the_curve_and_its_inverse() {
        // (linear, stored) by the formulas in 50 digits.
        for (linear, stored) in [(0.0, 0.0), (0.002, 0.025_84), (0.18, 0.461_356_129_500_441_7), (1.0, 1.0)] {
            assert!((encode::<f64>(linear) - stored).abs() < 1e-14, "{linear}");
            assert!((decode::<f64>(stored) - linear).abs() < 1e-14, "{stored}");
            assert!((encode(linear as f32) - stored as f32).abs() < 1e-6, "{linear}");
        }
        assert!(encode(f32::NAN).is_nan());
    }
}
