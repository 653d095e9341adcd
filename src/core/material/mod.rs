//! The four maps of a material, with their invariants checked once.
//!
//! ```
//! use svbrdf_core::material::{Material, Planes};
//!
//! // One texel of a flat, rough, gray dielectric.
//! let planes = Planes {
//!     normal: [vec![0.0], vec![0.0], vec![1.0]],
//!     diffuse: [vec![0.5], vec![0.5], vec![0.5]],
//!     specular: [vec![0.04], vec![0.04], vec![0.04]],
//!     roughness: vec![0.6],
//! };
//! let material = Material::<f32>::new("gray", 1, 1, planes)?;
//! assert_eq!(material.size(), [1, 1]);
//! # Ok::<(), svbrdf_core::error::Error>(())
//! ```

mod depth;
mod grid;
mod mask;
mod metallic;
mod mix;
pub mod resize;

pub use depth::{Depth, half_normal};
pub use grid::Grid;
pub use mask::Mask;
pub use metallic::{DIELECTRIC, base_and_metallic};
pub use mix::Map;

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::error::Error;
use crate::math::real::{Real, Vector as _};
use crate::model::brdf::Texel;
use crate::text::line;
use resize::{Filter, Kernel};

/// The maps of a material as planes of `width * height` values, row 0 on top.
///
/// Meanings and ranges are as in [`Texel`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Planes<T> {
    pub normal: [Vec<T>; 3],
    pub diffuse: [Vec<T>; 3],
    pub specular: [Vec<T>; 3],
    pub roughness: Vec<T>,
}

impl<T> Planes<T> {
    /// The ten planes: normal, specular, diffuse, roughness, in the order in which a loss loads them.
    pub fn all(&self) -> impl Iterator<Item = &[T]> {
        let vectors = self.normal.iter().chain(&self.specular).chain(&self.diffuse);
        vectors.chain([&self.roughness]).map(Vec::as_slice)
    }
}

/// An SVBRDF: normal, diffuse, specular and roughness of every texel of a plane.
///
/// Every texel is finite, its normal has length 1, its other values lie in [0, 1], and there is at least one. A clone shares the values.
#[derive(Clone, Debug, PartialEq)]
pub struct Material<T> {
    name: String,
    width: usize,
    height: usize,
    planes: Arc<Planes<T>>,
}

impl<T: Real> Material<T> {
    /// Takes over `planes` of `width` x `height` texels; normals of any length are normalized. The name becomes a [`line()`].
    ///
    /// # Errors
    /// [`Error::BadPlanes`] without texels, or where a plane has not `width * height` values,
    /// [`Error::OutOfRange`] at the first texel that is not finite, has no normal or lies outside [0, 1].
    pub fn new(
        name: impl Into<String>,
        width: usize,
        height: usize,
        mut planes: Planes<T>,
    ) -> Result<Self, Error> {
        let name = line(&name.into());
        check_sizes(&name, width, height, &planes)?;
        let place = |index: usize| (index % width, index / width);
        let scalar_maps = [
            ("diffuse", planes.diffuse.as_slice()),
            ("specular", planes.specular.as_slice()),
            ("roughness", std::slice::from_ref(&planes.roughness)),
        ];
        for (map, channels) in scalar_maps {
            for channel in channels {
                check_range(&name, map, channel, place)?;
            }
        }
        normalize_normals(&name, &mut planes.normal, place)?;
        Ok(Self { name, width, height, planes: Arc::new(planes) })
    }

    /// The same texel everywhere: for tests and examples.
    ///
    /// # Errors
    /// As [`Material::new`].
    pub fn uniform(
        name: impl Into<String>,
        width: usize,
        height: usize,
        texel: &Texel<T>,
    ) -> Result<Self, Error> {
        let plane = |value: T| vec![value; width * height];
        let planes = Planes {
            normal: texel.normal.to_array().map(plane),
            diffuse: texel.diffuse.map(plane),
            specular: texel.specular.map(plane),
            roughness: plane(texel.roughness),
        };
        Self::new(name, width, height, planes)
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// The same material under another name.
    #[must_use]
    pub fn renamed(self, name: impl Into<String>) -> Self {
        Self { name: line(&name.into()), ..self }
    }

    pub fn width(&self) -> usize {
        self.width
    }

    pub fn height(&self) -> usize {
        self.height
    }

    /// (width, height) in texels.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    pub fn planes(&self) -> &Planes<T> {
        &self.planes
    }

    pub fn grid(&self) -> Grid {
        Grid { width: self.width, height: self.height }
    }

