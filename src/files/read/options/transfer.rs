//! Transfer functions: from stored values of [0, 1] to reflectance and roughness, and back.

use svbrdf_core::math::srgb;

use crate::read::options::{Albedo, Roughness};

/// The dark end of the logarithmic encoding.
const DARK: f64 = 0.01;

/// The reflectance, in [0, 1], that a stored `value` of [0, 1] stands for.
pub(crate) fn linear(value: f64, albedo: Albedo) -> f64 {
    match albedo {
        Albedo::Linear => value,
        Albedo::Srgb => srgb::decode(value),
        Albedo::Gamma22 => value.powf(2.2),
        Albedo::Log => (DARK * ((1.0 + DARK) / DARK).powf(value) - DARK).clamp(0.0, 1.0),
    }
}

/// The stored value of the reflectance `value` of [0, 1]: the inverse of [`linear`].
pub(crate) fn encoded(value: f64, albedo: Albedo) -> f64 {
    match albedo {
        Albedo::Linear => value,
        Albedo::Srgb => srgb::encode(value),
        Albedo::Gamma22 => value.powf(1.0 / 2.2),
        Albedo::Log => ((value + DARK) / DARK).ln() / ((1.0 + DARK) / DARK).ln(),
    }
}

/// The roughness r that a stored `value` of [0, 1] stands for.
pub(crate) fn roughness(value: f64, code: Roughness) -> f64 {
    match code {
        Roughness::R => value,
        Roughness::Gloss => 1.0 - value,
        Roughness::Alpha | Roughness::Anisotropic => value.sqrt(),
        Roughness::Gamma22 => value.powf(2.2),
    }
}

/// The stored value of the roughness `r`: the inverse of [`roughness`].
pub(crate) fn encoded_roughness(r: f64, code: Roughness) -> f64 {
    match code {
        Roughness::R => r,
        Roughness::Gloss => 1.0 - r,
        Roughness::Alpha | Roughness::Anisotropic => r * r,
        Roughness::Gamma22 => r.powf(1.0 / 2.2),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encoding_is_the_inverse_of_decoding() {
        for step in 0..=1000 {
            let value = f64::from(step) / 1000.0;
            for albedo in Albedo::ALL {
                assert!((linear(encoded(value, albedo), albedo) - value).abs() < 1e-7, "{albedo}: {value}");
            }
            for code in Roughness::ALL {
                assert!(
                    (roughness(encoded_roughness(value, code), code) - value).abs() < 1e-12,
                    "{code}: {value}"
                );
            }
        }
    }

    /// The code of `logOutputAlbedos` as Deschaintre et al. print it.
    #[test]
    fn the_logarithmic_code_is_theirs() {
        let theirs = |x: f64| ((x + 0.01).ln() - 0.01_f64.ln()) / (1.01_f64.ln() - 0.01_f64.ln());
        for x in [0.0, 0.04, 0.5, 1.0] {
            assert!((encoded(x, Albedo::Log) - theirs(x)).abs() < 1e-14);
        }
    }
}
