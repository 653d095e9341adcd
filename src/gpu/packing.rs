//! A material in 16 bytes a texel, exactly: codes for values that are few, and of a normal two components and a hint at the third.

use svbrdf_core::material::Planes;

use super::codes::{Codes, VALUES};

/// A material whose texels are packed: what `coded_maps.wgsl` unpacks.
#[derive(Debug)]
pub(super) struct Packing<'a> {
    planes: &'a Planes<f32>,
    roughness: Codes,
    diffuse: Codes,
    specular: Codes,
}

impl<'a> Packing<'a> {
    pub(super) fn new(planes: &'a Planes<f32>) -> Self {
        let [roughness, diffuse, specular] = std::array::from_fn(|_| Codes::new());
        Self { planes, roughness, diffuse, specular }
    }

    /// Packs texels, of which each has the `index` of its number. Returns whether all can be: their maps hold at most 256 values, and
    /// their normals are of unit length.
    pub(super) fn pack(&self, texels: &mut [[u32; 4]], index: impl Fn(usize) -> usize) -> bool {
        let Planes { normal: [x, y, z], diffuse, specular, roughness } = self.planes;
        let mut are_packed = true;
        // Plane by plane, in loops that are short.
        for (number, texel) in texels.iter_mut().enumerate() {
            let index = index(number);
            let [first, second, hint] = packed_normal([x[index], y[index], z[index]]).unwrap_or_else(|| {
                are_packed = false;
                [0; 3]
            });
            *texel = [first, second, hint << 24, 0];
        }
        for (channel, shift) in [16, 8, 0].into_iter().enumerate() {
            are_packed &= add::<2>(texels, &diffuse[channel], &self.diffuse, shift, &index);
            are_packed &= add::<3>(texels, &specular[channel], &self.specular, shift, &index);
        }
        are_packed & add::<3>(texels, roughness, &self.roughness, 24, &index)
    }

    /// The values of the codes of roughness, of diffuse and of specular.
    pub(super) fn values(&self) -> [[f32; 4]; VALUES] {
        let [roughness, diffuse, specular] =
            [&self.roughness, &self.diffuse, &self.specular].map(Codes::values);
        std::array::from_fn(|code| [roughness[code], diffuse[code], specular[code], 0.0])
    }
}

/// Adds the codes of a plane to one of the words of the texels. Returns whether all values have one.
fn add<const WORD: usize>(
    texels: &mut [[u32; 4]],
    plane: &[f32],
    codes: &Codes,
    shift: u32,
    index: impl Fn(usize) -> usize,
) -> bool {
    let mut have_codes = true;
    for (number, texel) in texels.iter_mut().enumerate() {
        match codes.code(plane[index(number)]) {
            Some(code) => texel[WORD] |= code << shift,
            None => have_codes = false,
        }
    }
    have_codes
}

/// Bits of the largest component that the hint holds.
const LOW_BITS: u32 = 5;
/// How many units in the last place the largest component may be away from what the two others say, computed here. From what the
/// adapter computes it may be 16 away: its square root is correct to 5 (WGSL).
const MOST_ULPS: i32 = 10;

/// The two smaller components of a unit vector, and a byte that says which component the largest is, its sign and its last bits:
/// the shader computes it from the others, and takes the nearest number that ends in these bits. `None` where the length is too
/// far from 1 for that.
#[inline]
fn packed_normal([x, y, z]: [f32; 3]) -> Option<[u32; 3]> {
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
    use super::*;

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
