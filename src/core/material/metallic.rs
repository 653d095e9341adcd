//! Base colour and metallic from diffuse and specular, as far as these can express them.

/// Reflectance of dielectrics at normal incidence.
pub const DIELECTRIC: f64 = 0.04;

/// Base colour b and metallic m for diffuse d and specular s, linear and in [0, 1]: the inverse of d = b (1 - m) and
/// s = 0.04 (1 - m) + b m (glTF 2.0, appendix B.2).
///
/// Exact for the diffuse and specular of a base colour and a metallic; of all else in the mean of the channels. Of the two solutions
/// for m, the smaller one in [0, 1]: most materials are dielectrics.
pub fn base_and_metallic(diffuse: [f64; 3], specular: [f64; 3]) -> ([f64; 3], f64) {
    let mean = |rgb: [f64; 3]| rgb.iter().sum::<f64>() / 3.0;
    let left = left(mean(diffuse), mean(specular));
    let base = |c: usize| (diffuse[c] + specular[c] - DIELECTRIC * left).clamp(0.0, 1.0);
    ([0, 1, 2].map(base), 1.0 - left)
}

/// 1 - m = t of 0.04 t^2 - (d + s) t + d = 0: the larger root where it is at most 1, since most materials are dielectrics.
fn left(d: f64, s: f64) -> f64 {
    const ROUNDING: f64 = 1e-6;
    let sum = d + s;
    let root = (sum * sum - 4.0 * DIELECTRIC * d).max(0.0).sqrt();
    let [small, large] = [sum - root, sum + root].map(|t| t / (2.0 * DIELECTRIC));
    if large <= 1.0 + ROUNDING { large.min(1.0) } else { small.clamp(0.0, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_base_colour_and_metallic_made_comes_back_as_they() {
        for base in [0.05, 0.3, 0.6, 1.0] {
            for metallic in [0.0, 0.3, 0.7, 1.0] {
                let base = [base, 0.9 * base, 0.8 * base];
                let diffuse = base.map(|b| b * (1.0 - metallic));
                let specular = base.map(|b| DIELECTRIC * (1.0 - metallic) + b * metallic);
                let (b, m) = base_and_metallic(diffuse, specular);
                let again = [b.map(|b| b * (1.0 - m)), b.map(|b| DIELECTRIC * (1.0 - m) + b * m)];
                for (x, y) in again.into_iter().flatten().zip([diffuse, specular].into_iter().flatten()) {
                    assert!((x - y).abs() < 1e-6, "{base:?}, {metallic}: {b:?}, {m}");
                }
            }
        }
    }

    #[test]
    fn whatever_is_there_has_a_base_colour() {
        for d in 0..=20 {
            for s in 0..=20 {
                let [d, s] = [d, s].map(|x| [f64::from(x) / 20.0; 3]);
                let (base, metallic) = base_and_metallic(d, s);
                assert!(base.into_iter().chain([metallic]).all(|x| (0.0..=1.0).contains(&x)), "{d:?}, {s:?}");
            }
        }
    }
}
