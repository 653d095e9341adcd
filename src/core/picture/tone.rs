//! From linear radiance to what a screen shows: exposure, the sRGB curve, 8 bits.
//!
//! `shaders/srgb.wgsl` and `shaders/encode.wgsl` are the twins of this file.

use crate::math::srgb;

/// The sRGB transfer curve (IEC 61966-2-1) of one linear value, which is first clipped to [0, 1]; NaN stays NaN.
pub fn srgb_encode(linear: f32) -> f32 {
    let clipped = linear.clamp(0.0, 1.0);
    srgb::encode(clipped)
}

/// Linear RGB, brightened by `exposure_ev` stops, as the 8-bit sRGB values of a screen, rounded half up.
pub fn to_display(rgb: [f32; 3], exposure_ev: f32) -> [u8; 3] {
    let gain = exposure_ev.exp2();
    // A float that is cast saturates, and NaN becomes 0.
    rgb.map(|linear| (srgb_encode(linear * gain) * 255.0 + 0.5).floor() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values_of_the_curve() {
        for (linear, byte) in [(0.0, 0), (1.0, 255), (0.214_041_14, 128), (0.002, 7), (0.18, 118)] {
            assert_eq!(to_display([linear; 3], 0.0), [byte; 3], "{linear}");
        }
    }

    #[test]
    fn what_does_not_fit_is_clipped_and_nan_is_black() {
        assert_eq!(to_display([f32::NAN, f32::INFINITY, -1.0], 0.0), [0, 255, 0]);
        assert_eq!(to_display([0.0, f32::MAX, f32::NEG_INFINITY], f32::MAX), [0, 255, 0]);
    }

    #[test]
    fn every_byte_survives_decoding_and_encoding() {
        for byte in 0..=255u8 {
            let linear: f64 = srgb::decode(f64::from(byte) / 255.0);
            assert_eq!(to_display([linear as f32; 3], 0.0), [byte; 3]);
        }
    }
}
