//! Colour spaces of FLIP, and the difference of two colours.

/// Over X, Y and Z of the white of D65.
const WHITE: [f32; 3] = [0.950_428_54, 1.0, 1.088_900_4];
const INVERSE_WHITE: [f32; 3] = [1.052_156_9, 1.0, 0.918_357_7];
/// The exponent of differences.
const EXPONENT: f32 = 0.7;
/// The share of the largest difference up to which a larger share of the scale is used, and that share.
const KNEE: f32 = 0.4;
const KNEE_VALUE: f32 = 0.95;

/// The scale of colour differences.
#[derive(Debug)]
pub(super) struct ColourScale {
    /// The difference of green and blue, the largest.
    largest: f32,
}

impl ColourScale {
    pub fn new() -> Self {
        let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(hunt_lab);
        Self { largest: hyab(green, blue).powf(EXPONENT) }
    }

    /// The difference of two colours of [`hunt_lab`], from 0 to 1.
    pub fn difference(&self, a: [f32; 3], b: [f32; 3]) -> f32 {
        let difference = hyab(a, b).powf(EXPONENT);
        let knee = KNEE * self.largest;
        if difference < knee {
            return difference * (KNEE_VALUE / knee);
        }
        KNEE_VALUE + ((difference - knee) / (self.largest - knee)) * (1.0 - KNEE_VALUE)
    }
}

/// Y, C_x and C_z of linear RGB: linear, with opponent colours.
pub(super) fn ycxcz(rgb: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = over_white(xyz(rgb));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// The inverse of [`ycxcz`].
pub(super) fn rgb_of_ycxcz([y, cx, cz]: [f32; 3]) -> [f32; 3] {
    let y = (y + 16.0) / 116.0;
    let [x, y, z] = [(y + cx / 500.0) * WHITE[0], y * WHITE[1], (y - cz / 200.0) * WHITE[2]];
    [
        3.241_003_3 * x + -1.537_398_9 * y + -0.498_615_86 * z,
        -0.969_224_33 * x + 1.875_930_1 * y + 0.041_554_224 * z,
        0.055_639_423 * x + -0.204_011_2 * y + 1.057_148_9 * z,
    ]
}

/// CIELAB of linear RGB in [0, 1], with less chroma where it is dark (Hunt's effect).
pub(super) fn hunt_lab(rgb: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = over_white(xyz(rgb)).map(lab_curve);
    let l = 116.0 * y - 16.0;
    let [a, b] = [500.0 * (x - y), 200.0 * (y - z)];
    [l, 0.01 * l * a, 0.01 * l * b]
}

/// X, Y and Z of linear RGB with the primaries of sRGB.
fn xyz([r, g, b]: [f32; 3]) -> [f32; 3] {
    const RED: [f32; 3] =
        [10_135_552.0 / 24_577_794.0, 2_613_072.0 / 12_288_897.0, 1_425_312.0 / 73_733_382.0];
    const GREEN: [f32; 3] =
        [8_788_810.0 / 24_577_794.0, 8_788_810.0 / 12_288_897.0, 8_788_810.0 / 73_733_382.0];
    const BLUE: [f32; 3] =
        [4_435_075.0 / 24_577_794.0, 887_015.0 / 12_288_897.0, 70_074_185.0 / 73_733_382.0];
    std::array::from_fn(|c| RED[c] * r + GREEN[c] * g + BLUE[c] * b)
}

fn over_white(xyz: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|c| xyz[c] * INVERSE_WHITE[c])
}

/// The cube root of CIELAB, with its linear part.
fn lab_curve(value: f32) -> f32 {
    const DELTA: f32 = 6.0 / 29.0;
    const SQUARE: f32 = DELTA * DELTA;
    const CUBE: f32 = DELTA * SQUARE;
    if value > CUBE { value.powf(1.0 / 3.0) } else { 1.0 / (3.0 * SQUARE) * value + 4.0 / 29.0 }
}

/// The distance HyAB (Abasi et al. 2020): city block in lightness, Euclidean in chroma.
fn hyab(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [l, c, d] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    l.abs() + (c * c + d * d).sqrt()
}
