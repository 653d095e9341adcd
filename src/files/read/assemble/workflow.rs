//! Workflows: diffuse and specular from the linear maps.

use rayon::prelude::*;

use svbrdf_core::math::real::Real;

use crate::read::interpret::LinearMaterial;
use crate::read::options::{Energy, Preset, ReadOptions, Reflectance};
use crate::read::record::{Assumption, Certainty, Reason, What};
use crate::read::stored::Inferred;

/// The reflectance of dielectrics where the map of its level is 1.
const MOST_DIELECTRIC: f64 = 0.08;

/// The three planes of a colour.
type Colour<T> = [Vec<T>; 3];

/// Takes diffuse and specular out of the maps of a material.
pub(super) fn separated<T: Real>(
    found: &mut LinearMaterial<T>,
    options: &ReadOptions,
) -> (Colour<T>, Colour<T>) {
    let colour = std::mem::take(&mut found.colour);
    let (specular, metallic, level) = (found.specular.take(), found.metallic.take(), found.level.take());
    let dielectric = options.dielectric.unwrap_or(Reflectance::DIELECTRIC);
    let reflectance =
        |i: usize| level.as_ref().map_or(dielectric.value(), |level| MOST_DIELECTRIC * level[i].f64());
    match (metallic, specular) {
        (Some(metallic), _) => {
            from_base(colour, metallic, reflectance, options.preset == Some(Preset::MatFusion))
        }
        (None, Some(specular)) => (colour, specular),
        (None, None) => {
            if level.is_none() {
                found.assumptions.push(missing_specular(options.dielectric));
            }
            let [width, height] = found.size;
            let plane = |_| (0..width * height).into_par_iter().map(|i| T::of(reflectance(i))).collect();
            (colour, [0, 1, 2].map(plane))
        }
    }
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
pub(crate) fn unscale_diffuse<T: Real>(
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
