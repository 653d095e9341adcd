//! The sum of |ln a - ln b| over many numbers, with one logarithm at the end.
//!
//! It equals ln(product of max(a, b)) - ln(product of min(a, b)). Mantissas are multiplied, exponents added as integers.

use fearless_simd::{Simd, prelude::*};

use crate::render::simd::lanes::{V, vec3};
use crate::render::simd::shade::TileRadiance;
use crate::render::simd::tile::{TilePlane, vectors};

/// Unsigned integers as wide as the floats of [`V`].
type Bits<S> = <V<S> as SimdFloat<S>>::Bits;

/// The bits of a mantissa.
const MANTISSA: u32 = 0x007f_ffff;
/// The bits of 1.
const ONE: u32 = 0x3f80_0000;

/// What adds up the differences of two materials, tile by tile.
pub(super) trait TileDifferences<S: Simd> {
    /// Adds all texels and channels of a tile. Radiances are positive and, unless `SAFE`, below 2^21.
    fn add<const SAFE: bool>(&mut self, simd: S, a: &TileRadiance, b: &TileRadiance);
}

/// Running products, one per lane. Each factor rounds once, so n factors are off by about sqrt(n) 4e-8.
#[derive(Clone, Copy, Debug)]
pub(super) struct LogProducts<S: Simd> {
    /// Mantissas in [1, 2) of the products of the larger and of the smaller numbers.
    larger: V<S>,
    smaller: V<S>,
    /// Exponent of the larger product minus that of the smaller one, in two's complement.
    exponent: Bits<S>,
}

impl<S: Simd> LogProducts<S> {
    #[inline(always)]
    pub(super) fn new(simd: S) -> Self {
        let one = V::<S>::splat(simd, 1.0);
        Self { larger: one, smaller: one, exponent: Bits::<S>::splat(simd, 0) }
    }

    /// The sum over all lanes.
    #[inline(always)]
    pub(super) fn total(&self) -> f64 {
        let (mut product, mut exponent) = (1.0, 0);
        for lane in 0..V::<S>::LEN {
            product *= f64::from(self.larger[lane]) / f64::from(self.smaller[lane]);
            exponent += i64::from(self.exponent[lane].cast_signed());
        }
        exponent as f64 * std::f64::consts::LN_2 + product.ln()
    }

    #[inline(always)]
    fn multiply(&mut self, larger: V<S>, smaller: V<S>) {
        self.larger *= larger;
        self.smaller *= smaller;
    }

    /// Moves the exponents of the products to the integer.
    #[inline(always)]
    fn normalize(&mut self) {
        let (larger, smaller) = (self.larger.to_bits(), self.smaller.to_bits());
        self.exponent += (larger >> 23) - (smaller >> 23);
        self.larger = V::<S>::from_bits((larger & MANTISSA) | ONE);
        self.smaller = V::<S>::from_bits((smaller & MANTISSA) | ONE);
    }

    /// The sum in one lane.
    #[inline(always)]
    fn of_lane(&self, lane: usize) -> f64 {
        let ratio = f64::from(self.larger[lane]) / f64::from(self.smaller[lane]);
        f64::from(self.exponent[lane].cast_signed()) * std::f64::consts::LN_2 + ratio.ln()
    }
}

impl<S: Simd> TileDifferences<S> for LogProducts<S> {
    /// The product of six radiances below 2^21 and a mantissa fits a float.
    #[inline(always)]
    fn add<const SAFE: bool>(&mut self, simd: S, a: &TileRadiance, b: &TileRadiance) {
        // In registers: through memory, each product would wait for the store of the one before.
        let mut products = *self;
        for pair in 0..vectors::<S>() / 2 {
            for i in [2 * pair, 2 * pair + 1] {
                let (a, b) = (TilePlane::load_three(&a.0, simd, i), TilePlane::load_three(&b.0, simd, i));
                let (larger, smaller) = (vec3!(C => a[C].max(b[C])), vec3!(C => a[C].min(b[C])));
                if SAFE {
                    for c in 0..3 {
                        products.multiply(larger[c], smaller[c]);
                        products.normalize();
                    }
                } else {
                    // In this order, only one multiplication waits for the vector before.
                    products
                        .multiply(larger[0] * larger[1] * larger[2], smaller[0] * smaller[1] * smaller[2]);
                }
            }
            products.normalize();
        }
        *self = products;
    }
}

/// A product for each texel and channel of a tile.
#[derive(Clone, Debug)]
pub(super) struct TexelLogProducts<S: Simd> {
    /// Of each vector of texels: red, green and blue.
    products: Vec<[LogProducts<S>; 3]>,
}

impl<S: Simd> TexelLogProducts<S> {
    #[inline(always)]
    pub(super) fn new(simd: S) -> Self {
        Self { products: vec![[LogProducts::new(simd); 3]; vectors::<S>()] }
    }

    /// The sums of red, green and blue of a texel of the tile.
    #[inline(always)]
    pub(super) fn of_texel(&self, texel: usize) -> [f64; 3] {
        let (vector, lane) = (texel / V::<S>::LEN, texel % V::<S>::LEN);
        self.products[vector].map(|products| products.of_lane(lane))
    }
}

impl<S: Simd> TileDifferences<S> for TexelLogProducts<S> {
    #[inline(always)]
    fn add<const SAFE: bool>(&mut self, simd: S, a: &TileRadiance, b: &TileRadiance) {
        for (i, channels) in self.products.iter_mut().enumerate() {
            for (c, products) in channels.iter_mut().enumerate() {
                let (a, b) = (a.0[c].load(simd, i), b.0[c].load(simd, i));
                // One factor fits beside a mantissa, also a large one.
                products.multiply(a.max(b), a.min(b));
                products.normalize();
            }
        }
    }
}
