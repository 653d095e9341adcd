//! Noise from integer hashes.
//!
//! Only additions, multiplications and roundings, whose results IEEE 754 fixes: the same bits on every platform.

/// A number in [0, 1) for a point of an integer lattice.
pub(super) fn hash(x: i64, y: i64, seed: u64) -> f64 {
    let mut bits = (x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        ^ (y as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F)
        ^ seed.wrapping_mul(0x1656_67B1_9E37_79F9);
    // The finalizer of MurmurHash3.
    bits = (bits ^ (bits >> 33)).wrapping_mul(0xFF51_AFD7_ED55_8CCD);
    bits = (bits ^ (bits >> 33)).wrapping_mul(0xC4CE_B9FE_1A85_EC53);
    ((bits ^ (bits >> 33)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// 0 below `from`, 1 above `to`, a smooth cubic between; runs down where `to` < `from`.
pub(super) fn step(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// From `a` at 0 to `b` at 1.
pub(super) fn mix(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// [`mix`] of three channels.
pub(super) fn mix3(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    [0, 1, 2].map(|c| mix(a[c], b[c], t))
}

/// Smooth noise in [0, 1] with features of size 1.
pub(super) fn noise(x: f64, y: f64, seed: u64) -> f64 {
    let (column, row) = (x.floor(), y.floor());
    let (tx, ty) = (step(0.0, 1.0, x - column), step(0.0, 1.0, y - row));
    let corner = |dx: i64, dy: i64| hash(column as i64 + dx, row as i64 + dy, seed);
    mix(mix(corner(0, 0), corner(1, 0), tx), mix(corner(0, 1), corner(1, 1), tx), ty)
}

/// Noise in [0, 1] of four octaves, the largest with features of size 1.
pub(super) fn clouds(x: f64, y: f64, seed: u64) -> f64 {
    let mut sum = 0.0;
    let (mut scale, mut weight) = (1.0, 0.5);
    for octave in 0..4_u32 {
        sum += weight * noise(x * scale + 17.3 * f64::from(octave), y * scale, seed + u64::from(octave));
        (scale, weight) = (scale * 2.03, weight * 0.5);
    }
    sum / 0.9375
}

/// Distance to the nearest border between the cells of a random mosaic with cells of size 1.
pub(super) fn cracks(x: f64, y: f64, seed: u64) -> f64 {
    let (column, row) = (x.floor() as i64, y.floor() as i64);
    let (mut nearest, mut second) = (f64::MAX, f64::MAX);
    for (dx, dy) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))) {
        let (i, j) = (column + dx, row + dy);
        let (px, py) = (i as f64 + hash(i, j, seed), j as f64 + hash(i, j, seed + 1));
        let distance = ((px - x) * (px - x) + (py - y) * (py - y)).sqrt();
        if distance < nearest {
            (nearest, second) = (distance, nearest);
        } else if distance < second {
            second = distance;
        }
    }
    (second - nearest) / 2.0
}
