//! A vector of three components, generic over the precision.

use std::ops::{Add, Mul, Sub};

use super::real::Real;

/// Three components: a position, a direction or a normal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3<T> {
    pub x: T,
    pub y: T,
    pub z: T,
}

impl<T: Real> Vec3<T> {
    pub const fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }

    pub fn zero() -> Self {
        Self::new(T::zero(), T::zero(), T::zero())
    }

    pub fn dot(self, b: Self) -> T {
        self.x * b.x + self.y * b.y + self.z * b.z
    }

    pub fn cross(self, b: Self) -> Self {
        Self::new(self.y * b.z - self.z * b.y, self.z * b.x - self.x * b.z, self.x * b.y - self.y * b.x)
    }

    pub fn length_squared(self) -> T {
        self.dot(self)
    }

    pub fn length(self) -> T {
        self.length_squared().sqrt()
    }

    /// The unit vector along `self`. A vector without length or with an infinite one has no direction: see
    /// [`Vec3::is_direction`].
    pub fn normalize(self) -> Self {
        self * self.length().recip()
    }

    /// Whether normalizing gives a unit vector: finite, and neither too short nor too long to be squared.
    pub fn is_direction(self) -> bool {
        let squared = self.length_squared();
        squared.is_finite() && squared >= T::min_positive_value()
    }

    /// The same vector in another precision.
    pub fn cast<U: Real>(self) -> Vec3<U> {
        Vec3::new(U::of(self.x.f64()), U::of(self.y.f64()), U::of(self.z.f64()))
    }

    pub fn to_array(self) -> [T; 3] {
        [self.x, self.y, self.z]
    }
}

impl<T> From<[T; 3]> for Vec3<T> {
    fn from([x, y, z]: [T; 3]) -> Self {
        Self { x, y, z }
    }
}

impl<T: Real> Add for Vec3<T> {
    type Output = Self;

    fn add(self, b: Self) -> Self {
        Self::new(self.x + b.x, self.y + b.y, self.z + b.z)
    }
}

impl<T: Real> Sub for Vec3<T> {
    type Output = Self;

    fn sub(self, b: Self) -> Self {
        Self::new(self.x - b.x, self.y - b.y, self.z - b.z)
    }
}

impl<T: Real> Mul<T> for Vec3<T> {
    type Output = Self;

    fn mul(self, k: T) -> Self {
        Self::new(self.x * k, self.y * k, self.z * k)
    }
}
