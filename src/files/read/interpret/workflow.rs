//! Workflows: diffuse and specular from the linear maps.

use rayon::prelude::*;

use svbrdf_core::material::Planes;
use svbrdf_core::math::real::Real;

use crate::read::options::{Energy, Preset, ReadOptions, Reflectance};
use crate::read::record::{Assumption, Certainty, Reason, What};
use crate::read::stored::Inferred;

/// The reflectance of dielectrics where the map of its level is 1.
const MOST_DIELECTRIC: f64 = 0.08;

/// The three planes of a colour.
type Colour<T> = [Vec<T>; 3];

/// Linear maps of one size, from which diffuse and specular follow.
pub(super) struct Reflection<T> {
    /// Diffuse, or the base colour where there is `metallic`.
    pub colour: Colour<T>,
    pub specular: Option<Colour<T>>,
    pub metallic: Option<Vec<T>>,
    /// The reflectance of dielectrics, 1 for 0.08.
    pub level: Option<Vec<T>>,
}

/// Diffuse and specular of a material; the choices that are made here are recorded.
pub(super) fn separated<T: Real>(
    maps: Reflection<T>,
    energy: Inferred<Energy>,
    options: &ReadOptions,
    assumptions: &mut Vec<Assumption>,
) -> (Colour<T>, Colour<T>) {
    let Reflection { colour, specular, metallic, level } = maps;
    let dielectric = options.dielectric.unwrap_or(Reflectance::DIELECTRIC);
    let reflectance =
        |i: usize| level.as_ref().map_or(dielectric.value(), |level| MOST_DIELECTRIC * level[i].f64());
    let (mut diffuse, specular) = match (metallic, specular) {
        (Some(metallic), _) => {
            from_base(colour, metallic, reflectance, options.preset == Some(Preset::MatFusion))
        }
        (None, Some(specular)) => (colour, specular),
        (None, None) => {
            if level.is_none() {
                assumptions.push(missing_specular(options.dielectric));
            }
            let plane = |_| (0..colour[0].len()).into_par_iter().map(|i| T::of(reflectance(i))).collect();
            let specular = [0, 1, 2].map(plane);
            (colour, specular)
        }
    };
    unscale_diffuse(&mut diffuse, &specular, energy, options, assumptions);
    (diffuse, specular)
}

fn missing_specular(given: Option<Reflectance>) -> Assumption {
    match given {
        Some(dielectric) => Assumption::given(What::Missing, format!("specular {dielectric}")),
        None => {
            let chosen = format!("specular {}", Reflectance::DIELECTRIC);
            Assumption::new(What::Missing, chosen, Reason::NoSpecularMap, Certainty::Likely)
        }
    }
}

/// d = b (1 - m) and s = f (1 - m) + b m, or s = f + b m where the reflectance f is `added`.
///
/// Diffuse takes the place of the base colour, and a channel of specular that of metallic.
fn from_base<T: Real>(
    mut base: Colour<T>,
    mut metallic: Vec<T>,
    reflectance: impl Fn(usize) -> f64 + Sync,
    added: bool,
) -> (Colour<T>, Colour<T>) {
    const CHUNK: usize = 1 << 14;
    let [mut red, mut green] = [0; 2].map(|_| vec![T::zero(); metallic.len()]);
    let diffuse = base.each_mut().map(|plane| plane.par_chunks_mut(CHUNK));
    let specular = [&mut red, &mut green, &mut metallic].map(|plane| plane.par_chunks_mut(CHUNK));
    let ([d0, d1, d2], [s0, s1, s2]) = (diffuse, specular);
    let chunks = d0.zip(d1).zip(d2).zip(s0.zip(s1).zip(s2)).enumerate();
    chunks.for_each(|(number, (((d0, d1), d2), ((s0, s1), s2)))| {
        let separate = |index: usize, m: f64, value: &mut T| {
            let b = value.f64();
            *value = T::of(b * (1.0 - m));
            let share = if added { 1.0 } else { 1.0 - m };
            T::of((reflectance(number * CHUNK + index) * share + b * m).min(1.0))
        };
        let texels = d0.iter_mut().zip(d1).zip(d2).zip(s0.iter_mut().zip(s1).zip(s2)).enumerate();
        for (index, (((d0, d1), d2), ((s0, s1), s2))) in texels {
            let m = s2.f64();
            [*s0, *s1, *s2] = [d0, d1, d2].map(|value| separate(index, m, value));
        }
    });
    (base, [red, green, metallic])
}

/// d / (1 - s), at most 1, where the renderer that these maps were made for does not scale diffuse by (1 - s).
fn unscale_diffuse<T: Real>(
    diffuse: &mut [Vec<T>; 3],
    specular: &[Vec<T>; 3],
    inferred: Inferred<Energy>,
    options: &ReadOptions,
    assumptions: &mut Vec<Assumption>,
) {
    let energy = options.energy.or(inferred.as_ref().map(|known| known.0));
    if energy != Some(Energy::Unscaled) {
        return;
    }
    let mut clamped = 0;
    for (d, s) in diffuse.iter_mut().flatten().zip(specular.iter().flatten()) {
        let (value, left) = (d.f64(), 1.0 - s.f64());
        clamped += usize::from(value > left);
        *d = if value >= left { T::of(f64::from(value > 0.0)) } else { T::of(value / left) };
    }
    let chosen = "diffuse not scaled by (1 - specular): d / (1 - s) is used";
    assumptions.push(match (options.energy, inferred) {
        (None, Some((_, why, certainty))) => Assumption::new(What::Energy, chosen, why, certainty),
        _ => Assumption::given(What::Energy, chosen),
    });
    if clamped > 0 {
        let why = Reason::MoreThanAllLight { count: clamped };
        assumptions.push(Assumption::new(What::Values, "diffuse 1", why, Certainty::Unsure));
    }
}

/// Top and bottom exchanged, and the normals with them.
pub(super) fn mirror<T: Real>(planes: &mut Planes<T>, width: usize) {
    let Planes { normal, diffuse, specular, roughness } = planes;
    normal[1].iter_mut().for_each(|y| *y = -*y);
    for plane in normal.iter_mut().chain(diffuse).chain(specular).chain([roughness]) {
        let height = plane.len() / width;
        for row in 0..height / 2 {
            let (above, below) = plane.split_at_mut((height - 1 - row) * width);
            above[row * width..(row + 1) * width].swap_with_slice(&mut below[..width]);
        }
    }
}