    /// The texel at `index` = row * width + column.
    ///
    /// # Panics
    /// Where there is no such texel, as indexing a slice does.
    #[inline]
    pub fn texel(&self, index: usize) -> Texel<T> {
        let at = |plane: &[Vec<T>; 3]| [plane[0][index], plane[1][index], plane[2][index]];
        Texel {
            normal: at(&self.planes.normal).into(),
            diffuse: at(&self.planes.diffuse),
            specular: at(&self.planes.specular),
            roughness: self.planes.roughness[index],
        }
    }

    /// The material of a size (width, height) whose texels are those of this one at `texels`, each as row * width + column.
    ///
    /// # Panics
    /// Where there is no such texel, as indexing a slice does, or they are not `width * height`.
    #[must_use]
    pub fn gathered(&self, texels: &[usize], [width, height]: [usize; 2]) -> Self {
        assert_eq!(texels.len(), width * height, "a texel for each place");
        let gather = |plane: &Vec<T>| texels.par_iter().map(|&texel| plane[texel]).collect::<Vec<_>>();
        let Planes { normal, diffuse, specular, roughness } = &*self.planes;
        let planes = Planes {
            normal: normal.each_ref().map(gather),
            diffuse: diffuse.each_ref().map(gather),
            specular: specular.each_ref().map(gather),
            roughness: gather(roughness),
        };
        Self { name: self.name.clone(), width, height, planes: Arc::new(planes) }
    }

    /// The same material in another size (width, height): the mean over areas on the way down, bilinear on the way up;
    /// normals are normalized again; roughness is averaged as alpha^2 = r^4, and interpolated as r.
    ///
    /// # Errors
    /// As [`Material::new`], as where normals cancel out.
    pub fn resized(self, size: [usize; 2]) -> Result<Self, Error> {
        let from = self.size();
        if from == size {
            return Ok(self);
        }
        let value = |plane: &Vec<T>| resize::plane(plane, from, size, Filter::Value);
        let Planes { normal, diffuse, specular, roughness } = &*self.planes;
        let planes = Planes {
            normal: normal.each_ref().map(value),
            diffuse: diffuse.each_ref().map(value),
            specular: specular.each_ref().map(value),
            roughness: resize::plane(roughness, from, size, Filter::Roughness),
        };
        Self::new(self.name, size[0], size[1], planes)
    }

    /// The same material in another size by a kernel: with [`Kernel::Cubic`] all maps as they are, cut to their ranges, roughness as r.
    ///
    /// # Errors
    /// As [`Material::resized`].
    pub fn resized_by(self, size: [usize; 2], kernel: Kernel) -> Result<Self, Error> {
        let from = self.size();
        if kernel == Kernel::Area || from == size {
            return self.resized(size);
        }
        let value = |plane: &Vec<T>| resize::cubic(plane, from, size, [0.0, 1.0]);
        let Planes { normal, diffuse, specular, roughness } = &*self.planes;
        let planes = Planes {
            normal: normal.each_ref().map(|plane| resize::cubic(plane, from, size, [-1.0, 1.0])),
            diffuse: diffuse.each_ref().map(value),
            specular: specular.each_ref().map(value),
            roughness: value(roughness),
        };
        Self::new(self.name, size[0], size[1], planes)
    }

    /// The same material, flat and gray where a mask of its size leaves texels out.
    #[must_use]
    pub fn gray_outside(mut self, mask: &Mask) -> Self {
        let Planes { normal: [x, y, z], diffuse, specular, roughness } = Arc::make_mut(&mut self.planes);
        let colours =
            diffuse.iter_mut().map(|plane| (plane, 0.2)).chain(specular.iter_mut().map(|plane| (plane, 0.0)));
        let values = [(x, 0.0), (y, 0.0), (z, 1.0), (roughness, 1.0)];
        for (plane, value) in colours.chain(values) {
            let outside = plane.iter_mut().zip(mask.kept()).filter(|(_, kept)| !**kept);
            outside.for_each(|(texel, _)| *texel = T::of(value));
        }
        self
    }

    /// The same material with another roughness: a factor times its own, and an offset, cut to [0, 1].
    #[must_use]
    pub fn with_roughness(mut self, [factor, offset]: [f64; 2]) -> Self {
        let planes = Arc::make_mut(&mut self.planes);
        let changed = |r: &T| T::of((factor * r.f64() + offset).clamp(0.0, 1.0));
        planes.roughness = planes.roughness.iter().map(changed).collect();
        self
    }

    /// The same material in another precision.
    pub fn cast<U: Real>(&self) -> Material<U> {
        let plane = |plane: &Vec<T>| plane.iter().map(|x| U::of(x.f64())).collect();
        Material {
            name: self.name.clone(),
            width: self.width,
            height: self.height,
            planes: Arc::new(Planes {
                normal: self.planes.normal.each_ref().map(plane),
                diffuse: self.planes.diffuse.each_ref().map(plane),
                specular: self.planes.specular.each_ref().map(plane),
                roughness: plane(&self.planes.roughness),
            }),
        }
    }
}

