//! The two precisions that everything is computed in, and their vectors, which are glam's.

use std::fmt::{Debug, Display};
use std::ops::{Add, Mul, Sub};

use num_traits::float::TotalOrder;
use num_traits::{Float, FloatConst};

/// A floating-point type that the core computes in: `f32` or `f64`.
///
/// `f64` is the reference; `f32` is what the GPU and the fast paths use.
pub trait Real: Float + FloatConst + TotalOrder + Default + Debug + Display + Send + Sync + 'static {
    /// How users call it: `f32` or `f64`.
    const NAME: &'static str;

    /// The vector of three components: [`glam::Vec3`] or [`glam::DVec3`].
    type Vec3: Vector<Scalar = Self>;

    /// The nearest value to `x`.
    fn of(x: f64) -> Self;

    /// The value as `f64`, exactly.
    fn f64(self) -> f64;
}

/// A position, a direction or a normal in the precision `T`.
pub type Vec3<T> = <T as Real>::Vec3;

/// What the core, generic over the precision, needs of [`glam::Vec3`] and [`glam::DVec3`].
pub trait Vector:
    Copy
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + From<[Self::Scalar; 3]>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Self::Scalar, Output = Self>
    + 'static
{
    /// The type of a component.
    type Scalar: Real<Vec3 = Self>;

    /// The components x, y, z.
    fn to_array(self) -> [Self::Scalar; 3];

    /// The component along the third axis, which points out of the surface.
    fn z(self) -> Self::Scalar;

    /// The dot product, summed from x to z.
    fn dot(self, b: Self) -> Self::Scalar;

    /// The cross product.
    fn cross(self, b: Self) -> Self;

    /// The square of the length.
    fn length_squared(self) -> Self::Scalar;

    /// The unit vector along `self`. A vector without length or with an infinite one has no direction: see
    /// [`Vector::is_direction`].
    fn normalize(self) -> Self;

    /// Whether normalizing gives a unit vector: finite, and neither too short nor too long to be squared.
    fn is_direction(self) -> bool {
        let squared = self.length_squared();
        squared.is_finite() && squared >= Self::Scalar::min_positive_value()
    }

    /// The same vector in the precision of `V`.
    fn cast<V: Vector>(self) -> V {
        V::from(self.to_array().map(|x| V::Scalar::of(x.f64())))
    }
}

macro_rules! real {
    ($real:ident, $vector:ty) => {
        impl Real for $real {
            const NAME: &'static str = stringify!($real);

            type Vec3 = $vector;

            #[inline]
            fn of(x: f64) -> Self {
                x as $real
            }

            #[inline]
            fn f64(self) -> f64 {
                self.into()
            }
        }

        impl Vector for $vector {
            type Scalar = $real;

            #[inline]
            fn to_array(self) -> [$real; 3] {
                <$vector>::to_array(&self)
            }

            #[inline]
            fn z(self) -> $real {
                self.z
            }

            #[inline]
            fn dot(self, b: Self) -> $real {
                self.dot(b)
            }

            #[inline]
            fn cross(self, b: Self) -> Self {
                self.cross(b)
            }

            #[inline]
            fn length_squared(self) -> $real {
                self.length_squared()
            }

            #[inline]
            fn normalize(self) -> Self {
                self.normalize()
            }
        }
    };
}

real!(f32, glam::Vec3);
real!(f64, glam::DVec3);