fn check_sizes<T>(name: &str, width: usize, height: usize, planes: &Planes<T>) -> Result<(), Error> {
    let expected = width.checked_mul(height).filter(|&count| count > 0);
    let Some(expected) = expected else {
        return Err(Error::BadPlanes {
            whose: name.to_owned(),
            expected: "at least one texel".to_owned(),
            found: format!("{width} x {height}"),
            remedy: "give maps of at least 1 x 1",
        });
    };
    let all = planes.normal.iter().chain(&planes.diffuse);
    let all = all.chain(&planes.specular).chain([&planes.roughness]);
    for plane in all {
        if plane.len() != expected {
            return Err(Error::BadPlanes {
                whose: name.to_owned(),
                expected: format!("{expected} values in every plane ({width} x {height})"),
                found: format!("a plane of {}", plane.len()),
                remedy: "give planes of the same size",
            });
        }
    }
    Ok(())
}

fn check_range<T: Real>(
    name: &str,
    map: &'static str,
    plane: &[T],
    place: impl Fn(usize) -> (usize, usize),
) -> Result<(), Error> {
    const CHUNK: usize = 1 << 16;
    let valid = |x: &T| *x >= T::zero() && *x <= T::one();
    // Without a way out within a chunk, the check is one of many values at once.
    let are_valid = |chunk: &[T]| chunk.iter().fold(true, |are, x| are & valid(x));
    let wrong = plane.par_chunks(CHUNK).position_first(|chunk| !are_valid(chunk));
    let wrong =
        wrong.and_then(|chunk| Some(chunk * CHUNK + plane[chunk * CHUNK..].iter().position(|x| !valid(x))?));
    match wrong {
        None => Ok(()),
        Some(index) => {
            let (column, row) = place(index);
            Err(Error::OutOfRange {
                whose: name.to_owned(),
                map,
                column,
                row,
                expected: "a value in [0, 1]",
                found: plane[index].to_string(),
            })
        }
    }
}

fn normalize_normals<T: Real>(
    name: &str,
    normal: &mut [Vec<T>; 3],
    place: impl Fn(usize) -> (usize, usize),
) -> Result<(), Error> {
    const CHUNK: usize = 1 << 14;
    /// Texels that stay in the nearest cache.
    const FEW: usize = 1 << 9;
    let [xs, ys, zs] = normal;
    let chunks = xs.par_chunks_mut(CHUNK).zip(ys.par_chunks_mut(CHUNK)).zip(zs.par_chunks_mut(CHUNK));
    let none = chunks.enumerate().find_map_first(|(number, ((xs, ys), zs))| {
        let parts = xs.chunks_mut(FEW).zip(ys.chunks_mut(FEW)).zip(zs.chunks_mut(FEW)).enumerate();
        let mut none = parts.filter_map(|(part, ((xs, ys), zs))| {
            let (offset, n) = normalize_few([xs, ys, zs])?;
            Some((number * CHUNK + part * FEW + offset, n))
        });
        none.next()
    });
    let Some((index, n)) = none else { return Ok(()) };
    let (column, row) = place(index);
    Err(Error::OutOfRange {
        whose: name.to_owned(),
        map: "normal",
        column,
        row,
        expected: "a finite vector of some length",
        found: format!("({}, {}, {})", n.x, n.y, n.z),
    })
}

/// Normalizes vectors, or returns the first that has no direction. Loops without branches, so that several vectors are
/// computed at once.
fn normalize_few<T: Real>([xs, ys, zs]: [&mut [T]; 3]) -> Option<(usize, DVec3)> {
    // In f64, so that f32 normals are the correctly rounded ones.
    let vector = |(x, y, z): (&T, &T, &T)| DVec3::new(x.f64(), y.f64(), z.f64());
    let all = || xs.iter().zip(&*ys).zip(&*zs).map(|((x, y), z)| vector((x, y, z)));
    let have_directions = all().fold(true, |all, n| {
        let squared = n.length_squared();
        all & squared.is_finite() & (squared >= f64::MIN_POSITIVE)
    });
    if !have_directions {
        return all().enumerate().find(|(_, n)| !n.is_direction());
    }
    for ((x, y), z) in xs.iter_mut().zip(ys).zip(zs) {
        let n = vector((x, y, z));
        let squared = n.length_squared();
        let unit = n * (1.0 / squared.sqrt());
        // A unit vector as exact as its type can hold it stays what it is: what was written is read back.
        let is_unit = (squared - 1.0).abs() <= 4.0 * T::epsilon().f64();
        let chosen = |old: &T, new: f64| if is_unit { *old } else { T::of(new) };
        [*x, *y, *z] = [chosen(x, unit.x), chosen(y, unit.y), chosen(z, unit.z)];
    }
    None
}
